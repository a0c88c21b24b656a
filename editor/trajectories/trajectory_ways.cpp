// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/trajectory_ways.h"

#include <algorithm>

#include "core/motion/carriers.h"
#include "core/motion/paced_way.h"
#include "editor/words/sentences.h"
#include "survey/movers/moving_world.h"
#include "survey/scene/bodies.h"

namespace standpoint {

namespace {

constexpr std::size_t kMostSamples = 2000;

bool same(const Waypoint& a, const Waypoint& b) {
  return a.floor_m == b.floor_m && a.stop_s == b.stop_s && a.look_rad == b.look_rad;
}

std::filesystem::file_time_type writtenAt(const std::string& file) {
  std::error_code ignored;
  return file.empty() ? std::filesystem::file_time_type() : std::filesystem::last_write_time(file, ignored);
}

std::vector<WayWish> wishesOf(const Job& job, const std::shared_ptr<const Georeference>& georeference,
                              const std::shared_ptr<const RayScene>& scene, const WayKnowledge& knowledge) {
  std::vector<WayWish> wishes;
  for (const auto& trajectory : job.trajectories) {
    wishes.push_back({trajectory, georeference, scene, writtenAt(trajectory.file), knowledge, openedDoors(job.movers)});
    wishes.back().trajectory.scans.clear();
  }
  return wishes;
}

double liftOf(const CarriedTrajectory& t) {
  if (!t.file.empty() || t.carrier == "uav" || carrierOf(t.carrier) == nullptr) return 0;
  return carriedHeight_m(t.carrier, t.height_m);
}

// As a scan has its operator.
std::vector<PoseFunctionPtr> limbsOfOperator(const CarriedTrajectory& t, const CarriedMotion& motion) {
  const Carrier* const carrier = carrierOf(t.carrier);
  if (carrier == nullptr || carrier->gait <= 0) return {};
  PoseFunctionPtr path = motion.path;
  if (!t.file.empty()) {
    const auto on_foot = wayOnFoot(*motion.truth);
    if (!on_foot) return {};
    path = *on_foot;
  }
  return operatorLimbs(path, carriedHeight_m(t.carrier, t.height_m), t.carrier == "hand");
}

std::vector<double> expectedOf(const TrajectoryWay& way, const CarriedMotion& carried, const WayWish& wish,
                               Progress& progress) {
  const WayKnowledge& known = wish.knowledge;
  std::vector<Station> stations;
  for (const auto& place : known.anchors) stations.push_back({.true_pose = {.translation = place}, .scans = {Scan{}}});
  const auto expected = expectedMotion(
      carried, *wish.scene, stations,
      {.profile = known.profile, .closures = known.closures, .anchors = true, .max_range_m = known.max_range_m},
      progress);
  if (!expected || expected->empty()) return {};  // or too long for an error of its own
  std::vector<double> times;
  for (const auto& sample : way.samples) times.push_back(carried.path->first_s() + sample.after_s);
  return expectedAt(*expected, times);
}

std::string shortText(const Product& product) {
  return product.name.empty() || product.ifc_class.empty() ? productText(product)
                                                           : product.ifc_class + " '" + product.name + "'";
}

}  // namespace

bool WayWish::operator==(const WayWish& other) const {
  const auto &a = trajectory, &b = other.trajectory;
  return georeference == other.georeference && scene == other.scene && written == other.written &&
         knowledge == other.knowledge && opened == other.opened && a.name == b.name && a.carrier == b.carrier &&
         a.height_m == b.height_m && a.speed_mps == b.speed_mps && a.seed == b.seed && a.file == b.file &&
         a.format == b.format &&
         std::equal(a.waypoints.begin(), a.waypoints.end(), b.waypoints.begin(), b.waypoints.end(), same);
}

std::size_t TrajectoryWay::closedDoors() const {
  return static_cast<std::size_t>(
      std::count_if(obstacles.begin(), obstacles.end(), [](const PathObstacle& o) { return o.closed_door; }));
}

TrajectoryWay wayOf(const WayWish& wish, Progress& progress) {
  TrajectoryWay way;
  Report report;
  const auto carried = carriedMotion(wish.trajectory, *wish.georeference, report, progress);
  if (!carried) {
    way.problem = trError(carried.error());
    return way;
  }
  way.length_m = carried->length_m;
  way.seconds = carried->seconds();
  way.samples = pathSamples(*carried, kMostSamples);
  way.expected_m = expectedOf(way, *carried, wish, progress);
  way.lift_m = liftOf(wish.trajectory);
  way.motion = *carried;
  way.limbs = limbsOfOperator(wish.trajectory, *carried);
  way.obstacles = obstaclesOf(*carried, *wish.scene, wish.opened);
  for (const auto& obstacle : way.obstacles)
    way.obstacle_products.push_back(shortText(wish.scene->environment().products[obstacle.product]));
  return way;
}

TrajectoryWays::TrajectoryWays(const std::function<void()>& wake)
    : latest_("Trajectories", wake), draft_("Trajectory", wake) {}

void TrajectoryWays::follow(const Document& document, const std::shared_ptr<const RayScene>& scene,
                            const WayKnowledge& knowledge) {
  constexpr std::chrono::seconds kBetweenLooks(2);
  takeIn();
  if (!document.job || !document.georeference || !scene) {
    job_.reset();
    wishes_.clear();
    shown_.clear();
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  const bool same_job =
      job_ == document.job && georeference_ == document.georeference && scene_ == scene && knowledge_ == knowledge;
  const bool files =
      std::any_of(wishes_.begin(), wishes_.end(), [](const auto& w) { return !w.trajectory.file.empty(); });
  if (same_job && (!files || now - looked_ < kBetweenLooks)) return;
  looked_ = now;
  job_ = document.job, georeference_ = document.georeference, scene_ = scene, knowledge_ = knowledge;
  auto wishes = wishesOf(*job_, georeference_, scene_, knowledge_);
  if (wishes == wishes_) return;
  wishes_ = std::move(wishes);
  showKnown();
  if (std::find(shown_.begin(), shown_.end(), nullptr) == shown_.end()) return;
  auto work = [wishes = wishes_, known = known_](Progress& progress) -> Result<Known> {
    Known made;
    for (const auto& wish : wishes) {
      const auto found = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.first == wish; });
      made.emplace_back(
          wish, found != known.end() ? found->second : std::make_shared<const TrajectoryWay>(wayOf(wish, progress)));
      TRY(progress.check());
    }
    return made;
  };
  latest_.want(wishes_, std::move(work), decltype(latest_)::Older::ends);
}

