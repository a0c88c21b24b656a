// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/plausibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

namespace standpoint {

namespace {

struct Unit {
  const char* option;   // of --unit
  const char* name;
  double metres;
};
// The likeliest first.
constexpr std::array kUnits{Unit{"mm", "millimetres", 0.001}, Unit{"m", "metres", 1}, Unit{"cm", "centimetres", 0.01},
                            Unit{"in", "inches", 0.0254}, Unit{"ft", "feet", 0.3048}};

// Higher than all but a few dozen towers; ground may be as high, but then it is wide and flat.
constexpr double kHighest_m = 300;
constexpr double kHighestGround_m = 1000;
constexpr double kFlat = 5;             // width over height of ground rather than building
constexpr double kWidest_m = 50000;     // of a city or a railway line in one file
constexpr double kSmallest_m = 0.5;     // less is a part of a building, or in another unit
constexpr double kStorey_m = 2;         // a building is at least that in every direction

std::string length(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, metres < 1000 ? "%.3g m" : "%.3g km", metres < 1000 ? metres : metres / 1000);
  return text;
}

bool looksLikeBuilding(const Eigen::Vector3d& size) {
  return size.maxCoeff() >= 3 && size.maxCoeff() <= 2000 && size.z() <= 150;
}

// The unit in which the model would be the size of a building.
const Unit* likelyUnit(const Eigen::Vector3d& size_units, double metres_per_unit) {
  for (const Unit& unit : kUnits)
    if (unit.metres != metres_per_unit && looksLikeBuilding(size_units * unit.metres)) return &unit;
  return nullptr;
}

std::optional<Issue> doubtSize(const Eigen::Vector3d& size, const FrameOrigin& origin) {
  const double width = std::max(size.x(), size.y());
  std::string what;
  if (size.z() > kHighestGround_m || (size.z() > kHighest_m && width < kFlat * size.z())) what = "the model is " + length(size.z()) + " high";
  else if (width > kWidest_m) what = "the model is " + length(width) + " wide";
  else if (size.maxCoeff() < kSmallest_m) what = "the whole model is only " + length(size.maxCoeff()) + " large";
  else return std::nullopt;
  const Unit* unit = likelyUnit(size / origin.metres_per_unit, origin.metres_per_unit);
  if (unit == nullptr) what += "; its unit looks wrong";
  else if (origin.unit_stated) what += "; the unit looks wrong, the numbers look like " + std::string(unit->name);
  else what += "; the numbers look like " + std::string(unit->name) + ": import with --unit " + unit->option;
  return Issue{Severity::warning, "", what};
}

// Area of the faces that look along each axis within 8 degrees; in a building floors, ceilings and roofs are the most.
Eigen::Vector3d areaAlongAxes(const Environment& environment) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (const Instance& instance : environment.instances) {
    const Mesh& mesh = *environment.meshes[instance.mesh];
    const Eigen::Matrix3d linear = instance.world_from_mesh.linear();
    for (const Triangle& t : mesh.triangles) {
      const Eigen::Vector3d a = mesh.positions[t[0]].cast<double>();
      const Eigen::Vector3d u = linear * (mesh.positions[t[1]].cast<double>() - a);
      const Eigen::Vector3d v = linear * (mesh.positions[t[2]].cast<double>() - a);
      const Eigen::Vector3d normal = u.cross(v);
      int axis = 0;
      const double along = normal.cwiseAbs().maxCoeff(&axis);
      if (along > 0.99 * normal.norm()) area[axis] += 0.5 * along;
    }
  }
  return area;
}

// The two axes that files stand on are z and y here: a file's other upright axis lies along y after either reading.
std::optional<Issue> doubtStance(const Environment& environment, const Eigen::Vector3d& size) {
  if (size.minCoeff() < kStorey_m || size.y() > 0.8 * size.z()) return std::nullopt;
  const Eigen::Vector3d area = areaAlongAxes(environment);
  if (area.y() < 1.5 * std::max(area.z(), area.x())) return std::nullopt;
  return Issue{Severity::warning, "", "most of its faces look sideways, as floors do in a building that lies on its side: "
                                      "import with the other upright axis (--up z, or --up y if that was asked for)"};
}

}  // namespace

std::vector<Issue> plausibility(const Environment& environment, const FrameOrigin& origin) {
  std::vector<Issue> issues;
  const Bounds box = bounds(environment);
  if (box.empty()) return issues;
  const Eigen::Vector3d size = box.max - box.min;
  if (auto issue = doubtSize(size, origin)) issues.push_back(std::move(*issue));
  if (!origin.up_stated)
    if (auto issue = doubtStance(environment, size)) issues.push_back(std::move(*issue));
  return issues;
}

}  // namespace standpoint
