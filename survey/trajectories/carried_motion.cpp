// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/carried_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/motion/carriers.h"
#include "core/motion/closures.h"
#include "core/motion/degeneracy.h"
#include "core/motion/gait.h"
#include "core/portable_math.h"
#include "core/random.h"
#include "core/units.h"
#include "optimizer/walk/door_leaves.h"
#include "optimizer/walk/doors.h"
#include "scanners/engine/footprint.h"
#include "survey/scene/bodies.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

constexpr double kSampled_hz = 200;
constexpr double kClosure_sigma_m = 0.003, kClosure_sigma_rad = 0.02 * kRadPerDeg;
constexpr double kCentring_sigma_m = 0.003;
constexpr int kDirections = 96;  // about a knot

double lengthOf(const PoseFunction& path) {
  constexpr double kStep_s = 0.05;
  double length = 0;
  Eigen::Vector3d before = path.pose(path.first_s()).translation;
  const auto steps = static_cast<std::uint64_t>(std::ceil((path.last_s() - path.first_s()) / kStep_s));
  for (std::uint64_t k = 1; k <= steps; ++k) {
    const Eigen::Vector3d here = path.pose(std::min(path.last_s(), path.first_s() + k * kStep_s)).translation;
    length += (here - before).norm();
    before = here;
  }
  return length;
}

// Of who walks with it, from step to step: what sways in their hand, or goes around them as they turn, goes farther.
double walkedLength(const PoseFunction& path) {
  constexpr double kLook_s = 0.05, kStep_m = 0.4;
  double length = 0;
  Eigen::Vector3d before = path.pose(path.first_s()).translation;
  const auto goTo = [&](const Eigen::Vector3d& place) {
    length += (place - before).norm();
    before = place;
  };
  for (double time_s = path.first_s(); time_s < path.last_s(); time_s += kLook_s)
    if (const Eigen::Vector3d here = path.pose(time_s).translation; (here - before).norm() >= kStep_m) goTo(here);
  goTo(path.pose(path.last_s()).translation);
  return length;
}

Result<CarriedMotion> motionOfFile(const CarriedTrajectory& trajectory, const Georeference& georeference,
                                   Report& report, Progress& progress) {
  const TrajectoryFormat* format = trajectoryFormat(trajectory.format);
  if (format == nullptr) {
    TRY_ASSIGN(format, trajectoryFormatOf(trajectory.file));
  }
  if (format == nullptr)
    return failure(ErrorKind::usage, "the format of this trajectory is not known; state it", trajectory.file);
  TRY_ASSIGN(const auto frame, fileFrame(georeference, format->id));
  TRY_ASSIGN(auto read, format->read(trajectory.file, frame, progress));
  report.append(read.report);
  auto spline = PoseSpline::through(read.samples, read.gap_s);
  if (!spline) return failure(spline.error().kind, spline.error().message, trajectory.file);
  CarriedMotion carried;
  carried.path = carried.truth = std::make_shared<const PoseSpline>(*std::move(spline));
  const Carrier* const carrier = carrierOf(trajectory.carrier);
  const bool walks = carrier != nullptr && carrier->gait > 0;
  carried.length_m = walks ? walkedLength(*carried.path) : lengthOf(*carried.path);
  return carried;
}

// Even over the sphere, as the leaves of a sunflower are over its disc.
Eigen::Vector3d directionOf(int k) {
  const double z = 1 - (2 * k + 1.0) / kDirections, turn = k * kGoldenTurns;
  double sine = 0, cosine = 0;
  portable::sinCos(2 * std::numbers::pi * (turn - std::floor(turn)), sine, cosine);
  const double across = std::sqrt(1 - z * z);
  return {across * cosine, across * sine, z};
}

void setDegeneracy(std::vector<ErrorKnot>& knots, const RayScene& scene, double max_range_m) {
  tbb::parallel_for(std::size_t{0}, knots.size(), [&](std::size_t i) {
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    int returned = 0;
    for (int k = 0; k < kDirections; ++k) {
      const auto hit = scene.intersect(knots[i].pose.translation, directionOf(k), max_range_m);
      if (!hit) continue;
      ++returned;
      normals += hit->normal * hit->normal.transpose();
    }
    knots[i].degeneracy = degeneracy(normals, static_cast<double>(returned) / kDirections);
  });
}

