// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/georeference.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "importers/files/epsg.h"
#include "importers/ifc/model/map_conversion.h"
#include "importers/ifc/model/units.h"
#include "importers/ifc/properties.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// "EPSG:25832" of "epsg: 25832", "25832" and "urn:ogc:def:crs:EPSG::25832"; other names stay as they are.
std::string crsName(const std::string& name) {
  const std::string digits = epsgDigits(name);
  return digits.empty() ? name : "EPSG:" + digits;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
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

void readSite(Georeference& geo, const Model& model, Report& report) {
  for (const Entity& site : model.file.all("IFCSITE")) {
    const auto latitude = compoundAngle(site[9]), longitude = compoundAngle(site[10]);
    if (!latitude || !longitude) continue;
    if (std::abs(*latitude) > 90 || std::abs(*longitude) > 360) {
      report.warn(site.place(), fmt::format("the site's latitude {} and longitude {} are out of range and were ignored",
                                            *latitude, *longitude));
      continue;
    }
    geo.site = GeographicPosition{*latitude, *longitude, site[11].number(0) * model.units.length_m};
    return;
  }
}

void readTrueNorth(Georeference& geo, const Model& model) {
  for (const Entity& context : model.file.all("IFCGEOMETRICREPRESENTATIONCONTEXT")) {
    const Entity north = context.ref(5);
    if (!north) continue;
    Scope scope(model);
    const Eigen::Vector3d d = direction(north, Eigen::Vector3d::UnitY(), scope);
    geo.true_north_rad = std::atan2(d.x(), d.y());
    if (context[1].text() == "Model") return;
  }
}

// The code at the end of a WKT is the whole CRS's: ID["EPSG",25832]] or AUTHORITY["EPSG","25832"]].
std::string crsOfWkt(const std::string& wkt) {
  const std::size_t at = std::max(wkt.rfind("ID[\"EPSG\"") + 1, wkt.rfind("AUTHORITY[\"EPSG\"") + 1);  // not found: 0
  if (at == 0) return wkt;
  const std::size_t first = wkt.find_first_of("0123456789", at), end = wkt.find_first_not_of("0123456789", first);
  return first == std::string::npos ? wkt : "EPSG:" + wkt.substr(first, end - first);
}

void checkDatum(const Entity& crs, std::size_t index, const char* what, Report& report) {
  const std::string name = crs[index].text();
  if (!lower(name).starts_with("epsg")) return;
  const std::string digits = epsgDigits(name);
  if (digits.empty() || !isEpsgReference(digits, index == 3))
    report.warn(crs.place(), fmt::format("{} '{}' is not in the EPSG dataset", what, name));
}

// A CRS that has no usable name gives coordinates that nobody can place: its fault is named.
void readCrs(Georeference& geo, const Entity& crs, const Model& model, Report& report) {
  const std::string name = crs[0].text(), digits = epsgDigits(name);
  const bool projected = crs.is("IFCPROJECTEDCRS");
  std::string wkt;
  for (const Entity& text : model.file.all("IFCWELLKNOWNTEXT"))
    if (text.ref(1) == crs) wkt = text[0].text();
  if (geo.crs.empty()) geo.crs = !digits.empty() || wkt.empty() ? crsName(name) : crsOfWkt(wkt);
  const char* remedy = "; specify it by its EPSG code";
  if (name.empty() && wkt.empty())
    report.warn(crs.place(),
                std::string("the coordinate reference system has no name; an EPSG code is required") + remedy);
  else if (digits.empty() && lower(name).starts_with("epsg"))
    report.warn(crs.place(), "'" + name + "' is not an EPSG code" + remedy);
  else if (digits.empty() && wkt.empty())
    report.warn(crs.place(), "'" + name + "' is not an EPSG code; unknown coordinate reference system" + remedy);
  if (!digits.empty()) {
    const EpsgAnswer known = epsgCrs(digits);
    if (known.asked && !known.crs)
      report.warn(crs.place(), "EPSG:" + digits + " is not a coordinate reference system in the EPSG dataset" + remedy);
    else if (known.crs && projected && !known.crs->projected)
      report.warn(crs.place(), "EPSG:" + digits + " is not a projected coordinate reference system" + remedy);
  }
  checkDatum(crs, 2, "geodetic datum", report);
  if (projected) checkDatum(crs, 3, "vertical datum", report);
}

std::vector<Entity> operations(const StepFile& file) {
  std::vector<Entity> all;
  for (const char* kind : {"IFCMAPCONVERSION", "IFCMAPCONVERSIONSCALED", "IFCRIGIDOPERATION"})
    for (const Entity& e : file.all(kind)) all.push_back(e);
  return all;
}

// All contexts of the model have to say the same: which one a product's shape is in must not move it on the map.
void checkContexts(const std::vector<Entity>& operations, const Model& model, Report& report) {
  const auto same = [](const Entity& a, const Entity& b) {
    for (std::size_t i = 1; i < 11; ++i)
      if (a[i].inner().raw() != b[i].inner().raw()) return false;
    return a.typeName() == b.typeName();
  };
  for (const Entity& e : operations)
    if (!same(e, operations[0]))
      report.warn(e.place(), "conflicts with the map position from " + operations[0].place() + "; the latter is used");
  for (const Entity& context : model.file.all("IFCGEOMETRICREPRESENTATIONCONTEXT")) {
    if (context[1].text() != "Model") continue;
    if (std::none_of(operations.begin(), operations.end(),
                     [&](const Entity& e) { return e.ref(0) == context || e.ref(0).is("IFCPROJECT"); }))
      report.warn(context.place(), "the context has no map position, but " + operations[0].ref(0).place() +
                                       " has one; it is used for both");
  }
}

void checkRigid(const Entity& e, Report& report) {
  const std::string first(e[2].typeName()), second(e[3].typeName());
  const auto fine = [](const std::string& t) { return t == "IFCLENGTHMEASURE" || t == "IFCPLANEANGLEMEASURE"; };
  if (first == second && fine(first)) return;
  report.warn(
      e.place(),
      fmt::format(
          "the first coordinate is {}, the second {}; both must be IFCLENGTHMEASURE or both IFCPLANEANGLEMEASURE",
          first, second));
}

// Of a geographic CRS: longitude first, as buildingSMART's own example writes it, unless only the other way is on
// Earth.
void readGeographicRigid(Georeference& geo, const Entity& e, const Model& model, Report& report) {
  const double stated = e.ref(1).is("IFCGEOGRAPHICCRS") ? siFactor(e.ref(1).ref(4)) : 0;
  const double degrees = (stated > 0 ? stated : model.units.angle_rad) / kRadPerDeg;
  double longitude = e[2].number(0) * degrees, latitude = e[3].number(0) * degrees;
  if (std::abs(latitude) > 90) std::swap(latitude, longitude);
  if (std::abs(latitude) > 90 || std::abs(longitude) > 360)
    return report.warn(e.place(), "the coordinates are out of range and were ignored");
  geo.site = GeographicPosition{latitude, longitude, e[4].number(0) * model.units.length_m};
  report.note(e.place(), fmt::format("origin set to latitude {:.6f}° and longitude {:.6f}°", latitude, longitude));
}

void readOperations(Georeference& geo, const Model& model, Report& report) {
  const std::vector<Entity> all = operations(model.file);
  if (all.empty()) return;
  checkContexts(all, model, report);
  for (const Entity& e : all)
    if (e.is("IFCRIGIDOPERATION")) checkRigid(e, report);
  if (const auto stated = statedConversion(all[0]))
    geo.map_from_file = conversionInMetres(*stated, model, report);
  else
    readGeographicRigid(geo, all[0], model, report);
  if (const Entity crs = all[0].ref(1))
    readCrs(geo, crs, model, report);
  else
    report.warn(all[0].place(), "the map conversion has no coordinate reference system; specify it by its EPSG code");
}

// Some exporters write the place into the world coordinate system of the context.
void readWorldCoordinates(Georeference& geo, const Model& model, Report& report) {
  constexpr double kFar_m = 1000;
  for (const Entity& context : model.file.all("IFCGEOMETRICREPRESENTATIONCONTEXT")) {
    if (context[1].text() != "Model" || !context.ref(4).is("IFCAXIS2PLACEMENT3D")) continue;
    Scope scope(model);
    const Eigen::Isometry3d world = axisPlacement(context.ref(4), scope);
    const Eigen::Vector3d at = world.translation();
    if (at.norm() < 1e-6 && world.linear().isIdentity(1e-9)) continue;
    const bool upright = world.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-6);
    if (geo.map_from_file || !upright || at.head<2>().norm() < kFar_m)
      return report.note(
          context.place(),
          fmt::format("the world coordinate system at {:.3f} {:.3f} {:.3f} m was not applied", at.x(), at.y(), at.z()));
    geo.map_from_file = MapConversion{at.x(), at.y(), at.z(), world.linear()(0, 0), world.linear()(1, 0), 1};
    return report.warn(context.place(),
                       "the world coordinate system is used as map position; specify the coordinate reference system "
                       "by its EPSG code");
  }
}

