// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "core/points.h"

namespace standpoint::testing {

// The head of a PNG, which says its size, and bytes of no picture.
inline StationPicture madeUpPicture(StationPicture::Projection projection, std::size_t bytes = 5001) {
  StationPicture p;
  p.name = projection == StationPicture::Projection::pinhole ? "front" : "panorama";
  p.projection = projection;
  p.media_type = "image/png";
  p.width = 400, p.height = 200;
  p.bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 1, 0x90, 0, 0, 0, 200};
  for (std::size_t i = p.bytes.size(); i < bytes; ++i) p.bytes.push_back(static_cast<std::uint8_t>(i * 7));
  p.pixel_width = 2 * M_PI / p.width, p.pixel_height = M_PI / p.height;
  if (projection == StationPicture::Projection::pinhole) {
    p.pixel_width = p.pixel_height = 5e-6;
    p.focal_length_m = 0.004, p.principal_x = 200.5, p.principal_y = 99.25;
  }
  p.file_from_camera.rotation = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  p.file_from_camera.translation = {5000000.25, -4999999.5, 1.625};
  p.acquired_gps_s = 1400000060.5;
  return p;
}

}  // namespace standpoint::testing
