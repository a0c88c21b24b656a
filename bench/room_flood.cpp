// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/room_flood.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <tbb/parallel_for.h>

#include "optimizer/walk/doors.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.05;      // m between the places
constexpr std::size_t kStride = 3;  // places
constexpr double kAround = 2;       // m around the rooms that are looked at
constexpr double kGround = 1.5;     // m above the lowest door outside of which one comes in
constexpr double kChest = 0.9;      // m above the floor where a room is asked for
constexpr double kFewest = 0.05;    // m² that count

struct Space {
  std::uint32_t product = 0;
  Soup soup;
  Bounds box;
};

std::vector<Space> spacesOf(const Environment& environment) {
  std::map<std::uint32_t, Space> spaces;
  for (const auto& instance : environment.instances) {
    if (environment.products[instance.product].ifc_class != "IfcSpace") continue;
    auto& space = spaces[instance.product];
    space.product = instance.product;
    space.soup.add(*environment.meshes[instance.mesh], instance.world_from_mesh, 0);
  }
  std::vector<Space> result;
  for (auto& [product, space] : spaces) {
    for (const auto& p : space.soup.positions) space.box.extend(p);
    if (!space.box.empty()) result.push_back(std::move(space));
  }
  return result;
}

bool within(const Space& space, const Vector3d& p) {
  if ((p.array() < space.box.min.array()).any() || (p.array() > space.box.max.array()).any()) return false;
  double sum = 0;  // solid angles
  for (std::uint32_t i = 0; i < space.soup.triangles.size(); ++i) {
    const auto t = space.soup.corners(i);
    const Vector3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(sum) > 6.28;  // half a turn of 4 pi
}

// Several, where a flat's space lies over its rooms'.
std::vector<int> spacesAt(const std::vector<Space>& spaces, const Vector3d& p) {
  std::vector<int> result;
  for (std::size_t i = 0; i < spaces.size(); ++i)
    if (within(spaces[i], p)) result.push_back(static_cast<int>(i));
  return result;
}

std::vector<double> floorsAt(const Soup& soup, const TriangleTree& tree, double x, double y, const Bounds& box) {
  std::vector<double> result;
  tree.inBox({x - 1e-7, y - 1e-7, box.min.z()}, {x + 1e-7, y + 1e-7, box.max.z()}, [&](std::uint32_t i) {
    const auto t = soup.corners(i);
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (std::abs(normal.z()) < 0.7 * normal.norm() || normal.norm() < 1e-12) return true;
    const auto side = [&](int a, int b) {
      return (t[b].x() - t[a].x()) * (y - t[a].y()) - (t[b].y() - t[a].y()) * (x - t[a].x());
    };
    const double s = side(0, 1), q = side(1, 2), r = side(2, 0);
    if ((s >= 0 && q >= 0 && r >= 0) || (s <= 0 && q <= 0 && r <= 0))
      result.push_back(t[0].z() - ((x - t[0].x()) * normal.x() + (y - t[0].y()) * normal.y()) / normal.z());
    return true;
  });
  std::sort(result.begin(), result.end());
  std::vector<double> upper;  // what is just under another surface is its underside, or under a carpet
  for (std::size_t i = 0; i < result.size(); ++i)
    if (i + 1 == result.size() || result[i + 1] - result[i] > kStepHeight) upper.push_back(result[i]);
  return upper;
}

struct Place {
  Vector3d feet;
  std::vector<int> spaces;
};

}  // namespace

bool meets(const Soup& soup, const TriangleTree& tree, const Body& body, const Vector3d& from, const Vector3d& to) {
  const Vector3d low(0, 0, body.radius_m), high(0, 0, body.height_m - body.radius_m),
      margin = Vector3d::Constant(body.radius_m);
  const Corners first{from + low, to + low, to + high}, second{from + low, to + high, from + high};
  bool result = false;
  tree.inBox((from + low).cwiseMin(to + low) - margin, (from + high).cwiseMax(to + high) + margin,
             [&](std::uint32_t i) {
               const auto t = soup.corners(i);
               result = distance(first, t) < body.radius_m || distance(second, t) < body.radius_m;
               return !result;
             });
  return result;
}

