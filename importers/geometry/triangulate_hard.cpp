// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/geometry/triangulate_hard.h"

#include <algorithm>
#include <exception>
#include <map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "importers/geometry/arrangement.h"

namespace standpoint::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Tds = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// A crossing throws instead of making a point that no index names.
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

constexpr std::size_t kMaxQuestions = 2'000'000'000;  // groups times points: some seconds

using EdgeList = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

struct Flat {
  std::vector<Eigen::Vector2d> points;  // in the order of the loops
  std::vector<std::uint32_t> index;     // into the caller's points
  std::vector<Loop2> loops;
  EdgeList edges;
  std::vector<std::pair<Eigen::Vector2d, std::uint32_t>> inner;
};

Flat flatten(std::span<const Eigen::Vector3d> points, const std::vector<std::vector<std::uint32_t>>& loops,
             const Projection& projection) {
  Flat flat;
  for (const auto& loop : loops) {
    const auto base = static_cast<std::uint32_t>(flat.points.size()), n = static_cast<std::uint32_t>(loop.size());
    Loop2& own = flat.loops.emplace_back();
    for (std::uint32_t i = 0; i < n; ++i) {
      flat.points.push_back(projection(points[loop[i]]));
      flat.index.push_back(loop[i]);
      flat.edges.emplace_back(base + i, base + (i + 1) % n);
      own.push_back(flat.points.back());
    }
    const bool should_be_positive = &loop == &loops.front();
    if ((signedArea(own) > 0) != should_be_positive) std::reverse(own.begin(), own.end());
  }
  return flat;
}

bool isInside(const Flat& flat, const Eigen::Vector2d& p) {
  int winding = 0;
  for (const Loop2& loop : flat.loops) winding += windingNumber(loop, p);
  return winding > 0;
}

using Faces = std::vector<Delaunay::Face_handle>;

// All faces, the infinite ones too, that can be reached without crossing a constraint; marks them as seen.
Faces reach(Delaunay::Face_handle seed) {
  Faces group{seed};
  seed->info() = 1;
  for (std::size_t next = 0; next < group.size(); ++next) {
    const auto f = group[next];
    for (int i = 0; i < 3; ++i) {
      const auto other = f->neighbor(i);
      if (other->info() != 0 || f->is_constrained(i)) continue;
      other->info() = 1;
      group.push_back(other);
    }
  }
  return group;
}

double doubledArea(Delaunay::Face_handle f) {
  const auto &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// A group of faces that no constraint parts is all in or all out: one question each, asked in the middle of its largest
// face. False when a hostile number of groups would take minutes.
bool emitInside(Delaunay& delaunay, const Flat& flat, std::vector<Triangle>& triangles) {
  for (auto f : delaunay.all_face_handles()) f->info() = 0;
  reach(delaunay.infinite_face());
  std::size_t questions = 0;
  for (auto seed : delaunay.finite_face_handles()) {
    if (seed->info() != 0) continue;
    if (++questions * flat.points.size() > kMaxQuestions) return false;
    const Faces group = reach(seed);
    const auto largest =
        *std::max_element(group.begin(), group.end(), [](auto f, auto g) { return doubledArea(f) < doubledArea(g); });
    const auto middle = CGAL::centroid(delaunay.triangle(largest));
    if (!isInside(flat, {middle.x(), middle.y()})) continue;
    for (const auto& f : group) {
      triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    }
  }
  return true;
}

bool delaunayOf(const Flat& flat, const EdgeList& edges, std::vector<Triangle>& triangles) {
  const std::size_t before = triangles.size();
  try {
    Delaunay delaunay;
    std::vector<Delaunay::Vertex_handle> vertices(flat.points.size());
    Delaunay::Vertex_handle last;
    const auto vertex = [&](std::uint32_t i) {
      if (vertices[i] != Delaunay::Vertex_handle()) return vertices[i];
      const std::size_t count = delaunay.number_of_vertices();
      const Delaunay::Face_handle hint = last == Delaunay::Vertex_handle() ? Delaunay::Face_handle() : last->face();
      vertices[i] = delaunay.insert({flat.points[i].x(), flat.points[i].y()}, hint);
      if (delaunay.number_of_vertices() > count) vertices[i]->info() = flat.index[i];
      return last = vertices[i];
    };
    for (const auto& [a, b] : edges) {
      const auto from = vertex(a), to = vertex(b);
      if (from != to) delaunay.insert_constraint(from, to);
    }
    for (const auto& [p, index] : flat.inner) {
      const std::size_t count = delaunay.number_of_vertices();
      const auto inserted = delaunay.insert({p.x(), p.y()}, last->face());
      if (delaunay.number_of_vertices() > count) inserted->info() = index;
    }
    if (delaunay.dimension() < 2 || !emitInside(delaunay, flat, triangles)) {
      triangles.resize(before);
      return false;
    }
  } catch (const std::exception&) {
    triangles.resize(before);
    return false;
  }
  return triangles.size() > before;
}

}  // namespace

bool triangulateHard(std::span<const Eigen::Vector3d> points, const std::vector<std::vector<std::uint32_t>>& loops,
                     std::span<const std::uint32_t> inner, const Projection& projection,
                     std::vector<Triangle>& triangles) {
  Flat flat = flatten(points, loops, projection);
  for (const auto i : inner) flat.inner.emplace_back(projection(points[i]), i);
  if (delaunayOf(flat, flat.edges, triangles)) return true;
  // Outlines that cross by a hair, as touching holes do after rounding: snap them, then try again.
  std::vector<Segment> segments;
  for (const auto& [a, b] : flat.edges) segments.push_back({a, b, 0, 1});
  const auto arrangement = arrange(flat.points, segments, 1, kSnap_m);
  if (!arrangement || arrangement->points.size() > flat.points.size()) return false;
  EdgeList edges;
  for (const auto& edge : arrangement->edges) edges.emplace_back(edge.a, edge.b);
  return delaunayOf(flat, edges, triangles);
}

}  // namespace standpoint::geometry
