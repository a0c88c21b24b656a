// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/start.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "core/ceiling.h"
#include "optimizer/walk/avatar.h"
#include "optimizer/walk/doors.h"
#include "optimizer/walk/spaces.h"
#include "optimizer/walk/walkable_map.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBelowEye = 3;          // m
constexpr double kSmallestIsland = 2;    // m²
constexpr double kHead = 1.1;            // m above the feet: over tables, below ceilings
constexpr double kHighestCover = 60;     // m
constexpr double kBehindEntrance = 0.8;  // m
constexpr double kStepsBefore = 1.5;     // m, the highest flight to an entrance
constexpr double kRoomStep = 0.25;       // m between the places that are compared in a room
constexpr double kWideEnough = 2;        // m of clearance; more is no better
constexpr double kLongView = 50;         // m
constexpr double kEdgeStep = 0.1;        // m, how finely the edge of a room is looked for

Vector3d up(double height_m) { return {0, 0, height_m}; }

// Everything that places are judged by.
class Places {
 public:
  Places(const Environment& environment, const CollideResult& collision, const Obstacles& obstacles, const Body& body)
      : environment_(environment),
        collision_(collision),
        obstacles_(obstacles),
        avatar_(obstacles, body),
        islands_(collision.walkable),
        spaces_(spaceBodies(environment)) {}

  std::optional<StartPlace> belowEye(const Onlooker& onlooker) {
    const auto feet = standing(onlooker.eye, kBelowEye);
    return feet && covered(*feet) && good(*feet) ? std::optional(StartPlace{*feet, {}}) : std::nullopt;
  }

  std::optional<StartPlace> lookedAt(const Onlooker& onlooker) {
    if (!onlooker.looked_at) return std::nullopt;
    const auto feet = standing(*onlooker.looked_at, kStepHeight);
    return feet && good(*feet) ? std::optional(StartPlace{*feet, {}}) : std::nullopt;
  }

  // The outer door with the largest island behind it; of several the lowest, then that into the room with the most
  // doors, which a hall is and the room at a terrace is not, then the widest.
  std::optional<StartPlace> mainEntrance() {
    struct Entrance {
      double area_m2, width_m, low_m;
      std::size_t leads_on;
      StartPlace place;
    };
    const auto rank = [](const Entrance& e) {
      return std::tuple(e.area_m2, std::round(e.low_m / kStepHeight), e.leads_on, e.width_m);
    };
    const auto doors_of = doorsOfRooms();
    std::optional<Entrance> best;
    for (const bool by_rooms : {true, false}) {  // not every model has them, and an entrance may have a porch
      for (const auto& door : collision_.doors) {
        const auto place = behind(door, by_rooms);
        if (!place) continue;
        const auto triangle = islands_.at(place->feet);
        const auto room = spaceAt(spaces_, place->feet + up(kHead));
        const Entrance entrance{triangle ? islands_.islandArea(*triangle) : 0, door.clear_width_m, -place->feet.z(),
                                room ? doors_of.at(*room) : 0, *place};
        if (!best || rank(entrance) > rank(*best)) best = entrance;
      }
      if (best) return before(best->place);
    }
    return std::nullopt;
  }

