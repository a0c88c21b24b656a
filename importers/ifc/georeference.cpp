// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/georeference.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

#include "importers/ifc/placement.h"
#include "importers/ifc/properties.h"
#include "importers/ifc/units.h"

namespace standpoint::ifc {
namespace {

// "EPSG:25832" of "epsg: 25832", "25832" and "urn:ogc:def:crs:EPSG::25832"; other names stay as they are.
std::string crsName(std::string name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::size_t digits = upper.find_last_not_of("0123456789") + 1;
  const bool bare = digits == 0, named = upper.find("EPSG") != std::string::npos;
  if (digits < upper.size() && (bare || named)) return "EPSG:" + upper.substr(digits);
  return name;
}

// Degrees, minutes, seconds and millionths of a second, each with the sign (IfcCompoundPlaneAngleMeasure).
std::optional<double> compoundAngle(const Value& list) {
  constexpr double kParts[] = {1, 60, 3600, 3600e6};
  if (list.size() < 3) return {};
  double degrees = 0;
  int i = 0;
  for (const Value v : list)
    if (i < 4) degrees += v.number(0) / kParts[i++];
  return std::isfinite(degrees) ? std::optional(degrees) : std::nullopt;
}

void readSite(Georeference& geo, const Model& model) {
  for (const Entity& site : model.file.all("IFCSITE")) {
    const auto latitude = compoundAngle(site[9]), longitude = compoundAngle(site[10]);
    if (!latitude || !longitude || std::abs(*latitude) > 90 || std::abs(*longitude) > 360) continue;
    geo.site = GeographicPosition{*latitude, *longitude, site[11].number(0) * model.units.length_m};
    return;
  }
}

void readTrueNorth(Georeference& geo, const Model& model) {
  for (const Entity& context : model.file.all("IFCGEOMETRICREPRESENTATIONCONTEXT")) {
    const Entity north = context.ref(5);
    if (!north) continue;
    const Eigen::Vector3d d = direction(north, Eigen::Vector3d::UnitY());
    geo.true_north_rad = std::atan2(d.x(), d.y());
    if (context[1].text() == "Model") return;
  }
}

void readMapConversion(Georeference& geo, const Model& model, Report& report) {
  std::vector<Entity> conversions = model.file.all("IFCMAPCONVERSION");
  for (const Entity& e : model.file.all("IFCMAPCONVERSIONSCALED")) conversions.push_back(e);
  for (const Entity& e : conversions) {
    const Entity crs = e.ref(1);
    // Eastings, northings and height are in the CRS's own unit where it states one, and Scale leads from project units to those.
    const double stated = crs.is("IFCPROJECTEDCRS") ? siFactor(crs.ref(6)) : 0;
    const double map_unit = stated > 0 ? stated : model.units.length_m;
    MapConversion c;
    c.eastings_m = e[2].number(0) * map_unit;
    c.northings_m = e[3].number(0) * map_unit;
    c.orthogonal_height_m = e[4].number(0) * map_unit;
    if (e[5].present() || e[6].present()) c.x_axis_abscissa = e[5].number(0), c.x_axis_ordinate = e[6].number(0);
    const double length = std::hypot(c.x_axis_abscissa, c.x_axis_ordinate);
    if (!(length > 1e-12)) c.x_axis_abscissa = 1, c.x_axis_ordinate = 0, report.warn(e.place(), "the map conversion's x axis has no direction; no rotation is assumed");
    else c.x_axis_abscissa /= length, c.x_axis_ordinate /= length;
    c.scale = e[7].number(0);
    // Scale leads from project units to map units. Left out, or 1 between different units, it cannot mean what it says.
    const double ratio = map_unit / model.units.length_m;
    if (c.scale == 1 && ratio != 1) report.note(e.place(), "a scale of 1 between different units is taken as: no scale");
    c.scale = c.scale > 0 && !(c.scale == 1 && ratio != 1) ? c.scale * ratio : 1;
    geo.map_from_file = c;
    if (geo.crs.empty()) geo.crs = crsName(crs[0].text());
    return;
  }
}

std::optional<double> firstNumber(const std::string& text) {
  double x = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), x);
  return error == std::errc() && std::isfinite(x) ? std::optional(x) : std::nullopt;
}

// IFC2X3 has no entity for it; buildingSMART's convention is two property sets on the site (or project or building).
void readPropertySets(Georeference& geo, const Model& model, const Relations& relations) {
  MapConversion c;
  bool found = false;
  for (const char* kind : {"IFCSITE", "IFCPROJECT", "IFCBUILDING"})
    for (const Entity& object : model.file.all(kind))
      for (const Id id : relations.propertySetsOf(object)) {
        std::vector<Property> properties;
        appendProperties(properties, model.file.entity(id), model);
        for (const Property& p : properties) {
          std::string set = p.set;
          std::transform(set.begin(), set.end(), set.begin(), [](unsigned char ch) { return static_cast<char>(std::tolower(ch)); });
          if (set == "epset_projectedcrs" && p.name == "Name" && geo.crs.empty()) geo.crs = crsName(p.value);
          const auto x = firstNumber(p.value);
          if (set != "epset_mapconversion" || !x) continue;
          found = true;
          if (p.name == "Eastings") c.eastings_m = *x;
          else if (p.name == "Northings") c.northings_m = *x;
          else if (p.name == "OrthogonalHeight") c.orthogonal_height_m = *x;
          else if (p.name == "XAxisAbscissa") c.x_axis_abscissa = *x;
          else if (p.name == "XAxisOrdinate") c.x_axis_ordinate = *x;
          else if (p.name == "Scale" && *x > 0) c.scale = *x;
        }
      }
  if (found) geo.map_from_file = c;
}

}  // namespace

Georeference readGeoreference(const Model& model, const Relations& relations, Report& report) {
  Georeference geo;
  readSite(geo, model);
  readTrueNorth(geo, model);
  readMapConversion(geo, model, report);
  if (!geo.map_from_file) readPropertySets(geo, model, relations);
  if (geo.crs.empty())
    for (const char* kind : {"IFCPROJECTEDCRS", "IFCGEOGRAPHICCRS"})
      for (const Entity& crs : model.file.all(kind))
        if (geo.crs.empty()) geo.crs = crsName(crs[0].text());
  if (!model.file.all("IFCRIGIDOPERATION").empty()) report.warn(model.file.all("IFCRIGIDOPERATION")[0].place(), "IfcRigidOperation is not read; the model's place on the map is unknown");
  return geo;
}

}  // namespace standpoint::ifc