// Whether at least 30 % of what is seen from one place is seen from the other, too: there is no wall between them.
bool seeTheSame(const RayScene& scene, const Eigen::Vector3d& here, const Eigen::Vector3d& there, double max_range_m) {
  constexpr double kShared = 0.3, kSurface_m = 0.05;
  int seen = 0, shared = 0;
  for (int k = 0; k < kDirections; ++k) {
    const auto hit = scene.intersect(here, directionOf(k), max_range_m);
    if (!hit) continue;
    ++seen;
    const Eigen::Vector3d to = hit->position - there;
    const double distance = to.norm();
    if (distance <= kSurface_m || distance > max_range_m) continue;
    const auto from_there = scene.intersect(there, to / distance, distance + kSurface_m);
    shared += from_there && (from_there->position - hit->position).norm() < kSurface_m ? 1 : 0;
  }
  return shared > kShared * seen;
}

std::vector<LoopClosure> closuresOf(std::span<const ErrorKnot> knots, const PoseFunction& path, const RayScene& scene,
                                    double max_range_m) {
  return findClosures(knots, {}, [&](const LoopClosure& c) {
    return seeTheSame(scene, path.pose(c.time_s).translation, path.pose(c.earlier_s).translation, max_range_m);
  });
}

const ErrorKnot& nearestTo(const std::vector<ErrorKnot>& knots, const Eigen::Vector3d& place) {
  return *std::min_element(knots.begin(), knots.end(), [&](const ErrorKnot& a, const ErrorKnot& b) {
    return (a.pose.translation - place).squaredNorm() < (b.pose.translation - place).squaredNorm();
  });
}

// Where it stands still at a control point, nearest to it; null where it does not.
const ErrorKnot* standingAt(const std::vector<ErrorKnot>& knots, const ControlPoint& control) {
  constexpr double kReach_m = 0.5, kStill_m = 0.005, kHighest_m = 3;
  const ErrorKnot* found = nullptr;
  double nearest = kReach_m;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Eigen::Vector3d from = knots[i].pose.translation - control.position;
    const double distance = from.head<2>().norm();
    if (knots[i].way_m - knots[i - 1].way_m > kStill_m || from.z() < 0 || from.z() > kHighest_m) continue;
    if (distance > nearest || (found != nullptr && distance == nearest)) continue;
    nearest = distance, found = &knots[i];
  }
  return found;
}

struct HeldKnots {
  std::vector<ErrorKnot> knots;
  std::vector<MotionConstraint> constraints;
};

// What the error of a trajectory depends on. Counts what holds it.
Result<HeldKnots> heldKnots(const CarriedMotion& carried, const RayScene& scene, std::span<const Station> stations,
                            const MotionSolving& solving, SolvedMotion& solved, Progress& progress) {
  HeldKnots held;
  TRY_ASSIGN(held.knots, errorKnots(*carried.path));
  setDegeneracy(held.knots, scene, solving.max_range_m);
  TRY(progress.check());
  if (solving.closures)
    for (const LoopClosure& closure : closuresOf(held.knots, *carried.path, scene, solving.max_range_m))
      held.constraints.push_back({closure.time_s, closure.earlier_s, kClosure_sigma_m, kClosure_sigma_rad});
  solved.closures = held.constraints.size();
  for (const Station& station : stations) {
    if (!solving.anchors || station.scans.empty()) continue;
    const ErrorKnot& knot = nearestTo(held.knots, station.true_pose.translation);
    if ((knot.pose.translation - station.true_pose.translation).norm() > solving.anchor_reach_m) continue;
    held.constraints.push_back({knot.time_s, {}, kClosure_sigma_m, kClosure_sigma_rad});
    ++solved.anchors;
  }
  for (const ControlPoint& control : solving.control) {
    const ErrorKnot* const knot = standingAt(held.knots, control);
    (knot == nullptr ? solved.missed : solved.control).push_back(control.name);
    if (knot != nullptr)
      held.constraints.push_back({knot->time_s, {}, std::hypot(control.sigma_m, kCentring_sigma_m), {}});
  }
  return held;
}

}  // namespace

Result<std::vector<LoopClosure>> closuresOf(const CarriedMotion& carried, const RayScene& scene, double max_range_m) {
  TRY_ASSIGN(const auto knots, errorKnots(*carried.path));
  return closuresOf(knots, *carried.path, scene, max_range_m);
}

