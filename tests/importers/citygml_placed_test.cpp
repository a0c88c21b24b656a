// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/importers/citygml_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// A box of 2 × 3 × 4 m from the origin on, its faces outward.
std::string gmlBox(const std::string& id = "box") {
  const char* faces[] = {"0 0 0 0 3 0 2 3 0 2 0 0 0 0 0", "0 0 4 2 0 4 2 3 4 0 3 4 0 0 4",
                         "0 0 0 2 0 0 2 0 4 0 0 4 0 0 0", "2 0 0 2 3 0 2 3 4 2 0 4 2 0 0",
                         "2 3 0 0 3 0 0 3 4 2 3 4 2 3 0", "0 3 0 0 0 0 0 0 4 0 3 4 0 3 0"};
  std::string all = "<gml:MultiSurface gml:id=\"" + id + "\">";
  for (std::size_t i = 0; i < 6; ++i) all += gmlPolygon(id + std::to_string(i), faces[i]);
  return all + "</gml:MultiSurface>";
}

const std::string kUnturned = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

std::string gmlTree(const std::string& id, const std::string& matrix, const std::string& point,
                    const std::string& geometry) {
  return "<core:cityObjectMember><veg:SolitaryVegetationObject gml:id=\"" + id +
         "\"><veg:lod2ImplicitRepresentation><core:ImplicitGeometry><core:transformationMatrix>" + matrix +
         "</core:transformationMatrix>" + geometry + "<core:referencePoint><gml:Point><gml:pos>" + point +
         "</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry></veg:lod2ImplicitRepresentation>"
         "</veg:SolitaryVegetationObject></core:cityObjectMember>";
}

std::string gmlTemplate(const std::string& geometry) {
  return "<core:relativeGMLGeometry>" + geometry + "</core:relativeGMLGeometry>";
}
const std::string kToTheBox = "<core:relativeGMLGeometry xlink:href=\"#box\"/>";

std::string gmlCity(const std::string& members) { return kGmlHead + members + "</core:CityModel>\n"; }

const Mesh& meshNamed(const ImportedModel& model, const std::string& name, Bounds* box = nullptr) {
  const auto& e = model.environment;
  for (const auto& i : e.instances)
    if (e.products[i.product].name == name) {
      if (box != nullptr) *box = bounds(*e.meshes[i.mesh], i.world_from_mesh);
      return *e.meshes[i.mesh];
    }
  ADD_FAILURE() << "there is no mesh of " << name;
  static const Mesh kNothing;
  return kNothing;
}

const Surface& surfaceNamed(const ImportedModel& model, const std::string& product, std::size_t triangle = 0) {
  static const Surface kNothing;
  const Mesh& mesh = meshNamed(model, product);
  return triangle < mesh.triangles.size() ? model.environment.surfaces[mesh.surface_of_triangle[triangle]] : kNothing;
}

std::string gmlMaterial(const std::string& inside, const std::string& name = {}) {
  return "<app:surfaceDataMember><app:X3DMaterial>" + (name.empty() ? "" : "<gml:name>" + name + "</gml:name>") +
         inside + "</app:X3DMaterial></app:surfaceDataMember>";
}
std::string gmlAppearance(const std::string& theme, const std::string& data) {
  return "<app:appearanceMember><app:Appearance><app:theme>" + theme + "</app:theme>" + data +
         "</app:Appearance></app:appearanceMember>";
}
std::string gmlTarget(const std::string& id) { return "<app:target>#" + id + "</app:target>"; }

std::string gmlTexture(const std::string& image, const std::string& association) {
  return "<app:surfaceDataMember><app:ParameterizedTexture><app:imageURI>" + image + "</app:imageURI>" + association +
         "</app:ParameterizedTexture></app:surfaceDataMember>";
}
std::string gmlProjection(const std::string& uri, const std::string& matrix) {
  return "<app:target uri=\"" + uri + "\"><app:TexCoordGen><app:worldToTexture>" + matrix +
         "</app:worldToTexture></app:TexCoordGen></app:target>";
}

