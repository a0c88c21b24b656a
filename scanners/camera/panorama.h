// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What the camera on a scanner sees all around, as a spherical picture: the middle looks along +X of the scanner's
// frame, left has the larger azimuth, the first row is the zenith.
struct Panorama {
  std::uint32_t width = 0, height = 0;                 // width = 2 height
  std::vector<std::array<std::uint8_t, 3>> pixels;     // sRGB, row by row from above
  Eigen::Vector3d camera_m = Eigen::Vector3d::Zero();  // in the scanner's frame
  // Of the pixel into which a point of the scanner's frame falls, whatever stands between it and the camera.
  const std::array<std::uint8_t, 3>& at(const Eigen::Vector3d& point) const;
};

// Which part of what it sees an exposure is made for.
enum class PictureMetering { even, horizon, zenith };
// What the chosen settings say of it: the effect "picture_metering" of a choice; else even.
PictureMetering meteringOf(const Instrument& instrument, const SettingValues& values);

// When the shots are taken, by the clock of what moves in the scene: one after the other, clockwise from the back.
struct PictureTimes {
  double begins_s = 0, lasts_s = 0;
};

// Renders it, four rays for each pixel: the surfaces' colours, vertex colours and images, under the sky and a little
// light from where the camera stands; what is transparent lets see through. Without HDR each of the instrument's shots
// has the exposure that its own brightness asks for, blended over a few degrees with the next. What moves is in each
// shot where it is in the middle of that shot's time, and cut at its seams. Same pixels for any number of threads.
Result<Panorama> takePanorama(const RayScene& scene, const Instrument& instrument, const Pose& local_from_scanner,
                              int threads, Report& report, Progress& progress,
                              PictureMetering metering = PictureMetering::even, const PictureTimes& times = {});

// As a JPEG, for PointSink::picture.
Result<StationPicture> pictureOf(const Panorama& panorama, const ScanHeader& header, double acquired_gps_s);

// Colours each point by the panorama on its way to `sink`, and gives it the picture behind the points.
std::unique_ptr<PointSink> colouring(PointSink& sink, std::shared_ptr<const Panorama> panorama);

}  // namespace standpoint
