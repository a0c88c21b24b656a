// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"
#include "core/survey.h"

namespace standpoint {

constexpr std::uint16_t kNoLabel = 65535;  // CloudPoint::product, ::material
constexpr std::uint8_t kNoIncidence = 255;
constexpr std::int16_t kNoResidual = -32768;

// A point as it is shown: in memory, and as these bytes in an octree file (little endian). What the cloud does not tell
// has the value beside it; CloudHeader::channels says which channels are there at all.
struct CloudPoint {
  std::array<float, 3> position_m = {};       // from the cloud's or the node's origin, axes of the file
  std::array<std::uint8_t, 3> colour = {};    // red, green, blue; white without colour
  std::uint8_t flags = 0;                     // point_flag
  std::uint16_t intensity = 32768;            // 0..65535 of CloudStation::intensity_min to intensity_max
  std::uint16_t station = 0;                  // index into CloudHeader::stations
  std::uint16_t product = kNoLabel;           // index into CloudHeader::products
  std::uint16_t material = kNoLabel;          // index into CloudHeader::materials
  std::uint8_t incidence_deg = kNoIncidence;  // 0 = along the surface's normal
  std::uint8_t return_number = 1;             // of the pulse
  // Measured minus true range, clamped to ±32767. Not known of what was not seen along the beam, as in a mirror, nor of
  // a scanner that moved, whose ranges do not begin at one place.
  std::int16_t residual_tenth_mm = kNoResidual;
  float time_s = 0;  // since CloudStation::acquisition_start_gps_s; NaN: not known
};
static_assert(sizeof(CloudPoint) == 32 && alignof(CloudPoint) == 4);

namespace cloud_channel {
inline constexpr std::uint32_t kColour = 1;
inline constexpr std::uint32_t kIntensity = 2;
inline constexpr std::uint32_t kLabels = 4;  // product and material
inline constexpr std::uint32_t kTime = 8;
inline constexpr std::uint32_t kReturns = 16;
inline constexpr std::uint32_t kTruth = 32;  // flags, incidence, residual
}  // namespace cloud_channel

// One scan of the file.
struct CloudStation {
  std::string name;
  Pose file_from_scanner;  // as ScanHeader::file_from_scanner
  double intensity_min = 0, intensity_max = 1;
  double acquisition_start_gps_s = 0;
  std::uint64_t points = 0;
};

// The tables that the columns of CloudPoint index. Those of several scans are joined: equal entries stand once.
struct CloudHeader {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // of CloudPoint::position_m, in the frame of the file
  std::uint32_t channels = 0;                          // cloud_channel that at least one scan has
  std::vector<CloudStation> stations;                  // at most 65536
  std::vector<LabelledProduct> products;               // at most 65535; what comes later has kNoLabel
  std::vector<std::string> materials;                  // likewise
};

// Turns the blocks of scans, one scan after the other, into points.
class CloudPointMaker {
 public:
  explicit CloudPointMaker(const Eigen::Vector3d& origin_m) { header_.origin_m = origin_m; }
  void begin(const ScanHeader& scan);  // refuses nothing: more than 65536 scans count as the last one
  // Of the last begun scan; `block` is as PointSink::write gets it, `place_m` what the record's position is made of,
  // before it is a float.
  CloudPoint make(const PointBlock& block, std::size_t i) const { return make(block, i, place_m(block, i)); }
  CloudPoint make(const PointBlock& block, std::size_t i, const Eigen::Vector3d& place_m) const;
  Eigen::Vector3d place_m(const PointBlock& block, std::size_t i) const {
    return pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
  }
  void count(std::uint64_t points) { header_.stations.back().points += points; }  // that were seen, made or not
  const CloudHeader& header() const { return header_; }

 private:
  CloudHeader header_;
  Pose pose_;
  std::vector<std::uint16_t> product_, material_;  // of the scan's tables in the cloud's
  double low_ = 0, scale_ = 0;
  bool coloured_ = false, labelled_ = false, timed_ = false, returns_ = false, truth_ = false;
};

}  // namespace standpoint
