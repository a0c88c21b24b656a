// SPDX-License-Identifier: GPL-3.0-or-later
// Faces on curved surfaces: the bounds are brought into the surface's parameters, triangulated there, and the triangles
// split along edges that leave the surface. An edge is split by a rule that only looks at its ends, so neighbours
// agree; edges of the bounds are never split, because the next face shares them.
#include <algorithm>
#include <map>
#include <numbers>

#include "importers/geometry/polygon.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/faceted.h"

namespace standpoint::ifc {
namespace {

using Uv = Eigen::Vector2d;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

struct Patch {
  std::vector<Uv> uv;
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
  std::map<Edge, bool> is_bound;
};

Edge edge(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

struct UvLoop {
  std::vector<Uv> uv;
  std::vector<Eigen::Vector3d> points;
  Uv drift = Uv::Zero();  // how far it is from closing: a whole period where it runs around
};

// The parameter that has no value at a pole, where a whole line of the parameters is one point; −1: this is none.
int undefinedAt(const ParametricSurface& surface, const Uv& uv) {
  for (const int k : {0, 1})
    if (surface.period()[k] > 0 &&
        (surface.at(uv + Uv::Unit(k) * surface.period()[k] / 4) - surface.at(uv)).norm() < 1e-7)
      return k;
  return -1;
}

UvLoop toParameters(std::vector<Eigen::Vector3d> points, const ParametricSurface& surface) {
  UvLoop loop;
  Uv near = surface.low().x() < surface.high().x() ? Uv((surface.low() + surface.high()) / 2) : Uv(Uv::Zero());
  const auto regular = std::find_if(points.begin(), points.end(), [&](const auto& p) {
    return undefinedAt(surface, surface.parameters(p, near)) < 0;
  });
  if (regular != points.end()) std::rotate(points.begin(), regular, points.end());
  const auto append = [&](const Uv& uv, const Eigen::Vector3d& p) { loop.uv.push_back(uv), loop.points.push_back(p); };
  // A pole is passed along its line, from where the bound arrives to where it leaves.
  int pole = -1;
  std::size_t left_at = 0;
  const auto leave = [&](const Uv& next) {
    if (pole < 0) return;
    Uv uv = loop.uv.back();
    const double from = uv[pole], turn = next[pole] - from;
    const Eigen::Vector3d point = loop.points.back();
    left_at = loop.uv.size();
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / surface.period()[pole] * 32)));
    for (int i = 1; i <= steps; ++i) uv[pole] = from + turn * i / steps, append(uv, point);
    pole = -1;
  };
  for (const auto& p : points) {
    near = surface.parameters(p, near);
    const int here = undefinedAt(surface, near);
    if (here < 0) leave(near);
    append(near, p);
    if (here >= 0) pole = here;
  }
  if (points.empty()) return loop;
  const Uv end = surface.parameters(points.front(), near);
  leave(end);
  loop.drift = end - loop.uv.front();
  // Which way round the pole only the end tells: a bound that passed it closes.
  if (left_at > 0 && loop.drift.norm() > 0.5 * surface.period().maxCoeff()) {
    const Uv arrived = loop.uv[left_at - 1];
    std::size_t back = left_at;
    while (back + 1 < loop.uv.size() && loop.points[back + 1] == loop.points[left_at]) ++back;
    const Uv turn = loop.uv[back] - arrived;
    for (std::size_t i = left_at; i < loop.uv.size(); ++i)
      loop.uv[i] = i > back ? Uv(loop.uv[i] - loop.drift)
                            : Uv(arrived + (turn - loop.drift) * static_cast<double>(i + 1 - left_at) /
                                               static_cast<double>(back + 1 - left_at));
    loop.drift.setZero();
  }
  return loop;
}

