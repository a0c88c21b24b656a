// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/simplify/collapses/collapse_queue.h"
#include "optimizer/simplify/collapses/quadric.h"

namespace standpoint {

// What a simplification works on: a shape, or a part of one, with what its vertices gathered so far.
struct Patch {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<Quadric> quadrics;    // of each vertex: the planes around it, and those that hold borders and creases
  std::vector<Quadric> features;    // lossless only: unweighted, so that its root bounds the distance to each
  std::vector<float> deviation_m;   // of what was gathered at a vertex, from the surface that it has now
  std::vector<std::uint8_t> fixed;  // stays where it is; empty: none. What is not fixed may still join it
};

struct Step {
  Collapse collapse;
  double cost = 0;  // never falls along a log: the largest so far
  float deviation_m = 0;
  std::uint32_t cell = 0;  // whose step it is, where several work side by side
};

// Collapses edges of a patch, cheapest first. Triangles are an array, each corner a link in its vertex's list of
// corners (corner = 3 * triangle + k).
class Collapser {
 public:
  Collapser(Patch patch, const CollapseOptions& options, const Shape& whole);
  // Until no more than `floor` triangles are left, or nothing more may go.
  std::vector<Step> run(std::size_t floor, const Progress& progress);
  std::size_t triangles() const { return alive_; }

 private:
  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  struct Merger {  // of two vertices
    Quadric q;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double value = 0;  // of q there
    double cost = 0;
  };
  struct Effect {  // what a collapse would do
    std::uint32_t vanishing = 0, surviving = 0;
    bool flips = false;
    double longest_edge = 0;  // of the vanishing triangles
  };
  using Corners = std::array<Eigen::Vector3d, 3>;

  struct Solid {  // of the triangles around a vertex: squared volume swept by moving it, and where that volume is kept
    Quadric sweep;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double offset = 0;
    void add(const Eigen::Vector3d& area_vector, const Eigen::Vector3d& point, double sign);
    void add(const Solid& other);
  };

  void linkCorners();
  void pushAll();
  std::optional<CollapseQueue::Entry> candidate(std::uint32_t a, std::uint32_t b);
  void pushAround(std::uint32_t v);
  void place(std::uint32_t a, std::uint32_t b, Merger& merger) const;
  void placeBySolid(std::uint32_t a, std::uint32_t b, const Solid& solid, Merger& merger) const;
  void sumSolid(std::uint32_t v);
  Merger merge(std::uint32_t a, std::uint32_t b);
  Effect effect(std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& p);
  void addEffect(std::uint32_t v, std::uint32_t other, bool first, const Eigen::Vector3d& p, Effect& effect);
  double price(std::uint32_t a, std::uint32_t b, const Merger& merger, const Effect& e) const;
  bool tooFar(std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& p, const Effect& e, double& deviation) const;
  void apply(std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& p);
  bool fixed(std::uint32_t v) const { return !patch_.fixed.empty() && patch_.fixed[v] != 0; }

  bool isFlat(const Eigen::Vector3d& normal, const Eigen::Vector3d& e1, const Eigen::Vector3d& e2) const {
    return normal.squaredNorm() <=
           rounding_ * rounding_ * std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
  }
  bool dead(std::uint32_t triangle) const { return patch_.triangles[triangle][0] == kNone; }

  template <class Visit>
  void forTriangles(std::uint32_t v, Visit visit) {  // drops the links of dead triangles on its way
    std::uint32_t* link = &first_corner_[v];
    std::uint32_t last = kNone;
    while (*link != kNone) {
      const std::uint32_t corner = *link;
      if (dead(corner / 3)) {
        *link = next_corner_[corner];
        --corner_count_[v];
        continue;
      }
      visit(corner / 3);
      last = corner;
      link = &next_corner_[corner];
    }
    last_corner_[v] = last;
  }

  CollapseOptions options_;
  double rounding_;
  bool capped_;  // there is a limit that can be met
  Eigen::Vector3d half_size_;
  Patch patch_;
  std::size_t alive_ = 0;
  std::vector<std::uint32_t> first_corner_, last_corner_, next_corner_, corner_count_, age_, mark_;
  std::vector<Solid> solids_;  // memoryless only
  CollapseQueue queue_;
  std::vector<Corners> before_, after_;  // the triangles around a candidate
  std::uint32_t epoch_ = 0;
};

}  // namespace standpoint
