// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kGmlHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
 xmlns:gen="http://www.opengis.net/citygml/generics/2.0" xmlns:dem="http://www.opengis.net/citygml/relief/2.0"
 xmlns:app="http://www.opengis.net/citygml/appearance/2.0" xmlns:gml="http://www.opengis.net/gml"
 xmlns:xlink="http://www.w3.org/1999/xlink">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783" srsDimension="3">
<gml:lowerCorner>500000 5400000 100</gml:lowerCorner><gml:upperCorner>500010 5400006 103</gml:upperCorner>
</gml:Envelope></gml:boundedBy>
)";

std::string gmlPolygon(const std::string& id, const std::string& outer, const std::string& inner = {}) {
  const auto ring = [](const std::string& name, const std::string& list) {
    return "<gml:" + name + "><gml:LinearRing><gml:posList>" + list + "</gml:posList></gml:LinearRing></gml:" + name +
           ">";
  };
  return "<gml:surfaceMember><gml:Polygon gml:id=\"" + id + "\">" + ring("exterior", outer) +
         (inner.empty() ? "" : ring("interior", inner)) + "</gml:Polygon></gml:surfaceMember>";
}

std::string gmlSurface(const std::string& type, const std::string& members, const std::string& inside = {}) {
  return "<bldg:boundedBy><bldg:" + type + "><bldg:lod2MultiSurface><gml:MultiSurface>" + members +
         "</gml:MultiSurface></bldg:lod2MultiSurface>" + inside + "</bldg:" + type + "></bldg:boundedBy>";
}

std::string gmlReference(const std::string& id) { return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>"; }

std::string gmlSolid(const std::string& members) {
  return "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
}

std::string gmlBuilding(const std::string& inside) {
  return kGmlHead + ("<core:cityObjectMember><bldg:Building gml:id=\"b1\"><gml:name>House &amp; Höfe</gml:name>"
                     "<gen:stringAttribute name=\"owner\"><gen:value>town</gen:value></gen:stringAttribute>"
                     "<bldg:measuredHeight uom=\"m\">3.0</bldg:measuredHeight>" +
                     inside + "</bldg:Building></core:cityObjectMember></core:CityModel>\n");
}

const std::string kGround =
    "500000 5400000 100 500000 5400006 100 500010 5400006 100 500010 5400000 100 500000 5400000 100";
const std::string kRoof =
    "500000 5400000 103 500010 5400000 103 500010 5400006 103 500000 5400006 103 500000 5400000 103";
const std::string kFront =
    "500000 5400000 100 500010 5400000 100 500010 5400000 103 500000 5400000 103 500000 5400000 100";
const std::string kHole =
    "500004 5400000 101 500004 5400000 102 500006 5400000 102 500006 5400000 101 500004 5400000 101";
const std::string kPane =
    "500004 5400000 101 500006 5400000 101 500006 5400000 102 500004 5400000 102 500004 5400000 101";

// The surfaces have the polygons, the solid refers to them; the front has a window in its hole.
std::string houseOfGml() {
  const std::string window = "<bldg:opening><bldg:Window><bldg:lod3MultiSurface><gml:MultiSurface>" +
                             gmlPolygon("pane", kPane) +
                             "</gml:MultiSurface></bldg:lod3MultiSurface></bldg:Window></bldg:opening>";
  std::string all = gmlBuilding(gmlSolid(gmlReference("g") + gmlReference("r") + gmlReference("f")) +
                                gmlSurface("GroundSurface", gmlPolygon("g", kGround)) +
                                gmlSurface("RoofSurface", gmlPolygon("r", kRoof)) +
                                gmlSurface("WallSurface", gmlPolygon("f", kFront, kHole), window));
  for (auto at = all.find("lod2"); at != std::string::npos; at = all.find("lod2", at)) all.replace(at, 4, "lod3");
  return all;
}

Result<ImportedModel> cityGml(const std::string& text, const ImportOptions& options = {}) {
  return import(write(scratch() / "a.gml", text), options);
}
std::string refusedCityGml(const std::string& text) { return refusal(write(scratch() / "a.gml", text)); }

const Product& ofClass(const ImportedModel& model, const std::string& ifc_class) {
  const auto& all = model.environment.products;
  const auto it = std::find_if(all.begin(), all.end(), [&](const Product& p) { return p.ifc_class == ifc_class; });
  if (it != all.end()) return *it;
  ADD_FAILURE() << "there is no " << ifc_class;
  static const Product kNothing;
  return kNothing;
}

double areaOfClass(const ImportedModel& model, const std::string& ifc_class) {
  double sum = 0;
  for (const auto& i : model.environment.instances)
    if (model.environment.products[i.product].ifc_class == ifc_class) sum += area(*model.environment.meshes[i.mesh]);
  return sum;
}

std::string toldBy(const ImportedModel& model) {
  std::string all;
  for (const auto& i : model.report.issues)
    all += std::string(name(i.severity)) + " " + i.source + ": " + i.message + "\n";
  return all;
}

TEST(CityGml, HasEachSurfaceOfASolidOnceWithItsMeaning) {
  const auto model = cityGml(houseOfGml());
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.size(), 4U);
  EXPECT_NEAR(areaOfClass(*model, "IfcWindow"), 2, 1e-3);
  EXPECT_NEAR(areaOfClass(*model, "IfcSlab"), 60, 1e-3);
  EXPECT_NEAR(areaOfClass(*model, "IfcRoof"), 60, 1e-3);
  EXPECT_NEAR(areaOfClass(*model, "IfcWall"), 28, 1e-3);
  EXPECT_EQ(model->georeference.crs, "EPSG:25832");
  const Bounds box = bounds(model->environment);
  EXPECT_EQ(box.min + model->georeference.shift_m, Eigen::Vector3d(500000, 5400000, 100));
  ASSERT_EQ(model->environment.spatial.size(), 2U);
  const SpatialNode& place = model->environment.spatial[1];
  EXPECT_EQ(place.ifc_class, "IfcBuilding");
  EXPECT_EQ(place.name, "House & Höfe");
  std::string properties;
  for (const Property& p : place.properties) properties += p.name + "=" + p.value + " ";
  EXPECT_EQ(properties, "type=Building owner=town measuredHeight=3.0 ");
}

