// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/seams.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace standpoint::ifc {
namespace {

constexpr double kNear_m = 2e-6;  // twice what the kernel's clip takes for one plane
using Loop = std::vector<std::uint32_t>;

// Points by their x, for looking around without a tree.
class Sweep {
 public:
  explicit Sweep(const std::vector<Eigen::Vector3d>& points) : points_(points), by_x_(points.size()) {
    std::iota(by_x_.begin(), by_x_.end(), 0U);
    std::sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return points[a].x() != points[b].x() ? points[a].x() < points[b].x() : a < b;
    });
  }
  template <class Visit>
  void between(double low, double high, const Visit& visit) const {
    auto it = std::lower_bound(by_x_.begin(), by_x_.end(), low,
                               [&](std::uint32_t p, double x) { return points_[p].x() < x; });
    for (; it != by_x_.end() && points_[*it].x() <= high; ++it) visit(*it);
  }

 private:
  const std::vector<Eigen::Vector3d>& points_;
  std::vector<std::uint32_t> by_x_;
};

// Every point to the first one near it.
std::vector<std::uint32_t> welded(const std::vector<Eigen::Vector3d>& points) {
  const Sweep sweep(points);
  std::vector<std::uint32_t> to(points.size(), UINT32_MAX);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (to[i] != UINT32_MAX) continue;
    to[i] = i;
    sweep.between(points[i].x() - kNear_m, points[i].x() + kNear_m, [&](std::uint32_t j) {
      if (to[j] == UINT32_MAX && (points[j] - points[i]).norm() < kNear_m) to[j] = i;
    });
  }
  return to;
}

// Without repeated points and without spikes (there and back again).
Loop cleaned(const Loop& loop) {
  Loop result;
  for (const std::uint32_t p : loop) {
    if (!result.empty() && result.back() == p) continue;
    if (result.size() > 1 && result[result.size() - 2] == p)
      result.pop_back();
    else
      result.push_back(p);
  }
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  while (result.size() > 2 && result[1] == result.back()) result.erase(result.begin()), result.pop_back();
  return result.size() < 3 ? Loop() : result;
}

void appendBetween(Loop& loop, const std::vector<Eigen::Vector3d>& points, const std::vector<char>& used,
                   const Sweep& sweep, std::uint32_t from, std::uint32_t to) {
  const Eigen::Vector3d a = points[from], d = points[to] - a;
  const double length = d.norm();
  if (length < 2 * kNear_m) return;
  std::vector<std::pair<double, std::uint32_t>> on;
  sweep.between(
      std::min(a.x(), points[to].x()) - kNear_m, std::max(a.x(), points[to].x()) + kNear_m, [&](std::uint32_t p) {
        const Eigen::Vector3d q = points[p] - a;
        const double along = q.dot(d) / length;
        if (used[p] && along > kNear_m && along < length - kNear_m && (q - d * (along / length)).norm() < kNear_m)
          on.emplace_back(along, p);
      });
  std::sort(on.begin(), on.end());
  for (const auto& [along, p] : on) loop.push_back(p);
}

template <class Change>
void changeLoops(geometry::PolyMesh& mesh, const Change& change) {
  for (auto& face : mesh.faces) {
    face.outer = change(face.outer);
    for (auto& hole : face.holes) hole = change(hole);
    std::erase_if(face.holes, [](const Loop& l) { return l.empty(); });
  }
  std::erase_if(mesh.faces, [](const geometry::Face& f) { return f.outer.empty(); });
}

void sew(geometry::PolyMesh& mesh) {
  std::vector<char> used(mesh.points.size(), 0);
  changeLoops(mesh, [&](const Loop& loop) {
    for (const std::uint32_t p : loop) used[p] = 1;
    return loop;
  });
  const Sweep sweep(mesh.points);
  changeLoops(mesh, [&](const Loop& loop) {
    Loop sewn;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sewn.push_back(loop[i]);
      appendBetween(sewn, mesh.points, used, sweep, loop[i], loop[(i + 1) % loop.size()]);
    }
    return cleaned(sewn);
  });
}

Loop fromLeast(Loop loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

// A face and its reverse hold nothing between them.
void cancelPairs(geometry::PolyMesh& mesh) {
  std::map<Loop, std::vector<std::size_t>> open;
  std::vector<char> gone(mesh.faces.size(), 0);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (!mesh.faces[i].holes.empty()) continue;
    const Loop own = fromLeast(mesh.faces[i].outer), reversed = fromLeast(Loop(own.rbegin(), own.rend()));
    if (const auto partner = open.find(reversed); partner != open.end() && !partner->second.empty()) {
      gone[i] = gone[partner->second.back()] = 1;
      partner->second.pop_back();
    } else {
      open[own].push_back(i);
    }
  }
  std::size_t i = 0;
  std::erase_if(mesh.faces, [&](const geometry::Face&) { return gone[i++] != 0; });
}

}  // namespace

void mendSeams(geometry::PolyMesh& mesh) {
  const auto to = welded(mesh.points);
  changeLoops(mesh, [&](Loop loop) {
    for (std::uint32_t& p : loop) p = to[p];
    return cleaned(loop);
  });
  sew(mesh);
  cancelPairs(mesh);
}

void snapToPlane(geometry::PolyMesh& mesh, const Eigen::Vector3d& normal, double offset) {
  constexpr double kOn_m = 5e-6;
  for (auto& p : mesh.points)
    if (const double above = normal.dot(p) - offset; std::abs(above) < kOn_m) p -= normal * above;
}

Result<geometry::PolyMesh> clipSnapped(geometry::PolyMesh mesh, const Eigen::Vector3d& normal, double offset) {
  snapToPlane(mesh, normal, offset);
  return geometry::clip(mesh, normal, offset);
}

}  // namespace standpoint::ifc
