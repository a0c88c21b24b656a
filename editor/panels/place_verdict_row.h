// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "survey/quality/place_verdict.h"

namespace standpoint {

struct Model;

// Of the place of a station, kept until that or what is around it is another.
struct KeptVerdict {
  std::weak_ptr<const RayScene> scene;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool on_tripod = true;
  double nearest_m = 0;
  PlaceVerdict answer;
};

// `centre` of the instrument, local frame. Null while the scene is prepared.
const PlaceVerdict* placeVerdict(const Model& model, KeptVerdict& kept, const Eigen::Vector3d& centre, bool on_tripod);
// The verdict's sign, word and reason.
void drawPlaceVerdict(const Model& model, KeptVerdict& kept, const Eigen::Vector3d& centre, bool on_tripod);

}  // namespace standpoint
