// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "core/edge_balance.h"
#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

template <class Visit>
void forEachEdge(const Face& face, Visit visit) {
  const auto loop = [&](const std::vector<std::uint32_t>& l) {
    for (std::size_t i = 0; i < l.size(); ++i) visit(l[i], l[i + 1 == l.size() ? 0 : i + 1]);
  };
  loop(face.outer);
  for (const auto& hole : face.holes) loop(hole);
}

// Spanned from the corners' mean, so that a loop that is not quite planar has one volume, whichever way it runs.
double loopVolume(const PolyMesh& mesh, const std::vector<std::uint32_t>& loop, const Eigen::Vector3d& origin) {
  if (loop.empty()) return 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint32_t i : loop) sum += mesh.points[i] - origin;
  return areaVector(mesh.points, loop).dot(sum) / (3.0 * static_cast<double>(loop.size()));
}

double faceVolume(const PolyMesh& mesh, const Face& face, const Eigen::Vector3d& origin) {
  double sum = loopVolume(mesh, face.outer, origin);
  if (face.holes.empty()) return sum;
  const Eigen::Vector3d normal = areaVector(mesh.points, face.outer);
  for (const auto& hole : face.holes) {  // files turn holes either way; a hole always takes away
    const double sign = areaVector(mesh.points, hole).dot(normal) > 0 ? -1.0 : 1.0;
    sum += sign * loopVolume(mesh, hole, origin);
  }
  return sum;
}

void weldLoop(std::vector<std::uint32_t>& loop, const std::vector<std::uint32_t>& map) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i : loop) {
    if (kept.empty() || kept.back() != map[i]) kept.push_back(map[i]);
  }
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  loop = std::move(kept);
}

bool isDegenerate(const PolyMesh& mesh, const std::vector<std::uint32_t>& loop, double weld_m) {
  if (loop.size() < 3) return true;
  double longest = 0;
  for (std::uint32_t i : loop) longest = std::max(longest, (mesh.points[i] - mesh.points[loop[0]]).norm());
  return areaVector(mesh.points, loop).norm() <= 1e-3 * weld_m * longest;
}

void weldAndClean(PolyMesh& mesh, double weld_m) {
  const std::vector<std::uint32_t> map = weldMap(mesh.points, weld_m);
  std::vector<Face> kept;
  for (Face& face : mesh.faces) {
    weldLoop(face.outer, map);
    if (isDegenerate(mesh, face.outer, weld_m)) continue;
    const Eigen::Vector3d normal = areaVector(mesh.points, face.outer);
    std::vector<std::vector<std::uint32_t>> holes;
    for (auto& hole : face.holes) {
      weldLoop(hole, map);
      if (isDegenerate(mesh, hole, weld_m)) continue;
      if (areaVector(mesh.points, hole).dot(normal) > 0) std::reverse(hole.begin(), hole.end());
      holes.push_back(std::move(hole));
    }
    face.holes = std::move(holes);
    kept.push_back(std::move(face));
  }
  mesh.faces = std::move(kept);
}

struct EdgeUse {
  std::uint32_t low, high, face;
  bool forward;
  bool operator<(const EdgeUse& o) const {
    return std::tie(low, high, face, forward) < std::tie(o.low, o.high, o.face, o.forward);
  }
};

std::vector<EdgeUse> sortedEdges(const PolyMesh& mesh) {
  std::vector<EdgeUse> uses;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    forEachEdge(mesh.faces[f], [&](std::uint32_t a, std::uint32_t b) {
      uses.push_back({std::min(a, b), std::max(a, b), f, a < b});
    });
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

struct Link {
  std::uint32_t face;
  bool opposed;  // the two faces run the shared edge in the same direction: one must be turned
};

std::vector<std::vector<Link>> neighbours(const PolyMesh& mesh, std::vector<bool>& has_border) {
  std::vector<std::vector<Link>> links(mesh.faces.size());
  has_border.assign(mesh.faces.size(), false);
  const std::vector<EdgeUse> uses = sortedEdges(mesh);
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
    if (end - begin == 2) {  // an edge of four faces says nothing about who belongs together
      const EdgeUse &a = uses[begin], &b = uses[begin + 1];
      links[a.face].push_back({b.face, a.forward == b.forward});
      links[b.face].push_back({a.face, a.forward == b.forward});
    } else if ((end - begin) % 2 == 1) {
      for (std::size_t i = begin; i < end; ++i) has_border[uses[i].face] = true;
    }
  }
  return links;
}

void turn(Face& face) {
  std::reverse(face.outer.begin(), face.outer.end());
  for (auto& hole : face.holes) std::reverse(hole.begin(), hole.end());
}

}  // namespace

