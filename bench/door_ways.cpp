// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/door_ways.h"

#include <array>
#include <cmath>

#include "optimizer/walk/walkable.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.01;  // m between the points
constexpr double kFeet = 0.15;  // m beside the middle of a way that need a floor too
constexpr double kReach = 0.6;  // m above and below the door's lower edge that its way may lie

struct Points {
  int along = 0, across = 0;
  std::vector<std::vector<double>> heights;  // of the surface over each
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(along) + static_cast<std::size_t>(i);
  }
};

// Level rectangles of two triangles each, as the walkable surface is made of.
Points pointsOn(const Mesh& walkable, const Passage& door, double reach) {
  Points points;
  points.along = 2 * static_cast<int>(std::ceil(reach / kStep)) + 1;
  points.across = 2 * static_cast<int>(std::ceil(door.half_width / kStep)) + 1;
  points.heights.resize(static_cast<std::size_t>(points.along) * static_cast<std::size_t>(points.across));
  const Vector3d margin(reach + door.half_width, reach + door.half_width, kReach);
  for (std::size_t t = 0; t + 1 < walkable.triangles.size(); t += 2) {
    const Vector3d a = walkable.positions[walkable.triangles[t][0]].cast<double>(),
                   b = walkable.positions[walkable.triangles[t][2]].cast<double>();
    const Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
    if (((low - door.middle - margin).array() > 0).any() || ((high - door.middle + margin).array() < 0).any()) continue;
    for (int j = 0; j < points.across; ++j)
      for (int i = 0; i < points.along; ++i) {
        const Vector3d p = door.middle + door.through * ((i - points.along / 2) * kStep) +
                           door.across * ((j - points.across / 2) * kStep);
        if (p.x() >= low.x() && p.x() <= high.x() && p.y() >= low.y() && p.y() <= high.y())
          points.heights[points.at(i, j)].push_back(low.z());
      }
  }
  return points;
}

}  // namespace

bool leadsThrough(const Mesh& walkable, const Passage& door, double radius_m) {
  const Points points = pointsOn(walkable, door, door.half_depth + radius_m);
  std::vector<std::vector<char>> seen(points.heights.size());
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i].assign(points.heights[i].size(), 0);
  std::vector<std::array<int, 3>> flood;  // along, across, which height
  const auto visit = [&](int i, int j, double from) {
    if (i < 0 || j < 0 || i >= points.along || j >= points.across) return;
    const auto at = points.at(i, j);
    for (std::size_t k = 0; k < points.heights[at].size(); ++k)
      if (!seen[at][k] && std::abs(points.heights[at][k] - from) <= kStepHeight + 1e-3)
        seen[at][k] = 1, flood.push_back({i, j, static_cast<int>(k)});
  };
  for (int j = 0; j < points.across; ++j)
    for (const double z : points.heights[points.at(0, j)]) visit(0, j, z);
  for (std::size_t next = 0; next < flood.size(); ++next) {
    const auto [i, j, k] = flood[next];
    if (i == points.along - 1) return true;
    const double z = points.heights[points.at(i, j)][static_cast<std::size_t>(k)];
    visit(i + 1, j, z), visit(i - 1, j, z), visit(i, j + 1, z), visit(i, j - 1, z);
  }
  return false;
}

bool hasFloor(const Soup& model, const TriangleTree& tree, const Passage& door, double radius_m) {
  const double reach = door.half_depth + radius_m;
  const auto under = [&](double along, double beside, double level, double within) {
    Vector3d p = door.middle + door.through * along + door.across * beside;
    p.z() = level;
    return floorUnder(model, tree, p, within, within);
  };
  for (const double beside : {0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3}) {
    double level = under(-reach, beside, door.middle.z(), 0.35);
    for (double along = -reach; along <= reach && level > -1e299; along += kStep) {
      level = under(along, beside, level, kStepHeight);
      for (const double foot : {-kFeet, kFeet})  // the top of a wall is no floor
        if (level > -1e299 && under(along, beside + foot, level, kStepHeight) < -1e299) level = -1e300;
    }
    if (level > -1e299) return true;
  }
  return false;
}

}  // namespace standpoint
