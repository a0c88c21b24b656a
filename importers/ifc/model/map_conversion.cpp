// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/map_conversion.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "importers/files/epsg.h"
#include "importers/ifc/model/units.h"

namespace standpoint::ifc {
namespace {

constexpr std::array kUnits_m{1.0, 0.001, 0.01, 0.3048, 1200.0 / 3937.0, 0.0254, 1000.0};

bool near(double a, double b, double relative) { return std::abs(a - b) <= relative * std::abs(b); }

// The known unit that `metres` is; 0: none.
double knownUnit(double metres) {
  for (const double u : kUnits_m)
    if (near(metres, u, 1e-7)) return u;
  return 0;
}

struct MapUnit {
  double metres = 1;
  bool scale_is_unit = false;  // the scale says nothing but the ratio of the units, the wrong way round
};

MapUnit mapUnit(const StatedConversion& stated, double project_m, Report& report) {
  if (stated.map_unit_m > 0) return {stated.map_unit_m};
  const double scale = stated.scale.value_or(1);
  if (scale > 0 && scale != 1) {
    if (const double u = knownUnit(project_m / scale); u > 0) return {u};
    if (const double u = knownUnit(project_m * scale); u > 0) {
      report.warn(
          stated.place,
          fmt::format(
              "scale {} is inverted compared to the schema (map unit to project unit); map unit assumed to be {} m",
              scale, u));
      return {u, true};
    }
  }
  const EpsgAnswer known = stated.crs_digits.empty() ? EpsgAnswer() : epsgCrs(stated.crs_digits);
  if (known.crs && known.crs->projected && !near(known.crs->unit, project_m, 1e-9)) {
    // By the schema the project's unit counts; 5 400 000 m north written in a project of millimetres would be 5.4 km.
    constexpr double kFarFromEquator_m = 20000;
    if (std::abs(stated.northings) * project_m < kFarFromEquator_m &&
        std::abs(stated.northings) * known.crs->unit >= kFarFromEquator_m) {
      report.warn(stated.place,
                  fmt::format("map unit not specified; using the unit of EPSG:{} ({} m) for eastings and northings",
                              stated.crs_digits, known.crs->unit));
      return {known.crs->unit};
    }
    report.note(stated.place, "map unit not specified; using the project unit for eastings and northings");
  }
  return {project_m};
}

}  // namespace

std::optional<StatedConversion> statedConversion(const Entity& e) {
  const bool scaled = e.is("IFCMAPCONVERSIONSCALED"), rigid = e.is("IFCRIGIDOPERATION");
  if (!scaled && !rigid && !e.is("IFCMAPCONVERSION")) return {};
  if (rigid && e[2].typeName() == "IFCPLANEANGLEMEASURE") return {};
  StatedConversion c;
  c.place = e.place();
  c.eastings = e[2].number(0);
  c.northings = e[3].number(0);
  c.height = e[4].number(0);
  if (!rigid) c.abscissa = e[5].number(), c.ordinate = e[6].number(), c.scale = e[7].number();
  if (scaled) c.factors = {e[8].number(1), e[9].number(1), e[10].number(1)};
  for (std::size_t i = 2; i < 11 && c.unread.empty(); ++i)
    if (const Value v = e[i]; v.present() && !v.number()) c.unread = shown(v);
  const Entity crs = e.ref(1);
  c.map_unit_m = crs.is("IFCPROJECTEDCRS") ? siFactor(crs.ref(6)) : 0;
  c.crs_digits = epsgDigits(crs[0].text());
  return c;
}

MapConversion conversionInMetres(const StatedConversion& stated, const Model& model, Report& report) {
  const double project_m = model.units.length_m;
  const MapUnit unit = mapUnit(stated, project_m, report);
  if (!stated.unread.empty())
    report.lose(stated.place, stated.unread + " is not a finite number; the model is not where it belongs on the map");
  MapConversion c;
  c.eastings_m = stated.eastings * unit.metres;
  c.northings_m = stated.northings * unit.metres;
  c.orthogonal_height_m = stated.height * unit.metres;
  if (stated.abscissa || stated.ordinate) {
    const double x = stated.abscissa.value_or(0), y = stated.ordinate.value_or(0), length = std::hypot(x, y);
    if (length > 1e-12)
      c.x_axis_abscissa = x / length, c.x_axis_ordinate = y / length;
    else
      report.warn(stated.place, "the map conversion's x axis has zero length; no rotation assumed");
  }
  // Scale leads from project units to map units; our model is in metres. Left out, or 1 between different units, it
  // cannot mean what it says.
  const double ratio = unit.metres / project_m, scale = stated.scale.value_or(1);
  if (stated.scale && scale == 1 && ratio != 1)
    report.note(stated.place, "scale 1 between different units is treated as not specified");
  if (!(scale > 0)) report.warn(stated.place, fmt::format("invalid scale {}; using 1", scale));
  c.scale = unit.scale_is_unit || !(scale > 0) || scale == 1 ? 1 : scale * ratio;
  if (near(c.scale, 1, 1e-9)) c.scale = 1;  // a ratio of units that was written with a few digits less
  if (std::abs(c.scale - 1) > 0.01)
    report.warn(
        stated.place,
        fmt::format("scale {} from model to map is implausible for a projection; check the length unit", c.scale));
  if ((stated.factors.array() > 0).all() && stated.factors.allFinite())
    c.factors = stated.factors;
  else
    report.warn(stated.place, "a factor of the map conversion is not positive; factors ignored");
  if (c.factors.maxCoeff() > 1.01 * c.factors.minCoeff() && c.factors.x() != c.factors.y())
    report.warn(stated.place, fmt::format("the factors {} {} {} distort the model on the map", c.factors.x(),
                                          c.factors.y(), c.factors.z()));
  return c;
}

}  // namespace standpoint::ifc
