// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/importers/citygml_files.h"

namespace standpoint::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

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

float heightOfNormal(const ImportedModel& model, const std::string& ifc_class) {
  float sum = 0;
  for (const auto& i : model.environment.instances) {
    if (model.environment.products[i.product].ifc_class != ifc_class) continue;
    const Mesh& mesh = *model.environment.meshes[i.mesh];
    for (const auto& t : mesh.triangles) {
      const auto& a = mesh.positions[t[0]];
      sum += (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).z() / 2;
    }
  }
  return sum;
}

TEST(CityGml, AReferenceTurnsWhatItGivesAndNothingElse) {
  const auto turned = [](const std::string& id) {
    return "<gml:surfaceMember>" + gmlTurned("<gml:baseSurface xlink:href=\"#" + id + "\"/>") + "</gml:surfaceMember>";
  };
  // The solid's roof looks down; its surface says that the other side is the roof.
  const auto given = cityGml(gmlBuilding(gmlSolid(gmlPolygon("r", kGround)) + gmlSurface("RoofSurface", turned("r"))));
  ASSERT_TRUE(given) << describe(given.error());
  EXPECT_NEAR(heightOfNormal(*given, "IfcRoof"), 60, 1e-3);
  const auto kept = cityGml(gmlBuilding(gmlSolid(turned("r")) + gmlSurface("RoofSurface", gmlPolygon("r", kRoof))));
  ASSERT_TRUE(kept) << describe(kept.error());
  EXPECT_NEAR(heightOfNormal(*kept, "IfcRoof"), 60, 1e-3);
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
      "<bldg:outerBuildingInstallation><bldg:BuildingInstallation><bldg:lod3ImplicitRepresentation>"
      "<core:ImplicitGeometry/></bldg:lod3ImplicitRepresentation></bldg:BuildingInstallation>"
      "</bldg:outerBuildingInstallation>"));
  ASSERT_TRUE(model) << describe(model.error());
  const std::string told = toldBy(*model);
  EXPECT_THAT(told, HasSubstr("geometries that are not in the file: 1"));
  EXPECT_THAT(told, HasSubstr("rings with fewer than three corners: 1"));
  EXPECT_THAT(told, HasSubstr("note line 10: implicit geometries without a shape left out: 1"));
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
