// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pointclouds/files/local_points.h"
#include "pointclouds/files/measure.h"
#include "pointclouds/files/number_line.h"
#include "pointclouds/files/record_points.h"
#include "pointclouds/ply/ply.h"
#include "pointclouds/ply/ply_cloud_header.h"

namespace standpoint::ply {
namespace {

class Reading {
 public:
  Reading(const std::filesystem::path& path, const Header& header, ScanHeader scan)
      : path_(path), header_(header), scan_(std::move(scan)), taker_(header.places, scan_, header.ours) {}
  Result<void> run(PointSink& sink, Report& report, Progress& progress);

 private:
  Result<void> readText(LocalPoints& local, Progress& progress);
  Result<void> readBinary(LocalPoints& local, Progress& progress);
  const std::filesystem::path& path_;
  const Header& header_;
  ScanHeader scan_;
  FieldTaker taker_;
};

Result<void> Reading::readBinary(LocalPoints& local, Progress& progress) {
  const bool turned = header_.form == PlyForm::big_endian;
  std::vector<double> values(header_.properties.size());
  const PointRecords records{"vertex", header_.vertices_at, header_.vertices, header_.vertex_bytes};
  return readRecordPoints(
      path_, records, local, progress, [&](std::uint64_t, const std::uint8_t* bytes, FoundPoints& to) {
        for (std::size_t k = 0; k < values.size(); ++k)
          values[k] = plyNumber(header_.properties[k].type, bytes + header_.properties[k].at, turned);
        return taker_.take(values, to);
      });
}

Result<void> Reading::readText(LocalPoints& local, Progress& progress) {
  TRY_ASSIGN(auto file, InputFile::open(path_));
  LineReader lines(std::move(file));
  TRY(readHeader(lines));
  std::vector<double> values;
  FoundPoints found;
  const std::uint64_t all = header_.skipped_lines + header_.vertices;
  for (std::uint64_t i = 0; i < all; ++i) {
    TRY_ASSIGN(const auto line, lines.next());
    if (!line) return failure(ErrorKind::unusable, "the file is truncated before its last vertex", lines.place());
    if (i >= header_.skipped_lines) {
      if (!numbersOf(*line, header_.properties.size(), values) || values.size() != header_.properties.size())
        return failure(ErrorKind::unusable,
                       "a vertex has " + std::to_string(header_.properties.size()) + " numbers here", lines.place());
      if (auto taken = taker_.take(values, found); !taken)
        return failure(ErrorKind::unusable, taken.error().message, lines.place());
    }
    if (i % kPointsAtOnce != kPointsAtOnce - 1 && i + 1 != all) continue;
    if (auto written = local.write(found); !written) return written;
    progress.advance(lines.fraction());
    if (auto going = progress.check(); !going) return going;
  }
  return {};
}

Result<void> Reading::run(PointSink& sink, Report& report, Progress& progress) {
  const auto single = [&](std::size_t k) {
    return header_.form != PlyForm::text && header_.properties[*header_.places.at[k]].type == PlyType::float32;
  };
  LocalPoints local(sink, scan_, !(single(0) && single(1) && single(2)));
  const auto read = header_.form == PlyForm::text ? readText(local, progress) : readBinary(local, progress);
  if (!read) return read;
  taker_.list(path_.filename().string(), report);
  return local.finish(report);
}

struct Opened {
  Header header;
  ScanHeader scan;
  std::string name;
  std::string unread;  // properties that have no place here
};

Result<Opened> open(const std::filesystem::path& path) {
  TRY_ASSIGN(auto file, InputFile::open(path));
  LineReader lines(std::move(file));
  TRY_ASSIGN(auto header, readHeader(lines));
  ScanHeader scan = header.scan;
  if (scan.name.empty()) scan.name = path.stem().string();
  if (!header.places[PointField::intensity]) scan.intensity_max = scan.intensity_min = 0;
  const FieldTaker taker(header.places, scan, header.ours);
  std::string unread;
  for (std::size_t i = 0; i < header.properties.size(); ++i)
    if (!taker.isRead(i)) unread += (unread.empty() ? "" : ", ") + header.properties[i].name;
  return Opened{std::move(header), std::move(scan), lines.name(), std::move(unread)};
}

void listUnread(const Opened& opened, Report& report) {
  if (!opened.unread.empty()) report.lose(opened.name, "skipped vertex properties: " + opened.unread);
  if (opened.header.faces > 0)
    report.lose(opened.name, std::to_string(opened.header.faces) + " faces skipped: vertices are read as points");
}

// What the type says; real numbers have to be looked at.
Result<void> setIntensityLimits(const std::filesystem::path& path, Opened& opened, Progress& progress) {
  const auto& intensity = opened.header.places[PointField::intensity];
  if (!intensity || opened.header.ours) return {};
  const PlyType type = opened.header.properties[*intensity].type;
  if (type == PlyType::uint8 || type == PlyType::uint16) {
    opened.scan.intensity_max = type == PlyType::uint8 ? 255 : 65535;
    return {};
  }
  IntensityRange range;
  Report ignored;
  progress.stage("Measuring " + opened.name, 0, 0.5);
  if (auto run = Reading(path, opened.header, opened.scan).run(range, ignored, progress); !run) return run;
  range.putInto(opened.scan);
  progress.stage("Reading " + opened.name, 0.5, 1);
  return {};
}

}  // namespace

Result<Report> read(const std::filesystem::path& path, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(auto opened, open(path));
  progress.stage("Reading " + opened.name);
  Report report;
  listUnread(opened, report);
  TRY(setIntensityLimits(path, opened, progress));
  TRY(Reading(path, opened.header, opened.scan).run(sink, report, progress));
  return report;
}

Result<CloudInfo> info(const std::filesystem::path& path) {
  TRY_ASSIGN(auto opened, open(path));
  CloudInfo info{.format = kPly.name};
  listUnread(opened, info.report);
  info.scans.push_back({std::move(opened.scan), opened.header.vertices});
  return info;
}

bool hasFaces(const std::filesystem::path& path) {
  const auto opened = open(path);
  return opened && opened->header.faces > 0;
}

}  // namespace standpoint::ply
