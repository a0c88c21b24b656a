// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/random.h"
#include "importers/city/city_frame.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Json = nlohmann::json;

// A house of 10 × 6 × 3 m with a window cut out of its front wall, in millimetres in the Dutch grid.
Json house() {
  return Json::parse(R"({
    "type": "CityJSON", "version": "2.0",
    "transform": {"scale": [0.001, 0.001, 0.001], "translate": [84000.5, 447000.25, 0]},
    "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
    "CityObjects": {
      "b1": {
        "type": "Building",
        "attributes": {"name": "House", "yearOfConstruction": 1957, "owner": null, "tags": ["a", 2]},
        "geometry": [
          {"type": "MultiSurface", "lod": "0", "boundaries": [[[0, 3, 2, 1]]]},
          {"type": "Solid", "lod": "2.2",
           "boundaries": [[
             [[0, 3, 2, 1]],
             [[4, 5, 6, 7]],
             [[0, 1, 5, 4], [8, 11, 10, 9]],
             [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]],
             [[8, 9, 10, 11]]]],
           "semantics": {
             "surfaces": [
               {"type": "GroundSurface"}, {"type": "RoofSurface", "slope": 0},
               {"type": "WallSurface"}, {"type": "Window", "parent": 2}],
             "values": [[0, 1, 2, 2, 2, null, 3]]},
           "material": {"visual": {"values": [[null, 0, null, null, null, null, null]]}}}]
      }},
    "appearance": {"materials": [{"name": "Slate", "diffuseColor": [0.2, 0.25, 0.3], "transparency": 0.25}]},
    "vertices": [[0,0,0], [10000,0,0], [10000,6000,0], [0,6000,0], [0,0,3000], [10000,0,3000], [10000,6000,3000],
                 [0,6000,3000], [4000,0,1000], [6000,0,1000], [6000,0,2000], [4000,0,2000]]})");
}

Result<ImportedModel> cityJson(const Json& json, const ImportOptions& options = {}) {
  return import(write(scratch() / "a.city.json", json.dump()), options);
}
std::string refusedCityJson(const Json& json) { return refusal(write(scratch() / "a.city.json", json.dump())); }

const Product& named(const ImportedModel& model, const std::string& name) {
  const auto& all = model.environment.products;
  const auto it = std::find_if(all.begin(), all.end(), [&](const Product& p) { return p.name == name; });
  if (it != all.end()) return *it;
  ADD_FAILURE() << "there is no product " << name;
  static const Product kNothing;
  return kNothing;
}

double areaOf(const ImportedModel& model, const Product& product) {
  double sum = 0;
  for (const auto& i : model.environment.instances)
    if (&model.environment.products[i.product] == &product) sum += area(*model.environment.meshes[i.mesh]);
  return sum;
}

std::string valueOf(const Product& product, const std::string& name) {
  for (const auto& p : product.properties)
    if (p.name == name) return p.value;
  return "nothing";
}

std::string issuesOf(const ImportedModel& model) {
  std::string text;
  for (const auto& i : model.report.issues)
    text += std::string(name(i.severity)) + " " + i.source + ": " + i.message + "\n";
  return text;
}

TEST(CityJson, SurfacesBecomeProductsOfTheNearestIfcClass) {
  const auto model = cityJson(house());
  ASSERT_TRUE(model) << describe(model.error());
  ASSERT_THAT(model->environment.products, SizeIs(5));
  const auto &roof = named(*model, "House RoofSurface"), &wall = named(*model, "House WallSurface"),
             &window = named(*model, "House Window"), &ground = named(*model, "House GroundSurface"),
             &rest = named(*model, "House");
  EXPECT_EQ(roof.ifc_class, "IfcRoof");
  EXPECT_EQ(wall.ifc_class, "IfcWall");
  EXPECT_EQ(window.ifc_class, "IfcWindow");
  EXPECT_EQ(ground.ifc_class, "IfcSlab");
  EXPECT_EQ(rest.ifc_class, "IfcBuilding");
  EXPECT_EQ(valueOf(window, "type"), "Window");
  EXPECT_EQ(valueOf(roof, "lod"), "2.2");
  EXPECT_EQ(valueOf(roof, "slope"), "0");
  EXPECT_EQ(valueOf(rest, "yearOfConstruction"), "1957");
  EXPECT_EQ(valueOf(rest, "tags"), "[\"a\",2]");
  EXPECT_EQ(valueOf(rest, "owner"), "nothing");
  EXPECT_EQ(&model->environment.products.at(static_cast<std::size_t>(window.whole)), &wall);
  EXPECT_EQ(rest.id, "/CityObjects/b1");
}

