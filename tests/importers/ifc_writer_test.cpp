// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/ifc_writer.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "importers/ifc/writer/class_table.h"
#include "importers/ifc/writer/georeference.h"
#include "importers/ifc/writer/global_ids.h"
#include "importers/ifc/writer/step_writer.h"
#include "importers/ifc/writer/units.h"
#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

using ifc::Schema;
using ::testing::HasSubstr;
using ::testing::Not;

struct Written {
  std::string text;
  IfcSummary summary;
  Report report;
  ImportedModel again;
};

Written written(const Environment& environment, const Georeference& georeference = {},
                const std::vector<const PhysicalMaterial*>& physical = {}) {
  Written result;
  const TemporaryFile file("");
  Progress progress;
  const auto done =
      writeIfc(environment, physical, georeference, file.path(), "Model", "Standpoint 1", result.report, progress);
  EXPECT_TRUE(done) << describe(done.error());
  if (!done) return result;
  result.summary = *done;
  std::ifstream in(file.path());
  result.text = (std::ostringstream() << in.rdbuf()).str();
  auto model = importFile(file.path(), {}, progress);
  EXPECT_TRUE(model) << describe(model.error());
  if (model) result.again = std::move(*model);
  return result;
}

std::vector<std::string> told(const Report& report) {
  std::vector<std::string> all;
  for (const Issue& issue : report.issues) all.push_back(issue.source + ": " + issue.message);
  return all;
}

const Product& comeBack(const ImportedModel& model, const std::string& name) {
  for (const Product& p : model.environment.products)
    if (p.name == name) return p;
  ADD_FAILURE() << "there is no product " << name;
  return model.environment.products.at(0);
}

std::vector<std::string> propertyTexts(const std::vector<Property>& properties) {
  std::vector<std::string> all;
  for (const Property& p : properties)
    all.push_back(p.set + " | " + p.name + " | " + p.value + " | " + std::string(keywordOf(p.type)));
  std::sort(all.begin(), all.end());
  return all;
}

// A right-angled prism that no mirror leaves as it is, of one surface.
std::shared_ptr<Mesh> wedge() {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh->surface_of_triangle = {0, 0, 0, 0};
  return mesh;
}

Environment wedges(const std::vector<Eigen::Affine3d>& places) {
  Environment e;
  e.meshes = {wedge()};
  e.surfaces = {{"Stone"}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Product p;
    p.id = "o " + std::to_string(i);
    p.name = "Wedge " + std::to_string(i);
    e.products.push_back(p);
    e.instances.push_back({0, static_cast<std::uint32_t>(i), places[i]});
  }
  return e;
}

TEST(IfcText, KeepsEveryCharacterOfAName) {
  EXPECT_EQ(ifc::stepText("Wände 'a' \\ 𝄞\n"),
            "'W\\X2\\00E4\\X0\\nde ''a'' \\\\ \\X4\\0001D11E\\X0\\\\X2\\000A\\X0\\'");
  EXPECT_EQ(ifc::stepText("\xC3"), "'\\X2\\FFFD\\X0\\'");
  EXPECT_EQ(ifc::stepText("\xED\xA0\x80"), "'\\X2\\FFFDFFFDFFFD\\X0\\'");  // half of a pair
  EXPECT_EQ(ifc::stepText("\xC0\xAF"), "'\\X2\\FFFDFFFD\\X0\\'");          // longer than it has to be
}

TEST(IfcText, GivesRealsTheirPoint) {
  EXPECT_EQ(ifc::stepReal(1.0), "1.");
  EXPECT_EQ(ifc::stepReal(0.1), "0.1");
  EXPECT_EQ(ifc::stepReal(1e-7), "1.E-07");
  EXPECT_EQ(ifc::stepReal(-2.5e30), "-2.5E+30");
  EXPECT_EQ(ifc::stepReal(0.1F), "0.1");
  EXPECT_EQ(ifc::stepReal(std::nan("")), "0.");
}