std::optional<double> firstNumber(const std::string& text) {
  double x = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), x);
  return error == std::errc() && std::isfinite(x) ? std::optional(x) : std::nullopt;
}

// "METRE", "MILLIMETRE", "US SURVEY FOOT" …; 0: unknown.
double unitByName(const std::string& name) {
  std::string word = lower(name);
  word.erase(std::remove_if(word.begin(), word.end(), [](char c) { return c == ' ' || c == '_' || c == '-'; }),
             word.end());
  constexpr std::pair<const char*, double> kNames[] = {{"metre", 1},
                                                       {"meter", 1},
                                                       {"m", 1},
                                                       {"millimetre", 0.001},
                                                       {"millimeter", 0.001},
                                                       {"mm", 0.001},
                                                       {"centimetre", 0.01},
                                                       {"cm", 0.01},
                                                       {"foot", 0.3048},
                                                       {"feet", 0.3048},
                                                       {"ft", 0.3048},
                                                       {"ussurveyfoot", 1200.0 / 3937.0},
                                                       {"usft", 1200.0 / 3937.0},
                                                       {"ftus", 1200.0 / 3937.0}};
  for (const auto& [known, metres] : kNames)
    if (word == known) return metres;
  return 0;
}

struct ConventionSets {
  StatedConversion conversion;
  bool found = false;
  std::string crs;