Result<CarriedMotion> carriedMotion(const CarriedTrajectory& trajectory, const Georeference& georeference,
                                    Report& report, Progress& progress) {
  if (!trajectory.file.empty()) return motionOfFile(trajectory, georeference, report, progress);
  const Carrier* const carrier = carrierOf(trajectory.carrier);
  if (carrier == nullptr)
    return failure(ErrorKind::usage, fmt::format("unknown carrier '{}'", trajectory.carrier), trajectory.name);
  PathLimits limits = carrier->limits;
  if (trajectory.height_m > 0) limits.height_m = trajectory.height_m;
  if (trajectory.speed_mps > 0) limits.speed_mps = trajectory.speed_mps;
  auto walked = walkPath(trajectory.waypoints, limits);
  if (!walked) return failure(walked.error().kind, walked.error().message, trajectory.name);
  CarriedMotion carried;
  carried.length_m = walked->length_m;
  carried.path = std::make_shared<const PoseSpline>(std::move(walked->poses));
  TRY(progress.check());
  const CarriedPose pose(carried.path, *carrier, trajectory.seed,
                         static_cast<std::uint32_t>(stableHash(trajectory.name.c_str())));
  TRY_ASSIGN(auto spline, sampled(pose, kSampled_hz));
  carried.truth = std::make_shared<const PoseSpline>(std::move(spline));
  return carried;
}

Trajectory evenSamples(const PoseFunction& function, double rate_hz) {
  Trajectory samples;
  const double first = function.first_s(), last = function.last_s();
  const auto count = static_cast<std::uint64_t>(std::ceil((last - first) * rate_hz));
  for (std::uint64_t k = 0; k <= count; ++k) {
    samples.time_s.push_back(k < count ? first + static_cast<double>(k) / rate_hz : last);
    samples.pose.push_back(function.pose(samples.time_s.back()));
  }
  return samples;
}

std::vector<PathSample> pathSamples(const CarriedMotion& carried, std::size_t most) {
  constexpr double kStep_s = 0.1, kBeside_s = 0.02;
  const PoseFunction& path = *carried.path;
  const double first = path.first_s(), last = path.last_s();
  const auto steps = static_cast<std::size_t>(
      std::clamp(std::ceil((last - first) / kStep_s), 1.0, static_cast<double>(std::max<std::size_t>(most, 2) - 1)));
  std::vector<PathSample> samples(steps + 1);
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t k) {
    const double time_s =
        k < steps ? first + (last - first) * static_cast<double>(k) / static_cast<double>(steps) : last;
    const double from_s = std::max(first, time_s - kBeside_s), to_s = std::min(last, time_s + kBeside_s);
    const Pose from = path.pose(from_s), to = path.pose(to_s);
    samples[k] = {time_s - first, path.pose(time_s).translation, 0, 0};
    if (to_s <= from_s) return;
    samples[k].speed_mps = (to.translation - from.translation).norm() / (to_s - from_s);
    samples[k].turn_radps = from.rotation.angularDistance(to.rotation) / (to_s - from_s);
  });
  return samples;
}

namespace {

// The doors among them that have leaves, each where it is met first; those that are opened are not met.
std::vector<PathObstacle> withDoors(std::vector<PathObstacle> found, const Environment& environment,
                                    std::span<const std::string> opened) {
  const auto door_of = doorOf(environment);
  if (std::none_of(found.begin(), found.end(), [&](const PathObstacle& o) { return door_of[o.product] >= 0; }))
    return found;
  std::vector<bool> has_leaf(environment.products.size()), met(environment.products.size());
  for (const auto& door : doorLeaves(environment).doors) has_leaf[door.product] = true;
  for (std::size_t i = 0; i < environment.products.size(); ++i)
    met[i] = std::find(opened.begin(), opened.end(), environment.products[i].id) != opened.end();
  std::vector<PathObstacle> kept;
  for (auto& obstacle : found) {
    const auto door = static_cast<std::size_t>(std::max(door_of[obstacle.product], 0));
    if (door_of[obstacle.product] >= 0 && has_leaf[door]) {
      if (met[door]) continue;
      met[door] = true;
      obstacle.product = static_cast<std::uint32_t>(door);
      obstacle.closed_door = true;
    }
    kept.push_back(obstacle);
  }
  return kept;
}

}  // namespace

std::vector<std::string> openedDoors(std::span<const Mover> movers) {
  std::vector<std::string> opened;
  for (const auto& mover : movers)
    if (mover.kind == MoverKind::door) opened.insert(opened.end(), mover.products.begin(), mover.products.end());
  return opened;
}

std::vector<PathObstacle> obstaclesOf(const CarriedMotion& carried, const RayScene& scene,
                                      std::span<const std::string> opened) {
  constexpr double kStep_s = 0.1;
  std::vector<PathObstacle> found;
  const double first = carried.path->first_s(), last = carried.path->last_s();
  Eigen::Vector3d before = carried.path->pose(first).translation;
  const auto steps = static_cast<std::uint64_t>(std::ceil((last - first) / kStep_s));
  for (std::uint64_t k = 1; k <= steps; ++k) {
    const double time_s = std::min(last, first + k * kStep_s);
    const Eigen::Vector3d here = carried.path->pose(time_s).translation;
    const double length = (here - before).norm();
    if (length < 1e-6) continue;
    const auto hit = scene.intersect(before, (here - before) / length, length);
    before = here;
    if (hit) found.push_back({hit->product, hit->position, time_s - first, false});
  }
  return withDoors(std::move(found), scene.environment(), opened);
}

