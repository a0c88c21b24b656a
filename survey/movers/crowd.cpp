// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/movers/crowd.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/motion/random_walk.h"
#include "core/portable_math.h"
#include "core/random.h"
#include "optimizer/walk/walkable_map.h"
#include "survey/movers/moving_world.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCrowdStep_s = 0.02;
constexpr int kStepsPerPlace = 10;  // kWayStep_s
constexpr double kUnderWay_s = 30, kUsual_s = 120, kLongest_s = 3600;
constexpr double kMostPlaces = 2e6;    // of all people: a project of 40 MB
constexpr double kBraking_s = 2.5;     // before they go back
constexpr double kTurning_s = 20;      // within which each of them stops, and sets off again
constexpr double kLeastIsland_m2 = 2;  // nobody walks up and down on less
constexpr int kDraws = 200;            // of a place to begin
constexpr double kNearestGoal_m = 1, kReached_m = 0.35;
constexpr double kStalled_s = 1.5;  // … then another way, then another goal
// The social force model; values as usual, unsourced.
constexpr double kRelaxation_s = 0.5, kStrength_m2ps2 = 2.1, kForceReach_m = 0.3, kForesight_s = 2;
constexpr double kBehind = 0.5, kBehindCosine = -0.17364817766693;  // seen within 100° of ahead
constexpr double kForceMost_mps2 = 10, kFasterMost = 1.3;
// Fitted to the law of crowdedSpeed: people who give way to each other step aside and slow down by this much of what
// pushes back, and who was slower than they want to be over the last seconds wants to be faster by that difference.
constexpr double kSlowing = 0.2, kHaste = 1, kPace_s = 2;
constexpr double kSight_m = 3, kDensityRadius_m = 1.5, kWithinFloor_m = 1;
constexpr double kMargin_m = 0.06;  // above kBodyDiameter_m: for the curve between places
constexpr double kSlowest_mps = 0.1;
constexpr double kStepMost_m = 0.2;  // nobody gets as far in a step

// Whatever takes room on a floor just now.
struct FloorBody {
  Vector3d at = Vector3d::Zero();
  Vector2d velocity = Vector2d::Zero();
  double radius_m = kBodyDiameter_m / 2;
};

// Which bodies are within kSight_m of a place, by a grid of such cells; bodies may have moved by a step since.
class BodiesNear {
 public:
  explicit BodiesNear(const std::vector<FloorBody>& bodies) {
    for (std::uint32_t i = 0; i < bodies.size(); ++i) cells_.emplace_back(cellOf(bodies[i].at), i);
    std::sort(cells_.begin(), cells_.end());
  }
  template <class Visit>
  void around(const Vector3d& place, const Visit& visit) const {
    const Cell middle = cellOf(place);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const Cell cell{middle.first + dx, middle.second + dy};
        for (auto at = std::lower_bound(cells_.begin(), cells_.end(), std::pair(cell, 0U));
             at != cells_.end() && at->first == cell; ++at)
          visit(at->second);
      }
  }

 private:
  using Cell = std::pair<int, int>;
  static Cell cellOf(const Vector3d& p) {
    return {static_cast<int>(std::floor(p.x() / (kSight_m + 0.1))),
            static_cast<int>(std::floor(p.y() / (kSight_m + 0.1)))};
  }
  std::vector<std::pair<Cell, std::uint32_t>> cells_;
};

// What pushes somebody at `from` away from another: the gradient of a repulsion that falls off with the semi-minor axis
// of the ellipse about the other's next step.
Vector2d repulsion(const Vector2d& from, const Vector2d& of_other_velocity) {
  const Vector2d ahead = of_other_velocity * kForesight_s, rest = from - ahead;
  const double near = from.norm(), far = rest.norm(), sum = near + far;
  if (near < 1e-6 || far < 1e-6) return Vector2d::Zero();
  const double axis = std::max(0.05, 0.5 * std::sqrt(std::max(0.0, sum * sum - ahead.squaredNorm())));
  const Vector2d gradient = sum / (4 * axis) * (from / near + rest / far);
  const Vector2d force = kStrength_m2ps2 / kForceReach_m * portable::exp(-axis / kForceReach_m) * gradient;
  const double size = force.norm();
  return size > kForceMost_mps2 ? Vector2d(force * (kForceMost_mps2 / size)) : force;
}

