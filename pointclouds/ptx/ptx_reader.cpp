// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/decompositions.h"
#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/local_points.h"
#include "pointclouds/files/measure.h"
#include "pointclouds/files/number_line.h"
#include "pointclouds/ptx/ptx.h"

namespace standpoint {

const CloudFormat kPtx = {
    "ptx", "Leica PTX: text, whole grids with poses", ".ptx", true, ptx::createWriter, ptx::read, ptx::info};

namespace ptx {
namespace {

constexpr std::size_t kChunk = 65536;
constexpr std::uint64_t kShortestCell = 4;  // bytes of a line; a grid that the file has no room for is refused at once
constexpr double kLargestSide = 1 << 30;

// Blank-separated numbers of a line; nothing when one of them is none, or when there are more than fit.
struct Numbers {
  std::array<double, 8> value{};
  std::size_t count = 0;
};

bool numbersOf(std::string_view line, Numbers& numbers) {
  numbers.count = 0;
  using Words = NumberLine<Between::blanks>;
  Words words(line);
  for (;;) {
    double value = 0;
    const auto word = words.next(value);
    if (word == Words::Word::end) return true;
    if (word == Words::Word::none || numbers.count == numbers.value.size()) return false;
    numbers.value[numbers.count++] = value;
  }
}

// What stands above a scan's cells.
struct Frame {
  std::uint32_t columns = 0, rows = 0;
  Pose pose;
  std::optional<Eigen::Matrix3d> stretch;  // applied to the points when it is no rotation
};

class Reader {
 public:
  Reader(InputFile file, PointSink& sink, Progress& progress)
      : lines_(std::move(file)), sink_(sink), progress_(progress) {}
  Result<Report> read();

 private:
  tl::unexpected<Error> broken(const std::string& what) const {
    return failure(ErrorKind::unusable, what, lines_.place());
  }
  Result<std::optional<std::string_view>> firstLine();
  Result<Numbers> headerLine(std::size_t count);
  Result<Frame> readFrame(std::string_view columns);
  void setPose(const Eigen::Matrix4d& matrix, Frame& frame);
  Result<void> readScan(const Frame& frame);
  Result<void> readCells(const Frame& frame, LocalPoints& local);
  Result<void> takeCell(const Frame& frame, FoundPoints& to);
  Result<void> nextCell();  // into cell_

  LineReader lines_;
  PointSink& sink_;
  Progress& progress_;
  Report report_;
  std::size_t scans_ = 0;
  std::string scan_name_;
  bool has_colour_ = false;
  std::uint64_t colours_lost_ = 0, colours_missing_ = 0;
  Numbers cell_;
  std::uint32_t row_ = 0, column_ = 0;  // of cell_
};

// Blank lines between scans and at the end are forgiven.
Result<std::optional<std::string_view>> Reader::firstLine() {
  for (;;) {
    const auto line = lines_.next();
    if (!line || !*line || !trimmed(**line).empty()) return line;
  }
}

Result<Numbers> Reader::headerLine(std::size_t count) {
  TRY_ASSIGN(const auto line, lines_.next());
  if (!line) return broken("the file is truncated inside a scan header");
  Numbers numbers;
  if (!numbersOf(*line, numbers) || numbers.count != count)
    return broken("a PTX header has " + std::to_string(count) + " numbers here");
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(numbers.value[i])) return broken("a number of the header is not finite");
  return numbers;
}

void Reader::setPose(const Eigen::Matrix4d& matrix, Frame& frame) {
  // PTX multiplies row vectors from the left.
  const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>().transpose();
  frame.pose.translation = matrix.row(3).head<3>();
  const double skew = (linear * linear.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(skew < 1e-3) || linear.determinant() < 0) {
    frame.stretch = linear;
    report_.warn(lines_.place(),
                 "the matrix is not a rotation: applied to the points; the pose keeps only the position");
    return;
  }
  if (skew > 1e-9)
    report_.note(lines_.place(), "the matrix is a rotation to " + numberText(static_cast<float>(skew)) +
                                     " only: using the nearest rotation");
  const auto [u, values, v] = singularValues(linear);
  const Eigen::Matrix3d nearest = skew > 1e-9 ? Eigen::Matrix3d(u * v.transpose()) : linear;
  frame.pose.rotation = Eigen::Quaterniond(nearest).normalized();
  if (frame.pose.rotation.w() < 0) frame.pose.rotation.coeffs() *= -1;
}

Result<Frame> Reader::readFrame(std::string_view columns_line) {
  Numbers columns;
  if (!numbersOf(columns_line, columns) || columns.count != 1)
    return broken("a PTX scan must start with its number of columns");
  TRY_ASSIGN(const auto rows, headerLine(1));
  const auto side = [](double n) { return n >= 0 && n <= kLargestSide && n == std::floor(n); };
  if (!side(columns.value[0]) || !side(rows.value[0])) return broken("columns and rows are not valid counts");
  Frame frame{static_cast<std::uint32_t>(columns.value[0]), static_cast<std::uint32_t>(rows.value[0])};
  if (std::uint64_t{frame.columns} * frame.rows > lines_.left() / kShortestCell)
    return broken("the file is too short for " + std::to_string(frame.columns) + " columns of " +
                  std::to_string(frame.rows) + " rows");
  for (int i = 0; i < 4;
       ++i)  // position and axes in the scanner's own survey: the matrix says what they mean for the file
    TRY(headerLine(3));
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 4; ++i) {
    TRY_ASSIGN(const auto row, headerLine(4));
    for (int k = 0; k < 4; ++k) matrix(i, k) = row.value[static_cast<std::size_t>(k)];
  }
  setPose(matrix, frame);
  return frame;
}

Result<void> Reader::nextCell() {
  TRY_ASSIGN(const auto line, lines_.next());
  if (!line) return broken("the file is truncated inside a scan");
  if (!numbersOf(*line, cell_) || (cell_.count != 4 && cell_.count != 7))
    return broken("a PTX point must have 4 or 7 numbers: x y z intensity [red green blue]");
  return {};
}

Result<void> Reader::takeCell(const Frame& frame, FoundPoints& to) {
  const auto& v = cell_.value;
  if (v[0] == 0 && v[1] == 0 && v[2] == 0) return {};  // nothing came back
  const Eigen::Vector3d raw(v[0], v[1], v[2]);
  const Eigen::Vector3d point = frame.stretch ? Eigen::Vector3d(*frame.stretch * raw) : raw;
  to.x.push_back(point.x());
  to.y.push_back(point.y());
  to.z.push_back(point.z());
  PointBlock& block = to.columns;
  block.intensity.push_back(static_cast<float>(v[3]));
  block.row.push_back(row_);
  block.column.push_back(column_);
  const bool coloured = cell_.count == 7;
  if (!has_colour_) {
    colours_lost_ += coloured;
    return {};
  }
  colours_missing_ += !coloured;
  std::vector<std::uint8_t>* const colours[3] = {&block.red, &block.green, &block.blue};
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = coloured ? v[4 + k] : 0;
    if (!(value >= 0 && value <= 255)) return broken("a colour is outside 0 to 255");
    colours[k]->push_back(static_cast<std::uint8_t>(value + 0.5));
  }
  return {};
}

