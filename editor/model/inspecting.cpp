// SPDX-License-Identifier: GPL-3.0-or-later
// What of the model looks into clouds.
#include <algorithm>
#include <any>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "editor/inspect/point_picking.h"
#include "editor/model/model.h"

namespace standpoint {

namespace {

PointPlaces placesOf(const Cloud& cloud) {
  if (cloud.points.empty()) return {};
  return {cloud.points.front().position_m.data(), cloud.points.size(), sizeof(CloudPoint) / sizeof(float)};
}

struct PlacedCloud {
  const Cloud* cloud;
  Eigen::Matrix4d local_from_cloud;
};
// Those that are measured; where there are some, `state` lives as long as they.
std::vector<PlacedCloud> measuredClouds(const Cloud* shown, const ViewState& state) {
  if (shown != nullptr) {
    PlacedCloud alone{shown, Eigen::Matrix4d::Identity()};
    alone.local_from_cloud.topRightCorner<3, 1>() = shown->pointsOrigin_m();
    return {alone};
  }
  std::vector<PlacedCloud> clouds;
  for (const auto& u : state.underlays) clouds.push_back({u.cloud.get(), u.local_from_cloud});
  return clouds;
}

struct MetPoint {
  Eigen::Vector3d position;  // local frame
  const PlacedCloud* of;
};
// The first that the line of sight meets of those that are neither above the cut nor outside the clip box.
std::optional<MetPoint> firstPoint(const std::vector<PlacedCloud>& clouds, const SightCone& cone,
                                   const ViewState& state) {
  std::optional<MetPoint> best;
  for (const auto& placed : clouds) {
    const Eigen::Matrix3d turn = placed.local_from_cloud.topLeftCorner<3, 3>();
    const Eigen::Vector3d shift = placed.local_from_cloud.topRightCorner<3, 1>();
    SightCone there = cone;
    there.origin = turn.transpose() * (cone.origin - shift);
    there.direction = turn.transpose() * cone.direction;
    const auto places = placesOf(*placed.cloud);
    const auto counts = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d here = turn * p + shift;
      return (!state.cut_height_m || here.z() <= *state.cut_height_m) && (!state.clip || state.clip->contains(here));
    };
    const auto i = standpoint::firstPoint(places, there, counts);
    if (!i) continue;
    const float* p = places.first + *i * places.stride;
    const Eigen::Vector3d at = turn * Eigen::Vector3d(p[0], p[1], p[2]) + shift;
    if (!best || (at - cone.origin).dot(cone.direction) < (best->position - cone.origin).dot(cone.direction))
      best = MetPoint{at, &placed};
  }
  return best;
}

// Of the plane that the cloud has there, in the narrowest surroundings that show one; local frame.
std::optional<Eigen::Vector3d> normalThere(const MetPoint& met) {
  const Eigen::Matrix3d turn = met.of->local_from_cloud.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift = met.of->local_from_cloud.topRightCorner<3, 1>();
  const Eigen::Vector3d there = turn.transpose() * (met.position - shift);
  for (const double radius_m : {0.1, 0.25, 0.5})
    if (const auto normal = normalAround(placesOf(*met.of->cloud), there, radius_m)) return turn * *normal;
  return std::nullopt;
}

std::string nameOf(const Cloud& cloud, const std::vector<InspectedCloud>& listed) {
  if (const auto* known = cloudOf(listed, cloud.file)) return known->label;
  return cloud.file.empty() ? tr("Scan") : cloud.file.filename().string();
}

SightCone coneOf(const ViewRay& ray, const ViewportState& view, double reach_px) {
  const double at_target = view.camera.heightAtTarget_m() / std::max(1.0, view.size.y()) * reach_px;
  SightCone cone{ray.origin, ray.direction};
  if (view.camera.orthographic)
    cone.radius_m = at_target;
  else
    cone.per_metre = at_target / view.camera.distance_m;
  return cone;
}

}  // namespace

