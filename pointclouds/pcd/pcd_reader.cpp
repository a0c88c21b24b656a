// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>

#include "pointclouds/files/measure.h"
#include "pointclouds/files/number_line.h"
#include "pointclouds/files/record_points.h"
#include "pointclouds/pcd/pcd.h"
#include "pointclouds/pcd/pcd_header.h"

namespace standpoint::pcd {
namespace {

// A colour is packed into an integer, or into the bits of a float.
double packed(const Field& field, double value) {
  if (field.type != PlyType::float32)
    return field.type == PlyType::int32
               ? static_cast<double>(static_cast<std::uint32_t>(static_cast<std::int64_t>(value)))
               : value;
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

class Reading {
 public:
  Reading(const std::filesystem::path& path, const Header& header, ScanHeader scan)
      : path_(path),
        header_(header),
        scan_(std::move(scan)),
        places_(placesOf(header)),
        taker_(places_, scan_, false) {}
  Result<void> run(PointSink& sink, Report& report, Progress& progress);
  bool isRead(std::size_t field) const { return taker_.isRead(field); }
  const ScanHeader& scan() const { return scan_; }

 private:
  // Behind the fields stand row and column, which an organised file says by the order of its points.
  static FieldPlaces placesOf(const Header& header) {
    FieldPlaces places = header.places;
    if (!header.organised()) return places;
    places[PointField::row] = header.fields.size();
    places[PointField::column] = header.fields.size() + 1;
    return places;
  }
  Result<void> readText(LocalPoints& local, Progress& progress);
  Result<void> readBinary(LocalPoints& local, Progress& progress);
  Result<void> take(std::uint64_t index, FoundPoints& to);  // of values_
  const std::filesystem::path& path_;
  const Header& header_;
  ScanHeader scan_;
  FieldPlaces places_;
  FieldTaker taker_;
  std::vector<double> values_;
};

Result<void> Reading::take(std::uint64_t index, FoundPoints& to) {
  for (const PointField axis : {PointField::x, PointField::y, PointField::z})
    if (!std::isfinite(values_[*places_[axis]])) return {};  // a cell without a point
  if (const auto& rgb = places_[PointField::packed_colour]) values_[*rgb] = packed(header_.fields[*rgb], values_[*rgb]);
  if (header_.organised()) {
    values_[header_.fields.size()] = static_cast<double>(index % header_.width);
    values_[header_.fields.size() + 1] = static_cast<double>(index / header_.width);
  }
  return taker_.take(values_, to);
}

Result<void> Reading::readBinary(LocalPoints& local, Progress& progress) {
  const PointRecords records{"point", header_.points_at, header_.points, header_.point_bytes};
  return readRecordPoints(path_, records, local, progress,
                          [&](std::uint64_t index, const std::uint8_t* bytes, FoundPoints& to) {
                            for (std::size_t k = 0; k < header_.fields.size(); ++k)
                              values_[k] = plyNumber(header_.fields[k].type, bytes + header_.fields[k].at, false);
                            return take(index, to);
                          });
}

Result<void> Reading::readText(LocalPoints& local, Progress& progress) {
  TRY_ASSIGN(auto file, InputFile::open(path_));
  LineReader lines(std::move(file));
  TRY(readHeader(lines));
  std::vector<double> numbers;
  FoundPoints found;
  for (std::uint64_t i = 0; i < header_.points; ++i) {
    TRY_ASSIGN(const auto line, lines.next());
    if (!line) return failure(ErrorKind::unusable, "the file is truncated before its last point", lines.place());
    if (!numbersOf(*line, header_.words, numbers) || numbers.size() != header_.words)
      return failure(ErrorKind::unusable, "a point has " + std::to_string(header_.words) + " numbers here",
                     lines.place());
    for (std::size_t k = 0; k < header_.fields.size(); ++k) values_[k] = numbers[header_.fields[k].word];
    if (auto taken = take(i, found); !taken) return failure(ErrorKind::unusable, taken.error().message, lines.place());
    if (i % kPointsAtOnce != kPointsAtOnce - 1 && i + 1 != header_.points) continue;
    if (auto written = local.write(found); !written) return written;
    progress.advance(static_cast<double>(i + 1) / static_cast<double>(header_.points));
    if (auto going = progress.check(); !going) return going;
  }
  return {};
}

Result<void> Reading::run(PointSink& sink, Report& report, Progress& progress) {
  bool single = header_.binary;
  for (std::size_t k = 0; k < 3; ++k) single &= header_.fields[*places_.at[k]].type == PlyType::float32;
  LocalPoints local(sink, scan_, !single);
  values_.resize(header_.fields.size() + 2);
  const auto read = header_.binary ? readBinary(local, progress) : readText(local, progress);
  if (!read) return read;
  taker_.list(path_.filename().string(), report);
  return local.finish(report);
}

struct Opened {
  Header header;
  ScanHeader scan;
  std::string unread;
};

Result<Opened> open(const std::filesystem::path& path) {
  TRY_ASSIGN(auto file, InputFile::open(path));
  LineReader lines(std::move(file));
  TRY_ASSIGN(auto header, readHeader(lines));
  ScanHeader scan = header.scan;
  if (scan.name.empty()) scan.name = path.stem().string();
  if (header.organised()) {
    constexpr std::uint64_t kLongestSide = 1 << 30;
    if (header.width > kLongestSide || header.height > kLongestSide)
      return failure(ErrorKind::unusable, "WIDTH or HEIGHT of the grid is too large", lines.name());
    scan.rows = static_cast<std::uint32_t>(header.width);
    scan.columns = static_cast<std::uint32_t>(header.height);
  }
  if (!header.places[PointField::intensity]) scan.intensity_max = scan.intensity_min = 0;
  const Reading reading(path, header, scan);
  std::string unread;
  for (std::size_t i = 0; i < header.fields.size(); ++i)
    if (header.fields[i].name != "_" && !reading.isRead(i))
      unread += (unread.empty() ? "" : ", ") + header.fields[i].name;
  scan = reading.scan();
  return Opened{std::move(header), std::move(scan), std::move(unread)};
}

void listUnread(const Opened& opened, const std::string& source, Report& report) {
  if (!opened.unread.empty()) report.lose(source, "skipped fields: " + opened.unread);
}

}  // namespace

Result<Report> read(const std::filesystem::path& path, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(auto opened, open(path));
  Report report;
  const std::string name = path.filename().string();
  listUnread(opened, name, report);
  const bool ours = !opened.header.scan.guid.empty() || !opened.header.scan.name.empty();
  if (opened.header.places[PointField::intensity] && !ours) {  // the file states no limits: they are looked at first
    IntensityRange range;
    Report ignored;
    progress.stage("Measuring " + name, 0, 0.5);
    TRY(Reading(path, opened.header, opened.scan).run(range, ignored, progress));
    range.putInto(opened.scan);
  }
  progress.stage("Reading " + name, ours ? 0 : 0.5, 1);
  TRY(Reading(path, opened.header, opened.scan).run(sink, report, progress));
  return report;
}

Result<CloudInfo> info(const std::filesystem::path& path) {
  TRY_ASSIGN(auto opened, open(path));
  CloudInfo info{.format = kPcd.name, .crs = opened.scan.coordinate_metadata};
  listUnread(opened, path.filename().string(), info.report);
  info.scans.push_back({std::move(opened.scan), opened.header.points});
  return info;
}

}  // namespace standpoint::pcd