// Random numbers of one person, the same however many others there are.
class Fortune {
 public:
  Fortune(std::uint64_t seed, std::uint32_t person) : key_{seed, person, MotionProcess::gait, 1} {}
  double draw(std::uint32_t turn, std::uint32_t what) const { return uniformNumber(key_, turn, what); }
  // Free speeds of pedestrians, N(1.34, 0.26) m/s (unsourced), within two standard deviations.
  double freeSpeed(double mean_mps) const {
    MotionKey key = key_;
    key.component = 9;
    return mean_mps * (1 + 0.26 / 1.34 * std::clamp(normalNumber(key, 0, 0), -2.0, 2.0));
  }

 private:
  MotionKey key_;
};

// Places on a walkable surface, by area.
class StrollingGround {
 public:
  explicit StrollingGround(const Mesh& walkable) : map_(walkable) {
    for (std::uint32_t i = 0; i < map_.size(); ++i)
      if (map_.islandArea(i) >= kLeastIsland_m2) boxes_.push_back(i), area_m2_ += map_.area(i);
  }
  bool nowhere() const { return boxes_.empty(); }
  Vector3d anywhere(const Fortune& fortune, std::uint32_t turn) const {
    return placeIn(boxAt(fortune.draw(turn, 0) * area_m2_, std::nullopt), fortune, turn);
  }
  // Where they can walk to from there.
  Vector3d anotherPlace(const Vector3d& from, const Fortune& fortune, std::uint32_t turn) const {
    const auto here = map_.under(from);
    if (!here) return from;
    return placeIn(boxAt(fortune.draw(turn, 0) * map_.islandArea(*here), map_.islandOf(*here)), fortune, turn);
  }
  std::vector<Vector3d> way(const Vector3d& from, const Vector3d& to) const { return map_.way(from, to); }
  // The place at its floor; nothing beside the surface.
  std::optional<Vector3d> on(const Vector3d& place) const {
    const auto box = map_.under(place);
    if (!box) return std::nullopt;
    return Vector3d(place.x(), place.y(), map_.box(*box).max.z());
  }

 private:
  std::uint32_t boxAt(double area_m2, std::optional<std::uint32_t> island) const {
    std::uint32_t last = boxes_.front();
    for (const std::uint32_t i : boxes_) {
      if (island && map_.islandOf(i) != *island) continue;
      last = i;
      if ((area_m2 -= map_.area(i)) < 0) break;
    }
    return last;
  }
  Vector3d placeIn(std::uint32_t box, const Fortune& fortune, std::uint32_t turn) const {
    const Bounds& b = map_.box(box);
    const double u = fortune.draw(turn, 1), v = fortune.draw(turn, 2);
    return {b.min.x() + u * (b.max.x() - b.min.x()), b.min.y() + v * (b.max.y() - b.min.y()), b.max.z()};
  }

  WalkableMap map_;
  std::vector<std::uint32_t> boxes_;
  double area_m2_ = 0;
};

// Where somebody wants to go.
class Errand {
 public:
  Errand(std::uint64_t seed, std::uint32_t person)
      : fortune_(seed, person), pause_s_(kTurning_s * fortune_.draw(0, 5)) {}
  const Fortune& fortune() const { return fortune_; }
  // How long before all of them go back.
  double stops_s() const { return kBraking_s + kTurning_s * fortune_.draw(0, 6); }

  // The unit vector to the next corner; zero where they stand a while.
  Vector2d direction(const StrollingGround& ground, const Vector3d& at) {
    if (pause_s_ > 0) {
      pause_s_ -= kCrowdStep_s;
      return Vector2d::Zero();
    }
    if (corners_.empty()) setOut(ground, at);
    while (!corners_.empty() && distanceTo(at) < kReached_m) {
      if (++next_ < corners_.size()) {
        nearest_m_ = distanceTo(at), stalled_s_ = 0;
        continue;
      }
      arrive();
    }
    if (corners_.empty()) return Vector2d::Zero();
    watch(ground, at);
    const Vector2d towards = (corners_[next_] - at).head<2>();
    const double length = towards.norm();
    return length > 1e-9 ? Vector2d(towards / length) : Vector2d::Zero();
  }

