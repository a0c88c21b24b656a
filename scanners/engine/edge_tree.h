// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "scanners/engine/edge_map.h"

namespace standpoint {

// What EdgeMap is for a scanner that stands, for one that moves: outlines of the scene in a tree of boxes, asked for by
// beams that start anywhere, sixteen at a time. 32 bytes for each edge and as much again for the tree; independent of
// the way.
class EdgeTree {
 public:
  explicit EdgeTree(const ScanPlan& plan);
  // The rows of a column whose beams may hold an edge that the axis' surface does not hide; `hits` has been traced
  // throughout.
  void mark(const ColumnHits& hits, FacetCache& facets, ColumnEdges& found) const;

 private:
  // A box and what it holds: two boxes, the first of which follows, or leaves.
  struct Node {
    Eigen::AlignedBox3f box;
    std::uint32_t second = 0;  // 0: it is a leaf
    std::uint32_t first_edge = 0, end_edge = 0;
  };
  // What holds the beams of sixteen rows as far as they go.
  struct Cone {
    Eigen::Vector3d apex, axis;
    double sine = 0, cosine = 1;  // of the half angle
    double aside_m = 0;           // beside it
    double reach_m = 0;
    bool meets(const Eigen::AlignedBox3f& box) const;
  };
  struct Placed {
    Eigen::Vector3f from, to;
    std::uint64_t edge = 0;  // placement << 32 | index
    Eigen::AlignedBox3f box() const;
  };
  // Beams side by side.
  struct alignas(64) BeamLanes {
    double origin[3][kPacket] = {}, direction[3][kPacket] = {}, across[3][kPacket] = {}, upward[3][kPacket] = {};
    // Those that an edge may be in, as bits; where it passes close by their origin, too.
    std::uint32_t near(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double exit_m,
                       double divergence_rad) const;
  };
  // Sixteen rows and what holds their beams.
  struct Packet {
    std::uint32_t first_row = 0, lanes = 0;
    Cone cone;
    Beam middle;
    Beam beams[kPacket];
    BeamLanes side_by_side;
    bool has_beams = false;
  };

  void build(std::size_t from, std::size_t to);
  void setCone(const ColumnHits& hits, FacetCache& facets, Packet& packet) const;
  bool mayHold(const Packet& packet, const Placed& edge) const;
  void markEdge(std::uint64_t edge, const ColumnHits& hits, Packet& packet, FacetCache& facets,
                ColumnEdges& found) const;

  const ScanPlan& plan_;
  std::vector<Node> nodes_;
  std::vector<Placed> edges_;
};

}  // namespace standpoint
