// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/rooms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/readable_name.h"
#include "optimizer/walk/doors.h"
#include "optimizer/walk/spaces.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.1;        // m between the places that are asked
constexpr double kBodyMiddle = 0.9;  // m above the floor: spaces begin on it or on the slab below it
constexpr double kBesideRoom = 0.3;  // m before and behind a door where its rooms are looked for
constexpr double kNearDoor = 0.3;    // m from there to the surface that the door leads onto …
constexpr double kSill = 0.35;       // … and above or below the door's lower edge
constexpr double kGround = 1.5;      // m above the lowest entrance up to which a door is one
constexpr double kLeast = 0.05;      // m² to stand on

// What of an island lies in a space.
struct Patch {
  double area_m2 = 0;
  double lowest = std::numeric_limits<double>::infinity();
};

struct Space : SpaceBody {
  std::map<std::uint32_t, Patch> patches;  // by island
  double area_m2 = 0;
};

// What of each island lies in the space, on a grid laid over its rectangles.
void measure(const Walkable& walkable, Space& space) {
  const auto& mesh = walkable.mesh;
  for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 2) {  // two triangles make a level rectangle
    const Vector3d low = mesh.positions[mesh.triangles[i][0]].cast<double>(),
                   high = mesh.positions[mesh.triangles[i][2]].cast<double>();
    const double z = low.z() + kBodyMiddle;
    if (low.x() > space.box.max.x() || high.x() < space.box.min.x() || low.y() > space.box.max.y() ||
        high.y() < space.box.min.y() || z < space.box.min.z() || z > space.box.max.z())
      continue;
    const int columns = std::max(1, static_cast<int>(std::ceil((high.x() - low.x()) / kStep))),
              rows = std::max(1, static_cast<int>(std::ceil((high.y() - low.y()) / kStep)));
    const double fraction = (high.x() - low.x()) * (high.y() - low.y()) / (static_cast<double>(columns) * rows);
    for (int column = 0; column < columns; ++column)
      for (int row = 0; row < rows; ++row) {
        const Vector3d p(low.x() + (column + 0.5) * (high.x() - low.x()) / columns,
                         low.y() + (row + 0.5) * (high.y() - low.y()) / rows, z);
        if (!space.contains(p)) continue;
        auto& patch = space.patches[walkable.island_of_triangle[i]];
        patch.area_m2 += fraction;
        patch.lowest = std::min(patch.lowest, low.z());
        space.area_m2 += fraction;
      }
  }
}

// The island that leads into most rooms, unless all of it is above `ceiling`.
std::optional<std::uint32_t> islandOfMost(const std::vector<Space>& spaces, double ceiling) {
  struct Sum {
    int rooms = 0;
    Patch patch;
  };
  std::map<std::uint32_t, Sum> islands;
  for (const auto& space : spaces)
    for (const auto& [island, patch] : space.patches) {
      if (patch.area_m2 <= kLeast) continue;
      auto& sum = islands[island];
      ++sum.rooms;
      sum.patch.area_m2 += patch.area_m2;
      sum.patch.lowest = std::min(sum.patch.lowest, patch.lowest);
    }
  std::erase_if(islands, [&](const auto& i) { return i.second.patch.lowest >= ceiling; });
  const auto most = std::max_element(islands.begin(), islands.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second.rooms, a.second.patch.area_m2) < std::pair(b.second.rooms, b.second.patch.area_m2);
  });
  return most == islands.end() ? std::nullopt : std::optional(most->first);
}

// The islands of the surface nearest to p, as far as that is within reach.
void addIslandsAt(const Walkable& walkable, const Vector3d& p, std::set<std::uint32_t>& islands) {
  const auto& mesh = walkable.mesh;
  for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 2) {
    const Vector3d low = mesh.positions[mesh.triangles[i][0]].cast<double>(),
                   high = mesh.positions[mesh.triangles[i][2]].cast<double>();
    const Vector3d off = p - p.cwiseMax(low.cwiseMin(high)).cwiseMin(low.cwiseMax(high));
    if (off.head<2>().norm() <= kNearDoor && std::abs(off.z()) <= kSill) islands.insert(walkable.island_of_triangle[i]);
  }
}

// Just behind the passable doors that lead from where no room is into one, at their lower edge.
std::vector<Vector3d> entrances(const Environment& environment, const std::vector<Space>& spaces,
                                const std::vector<Door>& doors) {
  std::vector<Vector3d> found;
  const auto isInAny = [&](const Vector3d& p) {
    return std::any_of(spaces.begin(), spaces.end(), [&](const Space& space) { return space.contains(p); });
  };
  for (const auto& door : doors) {
    const auto passage = door.passable ? passageOf(environment, door.product) : std::nullopt;
    if (!passage) continue;
    const Vector3d reach = passage->through * (passage->half_depth + kBesideRoom), up(0, 0, kBodyMiddle);
    const bool before = isInAny(passage->middle - reach + up), behind = isInAny(passage->middle + reach + up);
    if (before != behind) found.emplace_back(passage->middle + (behind ? reach : -reach));
  }
  return found;
}

// The islands that one gets to. Behind an entrance not all islands of its room: the upper end of a stair that nobody
// climbs may begin there too. An upper entrance may only lead from a balcony, an upper island hang together with many
// rooms and with no way down.
std::set<std::uint32_t> reachedIslands(const Environment& environment, const Walkable& walkable,
                                       const std::vector<Space>& spaces, const std::vector<Door>& doors) {
  const auto entered = entrances(environment, spaces, doors);
  double ceiling = std::numeric_limits<double>::infinity();
  for (const auto& p : entered) ceiling = std::min(ceiling, p.z() + kGround);
  std::set<std::uint32_t> islands;
  for (const auto& p : entered)
    if (p.z() < ceiling) addIslandsAt(walkable, p, islands);
  if (const auto island = islandOfMost(spaces, ceiling)) islands.insert(*island);
  return islands;
}

}  // namespace

RoomCheck checkRooms(const Environment& environment, const Walkable& walkable, const std::vector<Door>& doors) {
  std::vector<Space> spaces;
  for (auto& body : spaceBodies(environment)) spaces.push_back({std::move(body), {}, 0});
  tbb::parallel_for(std::size_t{0}, spaces.size(), [&](std::size_t i) { measure(walkable, spaces[i]); });
  RoomCheck check{{}, reachedIslands(environment, walkable, spaces, doors)};
  for (const auto& space : spaces) {
    Room room{space.product, space.area_m2, false, 0.5 * (space.box.min + space.box.max), {}};
    for (const auto& [island, patch] : space.patches)
      room.reached = room.reached || (patch.area_m2 > kLeast && check.reached_islands.contains(island));
    room.position.z() = space.box.min.z();
    check.rooms.push_back(room);
  }
  return check;
}

void reportRooms(const Environment& environment, const std::vector<Room>& rooms, Report& report) {
  for (const auto& room : rooms) {
    const auto& product = environment.products[room.product];
    if (room.reached || room.tight_place) continue;
    report.warn(product.id, room.walkable_m2 <= kLeast
                                ? fmt::format("room {} has no floor large enough to stand on", readableName(product))
                                : fmt::format("room {} cannot be reached", readableName(product)));
  }
}

}  // namespace standpoint