 private:
  double distanceTo(const Vector3d& at) const { return (corners_[next_] - at).head<2>().norm(); }
  void go(const StrollingGround& ground, const Vector3d& at) {
    corners_ = ground.way(at, goal_);
    next_ = 0, stalled_s_ = 0;
    if (!corners_.empty()) nearest_m_ = distanceTo(at);
  }
  void setOut(const StrollingGround& ground, const Vector3d& at) {
    ++turn_;
    went_around_ = false;
    goal_ = ground.anotherPlace(at, fortune_, turn_);
    if ((goal_ - at).norm() >= kNearestGoal_m) go(ground, at);
    if (corners_.empty()) pause_s_ = 0.2;
  }
  // Some pause: they are the ones that removal only half removes.
  void arrive() {
    corners_.clear();
    pause_s_ = fortune_.draw(turn_, 3) < 0.5 ? kCrowdStep_s : 1 + 4 * fortune_.draw(turn_, 4);
  }
  // Whoever comes no nearer takes another way, and then goes elsewhere.
  void watch(const StrollingGround& ground, const Vector3d& at) {
    const double left_m = distanceTo(at);
    if (left_m < nearest_m_ - 0.05) {
      nearest_m_ = left_m, stalled_s_ = 0;
      return;
    }
    stalled_s_ += kCrowdStep_s;
    if (stalled_s_ < kStalled_s) return;
    if (std::exchange(went_around_, true))
      setOut(ground, at);
    else
      go(ground, at);
    if (corners_.empty()) setOut(ground, at);
    if (corners_.empty()) corners_ = {at};
  }

  Fortune fortune_;
  std::uint32_t turn_ = 0;
  Vector3d goal_ = Vector3d::Zero();
  std::vector<Vector3d> corners_;
  std::size_t next_ = 0;
  double nearest_m_ = 0, stalled_s_ = 0, pause_s_;
  bool went_around_ = false;
};

class Crowd {
 public:
  Crowd(const StrollingGround& ground, std::span<const CrowdObstacle> obstacles)
      : ground_(ground), obstacles_(obstacles) {}

  // Those who found a place; each with the number that random numbers go by.
  std::vector<std::uint32_t> gather(const CrowdWish& wish) {
    std::vector<std::uint32_t> present;
    const auto mean_mps = wish.speed_mps > 0 ? wish.speed_mps : usualSpeed(MoverKind::person);
    const auto first = static_cast<std::uint32_t>(stableHash(wish.name.c_str()));
    std::vector<FloorBody> taken;
    for (std::size_t k = 0; k < obstacles_.size(); ++k) taken.push_back(obstacleAt(k, -kUnderWay_s));
    for (std::uint32_t number = 0; number < static_cast<std::uint32_t>(wish.count); ++number) {
      Errand errand(wish.seed, first + number);
      const auto place = freePlace(errand.fortune(), taken);
      if (!place) continue;
      present.push_back(number);
      taken.push_back({*place, Vector2d::Zero(), kBodyDiameter_m / 2});
      bodies_.push_back(taken.back());
      free_mps_.push_back(errand.fortune().freeSpeed(mean_mps));
      pace_mps_.push_back(free_mps_.back());
      errands_.push_back(std::move(errand));
    }
    return present;
  }

  Result<std::vector<std::vector<Vector3d>>> walk(double seconds, Progress& progress) {
    const std::size_t people = errands_.size();
    std::vector<std::vector<Vector3d>> ways(people);
    bodies_.resize(people + obstacles_.size());
    const auto steps = kStepsPerPlace * static_cast<int>(std::ceil(seconds / kWayStep_s));
    for (int step = 0; step <= steps; ++step) {
      if (step % kStepsPerPlace == 0) {
        for (std::size_t i = 0; i < people; ++i) ways[i].push_back(toMillimetres(bodies_[i].at));
        TRY(progress.check());
        progress.advance(static_cast<double>(step) / steps);
      }
      for (std::size_t k = 0; k < obstacles_.size(); ++k)
        bodies_[people + k] = obstacleAt(k, -kUnderWay_s + step * kCrowdStep_s);
      const BodiesNear near_by(bodies_);
      const double left_s = (steps - step) * kCrowdStep_s;
      for (std::size_t i = 0; i < people; ++i) advance(i, near_by, left_s < errands_[i].stops_s());
    }
    return ways;
  }