void findObstacles(const CarriedMotion& carried, const RayScene& scene, const Georeference& georeference,
                   const std::string& name, std::span<const std::string> opened, Report& report) {
  constexpr std::size_t kMost = 10;
  std::size_t walls = 0;
  for (const auto& found : obstaclesOf(carried, scene, opened)) {
    const std::string product = productText(scene.environment().products[found.product]);
    const Eigen::Vector3d at = found.place_m + georeference.shift_m;
    if (found.closed_door)
      report.note(name, fmt::format("a scan finds {} closed, through which it goes after {:.1f} s; a mover of the kind "
                                    "'door' opens it",
                                    product, found.after_s));
    else if (++walls <= kMost)
      report.warn(name, fmt::format("goes through {} at ({:.2f}, {:.2f}, {:.2f}), after {:.1f} s", product, at.x(),
                                    at.y(), at.z(), found.after_s));
  }
  if (walls > kMost) report.warn(name, fmt::format("goes through {} more surfaces", walls - kMost));
}

Result<SolvedMotion> solveMotion(const CarriedMotion& carried, const RayScene& scene, std::span<const Station> stations,
                                 const std::string& name, const MotionSolving& solving, Progress& progress) {
  SolvedMotion solved;
  if (solving.profile == nullptr) return solved;
  TRY_ASSIGN(const auto held, heldKnots(carried, scene, stations, solving, solved, progress));
  TRY_ASSIGN(const auto trajectory,
             solveTrajectory(carried.truth, held.knots, *solving.profile, held.constraints, solving.seed,
                             static_cast<std::uint32_t>(stableHash(name.c_str())), progress));
  for (const KnotError& error : trajectory.errors) {
    solved.rms_m += error.position_m.squaredNorm() / static_cast<double>(trajectory.errors.size());
    solved.largest_m = std::max(solved.largest_m, error.position_m.norm());
  }
  solved.rms_m = std::sqrt(solved.rms_m);
  TRY_ASSIGN(auto spline, sampled(*trajectory.pose, kSampled_hz));
  solved.pose = std::make_shared<const PoseSpline>(std::move(spline));
  return solved;
}

void reportSolved(const SolvedMotion& solved, const std::string& name, Report& report) {
  constexpr std::size_t kFewest = 3;
  report.note(name, fmt::format("the trajectory errs by {:.1f} mm (rms), {:.1f} mm at most; {} closures, {} stations "
                                "and {} control points hold it",
                                1e3 * solved.rms_m, 1e3 * solved.largest_m, solved.closures, solved.anchors,
                                solved.control.size()));
  for (const std::string& control : solved.missed)
    report.warn(name, fmt::format("does not stop within 0.5 m of control point {}, which does not hold it", control));
  if (!solved.control.empty() && solved.control.size() < kFewest)
    report.warn(name, "fewer than three control points hold it: they do not show an error in one of them");
}

Result<std::vector<ExpectedError>> expectedMotion(const CarriedMotion& carried, const RayScene& scene,
                                                  std::span<const Station> stations, const MotionSolving& solving,
                                                  Progress& progress) {
  if (solving.profile == nullptr) return std::vector<ExpectedError>{};
  SolvedMotion ignored;
  TRY_ASSIGN(const auto held, heldKnots(carried, scene, stations, solving, ignored, progress));
  return expectedErrors(held.knots, *solving.profile, held.constraints, progress);
}

std::vector<double> expectedAt(std::span<const ExpectedError> expected, std::span<const double> times_s) {
  std::vector<double> sigmas;
  std::size_t next = 0;
  for (const double time : times_s) {
    while (next < expected.size() && expected[next].time_s < time) ++next;
    if (expected.empty()) {
      sigmas.push_back(0);
    } else if (next == 0 || next == expected.size()) {
      sigmas.push_back(expected[next == 0 ? 0 : next - 1].position_m.norm());
    } else {
      const auto &before = expected[next - 1], &after = expected[next];
      const double part = (time - before.time_s) / (after.time_s - before.time_s);
      sigmas.push_back(std::lerp(before.position_m.norm(), after.position_m.norm(), part));
    }
  }
  return sigmas;
}

}  // namespace standpoint
