// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "project/document.h"
#include "project/latest_task.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

// What it takes to go a trajectory, and what it runs through.
struct TrajectoryWay {
  double length_m = 0, seconds = 0;
  std::vector<PathSample> samples;
  std::vector<double> expected_m;  // of each: how large the error of its position is over all seeds; or none
  double lift_m = 0;  // of the samples above the floor that is walked on; 0: there is none below, as of a flight
  std::vector<PathObstacle> obstacles;
  std::vector<std::string> obstacle_products;  // of each: "IfcWall 'East'", "IfcWall #12" of one without a name
  std::string problem;                         // why there is no such way; "" where there is
  CarriedMotion motion;                        // with gait and shaking, too
  std::vector<PoseFunctionPtr> limbs;          // of who walks with it (kLimbs), by its clock; none: nobody does
  std::size_t closedDoors() const;             // of the obstacles
};

// How well a trajectory would be known with the instrument and the conditions that are chosen.
struct WayKnowledge {
  const ErrorProfile* profile = nullptr;  // null: exactly
  bool closures = true;
  std::vector<Eigen::Vector3d> anchors;  // scanned stations that may hold it
  double max_range_m = 0;
  bool operator==(const WayKnowledge&) const = default;
};

// All that a way depends on.
struct WayWish {
  CarriedTrajectory trajectory;  // without its scans
  std::shared_ptr<const Georeference> georeference;
  std::shared_ptr<const RayScene> scene;
  std::filesystem::file_time_type written = {};  // of its file
  WayKnowledge knowledge = {};
  std::vector<std::string> opened = {};  // ids of doors that movers open
  bool operator==(const WayWish& other) const;
};
TrajectoryWay wayOf(const WayWish& wish, Progress& progress);

// The ways of a job's trajectories, and of one that is being laid or changed. Each is worked out once, in the
// background, and known until it changes.
class TrajectoryWays {
 public:
  explicit TrajectoryWays(const std::function<void()>& wake);

  // Once a frame. `scene` is that of the document's model; null: it is being built, and the ways wait for it.
  void follow(const Document& document, const std::shared_ptr<const RayScene>& scene, const WayKnowledge& knowledge);
  // Whether errors are shown: without, no way has them. From the next follow() on.
  void expectErrors(bool shown) { expects_errors_ = shown; }
  bool expectsErrors() const { return expects_errors_; }
  // By the index into the job; null while it is worked out.
  const TrajectoryWay* of(std::size_t trajectory) const;

  // What the pointer holds, in each frame anew.
  void wantDraft(WayWish wish);
  void dropDraft();
  // Of the newest that there is; null: none yet.
  const TrajectoryWay* draft() const;
  bool draftIsOld() const { return draft_.answer() == nullptr; }

  void wait();  // until all that is wanted is there

 private:
  using Way = std::shared_ptr<const TrajectoryWay>;
  using Known = std::vector<std::pair<WayWish, Way>>;
  void takeIn();
  void showKnown();

  std::shared_ptr<const Job> job_;
  std::shared_ptr<const Georeference> georeference_;
  std::shared_ptr<const RayScene> scene_;
  WayKnowledge knowledge_;
  bool expects_errors_ = false;
  std::chrono::steady_clock::time_point looked_;  // at the files
  std::vector<WayWish> wishes_;
  Known known_;
  std::vector<Way> shown_;
  LatestTask<std::vector<WayWish>, Known> latest_;
  LatestTask<WayWish, Way> draft_;
};

}  // namespace standpoint
