// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/cloud_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace standpoint {

namespace {

template <class T, class Same>
std::vector<std::uint16_t> joined(std::vector<T>& all, const std::vector<T>& more, Same same) {
  std::vector<std::uint16_t> places;
  places.reserve(more.size());
  const bool was_empty = all.empty();
  for (std::size_t k = 0; k < more.size(); ++k) {
    const T& entry = more[k];
    // Scans of one file mostly have the same tables: then the entry is at its own place.
    std::size_t at = k;
    if (was_empty)
      at = all.size();
    else if (at >= all.size() || !same(all[at], entry))
      at = static_cast<std::size_t>(
          std::find_if(all.begin(), all.end(), [&](const T& known) { return same(known, entry); }) - all.begin());
    if (at == all.size() && at < kNoLabel) all.push_back(entry);
    places.push_back(at < all.size() ? static_cast<std::uint16_t>(at) : kNoLabel);
  }
  return places;
}

std::uint16_t labelOf(const std::vector<std::uint32_t>& column, std::size_t i,
                      const std::vector<std::uint16_t>& table) {
  return column[i] < table.size() ? table[column[i]] : kNoLabel;
}

void addTruth(CloudPoint& p, const PointBlock& block, std::size_t i) {
  const auto& truth = block.truth;
  p.flags = truth.flags[i];
  if (truth.incidence_rad[i] >= 0)
    p.incidence_deg = static_cast<std::uint8_t>(std::min(truth.incidence_rad[i] / kRadPerDeg, 90.0) + 0.5);
  const double true_range_m = truth.range_m[i];
  const double away_m = std::hypot(double{truth.x_m[i]}, double{truth.y_m[i]}, double{truth.z_m[i]});
  if (!(std::abs(away_m - true_range_m) <= 1e-3 + 1e-6 * true_range_m)) return;
  const double residual =
      (std::hypot(double{block.x_m[i]}, double{block.y_m[i]}, double{block.z_m[i]}) - true_range_m) * 1e4;
  p.residual_tenth_mm = static_cast<std::int16_t>(std::lround(std::clamp(residual, -32767.0, 32767.0)));
}

}  // namespace

void CloudPointMaker::begin(const ScanHeader& scan) {
  constexpr std::size_t kMostStations = 65536;
  if (header_.stations.size() < kMostStations)
    header_.stations.push_back(
        {scan.name, scan.file_from_scanner, scan.intensity_min, scan.intensity_max, scan.acquisition_start_gps_s, 0});
  const auto sameProduct = [](const LabelledProduct& a, const LabelledProduct& b) {
    return a.id == b.id && a.global_id == b.global_id && a.ifc_class == b.ifc_class && a.name == b.name;
  };
  product_ = joined(header_.products, scan.products, sameProduct);
  material_ = joined(header_.materials, scan.materials, std::equal_to<>());
  pose_ = scan.file_from_scanner;
  pose_.translation -= header_.origin_m;
  low_ = scan.intensity_min;
  const double span = scan.intensity_max - scan.intensity_min;
  scale_ = span > 0 ? 65535 / span : 0;
  coloured_ = scan.has_colour;
  labelled_ = scan.has_labels;
  timed_ = scan.has_time;
  returns_ = scan.has_returns;
  truth_ = scan.has_truth;
  header_.channels |= (coloured_ ? cloud_channel::kColour : 0) | (span > 0 ? cloud_channel::kIntensity : 0) |
                      (labelled_ ? cloud_channel::kLabels : 0) | (timed_ ? cloud_channel::kTime : 0) |
                      (returns_ ? cloud_channel::kReturns : 0) | (truth_ ? cloud_channel::kTruth : 0);
}

CloudPoint CloudPointMaker::make(const PointBlock& block, std::size_t i, const Eigen::Vector3d& place_m) const {
  CloudPoint p;
  for (int k = 0; k < 3; ++k) p.position_m[static_cast<std::size_t>(k)] = static_cast<float>(place_m[k]);
  p.colour =
      coloured_ ? std::array{block.red[i], block.green[i], block.blue[i]} : std::array<std::uint8_t, 3>{255, 255, 255};
  if (scale_ > 0) {
    const double intensity = (block.intensity[i] - low_) * scale_;
    p.intensity = intensity > 0 ? static_cast<std::uint16_t>(std::min(intensity, 65535.0) + 0.5) : std::uint16_t{0};
  }
  p.station = static_cast<std::uint16_t>(header_.stations.size() - 1);
  if (labelled_) {
    p.product = labelOf(block.product, i, product_);
    p.material = labelOf(block.material, i, material_);
  }
  if (returns_) p.return_number = block.return_number[i];
  p.time_s = timed_ ? static_cast<float>(block.time_s[i]) : std::numeric_limits<float>::quiet_NaN();
  if (truth_) addTruth(p, block, i);
  return p;
}

}  // namespace standpoint
