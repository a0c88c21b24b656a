// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"

namespace standpoint {

// The point of triangle abc that is nearest to p (Ericson, Real-Time Collision Detection, 5.1.5: by Voronoi regions).
Eigen::Vector3d closestPoint(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c);

// A bounding-volume hierarchy over triangles, for distances and for "which triangles are near this box".
// It keeps references: positions and triangles must outlive it.
class TriangleTree {
 public:
  TriangleTree(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles);

  // Squared distance from p to the nearest triangle, or `bound` when nothing is nearer than that.
  double squaredDistance(const Eigen::Vector3d& p, double bound = std::numeric_limits<double>::infinity()) const;

  // The nearest triangle; none (the largest number) where nothing is nearer than the square root of `bound`. A search
  // that only asks whether something is near may end at the first that is no further than the root of `enough`.
  struct Near {
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = std::numeric_limits<std::uint32_t>::max();
  };
  Near nearestTriangle(const Eigen::Vector3d& p, double bound = std::numeric_limits<double>::infinity(),
                       double enough = 0) const;

  // Whether p is on the side of its nearest triangle that the triangle faces.
  bool isOutside(const Eigen::Vector3d& p) const;

  // The same distance for whatever the triangles stand for: squared(triangle, bound) is asked for those whose box is
  // nearer than bound.
  template <class Squared>
  double nearest(const Eigen::Vector3d& p, double bound, Squared squared, double enough = 0) const {
    return nearFirst(bound, enough, squared, [&](const Node& node) {
      return (node.low.cast<double>() - p).cwiseMax(p - node.high.cast<double>()).cwiseMax(0.0).squaredNorm();
    });
  }

  // How far along a ray (origin + t * direction) the first triangle is, or `reach`; for whatever the triangles stand
  // for, hit(triangle, reach) is asked for t, or for anything not below `reach`, of those whose box the ray meets.
  template <class Hit>
  double alongRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach, Hit hit) const {
    const Eigen::Vector3d inverse = direction.cwiseInverse();  // infinite along the axes, which slabs can do with
    return nearFirst(reach, -std::numeric_limits<double>::infinity(), hit, [&, reach](const Node& node) {
      double from = 0, to = reach;
      for (int k = 0; k < 3; ++k) {
        const double a = (static_cast<double>(node.low[k]) - origin[k]) * inverse[k],
                     b = (static_cast<double>(node.high[k]) - origin[k]) * inverse[k];
        from = std::max(from, std::min(a, b));  // a NaN (0 times infinity: on the slab's plane) leaves `from` as it is
        to = std::min(to, std::max(a, b));
      }
      return from <= to ? from : std::numeric_limits<double>::infinity();
    });
  }
  double firstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach) const;

  // Calls visit(triangle index) for each triangle whose box meets [low, high]; stops when visit returns false.
  template <class Visit>
  void inBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Visit visit) const {
    if (pairs_.empty()) return;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& here = node(stack[--top]);
      if ((here.low.cast<double>().array() > high.array()).any() ||
          (here.high.cast<double>().array() < low.array()).any())
        continue;
      if (here.count > 0) {
        for (std::uint32_t i = here.first; i < here.first + here.count; ++i)
          if (meetsBox(order_[i], low, high) && !visit(order_[i])) return;
      } else {
        stack[top++] = here.first;
        stack[top++] = here.first + 1;
      }
    }
  }

 private:
  struct Node {
    Eigen::Vector3f low, high;  // rounded outward
    std::uint32_t first = 0;    // of the children, or of the leaf's triangles in order_
    std::uint32_t count = 0;    // 0: inner node
  };
  struct alignas(64) Pair {  // of children: one cache line
    Node nodes[2];
  };
  struct Item {
    Eigen::Vector3f centre;
    std::uint32_t triangle;
  };
  // The least that cost(triangle, bound) gives, or `bound`, over the triangles of all nodes that from(node) puts below
  // it, those nearer first; ends at the first that is not above `enough`.
  template <class Cost, class From>
  double nearFirst(double bound, double enough, Cost cost, From from) const {
    if (pairs_.empty()) return bound;
    struct Entry {
      double from;
      std::uint32_t node;
    };
    Entry stack[64];
    int top = 0;
    stack[top++] = {from(node(0)), 0};
    while (top > 0) {
      const Entry entry = stack[--top];
      if (!(entry.from < bound)) continue;
      const Node& here = node(entry.node);
      if (here.count > 0) {
        for (std::uint32_t i = here.first; i < here.first + here.count; ++i)
          bound = std::min(bound, cost(order_[i], bound));
        if (bound <= enough) return bound;
        continue;
      }
      Entry left{from(node(here.first)), here.first}, right{from(node(here.first + 1)), here.first + 1};
      if (left.from < right.from) std::swap(left, right);
      stack[top++] = left;
      stack[top++] = right;  // the nearer one is looked at first
    }
    return bound;
  }

  Node& node(std::uint32_t i) { return pairs_[i / 2].nodes[i % 2]; }
  const Node& node(std::uint32_t i) const { return pairs_[i / 2].nodes[i % 2]; }
  void build(std::uint32_t index, std::uint32_t below, std::vector<Item>& items);
  bool meetsBox(std::uint32_t triangle, const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  void fitLeaf(Node& node) const;

  std::span<const Eigen::Vector3d> positions_;
  std::span<const Triangle> triangles_;
  std::vector<Pair> pairs_;  // node i is that of pair i / 2; 0 is the root, 1 is none
  std::vector<std::uint32_t> order_;
};

}  // namespace standpoint