// The first cell is in cell_.
Result<void> Reader::readCells(const Frame& frame, LocalPoints& local) {
  const std::uint64_t cells = std::uint64_t{frame.columns} * frame.rows;
  FoundPoints found;
  row_ = column_ = 0;
  for (std::uint64_t done = 1;; ++done) {
    if (auto taken = takeCell(frame, found); !taken) return taken;
    if (++row_ == frame.rows) row_ = 0, ++column_;
    if (found.size() == kChunk || done == cells || done % kChunk == 0) {
      if (auto written = local.write(found); !written) return written;
      progress_.advance(lines_.fraction());
      if (auto going = progress_.check(); !going) return going;
    }
    if (done == cells) return {};
    if (auto next = nextCell(); !next) return next;
  }
}

Result<void> Reader::readScan(const Frame& frame) {
  ScanHeader header;
  header.name = scan_name_;
  header.rows = frame.rows;
  header.columns = frame.columns;
  header.file_from_scanner = frame.pose;
  const bool any = frame.rows > 0 && frame.columns > 0;
  cell_.count = 0;
  if (any)
    if (auto first = nextCell(); !first) return first;
  header.has_colour = has_colour_ = cell_.count == 7;
  colours_lost_ = colours_missing_ = 0;
  LocalPoints local(sink_, header, true);
  if (any)
    if (auto read = readCells(frame, local); !read) return read;
  if (colours_lost_ > 0)
    report_.lose(scan_name_, std::to_string(colours_lost_) + " points have a colour, but the first cell has none");
  if (colours_missing_ > 0)
    report_.warn(scan_name_, std::to_string(colours_missing_) + " points without colour were set to black");
  return local.finish(report_);
}

Result<Report> Reader::read() {
  progress_.stage("Reading " + lines_.name());
  for (;;) {
    TRY_ASSIGN(const auto line, firstLine());
    if (!line) break;
    TRY_ASSIGN(const auto frame, readFrame(*line));
    scan_name_ = "Scan " + std::to_string(++scans_);
    TRY(readScan(frame));
  }
  if (scans_ == 0) return broken("the file contains no scan");
  return report_;
}

}  // namespace

Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(auto input, InputFile::open(file));
  return Reader(std::move(input), sink, progress).read();
}

Result<CloudInfo> info(const std::filesystem::path& file) {
  PointCounter counter;
  Progress progress;
  TRY_ASSIGN(auto report, read(file, counter, progress));
  return CloudInfo{kPtx.name, std::move(counter.scans), std::move(report)};
}

}  // namespace ptx
}  // namespace standpoint
