// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"
#include "core/georeference.h"
#include "core/report.h"
#include "core/survey.h"

namespace standpoint {

// Where a cloud of the given bounds lies in the model's file frame, when nobody says so: where the model has a map
// conversion and the cloud states the model's CRS, or states none and only so comes near the model, by that conversion;
// else as the cloud's own coordinates are. The report says which, and names what does not fit.
struct CloudPlace {
  std::string name, crs;  // of the cloud; the CRS as WKT or "EPSG:n", or empty
  Bounds bounds_cloud_m;
};
Pose placeCloud(const CloudPlace& cloud, const Georeference& model, const Bounds& model_file_m, Report& report);

// Between two boxes, 0 when they meet.
double distance_m(const Bounds& a, const Bounds& b);
constexpr double kFarFromModel_m = 1000;

// Of the corners of `bounds`.
Bounds moved(const Pose& pose, const Bounds& bounds);

}  // namespace standpoint
