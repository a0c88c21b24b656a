// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>

#include "tests/importers/mesh_files.h"

namespace standpoint::test {

inline constexpr const char* kGmlHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
 xmlns:gen="http://www.opengis.net/citygml/generics/2.0" xmlns:dem="http://www.opengis.net/citygml/relief/2.0"
 xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0"
 xmlns:app="http://www.opengis.net/citygml/appearance/2.0" xmlns:gml="http://www.opengis.net/gml"
 xmlns:xlink="http://www.w3.org/1999/xlink">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783" srsDimension="3">
<gml:lowerCorner>500000 5400000 100</gml:lowerCorner><gml:upperCorner>500010 5400006 103</gml:upperCorner>
</gml:Envelope></gml:boundedBy>
)";

inline std::string gmlPolygon(const std::string& id, const std::string& outer, const std::string& inner = {}) {
  const auto ring = [](const std::string& name, const std::string& list) {
    return "<gml:" + name + "><gml:LinearRing><gml:posList>" + list + "</gml:posList></gml:LinearRing></gml:" + name +
           ">";
  };
  return "<gml:surfaceMember><gml:Polygon gml:id=\"" + id + "\">" + ring("exterior", outer) +
         (inner.empty() ? "" : ring("interior", inner)) + "</gml:Polygon></gml:surfaceMember>";
}

inline std::string gmlSurface(const std::string& type, const std::string& members, const std::string& inside = {}) {
  return "<bldg:boundedBy><bldg:" + type + "><bldg:lod2MultiSurface><gml:MultiSurface>" + members +
         "</gml:MultiSurface></bldg:lod2MultiSurface>" + inside + "</bldg:" + type + "></bldg:boundedBy>";
}

inline std::string gmlReference(const std::string& id) { return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>"; }

// The other side of a polygon: of a baseSurface element.
inline std::string gmlTurned(const std::string& base_surface) {
  return "<gml:OrientableSurface orientation=\"-\">" + base_surface + "</gml:OrientableSurface>";
}

inline std::string gmlSolid(const std::string& members) {
  return "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
}

inline std::string gmlBuilding(const std::string& inside) {
  return kGmlHead + ("<core:cityObjectMember><bldg:Building gml:id=\"b1\"><gml:name>House &amp; Höfe</gml:name>"
                     "<gen:stringAttribute name=\"owner\"><gen:value>town</gen:value></gen:stringAttribute>"
                     "<bldg:measuredHeight uom=\"m\">3.0</bldg:measuredHeight>" +
                     inside + "</bldg:Building></core:cityObjectMember></core:CityModel>\n");
}

inline Result<ImportedModel> cityGml(const std::string& text, const ImportOptions& options = {}) {
  return import(write(scratch() / "a.gml", text), options);
}
inline std::string refusedCityGml(const std::string& text) { return refusal(write(scratch() / "a.gml", text)); }

inline const Product& ofClass(const ImportedModel& model, const std::string& ifc_class) {
  const auto& all = model.environment.products;
  const auto it = std::find_if(all.begin(), all.end(), [&](const Product& p) { return p.ifc_class == ifc_class; });
  if (it != all.end()) return *it;
  ADD_FAILURE() << "there is no " << ifc_class;
  static const Product kNothing;
  return kNothing;
}

inline double areaOfClass(const ImportedModel& model, const std::string& ifc_class) {
  double sum = 0;
  for (const auto& i : model.environment.instances)
    if (model.environment.products[i.product].ifc_class == ifc_class) sum += area(*model.environment.meshes[i.mesh]);
  return sum;
}

inline std::string toldBy(const ImportedModel& model) {
  std::string all;
  for (const auto& i : model.report.issues)
    all += std::string(name(i.severity)) + " " + i.source + ": " + i.message + "\n";
  return all;
}

}  // namespace standpoint::test
