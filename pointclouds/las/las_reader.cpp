// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "pointclouds/files/local_points.h"
#include "pointclouds/las/las.h"
#include "pointclouds/las/las_header.h"

namespace standpoint {

namespace las {
namespace {
template <bool near_infrared>
Result<std::unique_ptr<CloudWriter>> writer(const std::filesystem::path& file) {
  return createWriter(file, near_infrared);
}
constexpr CloudVariant kVariants[] = {{"pdrf8", "point format 8: near infrared is stored as 0", writer<true>}};
}  // namespace
}  // namespace las

const CloudFormat kLas = {"las",
                          "ASPRS LAS: read 1.0 to 1.4, written 1.4 with labels and truth as extra bytes",
                          ".las",
                          true,
                          las::writer<false>,
                          las::read,
                          las::info,
                          las::kVariants};
const CloudFormat kLaz = {"laz", "LASzip: recognised only", ".laz", false, nullptr, las::read, las::info};

namespace las {
namespace {

constexpr std::uint64_t kChunk = 65536, kChunkBytes = 8 << 20;
constexpr std::uint64_t kProbes = 64, kProbeRecords = 1024;

std::uint64_t recordsAtOnce(const Header& header) {
  return std::clamp<std::uint64_t>(kChunkBytes / header.record_bytes, 1, kChunk);
}

class Records {
 public:
  Records(const InputFile& file, const Header& header) : file_(file), header_(header) {}
  // Of `count` records from the given one; the header was checked against the size of the file.
  Result<const std::uint8_t*> at(std::uint64_t first, std::uint64_t count) {
    bytes_.resize(count * header_.record_bytes);
    TRY_ASSIGN(const auto n, file_.read(header_.points_at + first * header_.record_bytes, bytes_));
    if (n < bytes_.size())
      return failure(ErrorKind::unusable, "the file was truncated while reading",
                     file_.name() + " point " + std::to_string(first));
    return bytes_.data();
  }

 private:
  const InputFile& file_;
  const Header& header_;
  std::vector<std::uint8_t> bytes_;
};

// LAS wants 16 bits; many writers put 8 in. Looked at in records spread evenly over the file.
Result<bool> coloursAreBytes(const InputFile& file, const Header& header) {
  Records records(file, header);
  const auto colour_at = pointFormat(header).colour_at;
  std::uint16_t most = 0;
  for (std::uint64_t probe = 0; probe < kProbes; ++probe) {
    const std::uint64_t first = header.points / kProbes * probe;
    const std::uint64_t count = std::min({kProbeRecords, recordsAtOnce(header), header.points - first});
    TRY_ASSIGN(const auto bytes, records.at(first, count));
    for (std::uint64_t i = 0; i < count; ++i)
      for (std::uint32_t k = 0; k < 3; ++k)
        most = std::max(most, load<std::uint16_t>(bytes + i * header.record_bytes + colour_at + 2 * k));
  }
  return most > 0 && most <= 255;
}

// What the file says of one scan; one that is not ours has one.
struct Part {
  std::uint64_t first = 0, points = 0;
  ScanHeader header;
  bool ours = false;
  double time_shift_s = 0;  // of a point's GPS time, to the scan's own
  double intensity_scale = 1;
};

bool hasLabels(const Header& h) {
  return h.extras[Extra::product] && h.extras[Extra::material] && !h.products.empty() && !h.materials.empty();
}
bool hasTruth(const Header& h) {
  return std::all_of(h.extras.at + static_cast<int>(Extra::true_x), h.extras.at + kExtraKinds,
                     [](const auto& place) { return place.has_value(); });
}

// Turns records into the columns of a scan, in its scanner's frame.
class RecordTaker {
 public:
  RecordTaker(const Header& header, const Part& part, int colour_shift)
      : h_(header),
        part_(part),
        colour_shift_(colour_shift),
        colour_at_(pointFormat(header).colour_at),
        time_at_(pointFormat(header).time_at),
        back_(part.header.file_from_scanner.rotation.conjugate()) {}
  Result<void> take(const std::uint8_t* record, FoundPoints& to);
  std::uint64_t senseless_returns = 0, senseless_times = 0, senseless_truth = 0;

