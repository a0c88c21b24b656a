// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/geometry/polygon.h"

#include <algorithm>
#include <unordered_map>

namespace standpoint::geometry {
namespace {

using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0x9E3779B97F4A7C15ull;
    for (int i = 0; i < 3; ++i) h = (h ^ static_cast<std::uint64_t>(c[i])) * 0xD6E8FEB86659FD93ull, h ^= h >> 32;
    return h;
  }
};

// The middle of an edge lies on no other loop's edge, while corners may touch.
Eigen::Vector2d middleOfLongestEdge(const Loop2& loop) {
  double longest = -1;
  Eigen::Vector2d middle = loop.front();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i];
    const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
    if ((b - a).squaredNorm() > longest) longest = (b - a).squaredNorm(), middle = 0.5 * (a + b);
  }
  return middle;
}

}  // namespace

int windingNumber(std::span<const Eigen::Vector2d> loop, const Eigen::Vector2d& point) {
  int winding = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i];
    const Eigen::Vector2d& b = loop[i + 1 == loop.size() ? 0 : i + 1];
    if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
    const double side = cross(a, b, point);
    if (a.y() <= point.y() && side > 0) ++winding;
    if (a.y() > point.y() && side < 0) --winding;
  }
  return winding;
}

bool isFinite(const PolyMesh& mesh) {
  for (const Eigen::Vector3d& p : mesh.points) {
    if (!p.allFinite()) return false;
  }
  const auto in_range = [&](const std::vector<std::uint32_t>& loop) {
    return std::all_of(loop.begin(), loop.end(), [&](std::uint32_t i) { return i < mesh.points.size(); });
  };
  for (const Face& face : mesh.faces) {
    if (!in_range(face.outer) || !std::all_of(face.holes.begin(), face.holes.end(), in_range)) return false;
  }
  return true;
}

void flip(PolyMesh& mesh) {
  for (Face& face : mesh.faces) {
    std::reverse(face.outer.begin(), face.outer.end());
    for (auto& hole : face.holes) std::reverse(hole.begin(), hole.end());
  }
}

void addFace(PolyMesh& mesh, std::vector<std::uint32_t> loop) {
  for (std::size_t i = 0; i < loop.size() && loop.size() > 1;) {
    if (loop[i] == loop[(i + 1) % loop.size()]) {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  if (loop.size() < 3) return;
  const Eigen::Vector3d normal = areaVector(mesh.points, loop);
  const double length = normal.norm();
  if (length < 1e-18) return;
  bool planar = true;
  for (std::uint32_t i : loop) {
    planar = planar && std::abs(normal.dot(mesh.points[i] - mesh.points[loop[0]])) <= 1e-9 * length;
  }
  if (planar || loop.size() == 3) {
    mesh.faces.push_back({std::move(loop), {}, 0});
    return;
  }
  for (std::size_t i = 2; i < loop.size(); ++i) mesh.faces.push_back({{loop[0], loop[i - 1], loop[i]}, {}, 0});
}

Nesting nest(std::span<const Loop2> loops) {
  Nesting result;
  std::vector<double> areas;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    areas.push_back(signedArea(loops[i]));
    if (areas[i] > 0) result.outers.push_back(i);
  }
  result.holes.resize(result.outers.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (areas[i] >= 0) continue;
    std::size_t best = result.outers.size();
    if (result.outers.size() == 1) {
      best = 0;
    } else {
      const Eigen::Vector2d inside = middleOfLongestEdge(loops[i]);
      for (std::size_t o = 0; o < result.outers.size(); ++o) {
        const double outer_area = areas[result.outers[o]];
        const bool smaller = best == result.outers.size() || outer_area < areas[result.outers[best]];
        if (smaller && outer_area >= -areas[i] && windingNumber(loops[result.outers[o]], inside) != 0) best = o;
      }
    }
    if (best < result.outers.size()) result.holes[best].push_back(i);
  }
  return result;
}

std::vector<std::uint32_t> weldMap(std::span<const Eigen::Vector3d> points, double weld_m) {
  std::vector<std::uint32_t> map(points.size());
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;  // only looked up, never walked
  cells.reserve(points.size());
  const double size = 4 * weld_m;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    map[i] = i;
    if (!points[i].allFinite() || points[i].cwiseAbs().maxCoeff() > 1e9) continue;
    const Cell low = ((points[i].array() - weld_m) / size).floor().cast<std::int64_t>();
    const Cell high = ((points[i].array() + weld_m) / size).floor().cast<std::int64_t>();
    Cell c;
    for (c[0] = low[0]; c[0] <= high[0] && map[i] == i; ++c[0]) {
      for (c[1] = low[1]; c[1] <= high[1] && map[i] == i; ++c[1]) {
        for (c[2] = low[2]; c[2] <= high[2] && map[i] == i; ++c[2]) {
          const auto found = cells.find(c);
          if (found == cells.end()) continue;
          for (std::uint32_t j : found->second) {
            if ((points[j] - points[i]).squaredNorm() <= weld_m * weld_m) {
              map[i] = j;
              break;
            }
          }
        }
      }
    }
    if (map[i] == i) cells[(points[i].array() / size).floor().cast<std::int64_t>()].push_back(i);
  }
  return map;
}

}  // namespace standpoint::geometry
