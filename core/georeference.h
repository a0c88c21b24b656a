// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

namespace standpoint {

// IfcMapConversion: map = scale · R(θ) · diag(factors) · file + (E, N, H), θ = atan2(ordinate, abscissa); all in
// metres.
struct MapConversion {
  double eastings_m = 0;
  double northings_m = 0;
  double orthogonal_height_m = 0;
  double x_axis_abscissa = 1;
  double x_axis_ordinate = 0;
  double scale = 1;
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();  // IfcMapConversionScaled: of each axis of the file, positive
};

// WGS84, degrees as in the file (this is an edge), metres above whatever the file means.
struct GeographicPosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double elevation_m = 0;
};

// Three frames. `local`: what we compute in, small enough for float. `file`: the model's own frame, metres, Z up:
// file = local + shift_m, and every shift component is a whole number of metres up to 2^53, so the sum loses nothing
// that the double in the file had. `map`: the projected CRS, through map_from_file where the model states it.
struct Georeference {
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  std::optional<MapConversion> map_from_file;
  std::string crs;                         // "EPSG:25832", or what the file calls it; empty when unknown
  std::optional<GeographicPosition> site;  // IfcSite: often only the exporter's default city
  std::optional<double> true_north_rad;    // clockwise from +Y of the file frame to geographic north
};

Eigen::Vector3d mapFromFile(const MapConversion& conversion, const Eigen::Vector3d& file_m);
Eigen::Vector3d fileFromMap(const MapConversion& conversion, const Eigen::Vector3d& map_m);

}  // namespace standpoint