// Turned by a quarter from x to y and twice as large, the box of 2 × 3 × 4 m is one of 6 × 4 × 8 m.
TEST(CityGmlPlaced, AnImplicitGeometryStandsWhereItsMatrixAndItsPointSay) {
  const auto model =
      cityGml(gmlCity(gmlTree("late", "0 -2 0 1 2 0 0 2 0 0 2 3 0 0 0 1", "500100 5400200 50", kToTheBox) +
                      gmlTree("here", kUnturned, "500000 5400000 100", gmlTemplate(gmlBox()))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(toldBy(*model), Not(HasSubstr("loss")));
  EXPECT_EQ(model->environment.products.size(), 2U);
  const Eigen::Vector3d shift = model->georeference.shift_m;
  Bounds box;
  EXPECT_NEAR(volume(meshNamed(*model, "here", &box)), 24, 1e-4);
  EXPECT_EQ(box.min + shift, Eigen::Vector3d(500000, 5400000, 100));
  EXPECT_EQ(box.max + shift, Eigen::Vector3d(500002, 5400003, 104));
  EXPECT_NEAR(volume(meshNamed(*model, "late", &box)), 24 * 8, 1e-3);
  EXPECT_EQ(box.min + shift, Eigen::Vector3d(500100 + 1 - 6, 5400200 + 2, 50 + 3));
  EXPECT_EQ(box.max + shift, Eigen::Vector3d(500100 + 1, 5400200 + 2 + 4, 50 + 3 + 8));
  EXPECT_EQ(ofClass(*model, "IfcGeographicElement").properties.at(1).value, "2");  // its level of detail
}

TEST(CityGmlPlaced, AMirroredOneStaysOutward) {
  const auto model =
      cityGml(gmlCity(gmlTree("mirror", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "0 0 0", gmlTemplate(gmlBox()))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_NEAR(volume(meshNamed(*model, "mirror")), 24, 1e-5);
}

TEST(CityGmlPlaced, AnOrientableSurfaceWithAMinusHasItsOtherSideInFront) {
  std::string once = gmlBox();
  for (std::size_t at = once.find("<gml:Polygon"); at != std::string::npos; at = once.find("<gml:Polygon", at)) {
    const std::size_t end = once.find("</gml:Polygon>", at) + std::string("</gml:Polygon>").size();
    const std::string turned = gmlTurned("<gml:baseSurface>" + once.substr(at, end - at) + "</gml:baseSurface>");
    once.replace(at, end - at, turned);
    at += turned.size();
  }
  const std::string twice = gmlTurned("<gml:baseSurface>" + once + "</gml:baseSurface>");
  for (const auto& [box, expected] : {std::pair(once, -24.0), std::pair(twice, 24.0)}) {
    const auto model = cityGml(gmlCity(gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(box))));
    ASSERT_TRUE(model) << describe(model.error());
    EXPECT_NEAR(volume(meshNamed(*model, "tree")), expected, 1e-5);
  }
}

TEST(CityGmlPlaced, VersionsOneAndThreeNameTheirPartsOtherwise) {
  std::string text = gmlCity(gmlTree("tree", kUnturned, "7 0 0", gmlTemplate(gmlBox())));
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  for (const std::string version : {"1.0", "3.0"}) {
    replace("/2.0\"", "/" + version + "\"");
    if (version == "3.0") {
      replace("/1.0\"", "/3.0\"");
      replace("opengis.net/gml\"", "opengis.net/gml/3.2\"");
      replace("relativeGMLGeometry", "relativeGeometry");
      replace("veg:lod2Implicit", "core:lod2Implicit");
    }
    const auto model = cityGml(text);
    ASSERT_TRUE(model) << describe(model.error());
    EXPECT_EQ(bounds(model->environment).max.x(), 9) << version;
    EXPECT_NEAR(volume(meshNamed(*model, "tree")), 24, 1e-5) << version;
  }
}

TEST(CityGmlPlaced, TellsWhatHasNoShapeOrPlace) {
  const std::string file = "<core:libraryObject>tree.dae</core:libraryObject>";
  std::string nowhere = gmlTree("nowhere", kUnturned, "", gmlTemplate(gmlBox()));
  nowhere.replace(nowhere.find("<core:referencePoint>"),
                  nowhere.find("</core:referencePoint>") - nowhere.find("<core:referencePoint>"),
                  "<core:referencePoint>");
  const auto model =
      cityGml(gmlCity(gmlTree("file", kUnturned, "0 0 0", file) + nowhere +
                      gmlTree("gone", kUnturned, "0 0 0", "<core:relativeGMLGeometry xlink:href=\"#gone\"/>") +
                      gmlTree("elsewhere", kUnturned, "0 0 0", "<core:relativeGMLGeometry xlink:href=\"b.gml#box\"/>") +
                      gmlTree("within", kUnturned, "0 0 0",
                              gmlTemplate("<gml:MultiSurface>" + gmlReference("box1") +
                                          gmlPolygon("p", "0 0 0 1 0 0 0 1 0") + "</gml:MultiSurface>"))));
  ASSERT_TRUE(model) << describe(model.error());
  const std::string told = toldBy(*model);
  EXPECT_THAT(told, HasSubstr("loss line 10: implicit geometries that are files of their own: 1"));
  EXPECT_THAT(told, HasSubstr("implicit geometries without a reference point or a city object: 1"));
  EXPECT_THAT(told, HasSubstr("geometries that are not in the file: 2"));
  EXPECT_THAT(told, HasSubstr("references from implicit geometries to what is outside of them: 1"));
  EXPECT_THAT(told, HasSubstr("city objects without surfaces left out: 4"));
}

TEST(CityGmlPlaced, IsRefusedByLineAndBounded) {
  EXPECT_THAT(refusedCityGml(gmlCity(gmlTree("t", "1 0 0 0", "0 0 0", gmlTemplate(gmlBox())))),
              HasSubstr("a.gml line 10: a transformationMatrix requires 16 numbers"));
  EXPECT_THAT(refusedCityGml(gmlCity(gmlTree("t", kUnturned, "0 0 0 1 1 1", gmlTemplate(gmlBox())))),
              HasSubstr("a.gml line 10: a reference point requires three numbers"));
  EXPECT_THAT(
      refusedCityGml(gmlCity(gmlTree("t", "1e300 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "0 0 0", gmlTemplate(gmlBox())))),
      HasSubstr("a.gml line 10: a coordinate is not a finite number below 1e13"));
  std::string ring;
  for (int i = 0; i < 60000; ++i) ring += i % 3 == 0 ? "0 0 0 " : i % 3 == 1 ? "1 0 0 " : "0 1 0 ";
  std::string many =
      gmlTree("t", kUnturned, "0 0 0",
              gmlTemplate("<gml:MultiSurface gml:id=\"box\">" + gmlPolygon("p", ring) + "</gml:MultiSurface>"));
  for (int i = 0; i < 1000; ++i) many += gmlTree("t" + std::to_string(i), kUnturned, "0 0 0", kToTheBox);
  EXPECT_THAT(refusedCityGml(gmlCity(many)), HasSubstr("exceeds the limit of 20 000 000 placed corners"));
  EXPECT_THAT(refusedCityGml(gmlBuilding("<gml:Polygon><gml:exterior><gml:LinearRing><gml:Polygon/>"
                                         "<gml:posList>0 0 0</gml:posList></gml:LinearRing>")),
              HasSubstr("a polygon is within another one"));
}

TEST(CityGmlAppearance, AMaterialColoursWhatItTargetsAndTheInnermostTargetCounts) {
  const auto model = cityGml(
      gmlCity(gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(gmlBox())) +
              gmlTree("other", kUnturned, "5 0 0", gmlTemplate(gmlBox("plain"))) +
              gmlAppearance("", gmlMaterial("<app:diffuseColor>1 0 0.5</app:diffuseColor><app:transparency>0.25"
                                            "</app:transparency>" +
                                                gmlTarget("box1"),
                                            "Red glass") +
                                    gmlMaterial("<app:diffuseColor>0 1 0</app:diffuseColor>" + gmlTarget("box")) +
                                    gmlMaterial(gmlTarget("nothing")))));
  ASSERT_TRUE(model) << describe(model.error());
  // A material without a name is the colour of what is there, which keeps the name of its type.
  const Surface& green = surfaceNamed(*model, "tree", 0);
  EXPECT_EQ(green.name, "SolitaryVegetationObject");
  EXPECT_EQ(green.colour, (Colour{0, 1, 0, 1}));
  std::size_t red = 0;
  const Mesh& mesh = meshNamed(*model, "tree");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Surface& s = surfaceNamed(*model, "tree", i);
    if (s.name != "Red glass") continue;
    ++red;
    EXPECT_EQ(s.colour, (Colour{1, 0, 0.5F, 0.75F}));
    for (const auto corner : mesh.triangles[i]) EXPECT_EQ(mesh.positions[corner].z(), 4);  // the box's top
  }
  EXPECT_EQ(red, 2U);
  EXPECT_NE(surfaceNamed(*model, "other").colour, green.colour);
  EXPECT_THAT(toldBy(*model), HasSubstr("materials of geometries that are not in the file: 1"));
}

TEST(CityGmlAppearance, TheFirstThemeIsReadAndOnlyFrontsAreColoured) {
  const std::string green = "<app:diffuseColor>0 1 0</app:diffuseColor>",
                    red = "<app:diffuseColor>1 0 0</app:diffuseColor>";
  const auto model = cityGml(
      gmlCity(gmlAppearance("visual", gmlMaterial("<app:isFront>false</app:isFront>" + red + gmlTarget("box")) +
                                          gmlMaterial(green + gmlTarget("box"))) +
              gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(gmlBox())) +
              gmlAppearance("thermal", gmlMaterial(red + gmlTarget("box")) + gmlMaterial(red + gmlTarget("box1")))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.surfaces.size(), 1U);
  EXPECT_EQ(surfaceNamed(*model, "tree").colour, (Colour{0, 1, 0, 1}));
  EXPECT_THAT(toldBy(*model), HasSubstr("note line 10: materials and textures of back sides left out: 1"));
  EXPECT_THAT(toldBy(*model), HasSubstr("materials and textures of other themes than 'visual' left out: 2"));
  EXPECT_EQ(model->report.losses(), 0U);
}

TEST(CityGmlAppearance, AColourReachesPolygonsThatASurfaceRefersTo) {
  const std::string ground = "0 0 0 0 6 0 10 6 0 10 0 0 0 0 0", roof = "0 0 3 10 0 3 10 6 3 0 6 3 0 0 3";
  std::string text = gmlBuilding(
      gmlSolid(gmlPolygon("g", ground) + gmlPolygon("r", roof)) + gmlSurface("RoofSurface", gmlReference("r")) +
      gmlAppearance("", gmlMaterial(gmlTarget("roofs") + "<app:diffuseColor>0 0 1</app:diffuseColor>")));
  const std::string members = "<gml:MultiSurface><gml:surfaceMember xlink";
  text.replace(text.find(members), 18, "<gml:MultiSurface gml:id=\"roofs\">");
  const auto model = cityGml(text);
  ASSERT_TRUE(model) << describe(model.error());
  const auto& e = model->environment;
  for (const auto& i : e.instances) {
    const Surface& s = e.surfaces[e.meshes[i.mesh]->surface_of_triangle[0]];
    const bool is_roof = e.products[i.product].ifc_class == "IfcRoof";
    EXPECT_EQ(s.name, is_roof ? "RoofSurface" : "Building");
    EXPECT_EQ(s.colour == (Colour{0, 0, 1, 1}), is_roof);
  }
}

// In CityGML 2.0 a list of coordinates names its ring, in 3.0 the ring's name stands behind it.
TEST(CityGmlAppearance, ATextureIsReadWithItsCoordinatesAndGoesWithItsTemplate) {
  const std::string roof =
      "<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id=\"p\"><gml:exterior><gml:LinearRing gml:id=\"ring\">"
      "<gml:posList>0 0 3 8 0 3 8 4 3 0 4 3 0 0 3</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"
      "</gml:surfaceMember></gml:MultiSurface>";
  const auto texture = gmlTexture;
  const std::string list = "0 0 1 0 1 0.5 0 0.5 0 0";
  const std::string second = "<app:target uri=\"#p\"><app:TexCoordList><app:textureCoordinates ring=\"#ring\">" + list +
                             "</app:textureCoordinates></app:TexCoordList></app:target>";
  const std::string third =
      "<app:textureParameterization><app:TextureAssociation><app:target>#p</app:target>"
      "<app:textureParameterization><app:TexCoordList><app:textureCoordinates>" +
      list +
      "</app:textureCoordinates><app:ring>#ring</app:ring></app:TexCoordList>"
      "</app:textureParameterization></app:TextureAssociation></app:textureParameterization>";
  for (const std::string& association : {second, third}) {
    const auto folder = scratch();
    write(folder / "roof.png", "\x89PNG\r\n\x1a\n and so on");
    const auto model = import(
        write(folder / "a.gml",
              gmlCity(gmlTree("tree", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "0 0 0", gmlTemplate(roof)) +
                      gmlAppearance("", texture("roof.png", association) + texture("gone.png", association) +
                                            texture("roof.png", gmlProjection("#p", "9 0 0 0 0 9 0 0 0 0 0 1"))))));
    ASSERT_TRUE(model) << describe(model.error());
    ASSERT_EQ(model->environment.images.size(), 1U);
    EXPECT_EQ(surfaceNamed(*model, "tree").image, 0);
    const Mesh& mesh = meshNamed(*model, "tree");
    ASSERT_EQ(mesh.positions.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {  // u along the length of 8 m, v from 1 down over 4 m
      const Eigen::Vector3f& at = mesh.positions[i];
      EXPECT_EQ(mesh.texture_coordinates[i], Eigen::Vector2f(-at.x() / 8, 1 - at.y() / 8));
    }
    EXPECT_THAT(toldBy(*model), HasSubstr("colour texture 'gone.png' is missing"));
  }
}

// CityGML 2.0, 9.4: (s, t) = (s'/q', t'/q') with (s', t', q') = T p.
TEST(CityGmlAppearance, AMatrixPlacesATextureOnEachPolygonOfItsTarget) {
  const std::string matrix = "0.5 0 0 0  0 1 0 0  0 0 0.25 1";  // u = x / 2q, v = y / q with q = 1 + z / 4
  const std::string third =
      "<app:textureParameterization><app:TextureAssociation><app:target>#box</app:target>"
      "<app:textureParameterization><app:TexCoordGen><app:worldToTexture>" +
      matrix +
      "</app:worldToTexture></app:TexCoordGen></app:textureParameterization></app:TextureAssociation>"
      "</app:textureParameterization>";
  for (const std::string& association : {gmlProjection("#box", matrix), third}) {
    const auto folder = scratch();
    write(folder / "a.png", "\x89PNG\r\n\x1a\n and so on");
    const auto model =
        import(write(folder / "a.gml", gmlCity(gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(gmlBox())) +
                                               gmlAppearance("", gmlTexture("a.png", association)))));
    ASSERT_TRUE(model) << describe(model.error());
    EXPECT_EQ(model->report.losses(), 0U) << toldBy(*model);
    const Mesh& mesh = meshNamed(*model, "tree");
    ASSERT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
    ASSERT_EQ(mesh.triangles.size(), 12U);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      EXPECT_EQ(surfaceNamed(*model, "tree", i).image, 0);
      for (const auto corner : mesh.triangles[i]) {
        const Eigen::Vector3f& at = mesh.positions[corner];
        const float q = 1 + at.z() / 4;
        EXPECT_NEAR(mesh.texture_coordinates[corner].x(), at.x() / 2 / q, 1e-6);
        EXPECT_NEAR(mesh.texture_coordinates[corner].y(), 1 - at.y() / q, 1e-6);
      }
    }
  }
}

TEST(CityGmlAppearance, AMatrixThatPlacesNothingIsTold) {
  const auto folder = scratch();
  write(folder / "a.png", "\x89PNG\r\n\x1a\n and so on");
  const auto model = import(
      write(folder / "a.gml",
            gmlCity(gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(gmlBox())) +
                    gmlAppearance("", gmlTexture("a.png", gmlProjection("#box", "1 2 3") +
                                                              gmlProjection("#gone", "1 0 0 0 0 1 0 0 0 0 0 1") +
                                                              gmlProjection("#box", "1 0 0 0 0 1 0 0 0 0 0 0"))))));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_THAT(toldBy(*model), HasSubstr("matrices of textures that are not twelve numbers: 1"));
  EXPECT_THAT(toldBy(*model), HasSubstr("textures of geometries that are not in the file: 1"));
  EXPECT_THAT(toldBy(*model), HasSubstr("polygons that the matrix of a texture does not reach: 6"));
  EXPECT_EQ(surfaceNamed(*model, "tree").image, -1);
}

TEST(CityGmlAppearance, WhatIsWrongInItIsTold) {
  const auto model = cityGml(gmlCity(
      gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(gmlBox())) +
      gmlAppearance("", gmlMaterial("<app:diffuseColor>red</app:diffuseColor>" + gmlTarget("box")) +
                            "<app:surfaceDataMember xlink:href=\"#shared\"/><app:surfaceDataMember>"
                            "<app:GeoreferencedTexture/></app:surfaceDataMember><app:surfaceDataMember>"
                            "<app:ParameterizedTexture><app:imageURI>a.png</app:imageURI><app:target uri=\"#box1\">"
                            "<app:TexCoordList><app:textureCoordinates ring=\"#no\">0 0 1</app:textureCoordinates>"
                            "</app:TexCoordList></app:target></app:ParameterizedTexture></app:surfaceDataMember>")));
  ASSERT_TRUE(model) << describe(model.error());
  const std::string told = toldBy(*model);
  EXPECT_THAT(told, HasSubstr("colours that are not three numbers: 1"));
  EXPECT_THAT(told, HasSubstr("references to materials and textures that were not read: 1"));
  EXPECT_THAT(told, HasSubstr("georeferenced textures: 1"));
  EXPECT_THAT(told, HasSubstr("texture coordinates that are not pairs of numbers: 1"));
  EXPECT_THAT(told, HasSubstr("texture coordinates of rings that are not in the file: 1"));
}

TEST(CityGmlAppearance, TexturedSurfacesOfTheFirstVersionAreSurfaces) {
  const auto model = cityGml(gmlBuilding(gmlSolid(
      "<gml:surfaceMember><tex:TexturedSurface xmlns:tex=\"http://www.opengis.net/citygml/texturedsurface/1.0\" "
      "gml:id=\"t\"><gml:baseSurface><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 0 1 0 0 0 1 0"
      "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:baseSurface><tex:appearance><tex:Material/>"
      "</tex:appearance></tex:TexturedSurface></gml:surfaceMember>")));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.size(), 1U);
  EXPECT_NEAR(areaOfClass(*model, "IfcBuilding"), 0.5, 1e-6);
  EXPECT_THAT(toldBy(*model), HasSubstr("materials and textures of textured surfaces: 1"));
}

TEST(CityGmlPlaced, SurvivesChangedBytes) {
  const std::string whole =
      gmlCity(gmlTree("tree", kUnturned, "0 0 0", gmlTemplate(gmlBox())) + gmlTree("t", kUnturned, "9 0 0", kToTheBox) +
              gmlAppearance("", gmlMaterial("<app:diffuseColor>0 1 0</app:diffuseColor>" + gmlTarget("box"))));
  for (std::uint32_t round = 0; round < 400; ++round) {
    std::string text = whole;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint64_t at = (round * 2654435761U + i * 40503U * (round + 7)) % text.size();
      text[at] = static_cast<char>("<>/\"0 9-#x"[(round + i) % 10]);
    }
    const auto model = cityGml(text);
    EXPECT_EQ(model ? validate(model->environment) : std::string(), "");
  }
}

}  // namespace
}  // namespace standpoint::test
