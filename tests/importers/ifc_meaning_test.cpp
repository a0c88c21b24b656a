// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

const std::string kBox = boxSolid(100, "4.", "0.3", "3.");

TEST(IfcMeaning, TheTreeHasParentsBeforeChildrenAndProductsKnowTheirStorey) {
  const ImportedModel model =
      importText(ifcText(kBox + product(110, "IFCWALLSTANDARDCASE", "#102") + product(120, "IFCDOOR", "#102") +
                             "#130=IFCRELCONTAINEDINSPATIALSTRUCTURE('c',$,$,$,(#110),#22);\n"
                             "#131=IFCRELNESTS('n',$,$,$,#110,(#120));\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC2X3"));
  const auto& spatial = model.environment.spatial;
  ASSERT_EQ(spatial.size(), 3U);
  EXPECT_EQ(spatial[0].ifc_class, "IfcProject");
  EXPECT_EQ(spatial[2].name, "Ground");
  EXPECT_EQ(spatial[2].parent, 1);
  EXPECT_NEAR(spatial[2].elevation_m, 2.5, 1e-12);
  EXPECT_EQ(productOf(model, "#110").ifc_class, "IfcWallStandardCase");
  EXPECT_EQ(productOf(model, "#110").storey, "Ground");
  EXPECT_EQ(productOf(model, "#120").storey, "Ground");  // through the wall that it is nested in
  EXPECT_EQ(productOf(model, "#110").global_id, "guid110");
}

TEST(IfcMeaning, PredefinedTypesAreTold) {
  const ImportedModel model = importText(
      ifcText("#110=IFCSLAB('g',$,'S',$,$,#3,$,$,.ROOF.);\n#111=IFCDOOR('h',$,'D',$,$,#3,$,$,2.,1.,.GATE.,$,$);\n"));
  EXPECT_EQ(productOf(model, "#110").predefined_type, "ROOF");
  EXPECT_EQ(productOf(model, "#111").predefined_type, "GATE");
}

TEST(IfcMeaning, LayersComeWithTheirThicknessesAndWithoutAUsageTheFirstNamesTheSurface) {
  const ImportedModel model =
      importText(ifcText(kBox + product(110, "IFCWALL", "#102") +
                             "#120=IFCMATERIAL('Brick',$,$);\n#121=IFCMATERIAL('Plaster',$,$);\n#122=IFCMATERIALLAYER(#"
                             "120,240.,$,$,$,$,$);\n#123=IFCMATERIALLAYER(#121,15.,$,$,$,$,$);\n"
                             "#124=IFCMATERIALLAYERSET((#122,#123),'outer "
                             "wall',$);\n#126=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#124);\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  const Product& wall = productOf(model, "#110");
  EXPECT_EQ(wall.materials, (std::vector<std::string>{"Brick", "Plaster"}));
  ASSERT_EQ(wall.layers.size(), 2U);
  EXPECT_NEAR(wall.layers[0].thickness_m, 0.24, 1e-12);
  ASSERT_EQ(model.environment.surfaces.size(), 1U);
  EXPECT_EQ(model.environment.surfaces[0].name, "Brick");
}

const std::string kStyle =
    "#150=IFCCOLOURRGB($,0.2,0.4,0.6);\n#151=IFCSURFACESTYLERENDERING(#150,0.75,$,$,$,$,$,$,.FLAT.);\n#152="
    "IFCSURFACESTYLE('Glass',.BOTH.,(#151));\n";

TEST(IfcMeaning, AStyledItemColoursItsFacesAndNamesThemWhereThereIsNoMaterial) {
  const ImportedModel model =
      importText(ifcText(kBox + product(110, "IFCWINDOW", "#102") + kStyle + "#153=IFCSTYLEDITEM(#102,(#152),$);\n"));
  ASSERT_EQ(model.environment.surfaces.size(), 1U);
  EXPECT_EQ(model.environment.surfaces[0].name, "Glass");
  EXPECT_EQ(model.environment.surfaces[0].source, "#152");
  EXPECT_FLOAT_EQ(model.environment.surfaces[0].colour.b, 0.6F);
  EXPECT_FLOAT_EQ(model.environment.surfaces[0].colour.a, 0.25F);
}

TEST(IfcMeaning, TheStyleOfAnIfc2x3AssignmentAndTheMaterialOfTheTypeCount) {
  const ImportedModel model =
      importText(ifcText(kBox + product(110, "IFCWINDOW", "#102") + kStyle +
                             "#153=IFCPRESENTATIONSTYLEASSIGNMENT((#152));\n#154=IFCSTYLEDITEM(#102,(#153),$);\n#160="
                             "IFCWINDOWSTYLE('t',$,'T',$,$,$,$,$,.NOTDEFINED.,.NOTDEFINED.,.F.,.F.);\n"
                             "#161=IFCRELDEFINESBYTYPE('r',$,$,$,(#110),#160);\n#162=IFCMATERIAL('Float "
                             "glass');\n#163=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#160),#162);\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC2X3"));
  ASSERT_EQ(model.environment.surfaces.size(), 1U);
  EXPECT_EQ(model.environment.surfaces[0].name, "Float glass");
  EXPECT_FLOAT_EQ(model.environment.surfaces[0].colour.r, 0.2F);
}

TEST(IfcMeaning, AnIndexedColourMapGivesEachFaceItsColour) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(0.,1.,0.),(0.,0.,3.)));\n#101="
              "IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,4)),$);\n" +
              product(110, "IFCFURNISHINGELEMENT", "#101", "Tessellation") +
              "#120=IFCCOLOURRGBLIST(((1.,0.,0.),(0.,1.,0.)));\n#121=IFCINDEXEDCOLOURMAP(#101,$,#120,(1,1,2,1));\n"));
  ASSERT_EQ(model.environment.surfaces.size(), 2U);
  const Mesh& mesh = *model.environment.meshes.at(0);
  std::size_t green = 0;
  for (const std::uint32_t s : mesh.surface_of_triangle) green += model.environment.surfaces[s].colour.g == 1 ? 1 : 0;
  EXPECT_EQ(green, 1U);
}

