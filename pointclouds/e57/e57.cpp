// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57.h"

#include "pointclouds/e57/e57_document.h"
#include "pointclouds/e57/e57_scan_reader.h"

namespace standpoint {

namespace e57 {
namespace {

template <Coordinates kind>
Result<std::unique_ptr<CloudWriter>> writerOf(const std::filesystem::path& file) {
  return createWriter(file, kind);
}

constexpr CloudVariant kVariants[] = {
    {"scaled", "integers of 0.1 mm: three quarters of the size", writerOf<Coordinates::scaled>},
    {"spherical", "range, azimuth and elevation", writerOf<Coordinates::spherical>}};

std::size_t scanCount(const Document& document) {
  const Element* const scans = document.root->child("data3D");
  return scans ? scans->children.size() : 0;
}

struct FoundScan {
  const Element* points = nullptr;
  std::uint64_t records = 0;
  ScanPlan plan;
};

Result<FoundScan> findScan(Document& document, std::size_t i, Report& report) {
  const Element& scan = *document.root->child("data3D")->children[i];
  const std::string source = document.file.name() + " data3D/" + std::to_string(i);
  const Element* const points = scan.child("points");
  if (!points) return failure(ErrorKind::unusable, "the scan has no points element", source);
  TRY_ASSIGN(const auto vector, VectorReader::open(document.file, *points, source));
  return FoundScan{points, vector.records(), planScan(*document.root, scan, vector.fields(), source, report)};
}

}  // namespace

Result<Report> read(const std::filesystem::path& file, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(auto document, openDocument(file));
  Report report;
  const std::size_t scans = scanCount(document);
  const auto pictures = picturesOfScans(document, scans, report);
  for (std::size_t i = 0; i < scans; ++i) {
    TRY_ASSIGN(auto found, findScan(document, i, report));
    const auto fraction = [&](std::size_t n) { return static_cast<double>(n) / static_cast<double>(scans); };
    progress.stage("Reading " + found.plan.header.name, fraction(i), fraction(i + 1));
    TRY(readScan(document.file, *found.points, std::move(found.plan), pictures[i], sink, report, progress));
  }
  return report;
}

Result<CloudInfo> info(const std::filesystem::path& file) {
  TRY_ASSIGN(auto document, openDocument(file));
  CloudInfo info{.format = kE57.name};
  for (std::size_t i = 0; i < scanCount(document); ++i) {
    TRY_ASSIGN(auto found, findScan(document, i, info.report));
    if (info.crs.empty()) info.crs = found.plan.header.coordinate_metadata;
    info.scans.push_back({std::move(found.plan.header), found.records});
  }
  return info;
}

}  // namespace e57

const CloudFormat kE57 = {"e57",
                          "ASTM E57: structured scans with poses, intensity, colour, labels, truth and pictures",
                          ".e57",
                          true,
                          e57::writerOf<e57::Coordinates::cartesian>,
                          e57::read,
                          e57::info,
                          e57::kVariants};

}  // namespace standpoint