std::vector<FloodedRoom> floodRooms(const Environment& environment, const Soup& model, const Body& body) {
  const auto spaces = spacesOf(environment);
  const TriangleTree tree(model.positions, model.triangles);
  const Body upper{body.radius_m - 1e-3, body.height_m - kStepHeight};
  const Vector3d lift(0, 0, kStepHeight);
  Bounds box;
  for (const auto& space : spaces)
    box.extend(space.box.min - Vector3d(kAround, kAround, kAround)),
        box.extend(space.box.max + Vector3d(kAround, kAround, 0));
  if (spaces.empty()) return {};
  const auto columns = static_cast<std::size_t>((box.max.x() - box.min.x()) / kStep),
             rows = static_cast<std::size_t>((box.max.y() - box.min.y()) / kStep);
  std::vector<std::vector<Place>> places(columns * rows);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t at) {
    const double x = box.min.x() + (static_cast<double>(at % columns) + 0.317) * kStep,
                 y = box.min.y() + (static_cast<double>(at / columns) + 0.613) * kStep;
    for (const double z : floorsAt(model, tree, x, y, box))
      if (const Vector3d feet(x, y, z); !meets(model, tree, upper, feet + lift, feet + lift))
        places[at].push_back({feet, spacesAt(spaces, feet + Vector3d(0, 0, kChest))});
  });
  std::vector<std::size_t> first(places.size() + 1, 0);
  for (std::size_t i = 0; i < places.size(); ++i) first[i + 1] = first[i] + places[i].size();
  std::vector<std::size_t> joined(first.back());
  std::iota(joined.begin(), joined.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (joined[i] != i) i = joined[i] = joined[joined[i]];
    return i;
  };
  // A stride goes up by a step before the body is over the higher floor, so some places between are passed and not
  // stood on.
  for (std::size_t at = 0; at < places.size(); ++at)
    for (std::size_t stride = 1; stride <= kStride; ++stride)
      for (const bool sideways : {false, true}) {
        const bool there = sideways ? at / columns + stride < rows : at % columns + stride < columns;
        const auto next = at + stride * (sideways ? columns : 1);
        for (std::size_t i = 0; there && i < places[at].size(); ++i)
          for (std::size_t k = 0; k < places[next].size(); ++k) {
            Vector3d a = places[at][i].feet, b = places[next][k].feet;
            const double rise = std::abs(a.z() - b.z());
            if (rise > kStepHeight + 1e-3 || root(first[at] + i) == root(first[next] + k)) continue;
            a.z() = b.z() = std::max(a.z(), b.z());
            if ((stride > 1 || rise > 1e-3) && meets(model, tree, upper, a + lift, b + lift)) continue;
            joined[root(first[at] + i)] = root(first[next] + k);
          }
      }
  std::map<std::size_t, std::map<int, double>> areas;  // by what hangs together, and by space
  for (std::size_t at = 0; at < places.size(); ++at)
    for (std::size_t i = 0; i < places[at].size(); ++i)
      for (const int space : places[at][i].spaces) areas[root(first[at] + i)][space] += kStep * kStep;
  // Where one comes in: inside of those doors that lead from none into a room, near the lowest.
  std::vector<Vector3d> behind;
  for (std::uint32_t i = 0; i < environment.products.size(); ++i) {
    const auto door =
        environment.products[i].ifc_class.starts_with("IfcDoor") ? passageOf(environment, i) : std::nullopt;
    if (!door) continue;
    const Vector3d reach = door->through * (door->half_depth + 0.35), chest(0, 0, kChest);
    const bool one = spacesAt(spaces, door->middle - reach + chest).empty(),
               other = spacesAt(spaces, door->middle + reach + chest).empty();
    if (one != other) behind.emplace_back(door->middle + reach * (one ? 1 : -1));
  }
  double ground = 1e300;
  for (const auto& p : behind) ground = std::min(ground, p.z() + kGround);
  std::set<std::size_t> entered;
  std::map<std::size_t, double> lowest;  // place in a room, of what hangs together
  for (std::size_t at = 0; at < places.size(); ++at)
    for (std::size_t i = 0; i < places[at].size(); ++i) {
      const auto& place = places[at][i];
      if (!place.spaces.empty()) {
        double& own = lowest.try_emplace(root(first[at] + i), place.feet.z()).first->second;
        own = std::min(own, place.feet.z());
      }
      for (const auto& p : behind)
        if (p.z() < ground && (p - place.feet).head<2>().norm() < 0.3 && std::abs(p.z() - place.feet.z()) < 0.4)
          entered.insert(root(first[at] + i));
    }
  std::size_t mainland = std::numeric_limits<std::size_t>::max();
  double most = 0;
  for (const auto& [component, by_space] : areas) {
    double rooms = 0;
    for (const auto& [space, area] : by_space) rooms += area > kFewest ? 1 + 1e-6 * area : 0;
    if (rooms > most && lowest.at(component) < ground) most = rooms, mainland = component;
  }
  std::vector<FloodedRoom> result;
  for (std::size_t s = 0; s < spaces.size(); ++s) {
    FloodedRoom room;
    room.product = spaces[s].product;
    std::set<int> others;
    for (const auto& [component, by_space] : areas) {
      const auto own = by_space.find(static_cast<int>(s));
      if (own == by_space.end()) continue;
      room.area_m2 += own->second;
      if (component == mainland) room.mainland_m2 += own->second;
      if (entered.contains(component)) room.entered_m2 += own->second;
      if (own->second > kFewest)
        for (const auto& [space, area] : by_space)
          if (area > kFewest && space != static_cast<int>(s)) others.insert(space);
    }
    room.others = static_cast<int>(others.size());
    result.push_back(room);
  }
  return result;
}

}  // namespace standpoint