std::optional<MeasurablePlace> Model::measurable(const ViewRay& ray, const SightCone& cone, const ViewState& state,
                                                 bool with_normal) const {
  const auto clouds = measuredClouds(cloud_.get(), state);
  const auto point = firstPoint(clouds, cone, state);
  const auto hit = cloud_ ? std::nullopt : picker.pick(ray, state);
  if (hit && (!point || (hit->position - point->position).dot(ray.direction) < 0))
    return MeasurablePlace{hit->position, {}, {hit->normal}};
  if (!point) return std::nullopt;
  MeasurablePlace place{point->position, nameOf(*point->of->cloud, inspectedClouds(session.document()))};
  if (!with_normal) return place;
  if (const auto normal = normalThere(*point))
    place.normals = {normal->dot(ray.direction) > 0 ? Eigen::Vector3d(-*normal) : *normal};
  return place;
}

std::optional<MeasurablePlace> Model::measurableAt(const Eigen::Vector2d& pixel, double reach_px) const {
  const auto ray = rayThrough(view.camera, pixel, view.size);
  return measurable(ray, coneOf(ray, view, reach_px), viewState(), false);
}

std::optional<MeasurablePlace> Model::snappedAt(const Eigen::Vector2d& pixel, double reach_px, double snap_px) {
  const ViewState state = viewState();
  const auto ray = rayThrough(view.camera, pixel, view.size);
  auto place = measurable(ray, coneOf(ray, view, reach_px), state, true);
  if (cloud_ || (place && !place->cloud.empty())) return place;
  std::vector<Eigen::Vector3d> met;
  if (place) met.push_back(place->position);
  constexpr int kAround = 8;
  for (int i = 0; i < kAround; ++i) {
    const double turn = 2 * std::numbers::pi * i / kAround;
    const Eigen::Vector2d beside = pixel + snap_px * Eigen::Vector2d(std::cos(turn), std::sin(turn));
    if (const auto hit = picker.pick(rayThrough(view.camera, beside, view.size), state)) met.push_back(hit->position);
  }
  const auto sees = [&](std::uint32_t product, const Eigen::Vector3d& at) {
    if (!isShown(state, product, at)) return false;
    constexpr double kBeside_m = 0.002;  // a line of sight along a face may meet it
    const Eigen::Vector3d way = met.front() - at;
    const Eigen::Vector3d beside = at + way * std::min(1.0, kBeside_m / std::max(way.norm(), 1e-9));
    return picker.isInSight(beside, state);
  };
  snapping_.follow(state.environment);
  const auto snap = snapping_.nearest(met, {view.camera, view.size, pixel, snap_px, sees});
  if (snap) place = MeasurablePlace{snap->position, {}, snap->normals, snap->snap};
  return place;
}

std::optional<MeasurablePlace> Model::measurableOpposite() const {
  const auto normal = towardsOpposite(view.measuring);
  if (!normal) return std::nullopt;
  constexpr double kBefore_m = 0.03, kBeam_m = 0.03;  // where the beam leaves the face, and how wide it is for points
  const ViewRay ray{view.measuring.points[0] + *normal * kBefore_m, *normal};
  auto place = measurable(ray, {ray.origin, ray.direction, kBeam_m, 0}, viewState(), false);
  if (!place) return std::nullopt;
  place->normals = {-*normal};
  return squared(view.measuring, *place);
}

std::optional<InspectedCloud> Model::wallCloud(std::string* why_not) const {
  const auto clouds = inspectedClouds(session.document());
  const auto give = [](const InspectedCloud& cloud) { return std::optional(cloud); };
  if (!wall_choice.cloud.empty())
    if (const auto* chosen = cloudOf(clouds, wall_choice.cloud)) return give(*chosen);
  if (cloud_ && !cloud_->file.empty())
    if (const auto* shown_cloud = cloudOf(clouds, cloud_->file)) return give(*shown_cloud);
  for (const auto& cloud : clouds)
    if (cloud.station >= 0 && cloud.station == survey.station) return give(cloud);
  if (!clouds.empty()) return give(clouds.front());
  if (why_not != nullptr) *why_not = "Scan from a station, or add a point cloud, first";
  return std::nullopt;
}