double area2(const std::vector<Uv>& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Uv &a = loop[i], &b = loop[(i + 1) % loop.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum / 2;
}

// Within a hundredth of their size, for files round their points.
bool liesOn(const std::vector<UvLoop>& loops, const ParametricSurface& surface) {
  Eigen::AlignedBox3d box;
  double off = 0;
  for (const UvLoop& loop : loops)
    for (std::size_t i = 0; i < loop.uv.size(); ++i) {
      box.extend(loop.points[i]);
      off = std::max(off, (surface.at(loop.uv[i]) - loop.points[i]).norm());
    }
  return off <= 1e-3 + 0.01 * box.diagonal().norm();
}

// A tube's side may be bounded by two rings without a seam: both are opened and joined to one outline.
bool joinRings(std::vector<UvLoop>& loops, double period) {
  if (!(period > 0)) return true;
  std::vector<std::size_t> rings;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (loops[i].drift.norm() > 0.5 * period) rings.push_back(i);
  if (rings.empty()) return true;
  if (rings.size() != 2) return false;
  UvLoop a = loops[rings[0]], b = loops[rings[1]];
  if (a.drift.dot(b.drift) > 0) {
    std::reverse(b.uv.begin() + 1, b.uv.end());
    std::reverse(b.points.begin() + 1, b.points.end());
    for (auto it = b.uv.begin() + 1; it != b.uv.end(); ++it) *it -= b.drift;
    b.drift = -b.drift;
  }
  // b runs the other way; it starts over the end of a.
  std::size_t start = 0;
  const Uv end = a.uv.front() + a.drift;
  const double turn = a.drift.norm();
  const auto apart = [&](const Uv& x) { return std::abs(std::remainder((x - end).dot(a.drift) / turn, turn)); };
  for (std::size_t i = 1; i < b.uv.size(); ++i)
    if (apart(b.uv[i]) < apart(b.uv[start])) start = i;
  UvLoop joined = a;
  joined.uv.push_back(end);
  joined.points.push_back(a.points.front());
  const Uv offset = a.drift * std::round((end - b.uv[start]).dot(a.drift) / (turn * turn));
  for (std::size_t k = 0; k <= b.uv.size(); ++k) {
    const std::size_t i = (start + k) % b.uv.size();
    joined.uv.push_back(b.uv[i] + offset + (start + k >= b.uv.size() ? b.drift : Uv(Uv::Zero())));
    joined.points.push_back(b.points[i]);
  }
  joined.drift.setZero();
  loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(rings[1]));
  loops[rings[0]] = std::move(joined);
  return true;
}

// A lattice in the parameters on which chords keep to the surface.
struct Lattice {
  Uv low = Uv::Zero(), step = Uv::Zero();
  Eigen::Vector2i count = Eigen::Vector2i::Ones();  // of steps
};

// A chord over a step h is |S''| h² / 8 off; half of the error is left to the diagonals.
Lattice latticeOver(const std::vector<UvLoop>& loops, const ParametricSurface& surface, double chord_error_m) {
  constexpr int kProbes = 8, kMostSteps = 100;
  Eigen::AlignedBox2d box;
  for (const auto& loop : loops)
    for (const auto& p : loop.uv) box.extend(p);
  Lattice lattice{box.min(), box.sizes(), {1, 1}};
  for (const int k : {0, 1}) {
    const double d = box.sizes()[k] / 64;
    if (!(d > 0)) continue;
    double bend = 0;
    for (int i = 0; i < kProbes * kProbes; ++i) {
      const Uv at = box.min() + box.sizes().cwiseProduct(Uv(i % kProbes + 0.5, i / kProbes + 0.5) / kProbes);
      const Uv off = Uv::Unit(k) * d;
      bend = std::max(bend, (surface.at(at + off) - 2 * surface.at(at) + surface.at(at - off)).norm() / (d * d));
    }
    lattice.count[k] = static_cast<int>(
        std::clamp(std::ceil(box.sizes()[k] * std::sqrt(bend / (4 * chord_error_m))), 1.0, double{kMostSteps}));
    lattice.step[k] = box.sizes()[k] / lattice.count[k];
  }
  return lattice;
}

