// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/tight_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "optimizer/walk/avatar.h"
#include "optimizer/walk/door_connectivity.h"
#include "optimizer/walk/doors.h"
#include "optimizer/walk/spaces.h"
#include "optimizer/walk/walkable_map.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr int kTallestTried = 19, kLowestTried = 12;  // dm
constexpr std::array kSlimBodies = {0.25, 0.20};      // m, radii that are tried beside the agent's
constexpr double kInSpace = 0.9;                      // m above the floor: within a space that begins on it
constexpr double kLowSample = 0.02;                   // m between the places of a way that are looked at
constexpr double kGained = 1000;                      // times as dear as what the taller body walks on, too
constexpr double kOver = 2.5;                         // m over a floor that a headroom is measured to

double inMetres(int height_dm) { return height_dm / 10.0; }

const Room* reachedRoom(const WalkedWorld& world, std::uint32_t product) {
  for (const auto& room : world.rooms.rooms)
    if (room.product == product && room.reached) return &room;
  return nullptr;
}

std::vector<Vector3d> samplesOf(const Vector3d& a, const Vector3d& b) {
  const int count = 1 + static_cast<int>((b - a).norm() / kLowSample);
  std::vector<Vector3d> samples;
  for (int i = 0; i < count; ++i) samples.push_back(a + (b - a) * (i + 0.5) / count);
  return samples;
}

// The worlds of bodies of one radius and all heights, made when they are asked for.
class LowerWorlds {
 public:
  LowerWorlds(const Environment& environment, const std::vector<CollisionShape>& shapes,
              const std::vector<bool>& overhead, const CollideOptions& options, const WalkedWorld* tallest,
              Progress& progress)
      : environment_(environment),
        shapes_(shapes),
        overhead_(overhead),
        options_(options),
        tallest_(tallest),
        progress_(progress) {
    highest_dm_ = std::min(kTallestTried, static_cast<int>(std::ceil(options.agent_height_m * 10 - 1e-6)) - 1);
  }

  // Above it there is the agent's own height.
  int highest_dm() const { return highest_dm_; }
  CollideOptions optionsAt(int height_dm) const {
    CollideOptions lower = options_;
    if (height_dm <= highest_dm_) lower.agent_height_m = std::max(inMetres(height_dm), 2 * lower.agent_radius_m);
    return lower;
  }
  Result<const WalkedWorld*> at(int height_dm) {
    if (height_dm > highest_dm_ && tallest_ != nullptr) return tallest_;
    if (const auto known = worlds_.find(height_dm); known != worlds_.end()) return &known->second;
    TRY(progress_.check());
    Progress unseen;  // the bar is for all of them; whether to go on is asked between two
    TRY_ASSIGN(auto world, walkedWorld(environment_, shapes_, overhead_, optionsAt(height_dm), unseen));
    return &worlds_.emplace(height_dm, std::move(world)).first->second;
  }

 private:
  const Environment& environment_;
  const std::vector<CollisionShape>& shapes_;
  const std::vector<bool>& overhead_;
  CollideOptions options_;
  const WalkedWorld* tallest_;  // where it is known
  Progress& progress_;
  int highest_dm_ = 0;
  std::map<int, WalkedWorld> worlds_;
};

// The tallest body that gets into the room: what a body reaches, every lower one does.
Result<int> tallestInto(LowerWorlds& worlds, std::uint32_t product) {
  int reached = kLowestTried, not_reached = worlds.highest_dm() + 2;
  while (not_reached - reached > 1) {
    const int middle = (reached + not_reached) / 2;
    TRY_ASSIGN(const auto* world, worlds.at(middle));
    (reachedRoom(*world, product) != nullptr ? reached : not_reached) = middle;
  }
  return reached;
}

