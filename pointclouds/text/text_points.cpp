// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/text/text_points.h"

#include <cctype>
#include <cmath>

#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/local_points.h"
#include "pointclouds/files/measure.h"
#include "pointclouds/files/number_line.h"
#include "pointclouds/files/point_fields.h"

namespace standpoint {

const CloudFormat kPts = {"pts",
                          "Leica PTS: text, a count and points",
                          ".pts",
                          false,
                          text_points::createPtsWriter,
                          text_points::readPts,
                          text_points::infoPts};
const CloudFormat kXyz = {"xyz",
                          "Text: a point per line",
                          ".xyz",
                          false,
                          text_points::createXyzWriter,
                          text_points::readXyz,
                          text_points::infoXyz};
const CloudFormat kCsv = {"csv",
                          "Text with the names of its columns first",
                          ".csv",
                          false,
                          text_points::createCsvWriter,
                          text_points::readXyz,
                          text_points::infoCsv};

namespace text_points {
namespace {

constexpr std::size_t kChunk = 65536, kMostNumbers = 64;
constexpr std::uint64_t kHeadLines = 10, kShortestPoint = 5;

class Reader {
 public:
  Reader(InputFile file, bool counted, ScanHeader scan, PointSink& sink, Progress& progress)
      : lines_(std::move(file)), counted_(counted), scan_(std::move(scan)), sink_(sink), progress_(progress) {}
  Result<void> run(Report& report);
  // Instead of that: looks at the intensities alone. What else is wrong with the text is found when it is read.
  Result<void> measure(IntensityRange& range);

 private:
  tl::unexpected<Error> broken(const std::string& what) const {
    return failure(ErrorKind::unusable, what, lines_.place());
  }
  Result<bool> takeHead(std::string_view line);  // true when the line was no point
  void takeNames(std::string_view line);
  Result<void> beginPoints();
  Result<void> takePoint();
  Result<void> flush();

