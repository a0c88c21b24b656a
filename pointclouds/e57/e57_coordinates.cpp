// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_coordinates.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "pointclouds/files/number_text.h"

namespace standpoint::e57 {
namespace {

constexpr double kStepsPerMetre = 1e4;
// Bits are fixed before the first point is known. ±3.3 km is three times the reach of the longest tripod scanner.
constexpr unsigned kStepBits = 26, kIntensityBits = 16;
constexpr double kFarthestStep = 1 << (kStepBits - 1);
constexpr double kIntensitySteps = (1 << kIntensityBits) - 1;

std::string scaledAttributes(long minimum, long maximum, double scale, double offset) {
  return "type=\"ScaledInteger\" minimum=\"" + numberText(minimum) + "\" maximum=\"" + numberText(maximum) +
         "\" scale=\"" + numberText(scale) + "\" offset=\"" + numberText(offset + 0.0) + "\"";
}

// (-π, π]: as a float π itself is too large for strict readers.
float azimuthOf(float x, float y) {
  const auto largest = std::nextafter(std::numbers::pi_v<float>, 0.0F);
  return std::clamp(static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x))), -largest, largest);
}

}  // namespace

std::vector<Field> coordinateFields(Coordinates kind) {
  if (kind == Coordinates::spherical)
    return {floatField("sphericalRange"), floatField("sphericalAzimuth"), floatField("sphericalElevation")};
  std::vector<Field> fields;
  for (const char* name : {"cartesianX", "cartesianY", "cartesianZ"})
    fields.push_back(kind == Coordinates::cartesian
                         ? floatField(name)
                         : Field{name,
                                 scaledAttributes(-static_cast<long>(kFarthestStep),
                                                  static_cast<long>(kFarthestStep) - 1, 1 / kStepsPerMetre, 0),
                                 kStepBits});
  return fields;
}

Field intensityField(Coordinates kind, const ScanHeader& header) {
  if (kind != Coordinates::scaled) return floatField("intensity");
  const double scale = (header.intensity_max - header.intensity_min) / kIntensitySteps;
  return {"intensity", scaledAttributes(0, static_cast<long>(kIntensitySteps), scale, header.intensity_min),
          kIntensityBits};
}

Result<void> StoredPlaces::takeSteps(const ScanHeader& header, const PointBlock& block, const BlockExtent& extent) {
  const std::array<const std::vector<float>*, 3> axes = {&block.x_m, &block.y_m, &block.z_m};
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = std::round(extent.low[k] * kStepsPerMetre), high = std::round(extent.high[k] * kStepsPerMetre);
    if (low < -kFarthestStep || high >= kFarthestStep)
      return failure(ErrorKind::unusable,
                     "a point is more than " + numberText(std::floor(kFarthestStep / kStepsPerMetre)) +
                         " m from the scanner, out of range for integers of 0.1 mm: write floats instead",
                     "scan " + header.name);
    bounds.low[k] = any_ ? std::min(bounds.low[k], low / kStepsPerMetre) : low / kStepsPerMetre;
    bounds.high[k] = any_ ? std::max(bounds.high[k], high / kStepsPerMetre) : high / kStepsPerMetre;
    steps_[k].resize(block.size());
    for (std::size_t i = 0; i < block.size(); ++i)
      steps_[k][i] = static_cast<std::uint32_t>(std::llround((*axes[k])[i] * kStepsPerMetre) +
                                                static_cast<long long>(kFarthestStep));
  }
  if (!(intensities_ = hasIntensity(header))) return {};
  const double scale = kIntensitySteps / (header.intensity_max - header.intensity_min);
  steps_[3].resize(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    const double step = std::round((block.intensity[i] - header.intensity_min) * scale);
    clamped_ += step < 0 || step > kIntensitySteps;
    steps_[3][i] = static_cast<std::uint32_t>(std::clamp(step, 0.0, kIntensitySteps));
  }
  return {};
}

void StoredPlaces::takeAngles(const PointBlock& block) {
  for (auto& column : real_) column.resize(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Eigen::Vector3d p(block.x_m[i], block.y_m[i], block.z_m[i]);
    real_[0][i] = static_cast<float>(p.norm());
    real_[1][i] = azimuthOf(block.x_m[i], block.y_m[i]);
    real_[2][i] = static_cast<float>(std::atan2(p.z(), std::hypot(p.x(), p.y())));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(real_[k].begin(), real_[k].end());
    bounds.low[k] = any_ ? std::min<double>(bounds.low[k], *low) : *low;
    bounds.high[k] = any_ ? std::max<double>(bounds.high[k], *high) : *high;
  }
}

Result<void> StoredPlaces::take(const ScanHeader& header, const PointBlock& block, const BlockExtent& extent) {
  if (kind_ == Coordinates::scaled) {
    if (auto taken = takeSteps(header, block, extent); !taken) return taken;
  } else if (kind_ == Coordinates::spherical) {
    takeAngles(block);
  } else {
    for (std::size_t k = 0; k < 3; ++k) {
      bounds.low[k] = any_ ? std::min<double>(bounds.low[k], extent.low[k]) : extent.low[k];
      bounds.high[k] = any_ ? std::max<double>(bounds.high[k], extent.high[k]) : extent.high[k];
    }
  }
  intensities_ = hasIntensity(header);
  any_ = true;
  return {};
}

std::size_t StoredPlaces::put(PacketWriter& packets, std::size_t stream, const PointBlock& b, std::size_t from,
                              std::size_t n) const {
  const auto put = [&](const auto& column) { packets.put(stream++, std::span(column).subspan(from, n)); };
  if (kind_ == Coordinates::scaled) {
    for (std::size_t k = 0; k < (intensities_ ? 4u : 3u); ++k) put(steps_[k]);
    return stream;
  }
  if (kind_ == Coordinates::spherical)
    for (const auto& column : real_) put(column);
  else
    put(b.x_m), put(b.y_m), put(b.z_m);
  if (intensities_) put(b.intensity);
  return stream;
}

}  // namespace standpoint::e57
