// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/points.h"
#include "scanners/pulse_noise.h"
#include "scanners/scan_plan.h"
#include "scanners/signal_lanes.h"

namespace standpoint {

// Traces columns of a plan into a block: sixteen pulses at a time from ray to point. One per thread; it only remembers
// facets, so what it yields depends on the arguments alone.
class ColumnTracer {
 public:
  explicit ColumnTracer(const ScanPlan& plan);
  void trace(std::uint32_t column, PointBlock& block);

 private:
  // A facet with what belongs to it.
  struct Met {
    std::uint64_t number = kNoFacet;
    Facet facet;
    const Optics* optics = nullptr;
    std::uint32_t material = 0;
  };
  // The beam that a pulse sends, in the local frame.
  struct Beam {
    Eigen::Vector3d origin, direction;
  };
  // The surface whose return a pulse yields.
  struct Target {
    int lane = 0;                  // of the pulse
    double range_m = 0;            // true
    double excess_m = 0;           // of the optical path, behind glass
    float cosine = 1, equivalent = 1, gain = 1;
    std::uint32_t product = 0, surface = 0, material = 0;
  };
  struct Packet {
    int pulses = 0, targets = 0;
    Beam beam[kPacket];
    RayPacket rays;
    NearestHit hits[kPacket];
    Target target[kPacket];
    SignalLanes signal;
    PulseNoise noise;
  };

  std::int32_t materialAt(const Facet& facet) const;
  const Met& met(std::uint64_t number);
  void startColumn(std::uint32_t column);
  void aim(std::uint32_t first_row);
  void gather();
  Target meet(const Beam& beam, double range_m, const Met& met) const;
  Target lookThrough(const Beam& beam, const NearestHit& first);
  float receivedPower(const Target& target) const;
  void receiveAll(std::uint32_t first_row);
  void emit(std::uint32_t first_row, PointBlock& block);
  bool detected(int k) const;
  Eigen::Vector3d place(int k, std::uint32_t row) const;

  const ScanPlan& plan_;
  std::vector<Met> cache_;
  Packet packet_{};
  // Of the column at work:
  std::uint32_t column_ = 0;
  double face_ = 1;                                     // -1 behind
  Eigen::Vector3d ahead_, lateral_;                     // horizontal unit vectors of the scanner's frame; up is its z
  Pose pose_;                                           // of a scanner that stands still
};

}  // namespace standpoint