  LineReader lines_;
  bool counted_;
  ScanHeader scan_;
  PointSink& sink_;
  Progress& progress_;
  std::optional<LocalPoints> local_;
  FoundPoints found_;
  std::vector<double> numbers_;
  FieldPlaces places_;
  std::vector<std::string> names_;  // of the columns, where the file says them
  std::optional<FieldTaker> taker_;
  std::size_t width_ = 0;      // numbers of each point, as of the first
  std::uint64_t missing_ = 0;  // points of the block that are still to come
  std::uint64_t surplus_ = 0;
};

Result<bool> Reader::takeHead(std::string_view line) {
  const bool numbers = numbersOf(line, kMostNumbers, numbers_);
  if (numbers && numbers_.empty()) return true;  // blanks
  if (counted_ && missing_ == 0) {
    if (numbers && width_ > 0 && numbers_.size() == width_) return ++surplus_, true;
    if (!numbers || numbers_.size() != 1 || !(numbers_[0] >= 0) || numbers_[0] != std::floor(numbers_[0]))
      return broken("a PTS block must start with its point count");
    if (numbers_[0] > static_cast<double>(lines_.left() / kShortestPoint + 1))
      return broken("the file is truncated: it has no space for " + std::string(trimmed(line)) + " points");
    missing_ = static_cast<std::uint64_t>(numbers_[0]);
    return true;
  }
  if (numbers) return false;
  if (!counted_ && width_ == 0 && lines_.line() <= kHeadLines) return takeNames(line), true;
  return broken("a point must be a line of numbers");
}

// "//X Y Z R G B Intensity", "x,y,z" and their like; other words are no names of columns.
void Reader::takeNames(std::string_view line) {
  using F = PointField;
  constexpr std::pair<const char*, F> kNames[] = {{"x", F::x},
                                                  {"y", F::y},
                                                  {"z", F::z},
                                                  {"r", F::red},
                                                  {"g", F::green},
                                                  {"b", F::blue},
                                                  {"red", F::red},
                                                  {"green", F::green},
                                                  {"blue", F::blue},
                                                  {"intensity", F::intensity},
                                                  {"i", F::intensity},
                                                  {"time", F::time},
                                                  {"channel", F::channel},
                                                  {"returnnumber", F::return_number},
                                                  {"numberofreturns", F::return_count},
                                                  {"truex", F::true_x},
                                                  {"truey", F::true_y},
                                                  {"truez", F::true_z},
                                                  {"truerange", F::true_range},
                                                  {"incidence", F::incidence},
                                                  {"receivedpower", F::received_power},
                                                  {"flags", F::flags}};
  FieldPlaces places;
  std::vector<std::string> names;
  constexpr std::string_view kBetween = " \t\r,;/#\"";
  for (std::size_t from = line.find_first_not_of(kBetween); from < line.size();
       from = line.find_first_not_of(kBetween, from)) {
    const std::size_t end = std::min(line.find_first_of(kBetween, from), line.size());
    std::string name;
    for (const char c : line.substr(from, end - from))
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const auto& [known, field] : kNames)
      if (name == known && !places[field]) places[field] = names.size();
    names.push_back(std::move(name));
    from = end;
  }
  if (!places.all(F::x, F::z) || names.size() > kMostNumbers) return;
  places_ = places;
  names_ = std::move(names);
}

// Without names the width says what the numbers are.
Result<void> Reader::beginPoints() {
  using F = PointField;
  width_ = numbers_.size();
  if (width_ < 3) return broken("a point must have at least x y z");
  if (names_.size() != width_) {
    names_.clear();
    places_ = {};
    for (std::size_t k = 0; k < 3; ++k) places_.at[k] = k;
    if (width_ != 3 && width_ != 6) places_[F::intensity] = 3;
    if (width_ == 6 || width_ == 7)
      for (std::size_t k = 0; k < 3; ++k) places_.at[static_cast<std::size_t>(F::red) + k] = width_ - 3 + k;
  }
  if (!places_[F::intensity]) scan_.intensity_min = scan_.intensity_max = 0;
  taker_.emplace(places_, scan_, false);
  local_.emplace(sink_, scan_, true);
  return {};
}

Result<void> Reader::takePoint() {
  if (width_ == 0)
    if (auto begun = beginPoints(); !begun) return begun;
  if (numbers_.size() != width_)
    return broken("this point has " + std::to_string(numbers_.size()) + " numbers, previous points have " +
                  std::to_string(width_));
  if (scan_.has_colour)
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = numbers_[*places_.at[static_cast<std::size_t>(PointField::red) + k]];
      if (!(value >= 0 && value <= 255)) return broken("a colour is outside 0 to 255");
    }
  return taker_->take(numbers_, found_);
}

Result<void> Reader::flush() {
  if (auto written = local_->write(found_); !written) return written;
  progress_.advance(lines_.fraction());
  return progress_.check();
}

Result<void> Reader::run(Report& report) {
  for (;;) {
    TRY_ASSIGN(const auto line, lines_.next());
    if (!line) break;
    TRY_ASSIGN(const auto head, takeHead(*line));
    if (head) continue;
    if (auto taken = takePoint(); !taken) return taken;
    missing_ -= counted_ ? 1 : 0;
    if (found_.size() == kChunk)
      if (auto flushed = flush(); !flushed) return flushed;
  }
  if (missing_ > 0) return broken("the file is truncated: " + std::to_string(missing_) + " points are missing");
  if (!local_) return broken("the file contains no points");
  if (auto flushed = flush(); !flushed) return flushed;
  std::string unread;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (!taker_->isRead(i)) unread += (unread.empty() ? "" : ", ") + names_[i];
  if (!unread.empty()) report.lose(lines_.name(), "skipped columns: " + unread);
  taker_->list(lines_.name(), report);
  if (names_.empty() && width_ != 3 && width_ != 4 && width_ != 6 && width_ != 7)
    report.lose(lines_.name(),
                "points have " + std::to_string(width_) +
                    " numbers; only x y z and intensity (fourth) were read, since the others are not named");
  if (surplus_ > 0) report.lose(lines_.name(), std::to_string(surplus_) + " points exceed the specified count");
  return local_->finish(report);
}

Result<void> Reader::measure(IntensityRange& range) {
  for (std::uint64_t lines = 1;; ++lines) {
    TRY_ASSIGN(const auto line, lines_.next());
    if (!line) return {};
    if (width_ == 0 || (counted_ && missing_ == 0)) {
      TRY_ASSIGN(const auto head, takeHead(*line));
      if (head) continue;
      if (auto begun = beginPoints(); !begun) return begun;
      if (!places_[PointField::intensity]) return {};
    }
    using Words = NumberLine<Between::blanks_and_commas>;
    Words words(*line);
    std::size_t before = 0;
    while (before < *places_[PointField::intensity] && words.skip()) ++before;
    double value = 0;
    const auto word = words.next(value);
    if (before == 0 && word == Words::Word::end) continue;  // blanks
    if (word == Words::Word::number && std::isfinite(static_cast<float>(value))) range.add(static_cast<float>(value));
    missing_ -= counted_ ? 1 : 0;
    if (lines % kChunk != 0) continue;
    progress_.advance(lines_.fraction());
    if (auto going = progress_.check(); !going) return going;
  }
}

Result<void> readOnce(const std::filesystem::path& path, bool counted, const ScanHeader& scan, PointSink& sink,
                      Report& report, Progress& progress) {
  TRY_ASSIGN(auto file, InputFile::open(path));
  return Reader(std::move(file), counted, scan, sink, progress).run(report);
}

// The text states no limits of intensity, and a header comes before its points: they are looked at first.
Result<Report> read(const std::filesystem::path& path, bool counted, PointSink& sink, Progress& progress) {
  ScanHeader scan;
  scan.name = path.stem().string();
  Report report;
  IntensityRange range;
  progress.stage("Measuring " + path.filename().string(), 0, 0.5);
  TRY_ASSIGN(auto file, InputFile::open(path));
  TRY(Reader(std::move(file), counted, scan, range, progress).measure(range));
  range.putInto(scan);
  progress.stage("Reading " + path.filename().string(), 0.5, 1);
  TRY(readOnce(path, counted, scan, sink, report, progress));
  return report;
}

Result<CloudInfo> info(const std::filesystem::path& path, bool counted, const char* name) {
  PointCounter counter;
  Progress progress;
  CloudInfo info{.format = name};
  ScanHeader scan;
  scan.name = path.stem().string();
  TRY(readOnce(path, counted, scan, counter, info.report, progress));
  info.scans = std::move(counter.scans);
  return info;
}

}  // namespace

Result<Report> readPts(const std::filesystem::path& file, PointSink& sink, Progress& progress) {
  return read(file, true, sink, progress);
}
Result<Report> readXyz(const std::filesystem::path& file, PointSink& sink, Progress& progress) {
  return read(file, false, sink, progress);
}
Result<CloudInfo> infoPts(const std::filesystem::path& file) { return info(file, true, kPts.name); }
Result<CloudInfo> infoXyz(const std::filesystem::path& file) { return info(file, false, kXyz.name); }
Result<CloudInfo> infoCsv(const std::filesystem::path& file) { return info(file, false, kCsv.name); }

}  // namespace text_points
}  // namespace standpoint
