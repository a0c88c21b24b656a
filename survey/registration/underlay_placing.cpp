// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/registration/underlay_placing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "survey/geodesy.h"

namespace standpoint {

namespace {

// A pose cannot stretch: it is exact at the middle of the cloud, and what the conversion's scale would move further out
// is said.
Pose poseFromMap(const MapConversion& conversion, const CloudPlace& cloud, Report& report) {
  const Bounds& b = cloud.bounds_cloud_m;
  const Eigen::Vector3d middle = b.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d((b.min + b.max) / 2);
  Pose pose;
  const double angle = std::atan2(conversion.x_axis_ordinate, conversion.x_axis_abscissa);
  pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()));
  if (pose.rotation.w() < 0) pose.rotation.coeffs() *= -1;
  pose.translation = fileFromMap(conversion, middle) - pose.rotation * middle;
  const double off_m = std::abs(1 / conversion.scale - 1) * b.diagonal() / 2;
  if (off_m > 0.001)
    report.warn(cloud.name,
                fmt::format("map conversion scale {} is not applied to the cloud: {:.3f} m error at its edge",
                            conversion.scale, off_m));
  return pose;
}

// The codes where PROJ finds them, else the texts.
bool sameCrs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const auto first = findCrs(a), second = findCrs(b);
  return first && second && (first->code == second->code || first->name == second->name);
}

std::string shownCrs(const std::string& crs) {
  const auto found = findCrs(crs);
  if (!found) return crs.substr(0, 60);
  return found->code.size() < 20 ? fmt::format("{} ({})", found->name, found->code) : found->name;
}

}  // namespace

double distance_m(const Bounds& a, const Bounds& b) {
  if (a.empty() || b.empty()) return 0;
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0).norm();
}

Bounds moved(const Pose& pose, const Bounds& bounds) {
  Bounds result;
  if (bounds.empty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.extend(pose * Eigen::Vector3d((corner & 1) != 0 ? bounds.max.x() : bounds.min.x(),
                                         (corner & 2) != 0 ? bounds.max.y() : bounds.min.y(),
                                         (corner & 4) != 0 ? bounds.max.z() : bounds.min.z()));
  return result;
}

Pose placeCloud(const CloudPlace& cloud, const Georeference& model, const Bounds& model_file_m, Report& report) {
  const double as_is_m = distance_m(cloud.bounds_cloud_m, model_file_m);
  const bool model_in_map = model.map_from_file && model.map_from_file->scale > 0;
  const bool same = !cloud.crs.empty() && !model.crs.empty() && sameCrs(cloud.crs, model.crs);
  if (const auto found = findCrs(cloud.crs); !cloud.crs.empty() && found && std::abs(found->metres_per_unit - 1) > 1e-9)
    report.warn(cloud.name, fmt::format("CRS {} has a unit of {:.6g} m, which is read as metres, so the cloud is "
                                        "{:.3g} times too large: convert it to a metric CRS",
                                        shownCrs(cloud.crs), found->metres_per_unit, 1 / found->metres_per_unit));
  if (!cloud.crs.empty() && !model.crs.empty() && !same)
    report.warn(cloud.name, fmt::format("the cloud's CRS is {}, the model's is {}: coordinates are not transformed; "
                                        "convert the cloud to the model's CRS first, or specify its origin",
                                        shownCrs(cloud.crs), shownCrs(model.crs)));
  if (model_in_map) {
    Report of_map;
    const Pose by_map = poseFromMap(*model.map_from_file, cloud, of_map);
    const double by_map_m = distance_m(moved(by_map, cloud.bounds_cloud_m), model_file_m);
    if (same || (cloud.crs.empty() && as_is_m > kFarFromModel_m && by_map_m <= kFarFromModel_m)) {
      report.append(of_map);
      report.note(cloud.name, same ? "placed using the model's map conversion (same CRS)"
                                   : "placed using the model's map conversion: the cloud specifies no CRS, but this "
                                     "places it near the model");
      if (by_map_m > kFarFromModel_m)
        report.warn(cloud.name, fmt::format("the cloud is {:.1f} km from the model: check the model's map conversion, "
                                            "or specify the cloud's origin",
                                            by_map_m / 1000));
      return by_map;
    }
  }
  report.note(cloud.name, model_file_m.empty() ? "placed by its coordinates"
                                               : "placed by its coordinates in the model's file frame");
  if (as_is_m > kFarFromModel_m)
    report.warn(cloud.name, fmt::format("the cloud is {:.1f} km from the model: specify its origin, or set the model's "
                                        "map conversion and add the cloud again",
                                        as_is_m / 1000));
  return {};
}

}  // namespace standpoint
