// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/walk_scan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "emulated-ui/sighting.h"
#include "emulated-ui/walk_motion.h"
#include "project/survey/scan_preparation.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr unsigned kOnePulseIn = 16;
constexpr double kWritten_hz = 200;
constexpr double kJudged_s = 0.25;  // of the way, between two looks at the error
constexpr double kDoorOpens_s = 3;  // before somebody is in it [P]
constexpr double kDoorsBefore_s = 60;

// By the movers' clock, which shows kDoorsBefore_s when the walk begins.
void openDoors(Job& job, const CarriedMotion& carried, const RayScene& scene, bool before) {
  std::set<std::string> moving;
  for (const auto& mover : job.movers) moving.insert(mover.products.begin(), mover.products.end());
  for (const auto& obstacle : obstaclesOf(carried, scene)) {
    const auto& product = scene.environment().products[obstacle.product];
    if (!obstacle.closed_door || !moving.insert(product.id).second) continue;
    Mover door;
    door.name = "Door " + product.id;
    door.kind = MoverKind::door;
    door.products = {product.id};
    door.begins_s = before ? 0 : std::max(0.0, kDoorsBefore_s + obstacle.after_s - kDoorOpens_s);
    job.movers.push_back(std::move(door));
  }
}

// The known points that the scanner was held over, as the device knows them.
std::vector<ControlPoint> controlOf(const Document& document, const std::vector<WalkFix>& fixes) {
  std::vector<ControlPoint> control;
  for (const auto& known : standpoint::controlOf(document).targets)
    if (std::any_of(fixes.begin(), fixes.end(), [&](const WalkFix& fix) { return fix.point == known.name; }))
      control.push_back({known.name, known.place_m, 0});
  return control;
}

// What is left of the walk without its pauses, from 0 s on.
std::vector<std::array<double, 2>> recordedOf(const WalkOrder& walk, double seconds) {
  std::vector<std::array<double, 2>> recorded;
  double from = 0;
  for (const auto& [paused, resumed] : walk.pauses) {
    if (paused > from) recorded.push_back({from, std::min(paused, seconds)});
    from = std::max(from, resumed);
  }
  if (from < seconds) recorded.push_back({from, seconds});
  return recorded;
}

}  // namespace

Result<ScannedWalk> scanWalk(const Document& document, const ScanOrder& order, const WalkScanOptions& wanted,
                             Progress& progress) {
  const WalkOrder& walk = *order.walk;
  const auto& georeference = *document.georeference;
  ScannedWalk scanned;
  auto& trajectory = scanned.trajectory;
  trajectory.name = order.project + " " + order.name;
  trajectory.file = fs::path(wanted.file).replace_extension(".way.csv").string();
  trajectory.format = "csv";
  const Carrier& carrier = carrierOfMount(wanted.mount);
  trajectory.carrier = carrier.id;
  TRY_ASSIGN(const auto scene, RayScene::build(document.environment(), progress));
  TRY_ASSIGN(const auto carried, motionOf(walk.way, *scene, georeference, carrier, trajectory.name, wanted.seed));
  const auto* format = trajectoryFormat(trajectory.format);
  TRY_ASSIGN(const auto frame, fileFrame(georeference, format->id));
  TRY(format->write(trajectory.file, evenSamples(*carried.truth, kWritten_hz), frame));

  Document here = document;
  Job job = document.job ? *document.job : Job();
  std::erase_if(job.trajectories, [&](const CarriedTrajectory& t) { return t.name == trajectory.name; });
  openDoors(job, carried, *scene, walk.doors_open);
  job.trajectories.push_back(trajectory);
  here.job = std::make_shared<const Job>(std::move(job));

  auto& result = scanned.result;
  result.way = walk.way;
  result.seconds = carried.seconds();
  result.length_m = carried.length_m;
  CarriedBy by{.motion = carried,
               .recorded = recordedOf(walk, carried.seconds()),
               .one_pulse_in = kOnePulseIn,
               .control = controlOf(document, walk.fixes),
               .solved = {}};
  by.solved = [&result](const CarriedMotion& motion, const SolvedMotion& solved) {
    result.closures = solved.closures;
    result.held = solved.anchors + solved.control.size();
    const auto& truth = *motion.truth;
    for (double t = truth.first_s(); t <= truth.last_s(); t += kJudged_s) {
      const Eigen::Vector3d place = truth.pose(t).translation;
      const Eigen::Vector3d error =
          solved.pose ? Eigen::Vector3d(solved.pose->pose(t).translation - place) : Eigen::Vector3d::Zero();
      result.errors.push_back({place.x(), place.y(), error.x(), error.y(), error.z()});
    }
  };
  ScanVerbOptions options;
  options.trajectory = trajectory.name;
  options.instrument = order.instrument;
  options.settings = order.settings;
  options.seed = wanted.seed;
  options.output = wanted.file;
  options.truth = wanted.truth;
  options.notes = order.notes;
  options.quality = ScanQuality::preview;
  options.closures = walk.closures ? Switch::on : Switch::off;
  options.anchors = walk.stations ? Switch::on : Switch::off;
  options.movers_from_s = kDoorsBefore_s;
  ScanSurroundings company;
  company.carried = std::make_shared<const CarriedBy>(std::move(by));
  TRY_ASSIGN(const auto outcome, runScan(here, options, company, progress));
  trajectory = outcome.document.job->trajectories.back();
  for (auto& error : result.errors) {
    error[0] += georeference.shift_m.x();
    error[1] += georeference.shift_m.y();
  }
  return scanned;
}

}  // namespace standpoint
