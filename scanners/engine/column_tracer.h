// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/points.h"
#include "scanners/engine/beam_paths.h"
#include "scanners/engine/corner_light.h"
#include "scanners/engine/edge_finder.h"
#include "scanners/engine/edge_map.h"
#include "scanners/engine/end_powers.h"
#include "scanners/engine/plane_lanes.h"
#include "scanners/engine/point_lanes.h"
#include "scanners/engine/point_writer.h"
#include "scanners/engine/wide_beams.h"

namespace standpoint {

// Traces columns of a plan into a block, in place of what it holds, from ray to point. One per thread; it only
// remembers facets, so what it yields depends on the arguments alone, and a column's points on the column alone.
//
// A pulse whose beam meets one surface is that surface's return; most do, and they are dealt with sixteen at a time.
// Where an edge of the scene is in the beam (edge_map.h), its rays are traced (wide_beams.h), and where the surface is
// a pane or a mirror the light is followed (beam_paths.h); the receiver makes echoes of what comes back (waveform.h).
class ColumnTracer {
 public:
  // Where edges are; both null where no beam is wide, or each is. `corners`: null where they are not lit.
  struct Edges {
    const EdgeMap* map = nullptr;        // of what stands, before a scanner that stands
    const EdgeFinder* finder = nullptr;  // where either moves
    const EdgeMap* corners = nullptr;
  };
  ColumnTracer(const ScanPlan& plan, const Edges& edges, std::shared_ptr<SweptBodies> bodies);
  // How many pulses were sent.
  std::uint64_t trace(std::uint32_t from, std::uint32_t to, PointBlock& block);

 private:
  // A return of a pulse that is not its first.
  struct Further {
    int pulse = 0;  // its lane
    std::uint32_t number = 1;
    PathEnd end;
    Echo echo;
  };

  // Lanes whose axes meet a surface that light only comes back from, and another one.
  struct Surfaces {
    std::uint32_t plain = 0, other = 0;
  };

  // A pulse whose echoes are still to be made, and where what comes back of it begins in `ends_`.
  struct Special {
    int lane = 0;
    std::size_t from = 0;
  };

  void traceColumn();
  void traceRows(std::uint32_t first_row);
  Surfaces setSurfaces(std::uint32_t first_row);
  bool edgesKnown() const { return edges_.map != nullptr || edges_.finder != nullptr; }
  std::uint32_t traceEdges(std::uint32_t first_row);
  void gatherEnds(std::uint32_t row, const WideBeam* wide);
  void gatherWide(const WideBeam& wide);
  std::uint32_t straying(std::uint32_t first_row, std::uint32_t rows) const;
  bool struck(std::uint32_t row) const;
  void gatherStray(std::uint32_t row, std::size_t from);
  void gatherWings(const Beam& beam);
  void addSurfaceless(const RayLine& axis, double range_m, double x, std::uint8_t flag);
  std::uint32_t reported(std::uint32_t lanes);
  void setNormals(const RayLanes& axes, std::uint32_t lanes);
  void light(ReturnLanes& returns, int count);
  bool addEchoes(const std::vector<float>& powers, int lane, std::size_t from, std::size_t to);
  void writeSeveral(std::uint32_t detected);

  const ScanPlan& plan_;
  TimedScene scene_;
  FacetCache facets_;
  BeamPaths paths_;
  Edges edges_;
  CornerLight corner_light_;
  ColumnHits column_;
  ColumnEdges found_, found_corners_;
  WideBeams wide_;  // of sixteen rows
  PlaneLanes planes_;
  ReturnLanes returns_;          // a row each
  std::uint64_t held_[kPacket];  // facets whose surfaces and planes the lanes have
  Surfaces held_surfaces_;
  bool held_passing_ = false;  // one of them: a ball or a body's, whose plane is another for each beam
  std::vector<Special> specials_;
  std::vector<PathEnd> ends_;  // of all of them
  EndPowers powers_;
  std::vector<Contribution> contributions_;
  std::vector<Echo> echoes_;
  std::vector<Further> further_;
  std::vector<ReturnLanes> further_lanes_;
  std::vector<std::uint32_t> further_detected_;
  std::vector<PointWriter::Place> places_;
  PointLanes points_;
  PointWriter writer_;
};

}  // namespace standpoint
