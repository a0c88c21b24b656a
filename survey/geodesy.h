// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/georeference.h"
#include "core/result.h"

namespace standpoint {

struct CoordinateReferenceSystem {
  std::string code;  // "EPSG:25832"
  std::string name;  // "ETRS89 / UTM zone 32N"
  std::string wkt;   // WKT2:2019, for the files that carry one
  bool projected = false;
  double metres_per_unit = 1;  // of the eastings and northings
};

// By code ("EPSG:25832", or just "25832") or WKT, through PROJ. Unknown: an error of kind usage that says what to
// write.
Result<CoordinateReferenceSystem> findCrs(const std::string& code);

struct UtmPosition {
  int zone = 0;
  bool north = true;
  double easting_m = 0, northing_m = 0;
  double convergence_deg = 0;  // bearing of grid north from true north, clockwise
  double scale = 1;
};
UtmPosition utm(double latitude_deg, double longitude_deg);  // GeographicLib (Karney 2011)

struct MapFactors {
  GeographicPosition geographic;
  double grid_convergence_deg = 0;  // of the CRS, same sense as UtmPosition's
  double scale_factor = 1;          // of the projection at the point
};
// From map coordinates (easting, northing, height) of a projected CRS to WGS84, through PROJ.
Result<MapFactors> geographic(const std::string& crs, const Eigen::Vector3d& map_m);

// Between WGS84 and a projected CRS, for many points of one thread. Heights are not touched.
class MapProjection {
 public:
  static Result<MapProjection> of(const std::string& crs);
  MapProjection(MapProjection&&) noexcept;
  ~MapProjection();

  struct Geographic {
    double latitude_rad = 0, longitude_rad = 0;
  };
  // Eastings and northings in metres; an error of kind unusable outside the area of use.
  Result<Eigen::Vector2d> map(const Geographic& geographic) const;
  Result<Geographic> geographic(const Eigen::Vector2d& map_m) const;
  // The direction of true north there: counter-clockwise from east in the map, so π/2 where grid north is true.
  Result<double> northDirection_rad(const Geographic& geographic) const;

 private:
  struct Transformation;
  explicit MapProjection(std::unique_ptr<Transformation> transformation);
  std::unique_ptr<Transformation> transformation_;
};

}  // namespace standpoint
