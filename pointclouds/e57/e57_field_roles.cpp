// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_field_roles.h"

#include "pointclouds/e57/e57_labels.h"
#include "pointclouds/files/block_check.h"

namespace standpoint::e57 {

Roles rolesOf(const std::vector<StoredField>& fields, const ScanPlan& plan) {
  const auto at = [&](std::string_view name) { return fieldNamed(fields, name); };
  const ScanHeader& header = plan.header;
  Roles r{.x = at("cartesianX"), .y = at("cartesianY"), .z = at("cartesianZ")};
  r.spherical = !(r.x && r.y && r.z);
  if (r.spherical) r.x = at("sphericalRange"), r.y = at("sphericalAzimuth"), r.z = at("sphericalElevation");
  r.intensity = at("intensity");
  if (header.has_colour) {
    r.colour[0] = at("colorRed"), r.colour[1] = at("colorGreen"), r.colour[2] = at("colorBlue");
    r.colour_invalid = at("isColorInvalid");
  }
  if (hasGrid(header)) r.row = at("rowIndex"), r.column = at("columnIndex");
  if (header.has_labels) r.product = at(plan.prefix + "product"), r.material = at(plan.prefix + "material");
  if (header.has_time) r.time = at("timeStamp"), r.time_invalid = at("isTimeStampInvalid");
  if (header.has_channel) r.channel = at(plan.prefix + kChannelField);
  if (header.has_returns) r.return_index = at("returnIndex"), r.return_count = at("returnCount");
  if (header.has_truth)
    for (std::size_t i = 0; i < kTruthFields.size(); ++i) r.truth[i] = at(plan.prefix + kTruthFields[i]);
  (r.spherical ? r.spherical_state : r.cartesian_state) =
      at(r.spherical ? "sphericalInvalidState" : "cartesianInvalidState");
  r.intensity_invalid = at("isIntensityInvalid");
  return r;
}

}  // namespace standpoint::e57