TEST(CityGml, GivesASurfaceThePolygonsOfASolidThatItRefersTo) {
  const auto model =
      cityGml(gmlBuilding(gmlSolid(gmlPolygon("g", kGround) + gmlPolygon("r", kRoof) + gmlPolygon("f", kFront)) +
                          gmlSurface("RoofSurface", gmlReference("r"))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_NEAR(areaOfClass(*model, "IfcRoof"), 60, 1e-3);
  EXPECT_EQ(ofClass(*model, "IfcRoof").properties.at(0).value, "RoofSurface");
}

TEST(CityGml, TakesTheHighestLevelOfDetail) {
  std::string low = gmlSolid(gmlPolygon("x", kGround));
  for (auto at = low.find("lod2"); at != std::string::npos; at = low.find("lod2", at)) low.replace(at, 4, "lod1");
  const auto model = cityGml(gmlBuilding(low + gmlSurface("RoofSurface", gmlPolygon("r", kRoof))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.size(), 1U);
  EXPECT_THAT(toldBy(*model), HasSubstr("polygons of lower levels of detail left out for higher ones: 1"));
}

TEST(CityGml, ReadsTerrainAndTheCoordinatesOfOlderFiles) {
  const auto model = cityGml(
      std::string(kGmlHead) +
      "<core:cityObjectMember><dem:TINRelief gml:id=\"t\"><dem:lod>2</dem:lod><dem:tin><gml:TriangulatedSurface>"
      "<gml:trianglePatches><gml:Triangle><gml:exterior><gml:LinearRing><gml:coordinates>0,0,1 +4,0,1 0,2,1 0,0,1"
      "</gml:coordinates></gml:LinearRing></gml:exterior></gml:Triangle><gml:Triangle><gml:exterior><gml:LinearRing>"
      "<gml:pos>4 0 1</gml:pos><gml:pos>4 2 1</gml:pos><gml:pos>0 2 1</gml:pos></gml:LinearRing></gml:exterior>"
      "</gml:Triangle></gml:trianglePatches></gml:TriangulatedSurface></dem:tin></dem:TINRelief>"
      "</core:cityObjectMember></core:CityModel>");
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_NEAR(areaOfClass(*model, "IfcGeographicElement"), 8, 1e-6);
}

TEST(CityGml, TellsWhatItDoesNotRead) {
  const auto model = cityGml(gmlBuilding(
      gmlSolid(gmlPolygon("g", kGround) + gmlReference("nowhere") + gmlPolygon("thin", "0 0 0 1 1 1 0 0 0")) +
      "<app:appearance><app:Appearance><app:theme>x</app:theme></app:Appearance></app:appearance>"
      "<bldg:outerBuildingInstallation><bldg:BuildingInstallation><bldg:lod3ImplicitRepresentation>"
      "<core:ImplicitGeometry/></bldg:lod3ImplicitRepresentation></bldg:BuildingInstallation>"
      "</bldg:outerBuildingInstallation>"));
  ASSERT_TRUE(model) << describe(model.error());
  const std::string told = toldBy(*model);
  EXPECT_THAT(told, HasSubstr("geometries that are not in the file: 1"));
  EXPECT_THAT(told, HasSubstr("rings with fewer than three corners: 1"));
  EXPECT_THAT(told, HasSubstr("implicit geometries: 1"));
  EXPECT_THAT(told, HasSubstr("appearances were not read: 1"));
  EXPECT_THAT(told, HasSubstr("city objects without surfaces left out: 1"));
}

TEST(CityGml, IsRefusedByLine) {
  EXPECT_THAT(refusedCityGml("<!DOCTYPE x [<!ENTITY a \"aaaa\">]>\n<core:CityModel "
                             "xmlns:core=\"http://www.opengis.net/citygml/2.0\"/>"),
              HasSubstr("a.gml line 1: a document type is not allowed here"));
  EXPECT_THAT(refusedCityGml("<kml xmlns=\"http://x/citygml\"/>"), HasSubstr("the root element is 'kml'"));
  EXPECT_THAT(refusedCityGml(gmlBuilding(gmlSolid(gmlPolygon("g", "0 0 0 1 0 zero 1 1 0")))),
              HasSubstr("'zero 1 1 0' is not a coordinate"));
  EXPECT_THAT(refusedCityGml(gmlBuilding(gmlSolid(gmlPolygon("g", "0 0 0 1 0 0 1 1")))),
              HasSubstr("coordinates are not three for each corner"));
  EXPECT_THAT(refusedCityGml(gmlBuilding(gmlSolid(gmlPolygon("g", "0 0 0 1 0 0 1 1 1e99")))),
              HasSubstr("a coordinate is not a finite number below 1e13"));
  EXPECT_THAT(refusedCityGml(gmlBuilding(gmlSolid(gmlPolygon("g", "0 0 0 1 0 0 1 1 nan")))), Not(IsEmpty()));
  std::string deep = kGmlHead;
  for (int i = 0; i < 200; ++i) deep += "<bldg:consistsOfBuildingPart>";
  EXPECT_THAT(refusedCityGml(deep), HasSubstr("elements are nested more than 100 deep"));
}

TEST(CityGml, IsRefusedOrReadWhereverItEnds) {
  const std::string whole = houseOfGml();
  for (std::size_t size = 0; size + 2 < whole.size(); size += 7) {
    const auto model = cityGml(whole.substr(0, size));
    EXPECT_FALSE(model) << size;
    EXPECT_TRUE(model || !model.error().message.empty());
  }
}

TEST(CityGml, SurvivesChangedBytes) {
  const std::string whole = houseOfGml();
  for (std::uint32_t round = 0; round < 400; ++round) {
    std::string text = whole;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint64_t at = (round * 2654435761U + i * 40503U * (round + 7)) % text.size();
      text[at] = static_cast<char>("<>/\"0 9-#x"[(round + i) % 10]);
    }
    const auto model = cityGml(text);
    EXPECT_THAT(model ? validate(model->environment) : std::string(), IsEmpty());
  }
}

}  // namespace
}  // namespace standpoint::test