TEST(CityJson, AHoleIsCutOutOfItsWallAndAreasAreThoseOfTheFile) {
  const auto model = cityJson(house());
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_NEAR(areaOf(*model, named(*model, "House WallSurface")), 30 - 2 + 18 + 30, 1e-5);
  EXPECT_NEAR(areaOf(*model, named(*model, "House Window")), 2, 1e-6);
  EXPECT_NEAR(areaOf(*model, named(*model, "House RoofSurface")), 60, 1e-5);
}

TEST(CityJson, TheHighestLevelOfDetailIsTakenAndTheOthersAreNoted) {
  const auto model = cityJson(house());
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(issuesOf(*model),
              HasSubstr("note /CityObjects/b1: polygons of lower levels of detail left out for higher ones: 1"));
  EXPECT_EQ(model->report.losses(), 0U) << issuesOf(*model);
}

TEST(CityJson, CoordinatesStayExactAndTheReferenceSystemIsThatOfTheModel) {
  const auto model = cityJson(house());
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->georeference.crs, "EPSG:7415");
  ASSERT_TRUE(model->georeference.map_from_file);
  EXPECT_EQ(model->georeference.shift_m, Eigen::Vector3d(84006, 447003, 2));
  const auto box = bounds(model->environment);
  EXPECT_EQ(box.min + model->georeference.shift_m, Eigen::Vector3d(84000.5, 447000.25, 0));
  EXPECT_EQ(box.max + model->georeference.shift_m, Eigen::Vector3d(84010.5, 447006.25, 3));
}

TEST(CityJson, AMaterialHasItsNameAndColourAndASurfaceWithoutOneThatOfItsType) {
  const auto model = cityJson(house());
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(named(*model, "House RoofSurface").materials, ElementsAre("Slate"));
  EXPECT_THAT(named(*model, "House WallSurface").materials, ElementsAre("WallSurface"));
  const auto& slate = model->environment.surfaces.at(0);
  EXPECT_EQ(slate.colour, (Colour{0.2F, 0.25F, 0.3F, 0.75F}));
}

TEST(CityJson, PlacesAreATreeAndPartsStandInTheirBuilding) {
  auto json = house();
  auto& objects = json["CityObjects"];
  objects["b1"]["children"] = {"p1", "chimney"};
  objects["b1"]["geometry"].erase(1);  // its footprint stays
  objects["p1"] = house()["CityObjects"]["b1"];
  objects["p1"]["type"] = "BuildingPart";
  objects["p1"]["parents"] = {"b1"};
  objects["chimney"] = {{"type", "BuildingInstallation"}, {"parents", {"b1"}}};
  objects["chimney"]["geometry"] = {{{"type", "MultiSurface"}, {"lod", 3}, {"boundaries", {{{4, 5, 6, 7}}}}}};
  objects["quarter"] = {{"type", "CityObjectGroup"}, {"children", {"chimney", "nobody"}}};
  const auto model = cityJson(json);
  ASSERT_TRUE(model) << describe(model.error());
  const auto& places = model->environment.spatial;
  ASSERT_THAT(places, SizeIs(3));
  EXPECT_EQ(places[0].ifc_class, "IfcSite");
  EXPECT_EQ(places[1].id, "/CityObjects/b1");
  EXPECT_EQ(places[2].parent, 1);
  const auto& chimney = named(*model, "chimney");
  EXPECT_EQ(chimney.container, 1);
  EXPECT_EQ(chimney.ifc_class, "IfcBuildingElementProxy");
  EXPECT_THAT(chimney.groups, ElementsAre("CityObjectGroup quarter"));
  // Neither footprint is left where a part shows the building in more detail.
  EXPECT_THAT(issuesOf(*model), HasSubstr("left out for higher ones: 2"));
  EXPECT_THAT(issuesOf(*model), HasSubstr("parents, children or members that are not in the file: 1"));
}