TEST(IfcMeaning, OfSeveralMaterialsTheStyleTellsWhichIsMeant) {
  const ImportedModel model =
      importText(ifcText(kBox + product(110, "IFCWINDOW", "#102") + kStyle +
                         "#153=IFCSTYLEDITEM(#102,(#152),$);\n"
                         "#160=IFCMATERIAL('Wood',$,$);\n#161=IFCMATERIAL('Glass',$,$);\n#162=IFCMATERIALLIST((#160,#"
                         "161));\n#163=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#162);\n"));
  ASSERT_EQ(model.environment.surfaces.size(), 1U);
  EXPECT_EQ(model.environment.surfaces[0].name, "Glass");
  EXPECT_EQ(model.environment.surfaces[0].source, "#161");
}

TEST(IfcMeaning, PropertiesAndQuantitiesAreTextWithUnitsAndTheOccurrenceWins) {
  const ImportedModel model = importText(ifcText(
      kBox + product(110, "IFCWALL", "#102") +
      "#120=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F "
      "90'),$);\n#121=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);\n#122=IFCPROPERTYSET('p',$,'Pset_"
      "WallCommon',$,(#120,#121));\n"
      "#123=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#110),#122);\n#124=IFCQUANTITYLENGTH('Length',$,$,4.,$);\n#125="
      "IFCELEMENTQUANTITY('q',$,'BaseQuantities',$,$,(#124));\n#126=IFCRELDEFINESBYPROPERTIES('s',$,$,$,(#110),#125);\n"
      "#130=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F "
      "30'),$);\n#131=IFCPROPERTYSINGLEVALUE('Status',$,IFCLABEL('New'),$);\n#132=IFCPROPERTYSET('u',$,'Pset_"
      "WallCommon',$,(#130,#131));\n"
      "#133=IFCWALLTYPE('t',$,'T',$,$,(#132),$,$,$,.STANDARD.);\n#134=IFCRELDEFINESBYTYPE('d',$,$,$,(#110),#133);\n"));
  std::string all;
  for (const Property& p : productOf(model, "#110").properties) all += p.set + "." + p.name + "=" + p.value + ";";
  EXPECT_EQ(all,
            "Pset_WallCommon.FireRating=F 90;Pset_WallCommon.IsExternal=true;BaseQuantities.Length=4 "
            "m;Pset_WallCommon.Status=New;");
}