  void take(const Property& p, const std::string& set) {
    const std::string name = lower(p.name);
    if (set == "epset_projectedcrs") {
      if (name == "name") crs = p.value;
      if (name == "mapunit") conversion.map_unit_m = unitByName(p.value);
      return;
    }
    const auto x = firstNumber(p.value);
    if (!x) return;
    found = true;
    if (name == "eastings")
      conversion.eastings = *x;
    else if (name == "northings")
      conversion.northings = *x;
    else if (name == "orthogonalheight")
      conversion.height = *x;
    else if (name == "xaxisabscissa")
      conversion.abscissa = *x;
    else if (name == "xaxisordinate")
      conversion.ordinate = *x;
    else if (name == "scale")
      conversion.scale = *x;
  }
};

// IFC2X3 has no entity for it; buildingSMART's convention is two property sets on the site (or project or building),
// whose numbers are metres where they state no other map unit.
void readPropertySets(Georeference& geo, const Model& model, const Relations& relations, Report& report) {
  ConventionSets sets;
  for (const char* kind : {"IFCSITE", "IFCPROJECT", "IFCBUILDING"})
    for (const Entity& object : model.file.all(kind))
      for (const Id id : relations.propertySetsOf(object)) {
        const Entity set = model.file.entity(id);
        const std::string name = lower(set[2].text());
        if (name != "epset_mapconversion" && name != "epset_projectedcrs") continue;
        if (sets.conversion.place.empty()) sets.conversion.place = set.place();
        std::vector<Property> properties;
        appendProperties(properties, set, model);
        for (const Property& p : properties) sets.take(p, name);
      }
  if (sets.conversion.map_unit_m <= 0) sets.conversion.map_unit_m = 1;
  sets.conversion.crs_digits = epsgDigits(sets.crs);
  if (geo.crs.empty()) geo.crs = crsName(sets.crs);
  if (!sets.found) return;
  geo.map_from_file = conversionInMetres(sets.conversion, model, report);
  if (geo.crs.empty())
    report.warn(sets.conversion.place,
                "the map conversion has no coordinate reference system; specify it by its EPSG code");
}

}  // namespace

Georeference readGeoreference(const Model& model, const Relations& relations, Report& report) {
  Georeference geo;
  readSite(geo, model, report);
  readTrueNorth(geo, model);
  readOperations(geo, model, report);
  if (!geo.map_from_file) readPropertySets(geo, model, relations, report);
  if (geo.crs.empty() && operations(model.file).empty())
    for (const char* kind : {"IFCPROJECTEDCRS", "IFCGEOGRAPHICCRS"})
      for (const Entity& crs : model.file.all(kind))
        if (geo.crs.empty()) readCrs(geo, crs, model, report);
  readWorldCoordinates(geo, model, report);
  return geo;
}

}  // namespace standpoint::ifc
