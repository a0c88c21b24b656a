// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/scan_forecast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

namespace standpoint {

namespace {

constexpr int kColumns = 256, kRows = 128;  // of the grid that stands for all pulses

double elevationOf(const Eigen::Vector3d& direction_in_scanner) {
  return std::asin(std::clamp(direction_in_scanner.z(), -1.0, 1.0));
}

bool inField(const ScanSettings& settings, const Eigen::Vector3d& direction_in_scanner) {
  const double elevation = elevationOf(direction_in_scanner);
  if (elevation < settings.elevation_from_rad || elevation > settings.elevation_to_rad) return false;
  const double azimuth = -std::atan2(direction_in_scanner.y(), direction_in_scanner.x());  // clockwise
  const double turn = 2 * std::numbers::pi;
  const double after =
      azimuth - settings.azimuth_from_rad - turn * std::floor((azimuth - settings.azimuth_from_rad) / turn);
  return after <= settings.azimuth_to_rad - settings.azimuth_from_rad;
}

bool isMetFirst(const Expectation& expectation, const Eigen::Vector3d& eye, const Eigen::Vector3d& way, double range) {
  const double before = 1e-3 + 1e-4 * range;  // float trees put a surface a little off
  return !expectation.scene().intersect(eye, way / range, range - before);
}

// Of one pulse, the expected number of returns.
double returnsOf(const Expectation& expectation, const Pose& pose, const Eigen::Vector3d& in_scanner) {
  const Eigen::Vector3d direction = pose.rotation * in_scanner;
  const auto hit = expectation.scene().intersect(pose.translation, direction, expectation.law().settings().max_range_m);
  if (!hit) return 0;
  const auto expected = expectation.from(pose.translation, {hit->position, hit->normal, hit->instance, hit->triangle});
  return expected.fate == ReturnFate::seen_through ? 1 : expected.probability;
}

}  // namespace

bool isSeen(const Expectation& expectation, const Pose& pose, SurfacePlace place, const SeenWhen& wanted) {
  const auto& settings = expectation.law().settings();
  const Eigen::Vector3d way = place.position - pose.translation;
  const double range = way.norm();
  if (range < 1e-6 || range > wanted.max_range_m) return false;
  const Eigen::Vector3d in_scanner = pose.rotation.conjugate() * (way / range);
  if (!inField(settings, in_scanner)) return false;
  if (place.normal.dot(way) > 0) place.normal *= -1;  // the side that is turned to the station
  const double incidence = std::acos(std::clamp(-place.normal.dot(way) / range, 0.0, 1.0));
  if (incidence > wanted.max_incidence_rad) return false;
  if (spacingOf(settings, range, elevationOf(in_scanner), incidence) > wanted.max_spacing_m) return false;
  if (expectation.opticsAt(place.instance, place.triangle).transparent &&
      !isMetFirst(expectation, pose.translation, way, range))
    return false;  // of a pane's two faces one pulse has one point, and the stronger is the one in front
  return expectation.from(pose.translation, place).fate == ReturnFate::returned;
}

double spacingOf(const ScanSettings& settings, double range_m, double elevation_rad, double incidence_rad) {
  const double column =
      (settings.azimuth_to_rad - settings.azimuth_from_rad) / settings.columns * std::cos(elevation_rad);
  const double row = (settings.elevation_to_rad - settings.elevation_from_rad) / settings.rows;
  return range_m * std::sqrt(std::max(0.0, column * row) / std::max(1e-9, std::cos(incidence_rad)));
}

double spacingAt(const ScanSettings& settings, const Pose& local_from_scanner, const SurfacePlace& place) {
  const Eigen::Vector3d way = place.position - local_from_scanner.translation;
  const double range = way.norm();
  const double incidence = std::acos(std::clamp(std::abs(place.normal.dot(way)) / range, 0.0, 1.0));
  return spacingOf(settings, range, elevationOf(local_from_scanner.rotation.conjugate() * way / range), incidence);
}

std::vector<std::uint8_t> seenSamples(const Expectation& expectation, const Pose& local_from_scanner,
                                      const SurfaceSamples& samples, const SeenWhen& wanted) {
  std::vector<std::uint8_t> seen(samples.samples.size(), 0);
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t k) {  // each into its own slot
    seen[k] = static_cast<std::uint8_t>(samples.samples[k].exposed &&
                                        isSeen(expectation, local_from_scanner, samples.samples[k].place, wanted));
  });
  return seen;
}

ScanForecast forecastScan(const Expectation& expectation, const Pose& local_from_scanner, const SurfaceSamples& samples,
                          const SeenWhen& wanted) {
  const auto& settings = expectation.law().settings();
  ScanForecast forecast;
  forecast.seen = seenSamples(expectation, local_from_scanner, samples, wanted);
  std::vector<double> of_column(kColumns, 0);
  tbb::parallel_for(0, kColumns, [&](int j) {
    const double azimuth =
        settings.azimuth_from_rad + (settings.azimuth_to_rad - settings.azimuth_from_rad) * (j + 0.5) / kColumns;
    for (int i = 0; i < kRows; ++i) {
      const double elevation =
          settings.elevation_from_rad + (settings.elevation_to_rad - settings.elevation_from_rad) * (i + 0.5) / kRows;
      of_column[static_cast<std::size_t>(j)] += returnsOf(
          expectation, local_from_scanner,
          {std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
    }
  });
  double returns = 0;  // summed in order: the same on any number of threads
  for (const double r : of_column) returns += r;
  forecast.points = returns / (kColumns * kRows) * static_cast<double>(settings.columns) * settings.rows;
  forecast.seconds = settings.scan_seconds + settings.imaging_seconds;
  return forecast;
}

}  // namespace standpoint