  double freeSpeed_mps(std::size_t i) const { return free_mps_[i]; }

 private:
  // The same in memory as from a project's file.
  static Vector3d toMillimetres(const Vector3d& place) { return (place * 1000).array().round() / 1000; }

  FloorBody obstacleAt(std::size_t k, double time_s) const {
    const PoseFunction& function = *obstacles_[k].local_from_obstacle;
    return {function.pose(time_s).translation, velocity(function, time_s).linear_mps.head<2>(), obstacles_[k].radius_m};
  }

  static double apart(const FloorBody& a, const FloorBody& b) { return a.radius_m + b.radius_m + kMargin_m; }

  std::optional<Vector3d> freePlace(const Fortune& fortune, const std::vector<FloorBody>& taken) const {
    for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
      const FloorBody one{ground_.anywhere(fortune, 0x10000 + draw)};
      if (std::all_of(taken.begin(), taken.end(), [&](const FloorBody& other) {
            return std::abs(other.at.z() - one.at.z()) > kWithinFloor_m ||
                   (other.at - one.at).head<2>().norm() >= apart(one, other);
          }))
        return one.at;
    }
    return std::nullopt;
  }

  void advance(std::size_t i, const BodiesNear& near_by, bool braking) {
    FloorBody& one = bodies_[i];
    Vector2d ahead = errands_[i].direction(ground_, one.at);
    if (braking) ahead.setZero();
    Vector2d force = Vector2d::Zero();
    int near = 0;
    bool among_people = true;  // and nothing near that does not make way itself
    close_.clear();
    near_by.around(one.at, [&](std::uint32_t k) {
      if (k == i || std::abs(bodies_[k].at.z() - one.at.z()) > kWithinFloor_m) return;
      const Vector2d from = (one.at - bodies_[k].at).head<2>();
      const double distance = from.norm();
      if (distance > kSight_m) return;
      if (distance < apart(one, bodies_[k]) + kStepMost_m) close_.push_back(k);
      near += distance < kDensityRadius_m ? 1 : 0;
      const double wide = apart(one, bodies_[k]) - kMargin_m - kBodyDiameter_m;  // beyond somebody's
      const Vector2d push =
          repulsion(wide > 0 ? Vector2d(from * std::max(0.1, 1 - wide / distance)) : from, bodies_[k].velocity);
      force += (ahead.dot(-push) >= kBehindCosine * push.norm() ? 1 : kBehind) * push;
      among_people = among_people && k < errands_.size();
    });
    const double density = near / (std::numbers::pi * kDensityRadius_m * kDensityRadius_m);
    const double wish_mps = std::max(kSlowest_mps, free_mps_[i] * crowdedSpeed(density));
    const double hurried_mps = haste(i, wish_mps, ahead);
    if (among_people) force -= (1 - kSlowing) * std::min(0.0, force.dot(ahead)) * ahead;
    force += ((wish_mps + (among_people ? hurried_mps : 0)) * ahead - one.velocity) / kRelaxation_s;
    Vector2d moves_mps = one.velocity + kCrowdStep_s * force;
    const double speed = moves_mps.norm(), most = kFasterMost * free_mps_[i];
    if (speed > most) moves_mps *= most / speed;
    move(i, moves_mps * kCrowdStep_s);
  }

  // How much faster than they wish they try to get; those who stand begin without haste.
  double haste(std::size_t i, double wish_mps, const Vector2d& ahead) {
    double& pace_mps = pace_mps_[i];
    const bool stands = ahead.squaredNorm() == 0;
    pace_mps = stands ? wish_mps : pace_mps + (bodies_[i].velocity.dot(ahead) - pace_mps) * kCrowdStep_s / kPace_s;
    return kHaste * std::max(0.0, wish_mps - pace_mps);
  }

  // As far as floor and bodies leave room: along what is in the way where not straight, or not at all.
  void move(std::size_t i, const Vector2d& by) {
    const Vector3d before = bodies_[i].at;
    const auto beside = nearestBlocking(i, before + Vector3d(by.x(), by.y(), 0));
    Vector2d aside = by;
    if (beside) {
      const Vector2d away = (before - bodies_[*beside].at).head<2>().normalized();
      aside -= std::min(0.0, by.dot(away)) * away;
    }
    const Vector2d along_x(aside.x(), 0), along_y(0, aside.y());
    const bool x_first = std::abs(aside.x()) > std::abs(aside.y());
    for (const Vector2d& step : {aside, x_first ? along_x : along_y, x_first ? along_y : along_x}) {
      const auto there = ground_.on(before + Vector3d(step.x(), step.y(), 0));
      if (!there || nearestBlocking(i, *there)) continue;
      bodies_[i].at = *there;
      bodies_[i].velocity = step / kCrowdStep_s;
      return;
    }
    bodies_[i].velocity.setZero();
  }

  // The one that somebody would come too near to there, and nearer than they are.
  std::optional<std::uint32_t> nearestBlocking(std::size_t i, const Vector3d& there) const {
    std::optional<std::uint32_t> found;
    double nearest = kSight_m;
    for (const std::uint32_t k : close_) {
      const double distance = (there - bodies_[k].at).head<2>().norm();
      if (distance >= nearest || distance >= apart(bodies_[i], bodies_[k]) ||
          distance >= (bodies_[i].at - bodies_[k].at).head<2>().norm())
        continue;
      nearest = distance, found = k;
    }
    return found;
  }

  const StrollingGround& ground_;
  std::span<const CrowdObstacle> obstacles_;
  std::vector<FloorBody> bodies_;  // people, then obstacles
  std::vector<Errand> errands_;
  std::vector<double> free_mps_, pace_mps_;  // that they have alone; over the last seconds
  std::vector<std::uint32_t> close_;         // to the one who moves
};