double squaredDistance(const Uv& p, const Uv& a, const Uv& b) {
  const double length = (b - a).squaredNorm(), t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0;
  return (a + (b - a) * t - p).squaredNorm();
}

// Lattice points within the loops, a third of a step off them. Where a surface bends both ways, corners on the bounds
// alone leave long triangles, which no halving of their edges brings onto it.
std::vector<std::uint32_t> innerPoints(const std::vector<UvLoop>& loops, const Lattice& lattice,
                                       const ParametricSurface& surface, Patch& patch) {
  const auto inSteps = [&](const Uv& p) { return Uv((p - lattice.low).cwiseQuotient(lattice.step)); };
  std::vector<geometry::Loop2> scaled;
  for (const auto& loop : loops)
    for (scaled.emplace_back(); const auto& p : loop.uv) scaled.back().push_back(inSteps(p));
  const auto inside = [&](const Uv& p) {
    int crossings = 0;
    for (const auto& loop : scaled) {
      crossings += geometry::windingNumber(loop, p) != 0 ? 1 : 0;
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (squaredDistance(p, loop[i], loop[(i + 1) % loop.size()]) < 1.0 / 9) return false;
    }
    return crossings == 1;  // within the outline and in no hole
  };
  std::vector<std::uint32_t> inner;
  for (int i = 1; i < lattice.count.x(); ++i)
    for (int k = 1; k < lattice.count.y(); ++k) {
      if (!inside({i, k})) continue;
      inner.push_back(static_cast<std::uint32_t>(patch.uv.size()));
      patch.uv.emplace_back(lattice.low + lattice.step.cwiseProduct(Uv(i, k)));
      patch.points.push_back(surface.at(patch.uv.back()));
    }
  return inner;
}

// Triangulates in the parameters: in steps of the lattice where the surface bends both ways, else stretched to about
// the lengths they have in space.
bool triangulateLoops(const std::vector<UvLoop>& loops, const ParametricSurface& surface, double chord_error_m,
                      Patch& patch) {
  geometry::Face face;
  for (const UvLoop& loop : loops) {
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < loop.uv.size(); ++i) {
      indices.push_back(static_cast<std::uint32_t>(patch.uv.size()));
      patch.uv.push_back(loop.uv[i]);
      patch.points.push_back(loop.points[i]);
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
      patch.is_bound[edge(indices[i], indices[(i + 1) % indices.size()])] = true;
    (face.outer.empty() ? face.outer : face.holes.emplace_back()) = std::move(indices);
  }
  const Lattice lattice = latticeOver(loops, surface, chord_error_m);
  std::vector<std::uint32_t> inner;
  Uv scale = Uv::Ones();
  if (lattice.count.minCoeff() > 1) {
    inner = innerPoints(loops, lattice, surface, patch);
    scale = lattice.step.cwiseInverse();
  } else {
    const Uv middle = loops[0].uv[0], h(1e-3, 1e-3);
    const double su = (surface.at(middle + Uv(h.x(), 0)) - surface.at(middle)).norm() / h.x(),
                 sv = (surface.at(middle + Uv(0, h.y())) - surface.at(middle)).norm() / h.y();
    scale = {su > 1e-9 ? su : 1, sv > 1e-9 ? sv : 1};
  }
  std::vector<Eigen::Vector3d> flat;
  for (const Uv& p : patch.uv) flat.emplace_back(p.x() * scale.x(), p.y() * scale.y(), 0);
  return geometry::triangulate(flat, face, patch.triangles, inner) && !patch.triangles.empty();
}

bool leaves(const Patch& patch, const ParametricSurface& surface, std::uint32_t a, std::uint32_t b, double tolerance) {
  for (const double t : {0.5, 0.25, 0.75}) {
    const Eigen::Vector3d on_surface = surface.at(patch.uv[a] + (patch.uv[b] - patch.uv[a]) * t);
    if ((patch.points[a] + (patch.points[b] - patch.points[a]) * t - on_surface).norm() > tolerance) return true;
  }
  return false;
}