TEST(IfcText, ReadsLengthsInAnyUnitOfTheFile) {
  EXPECT_EQ(ifc::metresOf("2700 mm"), 2.7);
  EXPECT_EQ(ifc::metresOf("9 FOOT"), 9 * 0.3048);
  EXPECT_EQ(ifc::metresOf("2 INCH"), 0.0508);
  EXPECT_EQ(ifc::metresOf("-1.5 km"), -1500);
  EXPECT_EQ(ifc::metresOf("2.5"), 2.5);
  EXPECT_FALSE(ifc::metresOf("2 m²"));
  EXPECT_FALSE(ifc::metresOf("3 kg"));
  EXPECT_FALSE(ifc::metresOf("tall"));
}

TEST(IfcText, CountsAnglesOfASiteInMillionthsOfASecond) {
  EXPECT_EQ(ifc::compoundAngleText(48.5), "(48,30,0,0)");
  EXPECT_EQ(ifc::compoundAngleText(-0.0002777780556), "(0,0,-1,-1)");
}

TEST(IfcGlobalIds, AreKeptWhereTheyAreValidAndAlone) {
  ifc::GlobalIds ids("project");
  const std::string stated = "2O2Fr$t4X7Zf8NOew3FLOH";
  EXPECT_EQ(ids.keep(stated, "a"), stated);
  const std::string second = ids.keep(stated, "b");
  EXPECT_NE(second, stated);
  EXPECT_TRUE(ifc::isGlobalId(second)) << second;
  EXPECT_TRUE(ifc::isGlobalId(ids.keep("not a GlobalId", "c")));
  EXPECT_EQ(ids.replaced(), 2U);
  EXPECT_EQ(ifc::GlobalIds("project").make("x"), ifc::GlobalIds("project").make("x"));
  EXPECT_NE(ifc::GlobalIds("project").make("x"), ifc::GlobalIds("other").make("x"));
}

TEST(IfcClasses, AreThoseOfTheSchemaThatIsWritten) {
  EXPECT_EQ(ifc::classToWrite(Schema::ifc4, "IfcBeamStandardCase"), "IfcBeamStandardCase");
  EXPECT_EQ(ifc::classToWrite(Schema::ifc4x3, "IfcBeamStandardCase"), "IfcBeam");
  EXPECT_EQ(ifc::classToWrite(Schema::ifc4, "IfcElectricDistributionPoint"), "IfcElectricDistributionBoard");
  EXPECT_EQ(ifc::classToWrite(Schema::ifc4, "IfcWallType"), "IfcWall");
  EXPECT_EQ(ifc::classToWrite(Schema::ifc4, "IfcSomethingOfMyOwn"), "IfcBuildingElementProxy");
  EXPECT_FALSE(ifc::hasClass(Schema::ifc4, "IfcRoad"));
  EXPECT_TRUE(ifc::hasClass(Schema::ifc4x3, "IfcRoad"));
  EXPECT_TRUE(ifc::isPredefined(Schema::ifc4, "IfcBeam", "JOIST"));
  EXPECT_FALSE(ifc::isPredefined(Schema::ifc4, "IfcBeam", "PIERCAP"));
  EXPECT_TRUE(ifc::isPredefined(Schema::ifc4x3, "IfcBeam", "PIERCAP"));
  EXPECT_EQ(ifc::typeClassOf(Schema::ifc4, "IfcWallStandardCase"), "IfcWallType");
  EXPECT_EQ(ifc::typeClassOf(Schema::ifc4, "IfcFlowSegment"), "IfcDistributionElementType");
  EXPECT_EQ(ifc::typeClassOf(Schema::ifc4, "IfcSite"), "IfcTypeProduct");
}