// How long they walk before they come back.
double secondsOf(const CrowdWish& wish, std::size_t people, Report& report) {
  const double wanted = std::max(wish.until_s + kUnderWay_s, kUsual_s);
  const double most =
      std::min(kLongest_s, kMostPlaces * kWayStep_s / static_cast<double>(std::max<std::size_t>(1, people)));
  if (wanted <= most) return wanted;
  report.warn(wish.name,
              fmt::format("gives way until {:.0f} s of the movers' clock only; use fewer people or a shorter "
                          "trajectory",
                          most - kUnderWay_s));
  return most;
}

}  // namespace

double crowdedSpeed(double people_per_m2) {
  if (people_per_m2 <= 0) return 1;
  return std::clamp(1 - portable::exp(-1.913 * (1 / people_per_m2 - 1 / 5.4)), 0.0, 1.0);
}

Result<std::vector<Mover>> crowdOn(const Mesh& walkable, const CrowdWish& wish,
                                   std::span<const CrowdObstacle> obstacles, Report& report, Progress& progress) {
  const StrollingGround ground(walkable);
  if (ground.nowhere()) return failure(ErrorKind::unusable, "no walkable surface has room for a walk");
  Crowd crowd(ground, obstacles);
  const auto present = crowd.gather(wish);
  TRY_ASSIGN(auto ways, crowd.walk(secondsOf(wish, present.size(), report), progress));
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < present.size(); ++i) {
    Mover mover{.name = fmt::format("{} {}", wish.name, present[i] + 1)};
    mover.way_m = std::move(ways[i]);
    mover.speed = crowd.freeSpeed_mps(i);
    mover.repeats = true;
    mover.begins_s = -kUnderWay_s;
    mover.seed = wish.seed + present[i];
    movers.push_back(std::move(mover));
  }
  if (const std::size_t lost = static_cast<std::size_t>(wish.count) - present.size(); lost > 0)
    report.warn(wish.name, fmt::format("{} of {} people found no room and are left out", lost, wish.count));
  return movers;
}

}  // namespace standpoint
