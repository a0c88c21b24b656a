// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "project/model/model_verbs.h"
#include "survey/geodesy.h"

namespace standpoint {

namespace {

using nlohmann::json;

json geographicAnswer(const GeographicPosition& g, const char* from) {
  return {
      {"latitude_deg", g.latitude_deg}, {"longitude_deg", g.longitude_deg}, {"height", g.elevation_m}, {"from", from}};
}

// Where the model's centre is on the Earth. A model without map conversion whose CRS is named has map coordinates
// itself.
Result<void> locate(const Document& document, const Georeference& g, json& answer, Report& report) {
  const Bounds b = bounds(*document.imported);
  const Eigen::Vector3d file_m =
      (b.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(0.5 * (b.min + b.max))) + g.shift_m;
  answer["reference_point"] = toJson(file_m);
  std::optional<GeographicPosition> position;
  if (!g.crs.empty()) {
    const Eigen::Vector3d map_m = g.map_from_file ? mapFromFile(*g.map_from_file, file_m) : file_m;
    answer["map"] = toJson(map_m);
    auto factors = geographic(g.crs, map_m);
    if (factors) {
      position = factors->geographic;
      answer["geographic"] = geographicAnswer(*position, "crs");
      answer["grid_convergence_deg"] = factors->grid_convergence_deg;
      answer["scale_factor"] = factors->scale_factor;
    } else {
      report.warn(g.crs, factors.error().message);
    }
  }
  if (!position && g.site) {
    position = g.site;
    answer["geographic"] = geographicAnswer(*position, "site");
    report.note(
        "IfcSite",
        "the position comes from the site's latitude and longitude, which is often the exporter's default value");
  }
  if (!position) return {};
  const UtmPosition u = utm(position->latitude_deg, position->longitude_deg);
  answer["utm"] = {{"zone", fmt::format("{}{}", u.zone, u.north ? "N" : "S")},
                   {"easting", u.easting_m},
                   {"northing", u.northing_m},
                   {"convergence_deg", u.convergence_deg},
                   {"scale_factor", u.scale}};
  if (answer["grid_convergence_deg"].is_null()) {
    answer["grid_convergence_deg"] = u.convergence_deg;
    answer["scale_factor"] = u.scale;
  }
  return {};
}

}  // namespace

const Fields<GeoreferenceOptions>& georeferenceFields() {
  using O = GeoreferenceOptions;
  static const Fields<O> fields = {{"crs", &O::crs, "coordinate reference system, as EPSG:n"},
                                   {"origin", &O::origin, "map coordinates E,N,H of the model's origin", {.unit = "m"}},
                                   {"rotation-deg",
                                    &O::rotation_deg,
                                    "angle from map east to the model's X axis, counter-clockwise",
                                    {.unit = "deg", .minimum = -360, .maximum = 360}}};
  return fields;
}

Result<Outcome> runGeoreference(const Document& document, const GeoreferenceOptions& options, Progress& progress) {
  progress.stage("Georeference");
  Georeference g = *document.georeference;
  if (!options.crs.empty()) {
    TRY_ASSIGN(auto found, findCrs(options.crs));
    g.crs = found.code;
  }
  if (options.origin) {
    MapConversion c = g.map_from_file.value_or(MapConversion{});
    c.eastings_m = options.origin->x();
    c.northings_m = options.origin->y();
    c.orthogonal_height_m = options.origin->z();
    g.map_from_file = c;
  }
  if (options.rotation_deg) {
    MapConversion c = g.map_from_file.value_or(MapConversion{});
    const double angle = *options.rotation_deg * kRadPerDeg;
    c.x_axis_abscissa = std::cos(angle);
    c.x_axis_ordinate = std::sin(angle);
    g.map_from_file = c;
  }
  Outcome outcome{document, georeferenceToJson(g), {}, {}};
  for (const char* key : {"geographic", "utm", "grid_convergence_deg", "scale_factor"}) outcome.answer[key] = nullptr;
  TRY(locate(document, g, outcome.answer, outcome.report));
  if (!options.crs.empty() || options.origin || options.rotation_deg) {
    outcome.description = fmt::format("Set the georeference{}", g.crs.empty() ? "" : " to " + g.crs);
    outcome.document.georeference = std::make_shared<const Georeference>(g);
  }
  return outcome;
}

}  // namespace standpoint