// A wall with all that a product can have, beside a part of it, a room and an opening.
std::string fullText() {
  std::string wall = product(100, "IFCWALL", "#202");
  wall.replace(wall.find("'guid100'"), 9, "'2O2Fr$t4X7Zf8NOew3FLOH'");
  wall.replace(wall.find(",$,$);"), 6, ",'T-7',.PARAPET.);");
  return boxSolid(200, "4.", "0.3", "2.5") + wall + product(110, "IFCBUILDINGELEMENTPART", "#212") +
         boxSolid(210, "1.", "0.1", "1.") + product(120, "IFCOPENINGELEMENT", "#222") +
         boxSolid(220, "1.", "1.", "1.") +
         "#130=IFCSPACE('0000000000000000000130',$,'101',$,$,#3,#131,'Kitchen',.ELEMENT.,$,$);\n"
         "#131=IFCPRODUCTDEFINITIONSHAPE($,$,(#132));\n#132=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#232));\n" +
         boxSolid(230, "3.", "3.", "2.4") +
         "#300=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000300',$,$,$,(#100),#22);\n"
         "#301=IFCRELAGGREGATES('0000000000000000000301',$,$,$,#100,(#110));\n"
         "#302=IFCRELAGGREGATES('0000000000000000000302',$,$,$,#22,(#130));\n"
         "#310=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n#311=IFCSIUNIT(*,.POWERUNIT.,$,.WATT.);\n"
         "#312=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.);\n"
         "#313=IFCSIUNIT(*,.THERMODYNAMICTEMPERATUREUNIT.,$,.KELVIN.);\n"
         "#314=IFCDERIVEDUNITELEMENT(#311,1);\n#315=IFCDERIVEDUNITELEMENT(#312,-1);\n"
         "#316=IFCDERIVEDUNITELEMENT(#313,-1);\n"
         "#317=IFCDERIVEDUNIT((#314,#315,#316),.THERMALTRANSMITTANCEUNIT.,$);\n"
         "#320=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('30'),$);\n"
         "#321=IFCPROPERTYSINGLEVALUE('Width',$,IFCPOSITIVELENGTHMEASURE(300.),#310);\n"
         "#322=IFCPROPERTYSINGLEVALUE('Length',$,IFCLENGTHMEASURE(4.),$);\n"
         "#323=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);\n"
         "#324=IFCPROPERTYSINGLEVALUE('U',$,IFCTHERMALTRANSMITTANCEMEASURE(0.24),#317);\n"
         "#325=IFCPROPERTYSINGLEVALUE('Storeys',$,IFCINTEGER(2),$);\n"
         "#326=IFCPROPERTYSINGLEVALUE('Share',$,IFCREAL(0.5),$);\n"
         "#327=IFCPROPERTYSINGLEVALUE('Note',$,$,$);\n#328=IFCPROPERTYSINGLEVALUE('Empty',$,IFCTEXT(''),$);\n"
         "#330=IFCPROPERTYSET('0000000000000000000330',$,'Pset_WallCommon',$,(#320,#321,#322,#323,#324,#325,#326,#327,"
         "#328));\n"
         "#331=IFCRELDEFINESBYPROPERTIES('0000000000000000000331',$,$,$,(#100),#330);\n"
         "#335=IFCQUANTITYAREA('NetArea',$,$,9.5,$);\n"
         "#336=IFCELEMENTQUANTITY('0000000000000000000336',$,'Qto_WallBaseQuantities',$,$,(#335));\n"
         "#337=IFCRELDEFINESBYPROPERTIES('0000000000000000000337',$,$,$,(#100),#336);\n"
         "#340=IFCWALLTYPE('0000000000000000000340',$,'Basalt 30',$,$,$,$,$,$,.STANDARD.);\n"
         "#341=IFCRELDEFINESBYTYPE('0000000000000000000341',$,$,$,(#100),#340);\n"
         "#350=IFCCLASSIFICATION($,$,$,'Uniclass',$,$,$);\n"
         "#351=IFCCLASSIFICATIONREFERENCE($,'Ss_25_10','Walls',#350,$,$);\n"
         "#352=IFCRELASSOCIATESCLASSIFICATION('0000000000000000000352',$,$,$,(#100),#351);\n"
         "#355=IFCMATERIAL('Basalt',$,'stone');\n#356=IFCMATERIAL('Plaster',$,$);\n"
         "#357=IFCMATERIALLAYER(#355,0.28,$,$,$,$,$);\n#358=IFCMATERIALLAYER(#356,0.02,$,$,$,$,$);\n"
         "#359=IFCMATERIALLAYERSET((#357,#358),'Outer wall',$);\n"
         "#360=IFCRELASSOCIATESMATERIAL('0000000000000000000360',$,$,$,(#100),#359);\n"
         "#361=IFCPROPERTYSINGLEVALUE('MassDensity',$,IFCREAL(2900.),$);\n"
         "#362=IFCMATERIALPROPERTIES('Pset_MaterialCommon',$,(#361),#355);\n"
         "#363=IFCRELASSOCIATESMATERIAL('0000000000000000000363',$,$,$,(#110),#355);\n"
         "#370=IFCSYSTEM('0000000000000000000370',$,'Heating',$,$);\n"
         "#371=IFCRELASSIGNSTOGROUP('0000000000000000000371',$,$,$,(#100),$,#370);\n"
         "#380=IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,(#102),$);\n";
}

