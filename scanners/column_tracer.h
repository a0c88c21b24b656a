// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/points.h"
#include "scanners/beam_paths.h"
#include "scanners/column_hits.h"
#include "scanners/pulse_noise.h"
#include "scanners/waveform.h"

namespace standpoint {

// Traces columns of a plan into a block, from ray to point. One per thread; it only remembers facets, so what it yields
// depends on the arguments alone, and a column's points on the column alone.
//
// A pulse whose axis and whose neighbours' axes meet one surface is that surface's return; most are, and they are dealt
// with sixteen at a time. Where a neighbour meets another one, the beam's other rays are traced (footprint.h), and where
// the surface is a pane or a mirror the light is followed (beam_paths.h); the receiver makes echoes of what comes back
// (waveform.h). What is thinner than the distance of two pulses and lies between them is not met.
// Neighbours are those that the beam's edge reaches, up to kMostReach pulses away.
class ColumnTracer {
 public:
  explicit ColumnTracer(const ScanPlan& plan);
  void trace(std::uint32_t from, std::uint32_t to, PointBlock& block);

 private:
  // A return of a pulse.
  struct Target {
    std::uint32_t row = 0;
    std::uint8_t return_number = 1, return_count = 1;
    std::uint8_t flags = 0;
    double range_m = 0;            // as the light takes it, glass included
    PathEnd end;                   // of the strongest surface
    float known_x = -1;            // of an echo of several surfaces
    float deviation_m = 0;         // of that echo
    float range_noise = 0, lateral = 0, elevation = 0, detection = 0;
  };

  void traceColumn(PointBlock& block);
  ColumnHits& column(std::uint32_t number) { return columns_[number % columns_.size()]; }
  // How many pulses apart the axes are that the beam's edge reaches, up and across; at least 1.
  struct Reach {
    std::uint32_t rows = 1, columns = 1;
  };
  Reach reachAt(double range_m, std::uint32_t row) const;
  std::uint32_t unlikeNeighbours(std::uint32_t first_row);
  bool atEdge(std::uint32_t row);
  bool onSameSurface(const MetFacet& surface, const RayLine& line, const NearestHit& hit, double tolerance_m) const;
  bool probe(const Beam& beam, const NearestHit& axis);
  void traceRays(const Beam& beam, int from, int to);
  void gatherEnds(const Beam& beam, const NearestHit& axis, bool edge);
  void addEnds(const RayLine& line, const NearestHit& hit, float weight);
  void addSurface(std::uint32_t row, const RayLine& axis, const NearestHit& hit, const MetFacet& met);
  void gatherWings(const Beam& beam);
  bool struck(std::uint32_t row) const;
  void addStray(std::uint32_t row, const Beam& beam);
  void addSurfaceless(const Beam& beam, double range_m, double x, std::uint8_t flag);
  void addEchoes(std::uint32_t row);
  void varySurfaces(std::size_t first, int count);
  void drawNoise(std::uint32_t first_row, std::size_t first_target);
  void receiveAll(PointBlock& block);
  void receiveSome(std::size_t first, int count, PointBlock& block);
  void light(std::size_t first, int count);
  bool detected(const Target& target, int lane) const;
  bool faulted(const Target& target, float x, const PointFilters& filters) const;
  Eigen::Vector3d place(const Target& target, float x, float sigma_m) const;
  void grow(PointBlock& block, std::size_t size) const;
  void write(const Target& target, int lane, std::size_t i, PointBlock& block) const;
  void writeTruth(const Target& target, int lane, std::size_t i, PointTruth& truth) const;
  float powerOf(const PathEnd& end) const;

  const ScanPlan& plan_;
  FacetCache facets_;
  BeamPaths paths_;
  std::vector<ColumnHits> columns_;                     // those about the current one, by their number
  ColumnHits* current_ = nullptr;
  double face_ = 1;                                     // -1 behind
  Eigen::Vector3d ahead_, lateral_;                     // of the column, in the scanner's frame
  double azimuth_error_ = 0;                            // rad
  double row_step_, column_step_;                       // rad
  Pose start_;                                          // of the scanner at time 0
  RayPacket sub_rays_;
  RayLine sub_lines_[kSubRays];
  NearestHit sub_hits_[kSubRays];
  std::vector<PathEnd> ends_;
  std::vector<Contribution> contributions_;
  std::vector<int> order_;
  std::vector<Echo> echoes_;
  std::vector<Target> targets_;
  SignalLanes signal_;
  float wobble_[kPacket] = {};
  std::vector<float> along_;                            // noise of the column, by row
  PulseNoise noise_;
};

}  // namespace standpoint
