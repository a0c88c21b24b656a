// SPDX-License-Identifier: GPL-3.0-or-later
// What of the model looks into clouds.
#include <algorithm>
#include <any>
#include <cmath>
#include <numbers>

#include "editor/inspect/point_picking.h"
#include "editor/model/model.h"

namespace standpoint {

namespace {

PointPlaces placesOf(const Cloud& cloud) {
  if (cloud.points.empty()) return {};
  return {cloud.points.front().position_m.data(), cloud.points.size(), sizeof(CloudPoint) / sizeof(float)};
}

}  // namespace

std::optional<Model::MeasurablePlace> Model::measurableAt(const ViewRay& ray, double reach_px) const {
  const double at_target = view.camera.heightAtTarget_m() / std::max(1.0, view.size.y()) * reach_px;
  SightCone cone{ray.origin, ray.direction};
  if (view.camera.orthographic)
    cone.radius_m = at_target;
  else
    cone.per_metre = at_target / view.camera.distance_m;
  std::optional<MeasurablePlace> best;
  const auto offer = [&](const Eigen::Vector3d& place, const std::string& cloud) {
    if (!best || (place - ray.origin).dot(ray.direction) < (best->position - ray.origin).dot(ray.direction))
      best = {place, cloud};
  };
  const auto clouds = inspectedClouds(session.document());
  const auto nameOf = [&](const Cloud& cloud) {
    const auto* listed = standpoint::cloudOf(clouds, cloud.file);
    if (listed != nullptr) return listed->label;
    return cloud.file.empty() ? tr("Scan") : cloud.file.filename().string();
  };
  const auto tryCloud = [&](const Cloud& cloud, const Eigen::Matrix4d& local_from_cloud) {
    const Eigen::Matrix3d turn = local_from_cloud.topLeftCorner<3, 3>();
    const Eigen::Vector3d shift = local_from_cloud.topRightCorner<3, 1>();
    SightCone there = cone;
    there.origin = turn.transpose() * (cone.origin - shift);
    there.direction = turn.transpose() * cone.direction;
    const auto places = placesOf(cloud);
    const auto counts = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d here = turn * p + shift;
      return (!visibility.cut_height_m || here.z() <= *visibility.cut_height_m) &&
             (!view.clip.box || view.clip.box->contains(here));
    };
    if (const auto i = firstPoint(places, there, counts)) {
      const float* p = places.first + *i * places.stride;
      offer(turn * Eigen::Vector3d(p[0], p[1], p[2]) + shift, nameOf(cloud));
    }
  };
  if (cloud_) {
    Eigen::Matrix4d local_from_points = Eigen::Matrix4d::Identity();
    local_from_points.topRightCorner<3, 1>() = cloud_->pointsOrigin_m();
    tryCloud(*cloud_, local_from_points);
    return best;
  }
  const ViewState state = viewState();
  for (const auto& u : state.underlays) tryCloud(*u.cloud, u.local_from_cloud);
  if (const auto hit = picker.pick(ray, state)) offer(hit->position, {});
  return best;
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
  const Bounds chosen = selectionBounds();
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