void TrajectoryWays::takeIn() {
  latest_.poll();
  draft_.poll();
  const auto& latest = latest_.latest();
  if (!latest || !latest->result || latest->result->empty()) return;
  const bool news = known_.size() != latest->result->size() ||
                    !std::equal(known_.begin(), known_.end(), latest->result->begin(),
                                [](const auto& a, const auto& b) { return a.second == b.second; });
  if (!news) return;
  known_ = *latest->result;
  showKnown();
}

void TrajectoryWays::showKnown() {
  shown_.assign(wishes_.size(), nullptr);
  for (std::size_t i = 0; i < wishes_.size(); ++i)
    for (const auto& [wish, way] : known_)
      if (wish == wishes_[i]) shown_[i] = way;
}

const TrajectoryWay* TrajectoryWays::of(std::size_t trajectory) const {
  return trajectory < shown_.size() ? shown_[trajectory].get() : nullptr;
}

void TrajectoryWays::wantDraft(WayWish wish) {
  if (draft_.wants(wish)) return;
  auto work = [wish](Progress& progress) -> Result<Way> {
    return std::make_shared<const TrajectoryWay>(wayOf(wish, progress));
  };
  draft_.want(std::move(wish), std::move(work), decltype(draft_)::Older::ends);
}

void TrajectoryWays::dropDraft() {
  if (draft_.wanted()) draft_.drop();
}

const TrajectoryWay* TrajectoryWays::draft() const {
  const auto& latest = draft_.latest();
  return latest && latest->result ? latest->result->get() : nullptr;
}

void TrajectoryWays::wait() {
  latest_.wait();
  draft_.wait();
  takeIn();
}

}  // namespace standpoint