void Model::measureWall(const Eigen::Vector3d& place, const std::optional<Eigen::Vector3d>& normal) {
  const auto cloud = wallCloud();
  if (!cloud) return;
  const Pose cloud_from_local = inverse(cloud->local_from_cloud);
  WallRequest request{cloud->label, cloud->file, cloud->local_from_cloud, {}, {}};
  request.ball = {cloud_from_local * place, wall_choice.radius_m};
  if (normal) request.options.normal = cloud_from_local.rotation * *normal;
  request.options.roughness_radius_m = wall_choice.roughness_radius_m;
  wall.start(std::move(request));
}

// A mode that another file has no channel for gives way to its own colours.
void Model::followPointColours() {
  if (!cloud_ || cloud_->points.empty() || view.points_by == ColourBy::natural) return point_painter.follow({}, wake);
  if (!whyNotColoured(view.points_by, cloud_->header).empty()) {
    view.points_by = ColourBy::natural;
    return;
  }
  point_painter.follow({cloud_, cloud_->points, &cloud_->header, view.points_by, environment(), cloud_->shift_m}, wake);
}

const PointLegend* Model::pointLegend() const {
  if (difference_ && difference_->cloud == cloud_ && view.points_by == ColourBy::natural) return &difference_->legend;
  const auto* painted = point_painter.of(cloud_);
  return painted == nullptr ? nullptr : &painted->legend;
}

void Model::showPanorama(const InspectedCloud& cloud, std::optional<std::size_t> scan) {
  panorama.start({cloud.label, cloud.file, scan, cloud.local_from_cloud});
}

void Model::jumpTo(const Eigen::Vector3d& place, const Eigen::Vector3d& from) {
  constexpr double kNear_m = 1.5;
  const Eigen::Vector3d forward = (place - from).normalized();
  view.camera.orthographic = false;
  view.camera.target = place;
  view.camera.distance_m = std::min(kNear_m, 0.8 * (place - from).norm());
  view.camera.azimuth_rad = std::atan2(-forward.x(), forward.y());
  view.camera.elevation_rad = std::asin(std::clamp(-forward.z(), -1.0, 1.0));
}

void Model::clipAroundSelection() {
  Bounds chosen = selectionBounds();
  const auto& job = session.document().job;
  if (chosen.empty() && job && survey.station >= 0 && survey.station < static_cast<int>(job->stations.size())) {
    const auto& station = job->stations[static_cast<std::size_t>(survey.station)];
    const Eigen::Vector3d& centre = station.true_pose.translation;
    constexpr double kAround_m = 3, kAbove_m = 1.5;
    chosen.extend(centre - Eigen::Vector3d(kAround_m, kAround_m, station.instrument_height_m));
    chosen.extend(centre + Eigen::Vector3d(kAround_m, kAround_m, kAbove_m));
  }
  view.clip.box = clipAround(chosen.empty() ? buildingBounds() : chosen, chosen.empty() ? 0.1 : 0.3);
}

void Model::clipSection(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  view.clip.box = slabThrough(place, normal, view.clip.thickness_m, visibleBounds());
}

void Model::followClip(bool settled) {
  const auto* in_step = std::any_cast<std::optional<ClipBox>>(&session.history().shown());
  const auto noted = in_step != nullptr ? *in_step : std::nullopt;
  if (noted != noted_clip_) {  // undone or redone, or another project
    view.clip.box = noted_clip_ = noted;
    return;
  }
  if (!settled || view.clip.box == noted_clip_) return;
  const char* const step = !view.clip.box ? "Clip box removed" : noted_clip_ ? "Clip box changed" : "Clip box set";
  noted_clip_ = view.clip.box;
  session.note(noted_clip_, step);
}

void Model::lookAlongClip() {
  if (!view.clip.box) return;
  const auto& box = *view.clip.box;
  const int thin = thinAxis(box);
  view.camera.orthographic = true;
  view.camera.elevation_rad = thin == 2 ? std::numbers::pi / 2 : 0;
  // From where the camera is already, rather than from behind.
  const Eigen::Vector3d axis = box.axis(thin == 2 ? 1 : thin);
  const Eigen::Vector3d forward = thin == 2 || axis.dot(view.camera.forward()) >= 0 ? axis : Eigen::Vector3d(-axis);
  view.camera.azimuth_rad = std::atan2(-forward.x(), forward.y());
  bringIntoView(boundsOf(box));
}

}  // namespace standpoint
