// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// What one scan sees from its station, as a spherical picture: the columns are azimuths, from pi on the left to -pi (as
// one turns to the right), the rows elevations from the zenith to the nadir. Of several points in a pixel the nearest
// is kept.
struct Panorama {
  std::size_t scan = 0;            // its place among the scans of the file
  std::vector<std::string> scans;  // the names of all of them; "" where one has none
  Pose file_from_scanner;          // frame of the cloud's file
  int width = 0, height = 0;
  std::vector<float> range_m;                       // by pixel; 0 where nothing came back
  std::vector<float> intensity;                     // 0..1 of what nearly all have; NaN: none
  std::vector<std::array<std::uint8_t, 3>> colour;  // empty where the scan has none
  std::uint64_t points = 0;
  bool has_intensity = false;
  Report report;  // of reading

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  // Unit, in the scanner's frame: of a pixel's middle.
  Eigen::Vector3d direction(int x, int y) const;
  // Of a direction in the scanner's frame.
  Eigen::Vector2i pixel(const Eigen::Vector3d& direction) const;
  // In the frame of the cloud's file; nothing where nothing came back.
  std::optional<Eigen::Vector3d> point(int x, int y) const;
};

struct PanoramaOptions {
  std::optional<std::size_t> scan;  // its place in the file; nothing: the first that has a station
  int width = 0;  // pixels, the height is half of it; 0: as fine as the points are, if they fill the sphere
};

// Reads the file once. Errors: no such scan, a cloud without a station (a LAS, a merged cloud), no points.
Result<Panorama> readPanorama(const std::filesystem::path& file, const PanoramaOptions& options, Progress& progress);

enum class PanoramaChannel { intensity, range, colour };
// A shade for each pixel, rows from the top: 0..1, NaN where nothing came back. Of intensity and range, from what 2 %
// of the pixels have at most (`low`) to what 98 % have.
struct PanoramaShades {
  std::vector<float> shade;
  double low = 0, high = 0;
};
PanoramaShades shadesOf(const Panorama& panorama, PanoramaChannel channel);

}  // namespace standpoint
