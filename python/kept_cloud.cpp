// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/kept_cloud.h"

#include <algorithm>
#include <type_traits>

namespace standpoint {

namespace {

std::vector<double> placed(const Pose& file_from_scanner, const std::vector<float>& x, const std::vector<float>& y,
                           const std::vector<float>& z) {
  std::vector<double> places(3 * x.size());
  auto to = places.begin();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d place = file_from_scanner * Eigen::Vector3d(x[i], y[i], z[i]);
    to = std::copy(place.begin(), place.end(), to);
  }
  return places;
}

}  // namespace

Result<void> KeepingSink::begin(const ScanHeader& header) {
  scan_ = std::make_shared<KeptScan>(KeptScan{header, {}});
  return {};
}

Result<void> KeepingSink::write(const PointBlock& block) {
  std::vector<const void*> more;
  eachColumn(block, [&](const char*, const auto& column) { more.push_back(&column); });
  auto from = more.begin();
  eachColumn(scan_->points, [&](const char*, auto& column) {
    const auto& added = *static_cast<const std::remove_reference_t<decltype(column)>*>(*from++);
    column.insert(column.end(), added.begin(), added.end());
  });
  return {};
}

Result<void> KeepingSink::end() {
  eachColumn(scan_->points, [](const char*, auto& column) { column.shrink_to_fit(); });
  scans.push_back(std::move(scan_));
  return {};
}

std::vector<double> placesInFile(const KeptScan& scan) {
  return placed(scan.header.file_from_scanner, scan.points.x_m, scan.points.y_m, scan.points.z_m);
}

std::vector<double> truePlacesInFile(const KeptScan& scan) {
  const auto& truth = scan.points.truth;
  return placed(truePose(scan.header), truth.x_m, truth.y_m, truth.z_m);
}

}  // namespace standpoint
