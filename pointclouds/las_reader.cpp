// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>

#include "pointclouds/las.h"
#include "pointclouds/las_header.h"
#include "pointclouds/local_points.h"

namespace standpoint {

const CloudFormat kLas = {"las", "ASPRS LAS 1.0 to 1.4: one cloud with intensity and colour", ".las", false,
                          nullptr, las::read, las::info};
const CloudFormat kLaz = {"laz", "LASzip: recognised only", ".laz", false, nullptr, las::read, las::info};

namespace las {
namespace {

constexpr std::uint64_t kChunk = 65536, kChunkBytes = 8 << 20;
constexpr std::uint64_t kProbes = 64, kProbeRecords = 1024;

std::uint64_t recordsAtOnce(const Header& header) {
  return std::clamp<std::uint64_t>(kChunkBytes / header.record_bytes, 1, kChunk);
}

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

class Records {
 public:
  Records(const InputFile& file, const Header& header) : file_(file), header_(header) {}
  // Of `count` records from the given one; the header was checked against the size of the file.
  Result<const std::uint8_t*> at(std::uint64_t first, std::uint64_t count) {
    bytes_.resize(count * header_.record_bytes);
    const auto n = file_.read(header_.points_at + first * header_.record_bytes, bytes_);
    if (!n) return failure(n.error());
    if (*n < bytes_.size())
      return failure(ErrorKind::unusable, "the file became shorter while it was read",
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
    const auto bytes = records.at(first, count);
    if (!bytes) return failure(bytes.error());
    for (std::uint64_t i = 0; i < count; ++i)
      for (std::uint32_t k = 0; k < 3; ++k)
        most = std::max(most, load<std::uint16_t>(*bytes + i * header.record_bytes + colour_at + 2 * k));
  }
  return most > 0 && most <= 255;
}

void takeRecord(const std::uint8_t* record, const Header& header, int colour_shift, FoundPoints& to) {
  std::vector<double>* const axes[3] = {&to.x, &to.y, &to.z};
  for (std::size_t k = 0; k < 3; ++k)
    axes[k]->push_back(load<std::int32_t>(record + 4 * k) * header.scale[k] + header.offset[k]);
  PointBlock& block = to.columns;
  block.intensity.push_back(load<std::uint16_t>(record + 12));
  block.row.push_back(0);
  block.column.push_back(0);
  const auto colour_at = pointFormat(header).colour_at;
  if (colour_at == 0) return;
  std::vector<std::uint8_t>* const colours[3] = {&block.red, &block.green, &block.blue};
  for (std::size_t k = 0; k < 3; ++k) {
    const int value = load<std::uint16_t>(record + colour_at + 2 * k) >> colour_shift;
    colours[k]->push_back(static_cast<std::uint8_t>(std::min(value, 255)));
  }
}

ScanHeader scanHeader(const std::filesystem::path& file, const Header& header) {
  ScanHeader scan;
  scan.name = file.stem().string();
  scan.intensity_max = 65535;
  scan.has_colour = pointFormat(header).colour_at != 0;
  scan.coordinate_metadata = header.wkt;
  return scan;
}

void listUnread(const Header& header, const std::string& source, Report& report) {
  std::string fields = pointFormat(header).not_read;
  if (const auto extra = header.record_bytes - pointFormat(header).bytes; extra > 0)
    fields += ", " + std::to_string(extra) + " extra bytes";
  report.lose(source, "fields that are not read: " + fields);
  if (header.wkt.empty() && !header.epsg.empty())
    report.warn(source,
                "GeoTIFF keys say " + header.epsg + ": an underlay is placed by it, a converted file has it not");
}

}  // namespace

Result<Report> read(const std::filesystem::path& path, PointSink& sink, Progress& progress) {
  auto file = InputFile::open(path);
  if (!file) return failure(file.error());
  progress.stage("Reading " + file->name());
  Report report;
  const auto header = readHeader(*file, report);
  if (!header) return failure(header.error());
  listUnread(*header, file->name(), report);
  const ScanHeader scan = scanHeader(path, *header);
  int colour_shift = 8;
  if (scan.has_colour) {
    const auto bytes = coloursAreBytes(*file, *header);
    if (!bytes) return failure(bytes.error());
    if (*bytes) report.warn(file->name(), "colours are at most 255: they are taken as 8 bits, though LAS has 16");
    if (*bytes) colour_shift = 0;
  }
  const double finest = std::min({std::abs(header->scale[0]), std::abs(header->scale[1]), std::abs(header->scale[2])});
  LocalPoints local(sink, scan, true, finest / 2);
  Records records(*file, *header);
  FoundPoints found;
  for (std::uint64_t done = 0; done < header->points;) {
    const auto count = std::min(recordsAtOnce(*header), header->points - done);
    const auto bytes = records.at(done, count);
    if (!bytes) return failure(bytes.error());
    for (std::uint64_t i = 0; i < count; ++i)
      takeRecord(*bytes + i * header->record_bytes, *header, colour_shift, found);
    if (auto written = local.write(found); !written) return failure(written.error());
    done += count;
    progress.advance(static_cast<double>(done) / static_cast<double>(header->points));
    if (auto going = progress.check(); !going) return failure(going.error());
  }
  if (auto finished = local.finish(report); !finished) return failure(finished.error());
  return report;
}

Result<CloudInfo> info(const std::filesystem::path& path) {
  auto file = InputFile::open(path);
  if (!file) return failure(file.error());
  CloudInfo info{.format = kLas.name};
  const auto header = readHeader(*file, info.report);
  if (!header) return failure(header.error());
  info.scans.push_back({scanHeader(path, *header), header->points});
  info.crs = header->wkt.empty() ? header->epsg : header->wkt;
  return info;
}

}  // namespace las
}  // namespace standpoint