  // Indoors where there is an indoors.
  std::optional<StartPlace> largestIsland(double lowest_m = -1e300, double highest_m = 1e300) {
    for (const bool indoors : {true, false}) {
      std::map<std::uint32_t, std::pair<double, Vector3d>> sums;  // by island: area, and first moment of it
      for (std::uint32_t i = 0; i < islands_.size(); ++i) {
        const Vector3d middle = islands_.middle(i);
        if (middle.z() < lowest_m || middle.z() > highest_m) continue;
        if (islands_.islandArea(i) < kSmallestIsland || (indoors && !covered(middle)) || !bears(middle)) continue;
        auto& [area, moment] = sums.try_emplace(islands_.islandOf(i), 0.0, Vector3d::Zero()).first->second;
        area += islands_.area(i);
        moment += islands_.area(i) * middle;
      }
      const auto most = std::max_element(sums.begin(), sums.end(),
                                         [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
      if (most == sums.end()) continue;
      const Vector3d centre = most->second.second / std::max(most->second.first, 1e-9);
      if (auto place = nearestOf(most->first, centre, indoors, lowest_m, highest_m)) return place;
    }
    return std::nullopt;
  }

 private:
  std::optional<Vector3d> standing(const Vector3d& p, double reach_m) {
    return avatar_.stand(p, reach_m) ? std::optional(avatar_.feet()) : std::nullopt;
  }

  bool covered(const Vector3d& feet) const {
    return obstacles_.ray(feet + up(kHead), feet + up(kHighestCover)).has_value();
  }

  // Neither roof nor ceiling by its class, nor by standing open to the sky above another floor.
  bool bears(const Vector3d& feet) const {
    const auto floor = obstacles_.ray(feet + up(kStepHeight), feet - up(kStepHeight));
    if (!floor || isRoofOrCeiling(environment_, floor->product)) return false;
    return covered(feet) || !islands_.anyUnder(feet);
  }

  bool good(const Vector3d& feet) const {
    const auto triangle = islands_.at(feet);
    return triangle && islands_.islandArea(*triangle) >= kSmallestIsland && bears(feet);
  }

  bool inside(const Vector3d& feet, bool by_rooms) const {
    return by_rooms ? spaceAt(spaces_, feet + up(kHead)).has_value() : covered(feet);
  }

  std::optional<StartPlace> behind(const Door& door, bool by_rooms) {
    const auto passage = door.floor ? passageOf(environment_, door.product) : std::nullopt;
    if (!passage) return std::nullopt;
    const double away = passage->half_depth + kBehindEntrance;
    const Vector3d ahead = passage->middle + away * passage->through, back = passage->middle - away * passage->through;
    const bool ahead_inside = inside(ahead, by_rooms), back_inside = inside(back, by_rooms);
    if (ahead_inside == back_inside) return std::nullopt;
    const auto feet = standing((ahead_inside ? ahead : back) + up(kStepHeight), 2 * kStepHeight);
    if (!feet || !good(*feet)) return std::nullopt;
    const Vector2d through = passage->through.head<2>();
    return StartPlace{*feet, ahead_inside ? through : Vector2d(-through)};
  }

  std::map<std::uint32_t, std::size_t> doorsOfRooms() const {
    std::map<std::uint32_t, std::size_t> count;
    for (const auto& space : spaces_) count[space.product] = 0;
    for (const auto& door : collision_.doors) {
      const auto passage = passageOf(environment_, door.product);
      for (const double side : {-1.0, 1.0}) {
        const auto room = passage
                              ? spaceAt(spaces_, passage->middle + up(kHead) +
                                                     side * (passage->half_depth + kBehindEntrance) * passage->through)
                              : std::nullopt;
        if (room) ++count[*room];
      }
    }
    return count;
  }

  // From just behind an entrance to where one comes to it from outside and sees it; the same where nobody can.
  StartPlace before(const StartPlace& behind) {
    const auto inside_island = islands_.at(behind.feet);
    const Vector3d out(-behind.facing->x(), -behind.facing->y(), 0);
    for (const double away : {4.0, 3.5, 3.0, 2.5, 2.0}) {
      const auto feet = standing(behind.feet + away * out + up(kStepHeight), kStepsBefore);
      const auto island = feet ? islands_.at(*feet) : std::nullopt;
      if (!island || !inside_island || islands_.islandOf(*island) != islands_.islandOf(*inside_island) || !bears(*feet))
        continue;
      if (!obstacles_.ray(*feet + up(kHead), behind.feet + up(kHead))) return {*feet, behind.facing};
    }
    return {behind.feet, behind.facing, true};
  }

  std::optional<StartPlace> nearestOf(std::uint32_t island, const Vector3d& centre, bool indoors, double lowest_m,
                                      double highest_m) {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < islands_.size(); ++i)
      if (islands_.islandOf(i) == island && islands_.middle(i).z() >= lowest_m && islands_.middle(i).z() <= highest_m)
        order.emplace_back((islands_.middle(i) - centre).squaredNorm(), i);
    std::sort(order.begin(), order.end());
    for (const auto& [distance, i] : order) {
      const auto feet = standing(islands_.middle(i), kStepHeight);
      if (feet && bears(*feet) && (!indoors || covered(*feet))) return StartPlace{*feet, {}};
    }
    return std::nullopt;
  }

  const Environment& environment_;
  const CollideResult& collision_;
  const Obstacles& obstacles_;
  Avatar avatar_;
  WalkableMap islands_;
  std::vector<SpaceBody> spaces_;
};

double clearance(const Obstacles& obstacles, const Vector3d& feet) {
  double gap = kWideEnough;
  constexpr double kThin = 0.05;  // m, the radius of the line that the distance is taken from
  obstacles.near({kThin, kHead}, feet + up(kStepHeight), kWideEnough, [&](const Contact& contact, double found) {
    if (std::abs(contact.normal.z()) < 0.7) gap = std::min(gap, found);
  });
  return gap;
}

// From there to where the room ends, at most `farthest`.
double toEdge(const SpaceBody& room, const Vector3d& from, const Vector3d& way, double farthest) {
  for (double away = kEdgeStep; away < farthest; away += kEdgeStep)
    if (!room.contains(from + away * way)) return away;
  return farthest;
}

// As clearance(), but a door does not lead out of the room. Once it is known to be no more than `enough`, no closer.
double clearanceInRoom(const SpaceBody& room, const Obstacles& obstacles, const Vector3d& feet, double enough) {
  constexpr int kDirections = 16;
  double gap = clearance(obstacles, feet);
  for (int i = 0; i < kDirections && gap > enough; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const Vector3d way(std::cos(angle), std::sin(angle), 0), middle = feet + up(kHead);
    if (!room.contains(middle + gap * way)) gap = toEdge(room, middle, way, gap);
  }
  return gap;
}

// Doors stand open for obstacles, but may be closed for the eye: in a room it ends where that does.
Vector2d longestView(const Obstacles& obstacles, const Vector3d& feet, const SpaceBody* room) {
  constexpr int kDirections = 32;
  Vector2d best(0, 1);
  double farthest = -1;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const Vector3d way(std::cos(angle), std::sin(angle), 0), eye = feet + up(1.5);
    const auto hit = obstacles.ray(eye, eye + kLongView * way);
    double free = hit ? kLongView * hit->fraction : kLongView;
    if (free <= farthest) continue;
    if (room != nullptr) free = toEdge(*room, feet + up(kHead), way, free);
    if (free <= farthest) continue;
    farthest = free;
    best = way.head<2>();
  }
  return best;
}

}  // namespace