TEST(IfcWriter, GivesAProductBackWithAllThatItHad) {
  const ImportedModel source = importText(ifcText(fullText()));
  const Written w = written(source.environment, source.georeference);
  const Product &before = productOf(source, "#100"), &after = comeBack(w.again, "Product 100");
  EXPECT_EQ(after.global_id, "2O2Fr$t4X7Zf8NOew3FLOH");
  EXPECT_EQ(after.ifc_class, before.ifc_class);
  EXPECT_EQ(after.predefined_type, "PARAPET");
  EXPECT_EQ(after.type_name, "Basalt 30");
  EXPECT_EQ(after.storey, "Ground");
  EXPECT_EQ(after.materials, before.materials);
  EXPECT_EQ(after.groups, before.groups);
  ASSERT_EQ(after.layers.size(), 2U);
  EXPECT_EQ(after.layers[1].name, "Plaster");
  EXPECT_DOUBLE_EQ(after.layers[0].thickness_m, 0.28);
  EXPECT_EQ(propertyTexts(after.properties), propertyTexts(before.properties));
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('30'),$)"));
  EXPECT_THAT(w.text, HasSubstr("IFCBOOLEAN(.T.)"));
  EXPECT_THAT(w.text, HasSubstr("IFCQUANTITYAREA('NetArea',$,$,9.5,$)"));
  EXPECT_THAT(w.text, HasSubstr("IFCCLASSIFICATIONREFERENCE($,'Ss_25_10','Walls',"));
  EXPECT_THAT(w.text, HasSubstr("IFCMATERIALPROPERTIES('Pset_MaterialCommon',"));
}