// Where the lower body comes from what the taller one reaches into the room, over as little as possible on which the
// taller one cannot be.
std::optional<TightPlace> placeOf(const SpaceBody& space, const WalkedWorld& lower, const WalkedWorld& taller,
                                  const Obstacles& obstacles, const CollideOptions& lower_options) {
  const WalkableMap map(lower.walkable.mesh), before(taller.walkable.mesh);
  const auto islandAt = [](const WalkedWorld& world, std::uint32_t rectangle) {
    return world.walkable.island_of_triangle[2 * std::size_t{rectangle}];
  };
  std::vector<Vector3d> reached;
  for (std::uint32_t i = 0; i < before.size(); ++i)
    if (taller.rooms.reached_islands.contains(islandAt(taller, i))) reached.push_back(before.middle(i));
  const auto isGained = [&](const Vector3d& p) { return !before.under(p); };
  const auto way = map.cheapestWay(
      reached,
      [&](std::uint32_t i) {
        return lower.rooms.reached_islands.contains(islandAt(lower, i)) &&
               space.contains(map.middle(i) + Vector3d(0, 0, kInSpace));
      },
      [&](const Vector3d& a, const Vector3d& b) {
        const auto samples = samplesOf(a, b);
        const auto gained = std::count_if(samples.begin(), samples.end(), isGained);
        return (b - a).norm() * (1 + kGained * static_cast<double>(gained) / static_cast<double>(samples.size()));
      });
  std::optional<TightPlace> lowest;
  Avatar avatar(obstacles, {lower_options.agent_radius_m, lower_options.agent_height_m});
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    for (const auto& p : samplesOf(way[i], way[i + 1])) {
      if (!isGained(p) || !avatar.stand(p + Vector3d(0, 0, 0.1), kStepHeight)) continue;
      const double headroom = avatar.ceiling(kOver);
      if (!lowest || headroom < lowest->headroom_m)
        lowest = TightPlace{avatar.feet(), headroom, lower_options.agent_height_m, lower_options.agent_radius_m};
    }
  return lowest;
}

}  // namespace

Result<WalkedWorld> walkedWorld(const Environment& environment, const std::vector<CollisionShape>& shapes,
                                const std::vector<bool>& overhead, const CollideOptions& options, Progress& progress) {
  WalkedWorld world;
  TRY_ASSIGN(world.walkable, walkableSurface(shapes, overhead, options, progress));
  TRY(progress.check());
  world.doors = checkDoors(environment, shapes, options, world.report);
  joinThroughDoors(environment, shapes, options, world.doors, world.walkable, world.report);
  if (options.doors != DoorState::closed) world.rooms = checkRooms(environment, world.walkable, world.doors);
  return world;
}

Result<void> findTightPlaces(const Environment& environment, const std::vector<CollisionShape>& shapes,
                             const std::vector<bool>& overhead, const CollideOptions& options, WalkedWorld& world,
                             Progress& progress) {
  auto& rooms = world.rooms.rooms;
  const auto isOpen = [](const Room& room) { return !room.reached && !room.tight_place; };
  const auto spaces = spaceBodies(environment);
  std::optional<Obstacles> obstacles;
  for (const double radius_m : {options.agent_radius_m, kSlimBodies[0], kSlimBodies[1]}) {
    const bool own = radius_m == options.agent_radius_m;
    if ((!own && radius_m > options.agent_radius_m - 1e-6) || std::none_of(rooms.begin(), rooms.end(), isOpen))
      continue;
    CollideOptions slim = options;
    slim.agent_radius_m = radius_m;
    LowerWorlds worlds(environment, shapes, overhead, slim, own ? &world : nullptr, progress);
    if (worlds.highest_dm() < kLowestTried) continue;
    if (!obstacles) obstacles.emplace(shapes);
    TRY_ASSIGN(const auto* lowest, worlds.at(kLowestTried));
    for (auto& room : rooms) {
      if (!isOpen(room) || reachedRoom(*lowest, room.product) == nullptr) continue;
      TRY_ASSIGN(const int height_dm, tallestInto(worlds, room.product));
      TRY_ASSIGN(const auto* lower, worlds.at(height_dm));
      // Where a slimmer body gets in at full height, its radius is all.
      TRY_ASSIGN(const auto* taller,
                 height_dm > worlds.highest_dm() ? Result<const WalkedWorld*>(&world) : worlds.at(height_dm + 1));
      const auto space =
          std::find_if(spaces.begin(), spaces.end(), [&](const SpaceBody& s) { return s.product == room.product; });
      room.tight_place = placeOf(*space, *lower, *taller, *obstacles, worlds.optionsAt(height_dm));
    }
  }
  return {};
}

}  // namespace standpoint
