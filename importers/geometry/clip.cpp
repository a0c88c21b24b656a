// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "importers/geometry/arrangement.h"
#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

using Loop = std::vector<std::uint32_t>;

// Points within kSnap_m of the plane count as lying on it (0), so that no slivers arise; they are not moved.
class Cutter {
 public:
  Cutter(PolyMesh& mesh, const Eigen::Vector3d& normal, double offset_m)
      : mesh_(mesh), normal_(normal), offset_(offset_m) {
    for (const Eigen::Vector3d& p : mesh.points) {
      const double height = normal.dot(p) - offset_m;
      side_.push_back(std::abs(height) <= kSnap_m ? 0 : height > 0 ? 1 : -1);
    }
  }

  int side(std::uint32_t point) const { return side_[point]; }

  std::vector<double> along;  // scratch of clipFace: place on the cutting line, per point

  // The loop with a point of its own where it passes the plane; neighbours share it.
  Loop withCrossings(const Loop& loop) {
    Loop result;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[i + 1 == loop.size() ? 0 : i + 1];
      result.push_back(a);
      if (side_[a] * side_[b] < 0) result.push_back(crossing(std::min(a, b), std::max(a, b)));
    }
    return result;
  }

 private:
  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] = crossings_.try_emplace({a, b}, static_cast<std::uint32_t>(mesh_.points.size()));
    if (fresh) {
      const Eigen::Vector3d p = mesh_.points[a], d = mesh_.points[b] - p;
      mesh_.points.push_back(p + d * ((offset_ - normal_.dot(p)) / normal_.dot(d)));
      side_.push_back(0);
    }
    return at->second;
  }

  PolyMesh& mesh_;
  Eigen::Vector3d normal_;
  double offset_;
  std::vector<int> side_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

struct Chain {
  Loop points;
  std::size_t next = SIZE_MAX;  // the chain that follows on the cutting line
};

// What one loop leaves below the plane: whole loops, and chains that begin and end on the plane.
void chainsOf(const Loop& loop, const std::vector<double>& along, const Cutter& cutter, std::vector<Chain>& chains,
              std::vector<Loop>& whole) {
  const std::size_t n = loop.size();
  const auto kept = [&](std::size_t i) {  // edge i → i+1; one on the plane stays when the inside is below it
    const std::uint32_t a = loop[i % n], b = loop[(i + 1) % n];
    return cutter.side(a) < 0 || cutter.side(b) < 0 ||
           (cutter.side(a) == 0 && cutter.side(b) == 0 && along[b] > along[a]);
  };
  const auto breaks = [&](std::size_t i) {  // point i: a chain may begin or end here
    if (cutter.side(loop[i % n]) != 0) return false;
    const bool before = kept(i + n - 1), after = kept(i);
    return before != after || (before && cutter.side(loop[(i + n - 1) % n]) < 0 && cutter.side(loop[(i + 1) % n]) < 0);
  };
  // A corner that touches the line from above must become a corner of the edge that is cut beside it, if there is one.
  for (std::size_t i = 0; i < n; ++i) {
    if (cutter.side(loop[i]) == 0 && !kept(i + n - 1) && !kept(i)) chains.push_back({{loop[i]}});
  }
  std::size_t start = 0;
  while (start < n && !breaks(start)) ++start;
  if (start == n) {
    if (kept(0)) whole.push_back(loop);
    return;
  }
  for (std::size_t i = start; i < start + n;) {
    std::size_t end = i + 1;
    while (!breaks(end)) ++end;
    if (kept(i)) {
      Chain chain;
      for (std::size_t j = i; j <= end; ++j) chain.points.push_back(loop[j % n]);
      chains.push_back(std::move(chain));
    }
    i = end;
  }
}

// Joins the chains along the cutting line: the inside lies below it between the end of one chain and the next
// beginning.
bool link(std::vector<Chain>& chains, const std::vector<double>& along) {
  struct Event {
    double at;
    bool begins;
    std::size_t chain;
  };
  std::vector<Event> events;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    events.push_back({along[chains[c].points.front()], true, c});
    events.push_back({along[chains[c].points.back()], false, c});
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return std::tie(a.at, a.chain, a.begins) < std::tie(b.at, b.chain, b.begins);
  });
  std::vector<std::size_t> open;
  for (std::size_t begin = 0, end = 0; begin < events.size(); begin = end) {
    std::vector<std::size_t> starts, ends;
    for (; end < events.size() && events[end].at <= events[begin].at + 1e-9; ++end) {
      (events[end].begins ? starts : ends).push_back(events[end].chain);
    }
    for (std::size_t s : starts) {
      std::vector<std::size_t>& from = open.empty() ? ends : open;
      if (from.empty()) return false;
      chains[from.front()].next = s;
      from.erase(from.begin());
    }
    open.insert(open.end(), ends.begin(), ends.end());
  }
  return open.empty();
}