TEST(IfcMeaning, AMapConversionIsReadInTheUnitOfItsMap) {
  // As in PCERT's scene: map unit millimetre, so that 729013348 means 729 km.
  const ImportedModel model = importText(ifcText(
      "#60=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n#61=IFCPROJECTEDCRS('EPSG:32760',$,'WGS84',$,'UTM','60S',#60);\n"
      "#62=IFCMAPCONVERSION(#12,#61,729013348.8297,9000.,1500.,0.5,0.8660254,1.);\n",
      "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  ASSERT_TRUE(model.georeference.map_from_file.has_value());
  EXPECT_NEAR(model.georeference.map_from_file->eastings_m, 729013.3488297, 1e-6);
  EXPECT_NEAR(model.georeference.map_from_file->orthogonal_height_m, 1.5, 1e-12);
  EXPECT_NEAR(model.georeference.map_from_file->scale, 1, 1e-12);
  EXPECT_EQ(model.georeference.crs, "EPSG:32760");
}

TEST(IfcMeaning, AScaleFromMillimetresToMetresOfTheMapIsNoScaleOfOurs) {
  const ImportedModel model =
      importText(ifcText("#60=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#61=IFCPROJECTEDCRS('25832',$,$,$,$,$,#60);\n#62="
                         "IFCMAPCONVERSION(#12,#61,500000.,5400000.,0.,1.,0.,0.001);\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"));
  EXPECT_NEAR(model.georeference.map_from_file->eastings_m, 500000, 1e-9);
  EXPECT_NEAR(model.georeference.map_from_file->scale, 1, 1e-12);
  EXPECT_EQ(model.georeference.crs, "EPSG:25832");
}

TEST(IfcMeaning, TheConventionOfIfc2x3PutsTheConversionIntoPropertySets) {
  const ImportedModel model = importText(ifcText(
      "#60=IFCSITE('s',$,'Site',$,$,#3,$,$,.ELEMENT.,(52,30,36,500000),(-13,-22,-48),34.5,$,$);\n"
      "#61=IFCPROPERTYSINGLEVALUE('Eastings',$,IFCLENGTHMEASURE(76670.),$);\n#62=IFCPROPERTYSINGLEVALUE('Northings',$,"
      "IFCLENGTHMEASURE(77179.),$);\n#63=IFCPROPERTYSET('p',$,'ePSet_MapConversion',$,(#61,#62));\n"
      "#64=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#60),#63);\n",
      "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC2X3"));
  ASSERT_TRUE(model.georeference.map_from_file.has_value());
  EXPECT_EQ(model.georeference.map_from_file->eastings_m, 76670);
  ASSERT_TRUE(model.georeference.site.has_value());
  EXPECT_NEAR(model.georeference.site->latitude_deg, 52 + 30 / 60.0 + 36.5 / 3600, 1e-12);
  EXPECT_NEAR(model.georeference.site->longitude_deg, -(13 + 22 / 60.0 + 48 / 3600.0), 1e-12);
  EXPECT_NEAR(model.georeference.site->elevation_m, 34.5, 1e-12);
}

TEST(IfcMeaning, SpacesAreListedButNoBeamMeetsThem) {
  const ImportedModel model = importText(ifcText(kBox + product(110, "IFCSPACE", "#102")));
  EXPECT_FALSE(productOf(model, "#110").tangible);
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
}

TEST(IfcMeaning, AClassThatNoSchemaHasIsStillAProduct) {
  const ImportedModel model = importText(ifcText(kBox + product(110, "IFCTELEPORTER", "#102")));
  EXPECT_EQ(productOf(model, "#110").ifc_class, "IfcTeleporter");
  EXPECT_NEAR(volumeOf(model, "#110"), 3.6, 1e-5);
}

TEST(IfcMeaning, APartHasTheMaterialOfTheConstituentOfItsName) {
  // A frame and a pane in one body, of one style; their names tell what each is made of.
  const ImportedModel model = importText(ifcText(
      kBox + boxSolid(103, "1.", "1.", "0.1") + product(110, "IFCWINDOW", "#102,#105") +
      "#160=IFCMATERIAL('Oak',$,$);\n#161=IFCMATERIAL('Float "
      "glass',$,$);\n#162=IFCMATERIALCONSTITUENT('Glazing',$,#161,$,$);\n#163=IFCMATERIALCONSTITUENT('Frame',$,#160,$,$"
      ");\n"
      "#164=IFCMATERIALCONSTITUENTSET('window',$,(#162,#163));\n#165=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#164);\n"
      "#170=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#102));\n#171=IFCSHAPEASPECT((#170),'Frame',$,.F.,#111);\n"
      "#172=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#105));\n#173=IFCSHAPEASPECT((#172),'Glazing',$,.F.,#111);"
      "\n"));
  const Mesh& mesh = *model.environment.meshes.at(0);
  std::map<std::string, float> top;  // by material, how high it reaches
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    for (const std::uint32_t i : mesh.triangles[k]) {
      float& z = top[model.environment.surfaces[mesh.surface_of_triangle[k]].name];
      z = std::max(z, mesh.positions[i].z());
    }
  ASSERT_EQ(top.size(), 2U);
  EXPECT_FLOAT_EQ(top.at("Float glass"), 0.1F);
  EXPECT_GT(top.at("Oak"), 0.5F);
}

}  // namespace
}  // namespace standpoint::test