 private:
  Eigen::Vector3d local(const Eigen::Vector3d& file) const {
    return part_.ours ? Eigen::Vector3d(back_ * (file - part_.header.file_from_scanner.translation)) : file;
  }
  Result<void> takeIndices(const std::uint8_t* record, PointBlock& block);
  void takeReturn(const std::uint8_t* record, PointBlock& block);
  void takeTruth(const std::uint8_t* record, FoundPoints& to);
  const Header& h_;
  const Part& part_;
  int colour_shift_;
  std::uint32_t colour_at_, time_at_;
  Eigen::Quaterniond back_;
};

void RecordTaker::takeReturn(const std::uint8_t* record, PointBlock& block) {
  const bool wide = h_.point_format >= 6;
  const int number = record[14] & (wide ? 15 : 7), count = wide ? record[14] >> 4 : record[14] >> 3 & 7;
  const bool sensible = number >= 1 && number <= count;
  senseless_returns += !sensible;
  block.return_number.push_back(static_cast<std::uint8_t>(sensible ? number : 1));
  block.return_count.push_back(static_cast<std::uint8_t>(sensible ? count : 1));
}

Result<void> RecordTaker::takeIndices(const std::uint8_t* record, PointBlock& block) {
  const ScanHeader& scan = part_.header;
  const bool grid = scan.rows > 0 && scan.columns > 0;
  const auto row = grid ? load<std::uint32_t>(record + *h_.extras[Extra::row]) : 0;
  const auto column = grid ? load<std::uint32_t>(record + *h_.extras[Extra::column]) : 0;
  if (grid && (row >= scan.rows || column >= scan.columns))
    return failure(ErrorKind::unusable, "a point's row or column is outside the scan's grid", scan.name);
  block.row.push_back(row);
  block.column.push_back(column);
  if (!scan.has_labels) return {};
  const auto product = load<std::uint32_t>(record + *h_.extras[Extra::product]);
  const auto material = load<std::uint32_t>(record + *h_.extras[Extra::material]);
  if (product >= scan.products.size() || material >= scan.materials.size())
    return failure(ErrorKind::unusable, "a point's label is outside the label table", scan.name);
  block.product.push_back(product);
  block.material.push_back(material);
  return {};
}

void RecordTaker::takeTruth(const std::uint8_t* record, FoundPoints& to) {
  Eigen::Vector3d place;
  for (std::size_t k = 0; k < 3; ++k)
    place[static_cast<int>(k)] =
        load<std::int32_t>(record + *h_.extras.at[static_cast<std::size_t>(Extra::true_x) + k]) * h_.true_scale[k] +
        h_.true_offset[k];
  place = local(place);
  constexpr double kMost = std::numeric_limits<float>::max() / 2.0;  // as LocalPoints takes coordinates
  const auto sensible = [&](double v) {
    const bool good = std::abs(v) <= kMost;
    senseless_truth += !good;
    return good ? v : 0;
  };
  const auto real = [&](Extra kind) { return static_cast<float>(sensible(load<float>(record + *h_.extras[kind]))); };
  to.true_x.push_back(sensible(place.x())), to.true_y.push_back(sensible(place.y())),
      to.true_z.push_back(sensible(place.z()));
  PointTruth& truth = to.columns.truth;
  truth.range_m.push_back(real(Extra::true_range));
  truth.incidence_rad.push_back(real(Extra::incidence));
  truth.received_db.push_back(real(Extra::received_power));
  truth.flags.push_back(record[*h_.extras[Extra::flags]]);
}

Result<void> RecordTaker::take(const std::uint8_t* record, FoundPoints& to) {
  Eigen::Vector3d place;
  for (std::size_t k = 0; k < 3; ++k)
    place[static_cast<int>(k)] = load<std::int32_t>(record + 4 * k) * h_.scale[k] + h_.offset[k];
  place = local(place);
  to.x.push_back(place.x()), to.y.push_back(place.y()), to.z.push_back(place.z());
  PointBlock& block = to.columns;
  const double least = part_.ours ? part_.header.intensity_min : 0;
  block.intensity.push_back(static_cast<float>(load<std::uint16_t>(record + 12) * part_.intensity_scale + least));
  if (part_.header.has_time) {
    double time = load<double>(record + time_at_) + part_.time_shift_s;
    if (!std::isfinite(time)) ++senseless_times, time = 0;
    block.time_s.push_back(time);
  }
  if (part_.header.has_channel) block.channel.push_back(record[*h_.extras[Extra::channel]]);
  if (part_.header.has_returns) takeReturn(record, block);
  if (colour_at_ != 0) {
    std::vector<std::uint8_t>* const colours[3] = {&block.red, &block.green, &block.blue};
    for (std::size_t k = 0; k < 3; ++k) {
      const int value = load<std::uint16_t>(record + colour_at_ + 2 * k) >> colour_shift_;
      colours[k]->push_back(static_cast<std::uint8_t>(std::min(value, 255)));
    }
  }
  if (part_.header.has_truth) takeTruth(record, to);
  return takeIndices(record, block);
}

void complete(Part& part, const Header& header) {
  ScanHeader& scan = part.header;
  scan.has_colour = pointFormat(header).colour_at != 0;
  scan.coordinate_metadata = header.wkt;
  scan.has_channel = header.extras[Extra::channel].has_value();
  scan.has_returns = true;
  scan.has_truth = hasTruth(header);
  if ((scan.has_labels = hasLabels(header))) scan.products = header.products, scan.materials = header.materials;
  if (!header.extras[Extra::row] || !header.extras[Extra::column]) scan.rows = scan.columns = 0;
}

Result<std::vector<Part>> partsOf(const std::filesystem::path& path, const InputFile& file, const Header& header) {
  std::vector<Part> parts;
  for (const OurScan& ours : header.scans) {
    Part part{parts.empty() ? 0 : parts.back().first + parts.back().points, ours.points, ours.header, true};
    const double range = part.header.intensity_max - part.header.intensity_min;
    part.intensity_scale = std::isfinite(range) ? range / 65535 : 1;
    part.time_shift_s = kAdjustedGps_s - part.header.acquisition_start_gps_s;
    part.header.has_time &= pointFormat(header).time_at != 0;
    complete(part, header);
    parts.push_back(std::move(part));
  }
  if (!parts.empty()) return parts;
  Part whole{.points = header.points};
  whole.header.name = path.stem().string();
  whole.header.intensity_max = 65535;
  whole.header.has_time = pointFormat(header).time_at != 0;
  if (whole.header.has_time && header.adjusted_time && header.points > 0) {
    Records records(file, header);
    TRY_ASSIGN(const auto first, records.at(0, 1));
    const double start = std::floor(load<double>(first + pointFormat(header).time_at));
    if (std::abs(start) < 1e10)
      whole.time_shift_s = -start, whole.header.acquisition_start_gps_s = start + kAdjustedGps_s;
  }
  complete(whole, header);
  parts.push_back(std::move(whole));
  return parts;
}

void listUnread(const Header& header, const std::string& source, Report& report) {
  std::string fields = pointFormat(header).not_read;
  if (const auto extra = header.unread_extra_bytes; extra > 0) fields += ", " + std::to_string(extra) + " extra bytes";
  // Of a file of ours nothing is lost: class and point source follow from the labels and the stations.
  if (header.scans.empty()) report.lose(source, "skipped fields: " + fields);
  if (header.wkt.empty() && !header.epsg.empty())
    report.warn(source, "GeoTIFF keys say " + header.epsg + ": used to place underlays, not stored in converted files");
}

Result<void> readPart(const InputFile& file, const Header& header, const Part& part, int colour_shift, PointSink& sink,
                      Report& report, Progress& progress) {
  const double finest = std::min({std::abs(header.scale[0]), std::abs(header.scale[1]), std::abs(header.scale[2])});
  LocalPoints local(sink, part.header, true, finest / 2);
  Records records(file, header);
  RecordTaker taker(header, part, colour_shift);
  FoundPoints found;
  for (std::uint64_t done = 0; done < part.points;) {
    const auto count = std::min(recordsAtOnce(header), part.points - done);
    TRY_ASSIGN(const auto bytes, records.at(part.first + done, count));
    for (std::uint64_t i = 0; i < count; ++i)
      if (auto taken = taker.take(bytes + i * header.record_bytes, found); !taken)
        return failure(ErrorKind::unusable, taken.error().message,
                       file.name() + " point " + std::to_string(part.first + done + i));
    if (auto written = local.write(found); !written) return written;
    done += count;
    progress.advance(static_cast<double>(part.first + done) / static_cast<double>(header.points));
    if (auto going = progress.check(); !going) return going;
  }
  const auto number = [](std::uint64_t n) { return std::to_string(n); };
  if (taker.senseless_returns > 0)
    report.warn(file.name(), number(taker.senseless_returns) + " invalid return numbers were set to 1 of 1");
  if (taker.senseless_times > 0)
    report.lose(file.name(), number(taker.senseless_times) + " non-numeric times were set to 0");
  if (taker.senseless_truth > 0)
    report.lose(file.name(), number(taker.senseless_truth) + " non-numeric truth values were set to 0");
  return local.finish(report);
}

}  // namespace

Result<Report> read(const std::filesystem::path& path, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(auto file, InputFile::open(path));
  progress.stage("Reading " + file.name());
  Report report;
  TRY_ASSIGN(const auto header, readHeader(file, report));
  listUnread(header, file.name(), report);
  int colour_shift = 8;
  if (pointFormat(header).colour_at != 0) {
    TRY_ASSIGN(const auto bytes, coloursAreBytes(file, header));
    if (bytes) report.warn(file.name(), "colours do not exceed 255: read as 8 bits instead of 16");
    if (bytes) colour_shift = 0;
  }
  TRY_ASSIGN(const auto parts, partsOf(path, file, header));
  for (const Part& part : parts) TRY(readPart(file, header, part, colour_shift, sink, report, progress));
  return report;
}

Result<CloudInfo> info(const std::filesystem::path& path) {
  TRY_ASSIGN(auto file, InputFile::open(path));
  CloudInfo info{.format = kLas.name};
  TRY_ASSIGN(const auto header, readHeader(file, info.report));
  TRY_ASSIGN(const auto parts, partsOf(path, file, header));
  for (const Part& part : parts) info.scans.push_back({part.header, part.points});
  info.crs = header.wkt.empty() ? header.epsg : header.wkt;
  return info;
}

}  // namespace las
}  // namespace standpoint