std::vector<Loop> followChains(const std::vector<Chain>& chains) {
  std::vector<Loop> loops;
  std::vector<bool> used(chains.size(), false);
  for (std::size_t first = 0; first < chains.size(); ++first) {
    Loop loop;
    for (std::size_t c = first; !used[c]; c = chains[c].next) {
      used[c] = true;
      for (std::uint32_t p : chains[c].points) {
        if (loop.empty() || loop.back() != p) loop.push_back(p);
      }
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

void addFaces(const PolyMesh& mesh, const std::vector<Loop>& loops, const Eigen::Vector3d& normal, std::uint32_t tag,
              std::vector<Face>& faces) {
  const Projection projection(normal);
  std::vector<Loop2> flat;
  for (const Loop& loop : loops) {
    Loop2& points = flat.emplace_back();
    for (std::uint32_t p : loop) points.push_back(projection(mesh.points[p]));
  }
  const Nesting nesting = nest(flat);
  for (std::size_t o = 0; o < nesting.outers.size(); ++o) {
    Face face{loops[nesting.outers[o]], {}, tag};
    for (std::size_t h : nesting.holes[o]) face.holes.push_back(loops[h]);
    faces.push_back(std::move(face));
  }
}

// False when the face's outline contradicts itself (it crosses itself).
bool clipFace(PolyMesh& mesh, Cutter& cutter, const Face& face, const Eigen::Vector3d& plane_normal,
              std::vector<Face>& kept) {
  const Eigen::Vector3d area_vector = areaVector(mesh.points, face.outer);
  if (area_vector.norm() == 0) return true;
  const Eigen::Vector3d normal = area_vector.normalized();
  std::vector<Loop> loops{face.outer};
  loops.insert(loops.end(), face.holes.begin(), face.holes.end());
  bool below = false, above = false;
  for (const Loop& loop : loops) {
    for (std::uint32_t p : loop) below = below || cutter.side(p) < 0, above = above || cutter.side(p) > 0;
  }
  if (!above && (below || normal.dot(plane_normal) > 0)) kept.push_back(face);
  if (!above || !below) return true;
  const Eigen::Vector3d line = normal.cross(plane_normal).normalized();
  std::vector<Chain> chains;
  std::vector<Loop> whole;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (l > 0 && areaVector(mesh.points, loops[l]).dot(normal) > 0) std::reverse(loops[l].begin(), loops[l].end());
    loops[l] = cutter.withCrossings(loops[l]);
  }
  std::vector<double>& along = cutter.along;
  along.resize(mesh.points.size());
  for (const Loop& loop : loops) {
    for (std::uint32_t p : loop) along[p] = line.dot(mesh.points[p] - mesh.points[face.outer[0]]);
  }
  for (const Loop& loop : loops) chainsOf(loop, along, cutter, chains, whole);
  if (!link(chains, along)) return false;
  std::vector<Loop> result = followChains(chains);
  result.insert(result.end(), whole.begin(), whole.end());
  addFaces(mesh, result, normal, face.tag, kept);
  return true;
}

// What a face with a contradictory outline leaves is found from its triangles; triangles always cut well.
bool clipTriangles(PolyMesh& mesh, Cutter& cutter, const Face& face, const Eigen::Vector3d& normal,
                   std::vector<Face>& kept) {
  std::vector<Triangle> triangles;
  if (!triangulate(mesh.points, face, triangles)) return false;
  for (const Triangle& t : triangles) {
    if (!clipFace(mesh, cutter, {{t[0], t[1], t[2]}, {}, face.tag}, normal, kept)) return false;
  }
  return true;
}

// Closes the cut: the kept faces' edges on the plane, run backwards, bound the cap wherever no neighbour cancels them.
bool closeCut(PolyMesh& mesh, const Cutter& cutter, const Eigen::Vector3d& normal) {
  const Projection projection(normal);
  std::vector<Eigen::Vector2d> points;
  std::vector<std::uint32_t> mesh_point;
  std::map<std::uint32_t, std::uint32_t> local;
  std::vector<Segment> segments;
  const auto add = [&](std::uint32_t p) {
    const auto [at, fresh] = local.try_emplace(p, static_cast<std::uint32_t>(points.size()));
    if (fresh) points.push_back(projection(mesh.points[p])), mesh_point.push_back(p);
    return at->second;
  };
  for (const Face& face : mesh.faces) {
    const auto loop = [&](const Loop& l) {
      for (std::size_t i = 0; i < l.size(); ++i) {
        const std::uint32_t a = l[i], b = l[i + 1 == l.size() ? 0 : i + 1];
        if (cutter.side(a) == 0 && cutter.side(b) == 0) segments.push_back({add(b), add(a), 0, 1, 1, face.tag});
      }
    };
    loop(face.outer);
    for (const Loop& hole : face.holes) loop(hole);
  }
  if (segments.empty()) return true;
  const std::optional<Arrangement> arrangement = arrange(points, segments, 1, 1e-7);
  if (!arrangement) return false;
  const auto loops = boundary(*arrangement, [](std::span<const int> winding) { return winding[0] > 0; });
  if (!loops) return false;
  for (std::size_t i = points.size(); i < arrangement->points.size(); ++i) {  // where outlines cross in the plane
    Eigen::Vector3d p = mesh.points[mesh_point[0]];
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    Eigen::Vector3d moved = p;
    moved[projection.u] = arrangement->points[i].x(), moved[projection.v] = arrangement->points[i].y();
    moved[axis] = p[axis] - (normal.dot(moved - p) - normal[axis] * (moved[axis] - p[axis])) / normal[axis];
    mesh_point.push_back(static_cast<std::uint32_t>(mesh.points.size()));
    mesh.points.push_back(moved);
  }
  std::vector<Loop> cap;
  for (const BoundaryLoop& loop : *loops) {
    Loop& points_of_cap = cap.emplace_back();
    for (std::uint32_t p : loop.points) points_of_cap.push_back(mesh_point[p]);
  }
  addFaces(mesh, cap, normal, loops->empty() ? 0 : loops->front().tag, mesh.faces);
  return true;
}

void dropUnusedPoints(PolyMesh& mesh) {
  std::vector<std::uint32_t> to(mesh.points.size(), UINT32_MAX);
  std::vector<Eigen::Vector3d> points;
  const auto use = [&](Loop& loop) {
    for (std::uint32_t& i : loop) {
      if (to[i] == UINT32_MAX) to[i] = static_cast<std::uint32_t>(points.size()), points.push_back(mesh.points[i]);
      i = to[i];
    }
  };
  for (Face& face : mesh.faces) {
    use(face.outer);
    for (Loop& hole : face.holes) use(hole);
  }
  mesh.points = std::move(points);
}

}  // namespace

Result<PolyMesh> clip(const PolyMesh& mesh, const Eigen::Vector3d& normal_unit, double offset_m) {
  if (!isFinite(mesh) || !normal_unit.allFinite() || !std::isfinite(offset_m) ||
      std::abs(normal_unit.norm() - 1) > 1e-6) {
    return failure(ErrorKind::unusable, "clip: invalid coordinate or plane");
  }
  PolyMesh result;
  result.points = mesh.points;
  Cutter cutter(result, normal_unit, offset_m);
  for (const Face& face : mesh.faces) {
    if (face.outer.size() < 3) continue;
    std::vector<Face> kept;
    if (!clipFace(result, cutter, face, normal_unit, kept)) {
      kept.clear();
      if (!clipTriangles(result, cutter, face, normal_unit, kept)) {
        return failure(ErrorKind::unusable, "clip: self-intersecting face outline");
      }
    }
    result.faces.insert(result.faces.end(), kept.begin(), kept.end());
  }
  const bool capped = closeCut(result, cutter, normal_unit);
  if (!capped && isClosed(mesh)) return failure(ErrorKind::unusable, "clip: cannot close the cut");
  dropUnusedPoints(result);
  return result;
}

}  // namespace standpoint::geometry
