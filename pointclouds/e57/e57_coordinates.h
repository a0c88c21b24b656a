// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "pointclouds/e57/e57_packet_writer.h"
#include "pointclouds/e57/e57_scan_xml.h"
#include "pointclouds/files/block_check.h"

namespace standpoint::e57 {

// How the places of points, and with them their intensities, stand in the file.
enum class Coordinates {
  cartesian,  // single floats: a PointBlock returns bit for bit
  scaled,     // steps of 0.1 mm and of a 65535th of the sensor's range of intensity: three quarters of the size
  spherical,  // range, azimuth, elevation as single floats
};

std::vector<Field> coordinateFields(Coordinates kind);
Field intensityField(Coordinates kind, const ScanHeader& header);

// The columns of one block as the file holds them.
class StoredPlaces {
 public:
  explicit StoredPlaces(Coordinates kind) : kind_(kind) {}
  // Takes the block in; an error when its points have no place in the steps.
  Result<void> take(const ScanHeader& header, const PointBlock& block, const BlockExtent& extent);
  // Records [from, from + n) of the block that was taken, into the streams from `stream` on; returns the next stream.
  std::size_t put(PacketWriter& packets, std::size_t stream, const PointBlock& block, std::size_t from,
                  std::size_t n) const;
  std::uint64_t clamped() const { return clamped_; }  // intensities outside the sensor's range, where it matters
  PlaceBounds bounds;

 private:
  Result<void> takeSteps(const ScanHeader& header, const PointBlock& block, const BlockExtent& extent);
  void takeAngles(const PointBlock& block);
  Coordinates kind_;
  bool any_ = false, intensities_ = false;
  std::uint64_t clamped_ = 0;
  std::array<std::vector<float>, 3> real_;
  std::array<std::vector<std::uint32_t>, 4> steps_;
};

}  // namespace standpoint::e57
