// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "project/model/model_verbs.h"
#include "project/survey/underlays.h"
#include "survey/geodesy.h"

namespace standpoint {

namespace {

// Where the centre of the model, or of the clouds, is on the Earth. A model without map conversion whose CRS is named
// has map coordinates itself.
void locate(const Document& document, GeoreferenceAnswer& answer, Report& report) {
  const Bounds b = siteInFile(document);
  answer.reference_m = b.empty() ? answer.shift_m : Eigen::Vector3d(0.5 * (b.min + b.max));
  if (!answer.crs.empty()) {
    answer.map_m = answer.map_from_file ? mapFromFile(*answer.map_from_file, answer.reference_m) : answer.reference_m;
    const auto factors = geographic(answer.crs, *answer.map_m);
    if (factors) {
      const auto& position = factors->geographic;
      answer.geographic = {position.latitude_deg, position.longitude_deg, position.elevation_m, "crs"};
      answer.grid_convergence_deg = factors->grid_convergence_deg;
      answer.scale_factor = factors->scale_factor;
    } else {
      report.warn(answer.crs, factors.error().message);
    }
  }
  if (!answer.geographic && answer.site) {
    answer.geographic = {answer.site->latitude_deg, answer.site->longitude_deg, answer.site->elevation_m, "site"};
    report.note(
        "IfcSite",
        "the position comes from the site's latitude and longitude, which is often the exporter's default value");
  }
  if (!answer.geographic) return;
  const UtmPosition u = utm(answer.geographic->latitude_deg, answer.geographic->longitude_deg);
  answer.utm = {fmt::format("{}{}", u.zone, u.north ? "N" : "S"), u.easting_m, u.northing_m, u.convergence_deg,
                u.scale};
  if (!answer.grid_convergence_deg) {
    answer.grid_convergence_deg = u.convergence_deg;
    answer.scale_factor = u.scale;
  }
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

const AnswerFields<GeoreferencePlace>& answerFields(const GeoreferencePlace*) {
  using A = GeoreferencePlace;
  static const AnswerFields<A> fields = {{"latitude_deg", &A::latitude_deg},
                                         {"longitude_deg", &A::longitude_deg},
                                         {"height", &A::height_m},
                                         {"from", &A::from}};
  return fields;
}

const AnswerFields<GeoreferenceUtm>& answerFields(const GeoreferenceUtm*) {
  using A = GeoreferenceUtm;
  static const AnswerFields<A> fields = {{"zone", &A::zone},
                                         {"easting", &A::easting_m},
                                         {"northing", &A::northing_m},
                                         {"convergence_deg", &A::convergence_deg},
                                         {"scale_factor", &A::scale_factor}};
  return fields;
}

const AnswerFields<GeoreferenceAnswer>& answerFields(const GeoreferenceAnswer* answer) {
  using A = GeoreferenceAnswer;
  static const auto fields = withBases<A>({{"reference_point", &A::reference_m},
                                           {"map", &A::map_m, kLeftOut},
                                           {"geographic", &A::geographic},
                                           {"utm", &A::utm},
                                           {"grid_convergence_deg", &A::grid_convergence_deg},
                                           {"scale_factor", &A::scale_factor}},
                                          answerFields(static_cast<const Georeference*>(answer)));
  return fields;
}

Result<Answered<GeoreferenceAnswer>> runGeoreference(const Document& document, const GeoreferenceOptions& options,
                                                     Progress& progress) {
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
  Answered<GeoreferenceAnswer> outcome{document, {g}};
  locate(document, outcome.answer, outcome.report);
  if (!options.crs.empty() || options.origin || options.rotation_deg) {
    outcome.description = fmt::format("Set the georeference{}", g.crs.empty() ? "" : " to " + g.crs);
    outcome.document.georeference = std::make_shared<const Georeference>(g);
  }
  return outcome;
}

}  // namespace standpoint
