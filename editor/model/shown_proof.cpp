// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/shown_proof.h"

#include <algorithm>
#include <cmath>

#include "editor/model/model.h"

namespace standpoint {

Eigen::Vector3d alongSurface(const ProofLook& look) {
  const Eigen::Vector3d normal = look.normal.value_or(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  constexpr double kLevel = 0.99;  // of the normal's height: a floor or a ceiling
  if (std::abs(normal.z()) < kLevel) return normal.cross(up).normalized();
  Eigen::Vector3d away = look.centre - look.from;
  away.z() = 0;
  return away.norm() > 1e-3 ? Eigen::Vector3d(away.normalized()) : Eigen::Vector3d::UnitY();
}

Camera cameraOf(const ProofLook& look, Camera camera, double aspect) {
  const Eigen::Vector3d to_instrument = (look.from - look.centre).normalized();
  Eigen::Vector3d forward;
  if (look.edge_on) {
    forward = alongSurface(look);
  } else if (look.normal) {
    constexpr double kAslant = 0.35;  // so that form is seen
    forward = -(*look.normal + kAslant * to_instrument).normalized();
  } else {
    constexpr double kFromAbove = 0.25;
    Eigen::Vector3d from = to_instrument;
    from.z() = std::max(from.z(), kFromAbove);
    forward = -from.normalized();
  }
  camera.orthographic = look.edge_on;
  camera.azimuth_rad = std::atan2(-forward.x(), forward.y());
  camera.elevation_rad = std::asin(std::clamp(-forward.z(), -1.0, 1.0));
  camera.target = look.centre;
  constexpr double kMargin = 1.08;
  const double tangent = std::tan(camera.view_angle_rad / 2) * std::min(aspect, 1.0);
  // Seen in perspective, a ball covers more than its middle circle.
  const double lengths = look.edge_on ? 1 / tangent : std::sqrt(1 + 1 / (tangent * tangent));
  camera.distance_m = kMargin * look.radius_m * lengths;
  return camera;
}

void Model::showProof(ShownProof shown) {
  if (view.tool == Tool::fly) stopFlying(*this);
  if (view.tool == Tool::walk) stopWalking(*this);
  view.tool = Tool::select;
  shown.camera_before = proof ? proof->camera_before : view.camera;
  const double halves = shown.points ? 2 : 1;
  view.camera = cameraOf(shown.look, view.camera, view.size.x() / halves / std::max(view.size.y(), 1.0));
  proof = std::move(shown);
}

void Model::endProof() {
  if (!proof) return;
  view.camera = proof->camera_before;
  proof.reset();
}

ViewState Model::proofState(const std::shared_ptr<const Cloud>& cloud) const {
  ViewState state = viewState();
  state.cloud = cloud;
  state.cloud_paint.reset();
  state.underlays.clear();
  state.instruments.reset();
  state.under_way.reset();
  state.working.reset();
  state.clip.reset();
  state.cut_height_m.reset();
  state.selected.reset();
  state.colour = ColourMode::model;
  return state;
}

}  // namespace standpoint