// One round of splitting; false when nothing was left to split.
bool split(Patch& patch, const ParametricSurface& surface, double tolerance) {
  std::map<Edge, std::uint32_t> middle;
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k) {
      const Edge e = edge(t[k], t[(k + 1) % 3]);
      if (patch.is_bound.contains(e) || middle.contains(e) || !leaves(patch, surface, e.first, e.second, tolerance))
        continue;
      middle[e] = static_cast<std::uint32_t>(patch.uv.size());
      patch.uv.push_back((patch.uv[e.first] + patch.uv[e.second]) / 2);
      patch.points.push_back(surface.at(patch.uv.back()));
    }
  if (middle.empty()) return false;
  std::vector<Triangle> next;
  for (const Triangle& t : patch.triangles) {
    // The outline of the triangle with its new middles, as a fan that starts at a middle.
    std::vector<std::uint32_t> ring;
    std::size_t start = 0;
    for (int k = 0; k < 3; ++k) {
      ring.push_back(t[k]);
      if (const auto it = middle.find(edge(t[k], t[(k + 1) % 3])); it != middle.end())
        start = ring.size(), ring.push_back(it->second);
    }
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const Triangle part{ring[start % ring.size()], ring[(start + i) % ring.size()],
                          ring[(start + i + 1) % ring.size()]};
      next.push_back(part);
    }
  }
  patch.triangles = std::move(next);
  return true;
}

}  // namespace

Result<void> appendOnSurface(geometry::PolyMesh& mesh, const ParametricSurface& on, const Outlines& outlines,
                             bool turned, const Entity& face, Scope& scope) {
  std::vector<UvLoop> loops;
  for (const auto& points : outlines)
    if (points.size() >= 3) loops.push_back(toParameters(points, on));
  if (loops.empty()) return {};  // a face without area is no loss
  if (!liesOn(loops, on)) return fail(face, "the bounds of the face are not on its surface");
  if (!joinRings(loops, on.period().maxCoeff()))
    return fail(face, "a face whose bound encloses its whole surface is not supported");
  std::stable_sort(loops.begin(), loops.end(),
                   [](const UvLoop& a, const UvLoop& b) { return std::abs(area2(a.uv)) > std::abs(area2(b.uv)); });
  Patch patch;
  if (!triangulateLoops(loops, on, scope.tessellation.chord_error_m, patch))
    return fail(face, "cannot triangulate the face");
  constexpr std::size_t kMostTriangles = 20000;
  bool fine = false;
  for (int round = 0; !fine && round < 10 && patch.triangles.size() < kMostTriangles; ++round)
    fine = !split(patch, on, scope.tessellation.chord_error_m);
  if (!fine)
    scope.report.note(face.place(), "the face has " + std::to_string(patch.triangles.size()) +
                                        " triangles and still exceeds the chord error");
  if (!scope.spend(patch.points.size())) return fail(face, "too many points");
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), patch.points.begin(), patch.points.end());
  for (const Triangle& t : patch.triangles) {
    if (patch.points[t[0]] == patch.points[t[1]] || patch.points[t[1]] == patch.points[t[2]] ||
        patch.points[t[2]] == patch.points[t[0]])
      continue;  // at a pole
    geometry::Face f;
    f.outer = {base + t[0], base + t[1], base + t[2]};
    if (turned) std::swap(f.outer[1], f.outer[2]);
    mesh.faces.push_back(std::move(f));
  }
  return {};
}

Result<void> appendCurvedFace(geometry::PolyMesh& mesh, const Entity& face, Scope& scope) {
  TRY_ASSIGN(const auto on, surface(face.ref(1), scope));
  Outlines outlines;
  for (const Entity& bound : face.refs(0)) {
    TRY_ASSIGN(auto points, loopPoints(bound.ref(0), scope));
    outlines.push_back(std::move(points));
  }
  return appendOnSurface(mesh, *on, outlines, face[2].symbol() == "F", face, scope);
}

}  // namespace standpoint::ifc