std::optional<StartPlace> startPlace(const Environment& environment, const CollideResult& collision,
                                     const Obstacles& obstacles, const Body& body, const Onlooker& onlooker) {
  Places places(environment, collision, obstacles, body);
  if (auto place = places.belowEye(onlooker)) return place;
  if (auto place = places.lookedAt(onlooker)) return place;
  if (auto place = places.mainEntrance()) return place;
  return places.largestIsland();
}

std::optional<StartPlace> placeOnLevel(const Environment& environment, const CollideResult& collision,
                                       const Obstacles& obstacles, const Body& body, double lowest_m,
                                       double highest_m) {
  auto place = Places(environment, collision, obstacles, body).largestIsland(lowest_m, highest_m);
  if (place) place->facing = longestView(obstacles, place->feet, nullptr);
  return place;
}

std::optional<StartPlace> placeInRoom(const Environment& environment, std::uint32_t product,
                                      const CollideResult& collision, const Obstacles& obstacles, const Body& body) {
  const auto spaces = spaceBodies(environment);
  const auto space = std::find_if(spaces.begin(), spaces.end(), [&](const auto& s) { return s.product == product; });
  if (space == spaces.end()) return std::nullopt;
  Avatar avatar(obstacles, body);
  std::optional<Vector3d> best;
  double widest = -1;
  const auto look = [&](const Vector3d& p) {
    if (!space->contains(p + up(kHead)) || !avatar.stand(p, kStepHeight)) return;
    const double wide = clearanceInRoom(*space, obstacles, avatar.feet(), widest);
    if (wide <= widest) return;
    widest = wide;
    best = avatar.feet();
  };
  const auto& mesh = collision.walkable;
  for (const auto& t : mesh.triangles) {
    Bounds box;
    for (const auto v : t) box.extend(mesh.positions[v].cast<double>());
    const Vector3d low = box.min.cwiseMax(space->box.min), high = box.max.cwiseMin(space->box.max);
    if (low.x() > high.x() || low.y() > high.y()) continue;
    const int columns = 1 + static_cast<int>((high.x() - low.x()) / kRoomStep),
              rows = 1 + static_cast<int>((high.y() - low.y()) / kRoomStep);
    for (int column = 0; column < columns; ++column)
      for (int row = 0; row < rows; ++row)
        look({low.x() + (column + 0.5) * (high.x() - low.x()) / columns,
              low.y() + (row + 0.5) * (high.y() - low.y()) / rows, box.min.z()});
  }
  if (!best) return std::nullopt;
  return StartPlace{*best, longestView(obstacles, *best, &*space)};
}

}  // namespace standpoint