// What comes back has the text and the type that it had.
TEST(IfcWriter, WritesSeveralValuesAndComplexPropertiesAsWhatTheyAre) {
  const ImportedModel source = importText(ifcText(
      boxSolid(200, "4.", "0.3", "2.5") + product(100, "IFCWALL", "#202") +
      "#310=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n"
      "#320=IFCPROPERTYENUMERATEDVALUE('Status',$,(IFCLABEL('NEW'),IFCLABEL('30')),$);\n"
      "#321=IFCPROPERTYLISTVALUE('Widths',$,(IFCLENGTHMEASURE(12.),IFCLENGTHMEASURE(15.5)),#310);\n"
      "#322=IFCPROPERTYBOUNDEDVALUE('Range',$,IFCREAL(8.),IFCREAL(2.),$,IFCREAL(5.));\n"
      "#323=IFCPROPERTYBOUNDEDVALUE('Least',$,$,IFCPOWERMEASURE(2.),$,$);\n"
      "#324=IFCPROPERTYLISTVALUE('Words',$,(IFCLABEL('a, b'),IFCLABEL('c')),$);\n"
      "#325=IFCPROPERTYSINGLEVALUE('Deep',$,IFCINTEGER(7),$);\n#326=IFCPROPERTYSINGLEVALUE('Outer',$,IFCREAL(1.),$);\n"
      "#327=IFCCOMPLEXPROPERTY('Inner',$,'u',(#325,#321));\n#328=IFCCOMPLEXPROPERTY('Outer',$,'u',(#327,#325));\n"
      "#330=IFCPROPERTYSET('0000000000000000000330',$,'Set',$,(#320,#321,#322,#323,#324,#328,#326));\n"
      "#331=IFCRELDEFINESBYPROPERTIES('0000000000000000000331',$,$,$,(#100),#330);\n"
      "#335=IFCQUANTITYAREA('Net',$,$,9.5,$);\n#336=IFCPHYSICALCOMPLEXQUANTITY('Layer',$,(#335),'layer',$,$);\n"
      "#337=IFCELEMENTQUANTITY('0000000000000000000337',$,'Qto',$,$,(#335,#336));\n"
      "#338=IFCRELDEFINESBYPROPERTIES('0000000000000000000338',$,$,$,(#100),#337);\n"));
  const auto before = propertyTexts(productOf(source, "#100").properties);
  EXPECT_THAT(before, ::testing::Contains("Set | Status | NEW, 30 | IFCPROPERTYENUMERATEDVALUE(IFCLABEL)"));
  EXPECT_THAT(before, ::testing::Contains("Set › Outer › Inner | Deep | 7 | IFCINTEGER"));
  EXPECT_THAT(before, ::testing::Contains("Qto › Layer | Net | 9.5 | IFCQUANTITYAREA"));
  const Written w = written(source.environment, source.georeference);
  auto expected = before;
  // What its text alone does not take apart comes back as a label.
  std::replace(expected.begin(), expected.end(), std::string("Set | Words | a, b, c | "),
               std::string("Set | Words | a, b, c | IFCLABEL"));
  EXPECT_EQ(propertyTexts(comeBack(w.again, "Product 100").properties), expected);
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYENUMERATEDVALUE('Status',$,(IFCLABEL('NEW'),IFCLABEL('30')),$)"));
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYLISTVALUE('Widths',$,(IFCLENGTHMEASURE(12.),IFCLENGTHMEASURE(15.5)),#"));
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYBOUNDEDVALUE('Range',$,IFCREAL(8.),IFCREAL(2.),$,IFCREAL(5.))"));
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYBOUNDEDVALUE('Least',$,$,IFCPOWERMEASURE(2.),"));
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYSINGLEVALUE('Words',$,IFCLABEL('a, b, c'),$)"));
  EXPECT_THAT(w.text, HasSubstr("IFCCOMPLEXPROPERTY('Inner',$,'Inner',(#"));
  EXPECT_THAT(w.text, HasSubstr("IFCCOMPLEXPROPERTY('Outer',$,'Outer',(#"));
  EXPECT_THAT(w.text, HasSubstr("IFCPHYSICALCOMPLEXQUANTITY('Layer',$,(#"));
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYSET("));
}

TEST(IfcWriter, KeepsPlacesPartsAndRoomsAndTellsWhatItLeavesOut) {
  const ImportedModel source = importText(ifcText(fullText()));
  const Written w = written(source.environment, source.georeference);
  EXPECT_EQ(w.summary.schema, "IFC4");
  EXPECT_EQ(w.summary.products, 3U);
  EXPECT_EQ(w.summary.triangles, 36U);
  ASSERT_EQ(w.again.environment.spatial.size(), source.environment.spatial.size());
  for (std::size_t i = 0; i < source.environment.spatial.size(); ++i) {
    EXPECT_EQ(w.again.environment.spatial[i].global_id, source.environment.spatial[i].global_id);
    EXPECT_EQ(w.again.environment.spatial[i].ifc_class, source.environment.spatial[i].ifc_class);
    EXPECT_DOUBLE_EQ(w.again.environment.spatial[i].elevation_m, source.environment.spatial[i].elevation_m);
  }
  const Product& part = comeBack(w.again, "Product 110");
  ASSERT_GE(part.whole, 0);
  EXPECT_EQ(w.again.environment.products[static_cast<std::size_t>(part.whole)].name, "Product 100");
  const Product& room = comeBack(w.again, "101");
  EXPECT_FALSE(room.tangible);
  EXPECT_THAT(propertyTexts(room.properties), ::testing::Contains("Attributes | LongName | Kitchen | "));
  EXPECT_THAT(told(w.report),
              ::testing::Contains(HasSubstr("IfcOpeningElement: 1 not exported: not part of the scene")));
  EXPECT_EQ(bounds(w.again.environment).max, Eigen::Vector3d(2, 1.5, 2.5));  // the room's
}

TEST(IfcWriter, LeavesOutWhatTheAuthorExcluded) {
  ImportedModel source = importText(ifcText(fullText()));
  for (Product& p : source.environment.products) p.excluded = p.name == "Product 100";
  const Written w = written(source.environment, source.georeference);
  EXPECT_EQ(w.summary.products, 2U);
  // The part of what is not there stands in the storey itself.
  const Product& part = comeBack(w.again, "Product 110");
  EXPECT_EQ(part.whole, -1);
  EXPECT_EQ(part.storey, "Ground");
}

TEST(IfcWriter, MakesStoreysOfTheNamesThatProductsOfOtherFormatsHave) {
  Environment e = wedges({Eigen::Affine3d::Identity(), Eigen::Affine3d(Eigen::Translation3d(0, 0, 3))});
  e.products[0].storey = "Ground";
  e.products[1].storey = "Upper";
  const Written w = written(e);
  EXPECT_EQ(comeBack(w.again, "Wedge 0").storey, "Ground");
  EXPECT_EQ(comeBack(w.again, "Wedge 1").storey, "Upper");
  EXPECT_EQ(comeBack(w.again, "Wedge 1").ifc_class, "IfcBuildingElementProxy");
  EXPECT_TRUE(ifc::isGlobalId(comeBack(w.again, "Wedge 0").global_id));
}

// Cities and fragments have places, but no project above them.
TEST(IfcWriter, NamesAProjectThatTheModelDoesNotHave) {
  Environment e = wedges({Eigen::Affine3d::Identity()});
  e.spatial = {{"/", "IfcSite", "Quarter", "", -1, 0, {}}};
  e.products[0].container = 0;
  const Written w = written(e);
  ASSERT_EQ(w.again.environment.spatial.size(), 2U);
  EXPECT_EQ(w.again.environment.spatial[0].ifc_class, "IfcProject");
  EXPECT_EQ(w.again.environment.spatial[0].name, "Model");
  EXPECT_EQ(w.again.environment.spatial[1].name, "Quarter");
  const ImportedModel own = importText(ifcText(fullText()));
  EXPECT_EQ(written(own.environment).again.environment.spatial[0].name, own.environment.spatial[0].name);
}

TEST(IfcWriter, WritesASharedMeshOnceAndAMirroredOneOnceMore) {
  Eigen::Affine3d turned(Eigen::Translation3d(10, 0, 0) *
                         Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()));
  Eigen::Affine3d mirrored(Eigen::Translation3d(20, 0, 0) * Eigen::Scaling(-1.0, 1.0, 1.0));
  Eigen::Affine3d stretched(Eigen::Translation3d(30, 0, 0) * Eigen::Scaling(2.0, 1.0, 0.5));
  const Environment e = wedges({Eigen::Affine3d::Identity(), turned, mirrored, stretched});
  const Written w = written(e);
  std::size_t lists = 0;
  for (std::size_t at = w.text.find("IFCCARTESIANPOINTLIST3D("); at != std::string::npos;
       at = w.text.find("IFCCARTESIANPOINTLIST3D(", at + 1))
    ++lists;
  EXPECT_EQ(lists, 3U);
  const auto before = productBounds(e), after = productBounds(w.again.environment);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((before[i].min - after[i].min - w.again.georeference.shift_m).norm(), 1e-6) << i;
    EXPECT_LT((before[i].max - after[i].max - w.again.georeference.shift_m).norm(), 1e-6) << i;
    EXPECT_NEAR(volumeOf(w.again, comeBack(w.again, "Wedge " + std::to_string(i)).id), 1, 1e-6) << i;
  }
}

TEST(IfcWriter, KeepsACoordinateFarAwayToTheLastDigit) {
  Georeference far;
  far.shift_m = {456'000, 5'429'000, 100};
  far.map_from_file = MapConversion{1, 2, 3, 0.8, 0.6, 0.9996};
  far.crs = "EPSG:25832";
  far.site = GeographicPosition{49.0125, -8.5, 115.3};
  far.true_north_rad = 0.25;
  const Written w = written(wedges({Eigen::Affine3d(Eigen::Translation3d(780.33, 120.28, 15.1))}), far);
  const Georeference& g = w.again.georeference;
  const Bounds b = bounds(w.again.environment);
  EXPECT_NEAR(b.min.x() + g.shift_m.x(), 456'780.33, 1e-9);
  EXPECT_NEAR(b.min.y() + g.shift_m.y(), 5'429'120.28, 1e-9);
  EXPECT_NEAR(b.min.z() + g.shift_m.z(), 115.1, 1e-9);
  ASSERT_TRUE(g.map_from_file);
  EXPECT_EQ(g.map_from_file->eastings_m, 1);
  EXPECT_EQ(g.map_from_file->x_axis_ordinate, 0.6);
  EXPECT_EQ(g.map_from_file->scale, 0.9996);
  EXPECT_EQ(g.crs, "EPSG:25832");
  ASSERT_TRUE(g.site);
  EXPECT_NEAR(g.site->longitude_deg, -8.5, 1e-9);
  EXPECT_NEAR(g.true_north_rad.value_or(0), 0.25, 1e-12);
}

TEST(IfcWriter, TakesIfc4x3WhereFactorsOfTheMapOrARoadNeedIt) {
  Georeference scaled;
  scaled.map_from_file = MapConversion{};
  scaled.map_from_file->factors = {1, 1, 0.5};
  scaled.crs = "EPSG:25832";
  const Written w = written(wedges({Eigen::Affine3d::Identity()}), scaled);
  EXPECT_EQ(w.summary.schema, "IFC4X3_ADD2");
  EXPECT_EQ(w.again.georeference.map_from_file->factors.z(), 0.5);
  Environment road = wedges({Eigen::Affine3d::Identity()});
  road.products[0].ifc_class = "IfcCourse";
  EXPECT_EQ(written(road).summary.schema, "IFC4X3_ADD2");
}

TEST(IfcWriter, GivesEachSurfaceItsLookAndItsPhysicalMaterialBack) {
  Environment e = wedges({Eigen::Affine3d::Identity()});
  auto mesh = std::make_shared<Mesh>(*wedge());
  mesh->surface_of_triangle = {0, 0, 1, 1};
  e.meshes = {mesh};
  e.surfaces = {{"Stone", {0.25F, 0.5F, 0.75F, 1}}, {"Glass", {0.5F, 0.5F, 1, 0.25F}}};
  PhysicalMaterial pane;
  pane.id = "glass_clear";
  pane.label = "Glass, clear";
  pane.reflectance = {{532, 0.04}, {1064, 0.05}};
  pane.transmittance = {{532, 0.9}};
  pane.index_of_refraction = 1.52;
  const Written w = written(e, {}, {nullptr, &pane});
  ASSERT_EQ(w.again.environment.surfaces.size(), 2U);
  const Surface &stone = w.again.environment.surfaces[0], &glass = w.again.environment.surfaces[1];
  EXPECT_EQ(stone.name, "Stone");
  EXPECT_EQ(stone.colour, e.surfaces[0].colour);
  EXPECT_EQ(stone.physical_material, "");
  EXPECT_EQ(glass.name, "Glass");
  EXPECT_EQ(glass.colour, e.surfaces[1].colour);
  EXPECT_EQ(glass.physical_material, "glass_clear");
  EXPECT_THAT(w.text, HasSubstr("IFCPROPERTYTABLEVALUE('Reflectance','over the wavelength in nm',(IFCREAL(532.),"
                                "IFCREAL(1064.)),(IFCREAL(0.04),IFCREAL(0.05)),$,$,$,.LINEAR.)"));
}

TEST(IfcWriter, TellsOfGlobalIdsThatItCouldNotKeepAndOfImages) {
  Environment e = wedges({Eigen::Affine3d::Identity(), Eigen::Affine3d::Identity()});
  e.products[0].global_id = e.products[1].global_id = "2O2Fr$t4X7Zf8NOew3FLOH";
  e.images.push_back(std::make_shared<Image>());
  e.surfaces[0].image = 0;
  const Written w = written(e);
  EXPECT_THAT(told(w.report),
              ::testing::Contains(HasSubstr("GlobalId: 1 invalid or duplicate GlobalIds were replaced")));
  EXPECT_THAT(told(w.report), ::testing::Contains(HasSubstr("images of 1 surfaces were not exported")));
  EXPECT_EQ(comeBack(w.again, "Wedge 0").global_id, "2O2Fr$t4X7Zf8NOew3FLOH");
  EXPECT_NE(comeBack(w.again, "Wedge 1").global_id, "2O2Fr$t4X7Zf8NOew3FLOH");
}

TEST(IfcWriter, WritesTheSameBytesEachTime) {
  const ImportedModel source = importText(ifcText(fullText()));
  EXPECT_EQ(written(source.environment, source.georeference).text.substr(300),
            written(source.environment, source.georeference).text.substr(300));
}

}  // namespace
}  // namespace standpoint::test