void append(PolyMesh& to, const PolyMesh& from) {
  const auto shift = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  to.faces.reserve(to.faces.size() + from.faces.size());
  for (Face face : from.faces) {
    for (std::uint32_t& i : face.outer) i += shift;
    for (auto& hole : face.holes) {
      for (std::uint32_t& i : hole) i += shift;
    }
    to.faces.push_back(std::move(face));
  }
}

void transform(PolyMesh& mesh, const Eigen::Affine3d& to_from) {
  for (Eigen::Vector3d& p : mesh.points) p = to_from * p;
  if (to_from.linear().determinant() < 0) flip(mesh);
}

void setTag(PolyMesh& mesh, std::uint32_t tag) {
  for (Face& face : mesh.faces) face.tag = tag;
}

double volume(const PolyMesh& mesh) {
  if (mesh.points.empty()) return 0.0;
  double sum = 0;
  for (const Face& face : mesh.faces) sum += faceVolume(mesh, face, mesh.points[0]);
  return sum;
}

bool isClosed(const PolyMesh& mesh, double weld_m) {
  if (mesh.faces.empty()) return false;
  const std::vector<std::uint32_t> map = weldMap(mesh.points, weld_m);
  std::vector<PassedEdge> edges;
  for (const Face& face : mesh.faces)
    forEachEdge(face, [&](std::uint32_t a, std::uint32_t b) { edges.emplace_back(map[a], map[b]); });
  return balanced(edges);
}

namespace {

// Faces that hang together, their neighbours made to agree with the first.
struct Component {
  std::vector<std::uint32_t> faces;
  std::map<std::uint32_t, bool> turned;
  bool closed = true;
  double volume = 0;
  Eigen::AlignedBox3d box;
};

Component componentFrom(std::uint32_t seed, const PolyMesh& mesh, const std::vector<std::vector<Link>>& links,
                        const std::vector<bool>& has_border, std::vector<bool>& seen) {
  Component c;
  c.faces.push_back(seed);
  seen[seed] = true;
  for (std::size_t next = 0; next < c.faces.size(); ++next) {
    const std::uint32_t current = c.faces[next];
    c.closed = c.closed && !has_border[current];
    for (const Link& link : links[current]) {
      if (seen[link.face]) continue;
      seen[link.face] = true;
      c.faces.push_back(link.face);
    }
  }
  c.turned.emplace(seed, false);
  for (std::uint32_t current : c.faces) {
    for (const Link& link : links[current]) c.turned.emplace(link.face, c.turned[current] != link.opposed);
  }
  const Eigen::Vector3d origin = mesh.points[mesh.faces[seed].outer[0]];
  for (std::uint32_t f : c.faces) {
    c.volume += (c.turned[f] ? -1.0 : 1.0) * faceVolume(mesh, mesh.faces[f], origin);
    for (std::uint32_t i : mesh.faces[f].outer) c.box.extend(mesh.points[i]);
  }
  return c;
}

// A closed component within another one and turned against it is the cavity of a hollow body, and stays one.
bool isCavity(const Component& c, const std::vector<Component>& all) {
  const Component* around = nullptr;
  for (const Component& other : all) {
    const bool larger =
        &other != &c && other.closed && std::abs(other.volume) > std::abs(c.volume) && other.box.contains(c.box);
    if (larger && (!around || std::abs(other.volume) < std::abs(around->volume))) around = &other;
  }
  return around && (around->volume < 0) != (c.volume < 0);
}

}  // namespace

void orientOutward(PolyMesh& mesh, double weld_m) {
  weldAndClean(mesh, weld_m);
  if (mesh.faces.empty()) return;
  std::vector<bool> has_border;
  const std::vector<std::vector<Link>> links = neighbours(mesh, has_border);
  std::vector<bool> seen(mesh.faces.size(), false);
  std::vector<Component> components;
  for (std::uint32_t seed = 0; seed < mesh.faces.size(); ++seed) {
    if (!seen[seed]) components.push_back(componentFrom(seed, mesh, links, has_border, seen));
  }
  // Many loose parts are no hollow bodies, and each would be compared with each.
  constexpr std::size_t kMostCompared = 200;
  for (Component& c : components) {
    const bool cavity = c.closed && components.size() <= kMostCompared && isCavity(c, components);
    const bool inside_out = c.closed && (c.volume < 0) != cavity;
    for (std::uint32_t f : c.faces) {
      if (c.turned[f] != inside_out) turn(mesh.faces[f]);
    }
  }
}

}  // namespace standpoint::geometry