TEST(CityJson, ATemplateStandsWhereItsInstancesAreAndMirroredOnesStayOutward) {
  auto json = house();
  json["geometry-templates"] = Json::parse(R"({
    "templates": [{"type": "Solid", "lod": "3",
      "boundaries": [[[[0, 2, 1]], [[0, 1, 3]], [[0, 3, 2]], [[1, 2, 3]]]]}],
    "vertices-templates": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]})");
  json["CityObjects"] = Json::parse(R"({
    "tree": {"type": "SolitaryVegetationObject", "geometry": [{"type": "GeometryInstance", "template": 0,
      "boundaries": [6], "transformationMatrix": [2,0,0,5, 0,2,0,0, 0,0,2,0, 0,0,0,1]}]},
    "mirror": {"type": "SolitaryVegetationObject", "geometry": [{"type": "GeometryInstance", "template": 0,
      "boundaries": [0], "transformationMatrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]}})");
  const auto model = cityJson(json);
  ASSERT_TRUE(model) << describe(model.error());
  for (const auto& [name, expected] : {std::pair("tree", 8.0 / 6), std::pair("mirror", 1.0 / 6)}) {
    const auto& product = named(*model, name);
    EXPECT_EQ(product.ifc_class, "IfcGeographicElement");
    for (const auto& i : model->environment.instances)
      if (&model->environment.products[i.product] == &product)
        EXPECT_NEAR(volume(*model->environment.meshes[i.mesh]), expected, 1e-6) << name;
  }
  const auto box = bounds(model->environment);
  EXPECT_EQ(box.max.x() + model->georeference.shift_m.x(), 84010.5 + 5 + 2);
}

TEST(CityJson, ATextureIsReadWithItsCoordinates) {
  auto json = house();
  json["appearance"]["textures"] = {{{"type", "PNG"}, {"image", "roof.png"}}, {{"type", "PNG"}, {"image", "gone.png"}}};
  json["appearance"]["vertices-texture"] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  json["CityObjects"]["b1"]["geometry"][1]["texture"]["visual"]["values"] =
      Json::parse("[[[[1, 0, 1, 2, 3]], [[0, 0, 1, 2, 3]], [[null]], [[null]], [[null]], [[null]], [[null]]]]");
  const auto folder = scratch();
  write(folder / "roof.png", "\x89PNG\r\n\x1a\n and so on");
  const auto model = import(write(folder / "a.json", json.dump()));
  ASSERT_TRUE(model) << describe(model.error());
  ASSERT_THAT(model->environment.images, SizeIs(1));
  const auto& roof = named(*model, "House RoofSurface");
  for (const auto& i : model->environment.instances) {
    if (&model->environment.products[i.product] != &roof) continue;
    const auto& mesh = *model->environment.meshes[i.mesh];
    EXPECT_EQ(model->environment.surfaces.at(mesh.surface_of_triangle[0]).image, 0);
    EXPECT_THAT(mesh.texture_coordinates, Contains(Eigen::Vector2f(1, 0)));  // the file's (1, 1)
    EXPECT_THAT(mesh.texture_coordinates, SizeIs(4));
  }
  EXPECT_THAT(issuesOf(*model), HasSubstr("loss /appearance/textures/1: colour texture 'gone.png'"));
}

TEST(CityJson, ASequenceHasItsFeaturesWithVerticesOfTheirOwn) {
  auto first = house();
  auto feature = first;
  first["CityObjects"] = Json::object();
  first["vertices"] = Json::array();
  feature["type"] = "CityJSONFeature";
  feature["id"] = "b1";
  for (const char* key : {"version", "transform", "metadata"}) feature.erase(key);
  auto second = feature;
  second["CityObjects"]["b2"] = second["CityObjects"]["b1"];
  second["CityObjects"].erase("b1");
  for (auto& v : second["vertices"]) v[0] = v[0].get<int>() + 20000;
  const std::string text = first.dump() + "\n" + feature.dump() + "\n\n" + second.dump() + "\n";
  const auto model = import(write(scratch() / "a.city.jsonl", text));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(model->environment.products, SizeIs(10));
  EXPECT_EQ(bounds(model->environment).max.x() + model->georeference.shift_m.x(), 84030.5);
  auto broken = second;
  broken["CityObjects"]["b2"]["geometry"][0]["boundaries"][0][0][0] = 12;
  EXPECT_THAT(refusal(write(scratch() / "a.city.jsonl", first.dump() + "\n" + broken.dump() + "\n")),
              HasSubstr("a.city.jsonl /CityObjects/b2/geometry/0: refers to vertex 12; there are 12"));
  EXPECT_THAT(refusal(write(scratch() / "a.city.jsonl", first.dump() + "\n{\"type\": }\n")), HasSubstr("line 2"));
}

TEST(CityJson, VerticesMayStandBeforeOrAfterTheObjects) {
  const auto json = house();
  std::string text = "{\"CityObjects\":" + json["CityObjects"].dump();
  for (const char* key : {"vertices", "appearance", "transform", "version", "type"})
    text += ",\"" + std::string(key) + "\":" + json[key].dump();
  const auto model = import(write(scratch() / "late.dat", text + "}"));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_NEAR(areaOf(*model, named(*model, "House WallSurface")), 76, 1e-5);
}

TEST(CityJson, WhatIsNoSurfaceIsCountedAsLost) {
  auto json = house();
  json["CityObjects"]["b1"]["geometry"].push_back({{"type", "MultiPoint"}, {"lod", "1"}, {"boundaries", {0, 1}}});
  json["CityObjects"]["b1"]["geometry"][1]["boundaries"][0][0][0] = {0, 3};
  const auto model = cityJson(json);
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(issuesOf(*model), HasSubstr("loss /CityObjects/b1/geometry/2: geometries of type MultiPoint: 1"));
  EXPECT_THAT(issuesOf(*model), HasSubstr("rings with fewer than three corners: 1"));
}

TEST(CityJson, NamesOfReferenceSystemsAreUnderstoodAsTheyAreWritten) {
  EXPECT_EQ(crsOfCityName("https://www.opengis.net/def/crs/EPSG/0/7415"), "EPSG:7415");
  EXPECT_EQ(crsOfCityName("http://www.opengis.net/def/crs/epsg/9.9.1/28992"), "EPSG:28992");
  EXPECT_EQ(crsOfCityName("urn:ogc:def:crs:EPSG::25832"), "EPSG:25832");
  EXPECT_EQ(crsOfCityName("urn:ogc:def:crs:EPSG:6.12:3068"), "EPSG:3068");
  EXPECT_EQ(crsOfCityName("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783"), "EPSG:25832");
  EXPECT_EQ(crsOfCityName("EPSG:3068"), "EPSG:3068");
  EXPECT_EQ(crsOfCityName("urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH"), "EPSG:25832");
  EXPECT_EQ(crsOfCityName("somewhere"), "somewhere");
}

TEST(CityJson, FeetOfTheReferenceSystemBecomeMetresAndDegreesAreRefused) {
  auto json = house();
  json["metadata"]["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/2263";  // New York, US survey feet
  const auto feet = cityJson(json);
  ASSERT_TRUE(feet) << describe(feet.error());
  EXPECT_NEAR(areaOf(*feet, named(*feet, "House RoofSurface")), 60 * 0.3048006096 * 0.3048006096, 1e-5);
  json["metadata"]["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/4979";
  json["transform"] = {{"scale", {1e-7, 1e-7, 1e-3}}, {"translate", {4.3, 52.1, 0}}};
  EXPECT_THAT(refusedCityJson(json),
              HasSubstr("a.city.json /metadata/referenceSystem: the coordinates are in degrees"));
}

TEST(CityJsonHostile, WhatIsWrongIsRefusedWithItsPlace) {
  auto json = house();
  json["vertices"][3] = {1, 2};
  EXPECT_THAT(refusedCityJson(json), HasSubstr("a.city.json /vertices/3: must be a list of three numbers"));
  json["vertices"][3] = {1, 2, {3}};
  EXPECT_THAT(refusedCityJson(json), HasSubstr("/vertices/3: must be a list of three numbers"));
  json = house();
  json["vertices"][3] = {1, 2, 1e300};
  EXPECT_THAT(refusedCityJson(json), HasSubstr("/vertices/3: a coordinate is not a finite number below 1e13"));
  json = house();
  json["CityObjects"]["b1"]["geometry"][0]["boundaries"] = {0, 1, 2};
  EXPECT_THAT(refusedCityJson(json), HasSubstr("/CityObjects/b1/geometry/0: the boundaries are not nested"));
  json = house();
  json["type"] = "FeatureCollection";
  EXPECT_THAT(refusedCityJson(json), HasSubstr("a.city.json /type: is not CityJSON"));
  json = house();
  json["transform"]["scale"] = 3;
  EXPECT_THAT(refusedCityJson(json), HasSubstr("a.city.json /transform: requires a scale"));
  json = house();
  json["CityObjects"]["b1"]["geometry"][0] = {{"type", "GeometryInstance"}, {"template", 0}, {"boundaries", {0}}};
  EXPECT_THAT(refusedCityJson(json), HasSubstr("refers to a geometry template that does not exist"));
  EXPECT_THAT(refusal(write(scratch() / "a.json", "{\"CityObjects\": {\n\n\"a\": }}")), HasSubstr("a.json line 3"));
  EXPECT_THAT(refusal(write(scratch() / "a.json", "{\"CityObjects\": 1e999}")), HasSubstr("a.json"));
}

TEST(CityJsonHostile, NestingAndPlacedTemplatesAreBounded) {
  const std::string deep = "{\"type\": \"CityJSON\", \"CityObjects\": {\"a\": " + std::string(1000000, '[');
  EXPECT_THAT(refusal(write(scratch() / "a.json", deep)), HasSubstr("is nested deeper than 64 levels"));
  const std::string outside = "{\"type\": \"CityJSON\", \"vertices\": " + std::string(1000000, '[');
  EXPECT_THAT(refusal(write(scratch() / "a.json", outside)), HasSubstr("must be a list of three numbers"));
  auto json = house();
  Json many = {{Json::array()}};
  for (int i = 0; i < 60000; ++i) many[0][0].push_back(i % 3);
  json["geometry-templates"] = {{"templates", {{{"type", "MultiSurface"}, {"boundaries", many}}}},
                                {"vertices-templates", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  Json instances = Json::array();
  for (int i = 0; i < 1000; ++i)
    instances.push_back({{"type", "GeometryInstance"}, {"template", 0}, {"boundaries", {0}}});
  json["CityObjects"]["b1"]["geometry"] = instances;
  EXPECT_THAT(refusedCityJson(json), HasSubstr("exceeds the limit of 20 000 000 placed corners"));
}

TEST(CityJsonHostile, CirclesOfPartsAreCutAndSaid) {
  auto json = house();
  auto& objects = json["CityObjects"];
  objects["b1"]["type"] = "BuildingPart";
  objects["b1"]["parents"] = {"b2"};
  objects["b2"] = {{"type", "BuildingPart"}, {"parents", {"b1"}}};
  objects["b1"]["geometry"][1]["semantics"]["surfaces"][2]["parent"] = 3;
  const auto model = cityJson(json);
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(issuesOf(*model), HasSubstr("is a part of itself by way of its parents"));
  EXPECT_EQ(validate(model->environment), "");
}

TEST(CityJsonHostile, CutOffOrMutatedItIsAModelOrAnErrorWithItsPlace) {
  const auto file = scratch() / "cut.json";
  auto json = house();
  json.erase("metadata");  // looking up a reference system takes most of the time
  json["geometry-templates"] = {{"templates", {{{"type", "MultiSurface"}, {"boundaries", {{{0, 1, 2}}}}}}},
                                {"vertices-templates", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  json["CityObjects"]["t"] = {{"type", "SolitaryVegetationObject"}};
  json["CityObjects"]["t"]["geometry"] = {{{"type", "GeometryInstance"}, {"template", 0}, {"boundaries", {0}}}};
  const std::string whole = json.dump();
  for (std::size_t length = 0; length < whole.size(); length += 7)
    EXPECT_THAT(refusal(write(file, whole.substr(0, length))), HasSubstr("cut.json")) << length;
  for (std::uint32_t round = 0; round < 500; ++round) {
    auto mutated = whole;
    const auto r = philox({11, 0}, round, 0, 0);
    mutated[r[0] % mutated.size()] = static_cast<char>(r[1]);
    const auto model = import(write(file, mutated));
    EXPECT_EQ(model ? validate(model->environment) : "", "");
    EXPECT_THAT(model ? "cut.json" : describe(model.error()), HasSubstr("cut.json"));
  }
}

TEST(CityJsonHostile, MembersOfAnyKindAreNeverACrash) {
  const Json odd[] = {nullptr,
                      true,
                      -1,
                      4294967296,
                      0.5,
                      "text",
                      Json::array(),
                      Json::array({1}),
                      Json::object(),
                      Json::parse(R"([[[[[0, 1, 2]]]]])")};
  auto whole = house();
  whole.erase("metadata");
  const Json flat = whole.flatten();
  for (const auto& [place, value] : flat.items())
    for (const auto& other : odd) {
      auto json = whole;
      json[Json::json_pointer(place)] = other;
      const auto model = cityJson(json);
      EXPECT_EQ(model ? validate(model->environment) : "", "") << place;
    }
}

}  // namespace
}  // namespace standpoint::test
