// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/georeference.h"
#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// A map conversion as the file states it, in units that still have to be found.
struct StatedConversion {
  std::string place;
  double eastings = 0, northings = 0, height = 0;
  std::optional<double> abscissa, ordinate, scale;
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
  double map_unit_m = 0;   // 0: not stated
  std::string crs_digits;  // EPSG code of its CRS, or empty
  std::string unread;      // what stands in the place of a number and is none

  bool operator==(const StatedConversion& other) const = default;
};

// IfcMapConversion, IfcMapConversionScaled, and IfcRigidOperation with lengths; nothing of others.
std::optional<StatedConversion> statedConversion(const Entity& operation);

// In metres. Eastings, northings and height are in the map's unit: MapUnit, else the unit that a scale between units
// betrays, else the project's, unless only the CRS's own unit puts the model on Earth. What was guessed is told.
MapConversion conversionInMetres(const StatedConversion& stated, const Model& model, Report& report);

}  // namespace standpoint::ifc
