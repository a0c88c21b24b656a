// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/walking.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/readable_name.h"
#include "editor/model/fieldwork.h"
#include "editor/model/model.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "optimizer/walk/landing.h"

namespace standpoint {

namespace {

constexpr std::size_t kMostViews = 50;
constexpr double kReach_m = 30;      // of whoever walks; from outside one points anywhere
constexpr double kStoreySill = 0.4;  // m under a storey's level that still belong to it
constexpr double kBodyMiddle_m = 0.9;
constexpr double kHighestStorey_m = 6;  // of the uppermost one
constexpr double kLookDown_rad = 0.25, kNearest_m = 0.6, kFarthest_m = 3.5, kBeforeWall_m = 0.2, kOffSurface_m = 0.02;

ViewHistory::View viewNow(const Model& model) {
  return {model.view.camera,
          model.walk.active() ? std::optional(model.walk.feet()) : std::nullopt,
          model.visibility.cut_height_m,
          std::nullopt,
          {}};
}

void walkFrom(Model& model, WalkPlace place, bool jumps = false) {
  model.wanted_walk = std::move(place);
  model.wanted_jump = jumps;
  model.walk_ground.prepare(model.session.document(), model.walker, model.wake);
  followWalking(model);
}

void jump(Model& model, WalkPlace place) { walkFrom(model, std::move(place), true); }

// Without a source: there is no file to be repaired.
Error nowhere(std::string message) { return {ErrorKind::unusable, std::move(message), {}}; }

bool begin(Model& model, const std::shared_ptr<const WalkedGround>& ground, const StartPlace& place) {
  auto before = viewNow(model);
  if (model.wanted_jump) before.jumped_at = model.session.steps();
  stopFlying(model);
  if (!model.walk.start(ground, model.walker, place, model.view.camera)) return false;
  model.views.push(before);
  model.view.tool = Tool::walk;
  model.visibility.cut_height_m.reset();  // rooms have walls and ceilings for whoever stands in them
  if (place.no_ground_outside) model.say(tr("No way in from outside: the walk begins behind the entrance"));
  return true;
}

// A room or storey that is selected as a whole is so no longer for whoever stands in it: all that he sees would have
// the colour of the selection.
void deselectAround(Model& model, const std::vector<std::uint32_t>& room) {
  const auto& selected = model.selection.products();
  if (room.empty() || !std::includes(selected.begin(), selected.end(), room.begin(), room.end())) return;
  std::vector<std::uint32_t> left;
  std::set_difference(selected.begin(), selected.end(), room.begin(), room.end(), std::back_inserter(left));
  model.selection.set(std::move(left));
}

// What the middle of the picture shows.
std::optional<Eigen::Vector3d> lookedAt(const Model& model) {
  const auto ray = rayThrough(model.view.camera, model.view.size / 2, model.view.size);
  const auto hit = model.picker.pick(ray, model.viewState());
  return hit ? std::optional(hit->position) : std::nullopt;
}

// Turns it about its target to where most of the way back is free, and goes as far back as that allows.
void backAway(const Model& model, Camera& camera, std::initializer_list<double> elevations_rad) {
  constexpr int kDirections = 24;
  const auto state = model.viewState();
  camera.distance_m = kNearest_m;
  camera.elevation_rad = *elevations_rad.begin();
  Camera best = camera;
  for (const double elevation_rad : elevations_rad)
    for (int i = 0; i < kDirections; ++i) {
      Camera tried = camera;
      tried.elevation_rad = elevation_rad;
      tried.azimuth_rad = camera.azimuth_rad + 2 * std::numbers::pi * i / kDirections;
      const auto hit = model.picker.pick({camera.target - kOffSurface_m * tried.forward(), -tried.forward()}, state);
      tried.distance_m = std::min(hit ? hit->range_m - kBeforeWall_m : kFarthest_m, kFarthest_m);
      if (tried.distance_m > best.distance_m + 1e-6) best = tried;
    }
  camera = best;
}

}  // namespace

void ViewHistory::push(const View& view) {
  views_.push_back(view);
  if (views_.size() > kMostViews) views_.erase(views_.begin());
}

std::optional<ViewHistory::View> ViewHistory::back() {
  if (views_.empty()) return std::nullopt;
  const View view = views_.back();
  views_.pop_back();
  return view;
}

void startWalking(Model& model) {
  walkFrom(model, [&model, body = model.walker](const WalkedGround& ground) -> Result<StartPlace> {
    const Onlooker onlooker{model.view.camera.eye(), lookedAt(model)};
    if (auto place = startPlace(*ground.environment, *ground.collision, ground.obstacles, body, onlooker))
      return *place;
    return tl::unexpected(nowhere("No floor of at least 2 m² to walk on"));
  });
}

std::string whyNoLanding(const Landing& landing, const Model& model) {
  if (!landing.why_not.empty()) return landing.why_not;
  const bool far = model.walk.active() && (landing.feet - model.walk.feet()).norm() > kReach_m;
  return far ? fmt::format("out of reach: more than {:.0f} m away", kReach_m) : "";
}

void teleport(Model& model, const RayHit& hit) {
  jump(model, [&model, hit, body = model.walker](const WalkedGround& ground) -> Result<StartPlace> {
    const auto landing = landingOn(ground, body, hit.position, hit.normal);
    const auto why = whyNoLanding(landing, model);
    if (!why.empty()) return tl::unexpected(nowhere(trf("Cannot stand there: {}", trSentence(why))));
    return StartPlace{landing.feet, {}};
  });
}

void jumpToRoom(Model& model, std::uint32_t product) {
  jump(model, [&model, product, body = model.walker](const WalkedGround& ground) -> Result<StartPlace> {
    const auto place = placeInRoom(*ground.environment, product, *ground.collision, ground.obstacles, body);
    if (!place)
      return tl::unexpected(
          nowhere(trf("No floor to stand on in room {}", readableName(ground.environment->products[product]))));
    deselectAround(model, {product});
    return *place;
  });
}

void jumpToStation(Model& model, std::size_t station) {
  const auto& chosen = model.session.document().job->stations[station];
  jump(model, [chosen, body = model.walker](const WalkedGround& ground) -> Result<StartPlace> {
    Avatar avatar(ground.obstacles, body);
    if (avatar.stand(chosen.true_pose.translation, chosen.instrument_height_m + 1))
      return StartPlace{avatar.feet(), {}};
    return tl::unexpected(nowhere(trf("No room to stand at station {}", chosen.name)));
  });
}

void jumpToStorey(Model& model, std::int32_t node) {
  const auto& storeys = model.storeys();
  const auto storey = std::find_if(storeys.begin(), storeys.end(), [&](const auto& s) { return s.node == node; });
  if (storey == storeys.end()) return;
  const double low = storey->elevation_m - kStoreySill, high = std::next(storey) == storeys.end()
                                                                   ? low + kHighestStorey_m
                                                                   : std::next(storey)->elevation_m - kStoreySill;
  jump(model, [&model, low, high, node, body = model.walker](const WalkedGround& ground) -> Result<StartPlace> {
    const auto place = placeOnLevel(*ground.environment, *ground.collision, ground.obstacles, body, low, high);
    if (!place)
      return tl::unexpected(nowhere("No floor of 2 m² to stand on in " +
                                    model.environment()->spatial[static_cast<std::size_t>(node)].name));
    deselectAround(model, model.outliner.tree.productsBelow(static_cast<std::uint32_t>(node)));
    return *place;
  });
}

void rememberView(Model& model) { model.views.push(viewNow(model)); }

void walkFromEye(Model& model, const Eigen::Vector3d& eye, const Camera& camera) {
  walkFrom(model, [eye, camera, body = model.walker](const WalkedGround& ground) -> Result<StartPlace> {
    Avatar avatar(ground.obstacles, body);
    const Eigen::Vector3d forward = camera.forward();
    if (avatar.stand(eye, Walk::kHighestEyes_m + 1)) return StartPlace{avatar.feet(), forward.head<2>().normalized()};
    return tl::unexpected(nowhere("Nobody can stand there any more"));
  });
}

namespace {

// How far around a place is looked at, to know it again: half of the room that it is in or before.
double surroundings_m(const Model& model, const Eigen::Vector3d& place) {
  constexpr double kLeast_m = 1.5, kMost_m = 5, kUsual_m = 2.5;  // of a hall, a part; where there are no rooms
  const auto& rooms = model.room_labels.of(model.session.document().imported);
  const auto nearest = std::min_element(rooms.begin(), rooms.end(), [&](const RoomLabel& a, const RoomLabel& b) {
    return (a.anchor - place).squaredNorm() < (b.anchor - place).squaredNorm();
  });
  return nearest == rooms.end() ? kUsual_m : std::clamp(std::sqrt(nearest->floor_area_m2) / 2, kLeast_m, kMost_m);
}

// The newest scan of each station that is meant.
std::vector<PosedScan> scansOf(const Model& model, const FigurePlace& place) {
  const auto clouds = inspectedClouds(model.session.document());
  std::vector<PosedScan> scans;
  int last = -1;
  for (const auto& cloud : clouds) {
    const auto& wanted = place.stations;
    const bool meant = wanted.empty() || std::find(wanted.begin(), wanted.end(), cloud.scan) != wanted.end();
    if (cloud.station < 0 || cloud.station == last || !meant) continue;
    last = cloud.station;
    const bool shared = std::any_of(clouds.begin(), clouds.end(), [&](const InspectedCloud& other) {
      return other.file == cloud.file && other.station != cloud.station;
    });
    scans.push_back({cloud.file, std::nullopt, shared ? cloud.scan : std::string()});
  }
  return scans;
}

constexpr double kOver_m = 0.15;  // a place that is cut free

// So high over the floor below a place that it is seen from above; none where a storey's slab or more lies over it.
std::optional<double> cutOver(const Model& model, const Eigen::Vector3d& place) {
  constexpr double kSlab_m = 0.35;
  const auto& storeys = model.storeys();
  const auto above = std::find_if(storeys.begin(), storeys.end(),
                                  [&](const StoreyLevel& s) { return s.elevation_m > place.z() + kStoreySill; });
  const double floor = above == storeys.begin() ? place.z() : std::prev(above)->elevation_m;
  const double height = std::max(floor + kCutAboveFloor_m, place.z() + kOver_m);
  if (above != storeys.end() && height > above->elevation_m - kSlab_m) return std::nullopt;
  return height;
}

// The first direction, from the one that is looked in already, from which nothing hides the place; false: there is
// none.
bool lookFromAbove(Model& model, const Eigen::Vector3d& place, const Bounds& around) {
  constexpr int kDirections = 12;
  constexpr double kElevations_rad[] = {0.75, 1.0, 1.25};
  const auto cut = cutOver(model, place);
  if (!cut) return false;
  auto& camera = model.view.camera;
  const Camera before = camera;
  const auto cut_before = model.visibility.cut_height_m;
  camera.orthographic = false;
  camera.view_angle_rad = Camera().view_angle_rad;
  for (const double height_m : {*cut, place.z() + kOver_m}) {  // the lower one below eaves
    model.visibility.cut_height_m = height_m;
    const auto state = model.viewState();
    for (const double elevation_rad : kElevations_rad)
      for (int i = 0; i < kDirections; ++i) {
        camera.elevation_rad = elevation_rad;
        camera.azimuth_rad = azimuthBeside(before.azimuth_rad, i, kDirections);
        model.bringIntoView(around);
        if (model.picker.sees(camera.eye(), place - kOffSurface_m * camera.forward(), state)) return true;
      }
  }
  camera = before;
  model.visibility.cut_height_m = cut_before;
  return false;
}

void lookFromWithin(Model& model, const Eigen::Vector3d& at, const Bounds& around) {
  auto& cut = model.visibility.cut_height_m;
  if (cut && at.z() > *cut) cut.reset();
  auto& camera = model.view.camera;
  if (looksStraightDown(camera)) look(camera, StandardView::corner);
  camera.orthographic = false;
  model.bringIntoView(around);
  if (model.picker.sees(camera.eye(), at - kOffSurface_m * camera.forward(), model.viewState())) return;
  camera.view_angle_rad = Walk::kUsualViewAngle_rad;
  backAway(model, camera, {kLookDown_rad, 0.0, -kLookDown_rad, 2.5 * kLookDown_rad, -2.5 * kLookDown_rad});
}

}  // namespace

void showWorstPlace(Model& model, FigurePlace place) {
  const auto cut_before = model.visibility.cut_height_m;
  auto before = viewNow(model);
  if (const auto& cloud = model.cloud(); cloud && !place.among_points) {
    before.clouds = cloud->files;
    if (before.clouds.empty() && !cloud->file.empty()) before.clouds = {cloud->file};
    if (model.session.document().hasModel()) model.showClouds({});
  }
  model.views.push(before);
  stopWalking(model);
  stopFlying(model);
  const Eigen::Vector3d at = place.at;
  const double reach_m = surroundings_m(model, at);
  Bounds around;
  constexpr double kBeyond = 1.4;  // so that walls are in sight beside a floor
  around.extend(at - Eigen::Vector3d::Constant(kBeyond * reach_m));
  around.extend(at + Eigen::Vector3d::Constant(kBeyond * reach_m));
  model.place_points.drop();
  if (!place.among_points)
    model.place_points.start({scansOf(model, place), at, 2.5 * reach_m, model.shift_m()}, model.wake);
  place.where = placeName(model, at);
  model.view.worst_place = std::move(place);
  if (!lookFromAbove(model, at, around)) lookFromWithin(model, at, around);
  model.visibility.cutForSight(std::exchange(model.visibility.cut_height_m, cut_before));
}

void flyTo(Model& model, const Eigen::Vector3d& place) {
  const Eigen::Vector3d middle = place + Eigen::Vector3d(0, 0, kBodyMiddle_m);
  rememberView(model);
  stopWalking(model);
  stopFlying(model);
  model.visibility.cut_height_m.reset();
  model.view.flown_to = place;
  auto& camera = model.view.camera;
  camera.orthographic = false;
  camera.view_angle_rad = Walk::kUsualViewAngle_rad;
  camera.target = middle;
  backAway(model, camera, {kLookDown_rad});
}

void stopWalking(Model& model) {
  model.wanted_walk = nullptr;
  model.walk.stop(model.view.camera);
  if (model.view.tool == Tool::walk) model.view.tool = Tool::select;
}

void goBackInViews(Model& model) {
  const auto view = model.views.back();
  if (!view) return;
  model.view.worst_place.reset();
  model.view.teleport.goes_on_to_s = 0;
  stopFlying(model);
  const auto ground = view->feet ? model.walk_ground.of(model.session.document(), model.walker) : nullptr;
  if (ground && model.walk.start(ground, model.walker, {*view->feet, {}}, model.view.camera))
    model.view.tool = Tool::walk;
  else
    stopWalking(model);
  model.view.camera = view->camera;
  model.visibility.cut_height_m = view->cut_height_m;
  model.points_sought = false;
  if (!view->clouds.empty()) model.showClouds(view->clouds);
}

bool canUndoJump(const Model& model) { return model.walk.active() && model.views.endsInJump(model.session.steps()); }

bool awaitsWalk(const Model& model) {
  return model.wanted_walk || model.view.teleport.active() || model.walk_ground.preparing();
}

void giveUpWalk(Model& model) {
  model.wanted_walk = nullptr;
  model.view.teleport = {};
  model.walk_ground.cancel();
}

void followWalking(Model& model) {
  if (auto error = model.walk_ground.takeError()) {
    model.wanted_walk = nullptr;
    if (error->kind != ErrorKind::cancelled)
      model.session.errors().push_back({"The walkable surface could not be prepared", std::move(*error)});
  }
  if (model.walk.active() && model.view.tool != Tool::walk) model.walk.stop(model.view.camera);
  if (model.walk.active()) model.walk.goAmong(tripodsOf(model));
  if (!model.walk.active() && !model.wanted_walk) return;
  if (model.wanted_walk) model.walk_ground.prepare(model.session.document(), model.walker, model.wake);
  const auto ground = model.walk_ground.of(model.session.document(), model.walker);
  if (model.walk.active() && !model.walk.isIn(ground)) stopWalking(model);
  if (!ground || !model.wanted_walk) return;
  const auto place = std::exchange(model.wanted_walk, nullptr)(*ground);
  if (!place)
    model.session.errors().push_back({"Cannot walk there", place.error()});
  else if (!begin(model, ground, *place))
    model.session.errors().push_back({"Cannot walk there", nowhere("Not enough room to stand")});
}

std::string tightPlaceName(const TightPlace& place, const Body& agent) {
  return place.passes_height_m < agent.height_m - 1e-6 ? trf("headroom {:.2f} m", place.headroom_m) : "too narrow";
}

std::string whoPasses(const TightPlace& place) {
  return trf("a body of {:.1f} m with a radius of {:.2f} m passes", place.passes_height_m, place.passes_radius_m);
}

std::string storeyNameAt(const Model& model, double floor_m) {
  const StoreyLevel* storey = nullptr;
  for (const auto& level : model.storeys())
    if (level.elevation_m <= floor_m + kStoreySill) storey = &level;
  return storey == nullptr ? std::string() : model.environment()->spatial[static_cast<std::size_t>(storey->node)].name;
}

namespace {

std::string roomOnStorey(const std::string& room, const std::string& storey) {
  return room.empty() || storey.empty() ? room + storey : room + " · " + storey;
}

}  // namespace

std::string placeName(const Model& model, const Eigen::Vector3d& place) {
  const auto& imported = model.session.document().imported;
  const auto* room = model.room_labels.roomAt(imported, place);
  if (room == nullptr) return storeyNameAt(model, place.z());
  return roomOnStorey(readableName(imported->products[room->product]), storeyNameAt(model, room->box.min.z()));
}

std::string walkPlaceName(const Model& model) {
  const auto& document = model.session.document();
  const Eigen::Vector3d feet = model.walk.feet();
  std::string name;
  if (const auto room = spaceAt(model.walk.ground().spaces, feet + Eigen::Vector3d(0, 0, kBodyMiddle_m)))
    name = readableName(document.imported->products[*room]);
  return roomOnStorey(name, storeyNameAt(model, feet.z()));
}

}  // namespace standpoint
