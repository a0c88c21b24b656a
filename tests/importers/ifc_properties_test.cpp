// SPDX-License-Identifier: GPL-3.0-or-later
// What the file says of its products besides their shape: each value is written in the small file of its test.
#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

std::string text(const std::vector<Property>& properties) {
  std::string all;
  for (const Property& p : properties) all += p.set + "." + p.name + "=" + p.value + "\n";
  return all;
}

std::string withSet(const std::string& properties, const std::string& ids) {
  return "#110=IFCWALL('g',$,'W',$,$,#3,$,$,$);\n" + properties + "#190=IFCPROPERTYSET('p',$,'Set',$,(" + ids +
         "));\n#191=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#110),#190);\n";
}

TEST(IfcProperties, EveryKindOfValueIsTextWithItsUnit) {
  const ImportedModel model = importText(ifcText(withSet(
      "#60=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n#61=IFCSIUNIT(*,.POWERUNIT.,$,.WATT.);\n"
      "#120=IFCPROPERTYENUMERATEDVALUE('Status',$,(IFCLABEL('NEW'),IFCLABEL('TEMPORARY')),$);\n"
      "#121=IFCPROPERTYLISTVALUE('Widths',$,(IFCLENGTHMEASURE(12.),IFCLENGTHMEASURE(15.5)),#60);\n"
      "#122=IFCPROPERTYBOUNDEDVALUE('Range',$,IFCREAL(8.),IFCREAL(2.),$,IFCREAL(5.));\n"
      "#123=IFCPROPERTYTABLEVALUE('Curve',$,(IFCLENGTHMEASURE(1.),IFCLENGTHMEASURE(2.)),(IFCPOWERMEASURE(10.),"
      "IFCPOWERMEASURE(40.)),$,$,#61,$);\n"
      "#124=IFCMATERIAL('Brick',$,$);\n#125=IFCPROPERTYREFERENCEVALUE('Made of','usage',$,#124);\n"
      "#126=IFCPROPERTYSINGLEVALUE('Deep',$,IFCINTEGER(7),$);\n#127=IFCCOMPLEXPROPERTY('Outer',$,'u',(#126));\n",
      "#120,#121,#122,#123,#125,#127")));
  EXPECT_EQ(text(productOf(model, "#110").properties),
            "Set.Status=NEW, TEMPORARY\nSet.Widths=12 mm, 15.5 mm\nSet.Range=5 (2 … 8)\nSet.Curve=1 m → 10 W; 2 m → 40 "
            "W\nSet.Made of=IfcMaterial Brick\nSet › Outer.Deep=7\n");
}

TEST(IfcProperties, DerivedUnitsAreWrittenOut) {
  std::string file =
      ifcText(withSet("#120=IFCPROPERTYSINGLEVALUE('U',$,IFCTHERMALTRANSMITTANCEMEASURE(0.24),$);\n"
                      "#121=IFCSIUNIT(*,.POWERUNIT.,$,.WATT.);\n#122=IFCSIUNIT(*,.THERMODYNAMICTEMPERATUREUNIT.,$,."
                      "KELVIN.);\n#123=IFCDERIVEDUNITELEMENT(#121,1);\n"
                      "#124=IFCDERIVEDUNITELEMENT(#10,-2);\n#125=IFCDERIVEDUNITELEMENT(#122,-1);\n#126=IFCDERIVEDUNIT(("
                      "#123,#124,#125),.THERMALTRANSMITTANCEUNIT.,$);\n",
                      "#120"));
  file.replace(file.find("(#10,#13)"), 9, "(#10,#13,#126)");
  EXPECT_EQ(text(productOf(importText(file), "#110").properties), "Set.U=0.24 W/(m²·K)\n");
}

TEST(IfcProperties, ASetOfSetsAndTheDoorStylesLiningsCount) {
  const ImportedModel model =
      importText(ifcText("#110=IFCDOOR('g',$,'D','wide','Type "
                         "A',#3,$,'T-7',2.1,0.9);\n#120=IFCPROPERTYSINGLEVALUE('A',$,IFCLABEL('x'),$);\n#121="
                         "IFCPROPERTYSET('p',$,'One',$,(#120));\n#122=IFCPROPERTYSET('q',$,'Two',$,(#120));\n"
                         "#123=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#110),IFCPROPERTYSETDEFINITIONSET((#121,#122)));\n"
                         "#130=IFCDOORLININGPROPERTIES('l',$,'Lining',$,0.1,0.05,$,$,$,$,$,$,$,$,$);\n#131="
                         "IFCDOORPANELPROPERTIES('n',$,$,$,0.04,.SWINGING.,1.,.LEFT.,$);\n"
                         "#132=IFCDOORSTYLE('s',$,'Inner "
                         "door',$,$,(#130,#131),$,$,.SINGLE_SWING_LEFT.,.WOOD.,.T.,.F.);\n#133=IFCRELDEFINESBYTYPE('t',"
                         "$,$,$,(#110),#132);\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC2X3"));
  const Product& door = productOf(model, "#110");
  EXPECT_EQ(door.type_name, "Inner door");
  EXPECT_EQ(text(door.properties),
            "Attributes.Description=wide\nAttributes.ObjectType=Type "
            "A\nAttributes.Tag=T-7\nAttributes.OverallHeight=2.1 m\nAttributes.OverallWidth=0.9 m\nOne.A=x\nTwo.A=x\n"
            "Lining.LiningDepth=0.1 m\nLining.LiningThickness=0.05 m\nIfcDoorPanelProperties.PanelDepth=0.04 "
            "m\nIfcDoorPanelProperties.PanelOperation=SWINGING\n"
            "IfcDoorPanelProperties.PanelWidth=1\nIfcDoorPanelProperties.PanelPosition=LEFT\n");
}

TEST(IfcProperties, AUserDefinedTypeIsTheUsersWordAndAnUndefinedOneTheTypes) {
  const ImportedModel model = importText(ifcText(
      "#110=IFCWALL('a',$,'A',$,'Plinth',#3,$,$,.USERDEFINED.);\n#111=IFCWALL('b',$,'B',$,$,#3,$,$,.NOTDEFINED.);\n#"
      "112=IFCWALL('c',$,'C',$,$,#3,$,$,$);\n"
      "#120=IFCWALLTYPE('t',$,'T',$,$,$,$,$,$,.PARTITIONING.);\n#121=IFCRELDEFINESBYTYPE('r',$,$,$,(#111),#120);\n#122="
      "IFCWALLTYPE('u',$,'U',$,$,$,$,$,'Clinker',.USERDEFINED.);\n#123=IFCRELDEFINESBYTYPE('s',$,$,$,(#112),#122);\n"));
  EXPECT_EQ(productOf(model, "#110").predefined_type, "Plinth");
  EXPECT_EQ(productOf(model, "#111").predefined_type, "PARTITIONING");
  EXPECT_EQ(productOf(model, "#112").predefined_type, "Clinker");
}

TEST(IfcProperties, GroupsSystemsAndOtherPlacesAreTold) {
  const ImportedModel model =
      importText(ifcText("#110=IFCPIPESEGMENT('a',$,'A',$,$,#3,$,$,$);\n#120=IFCSYSTEM('s',$,'Heating',$,$);\n#121="
                         "IFCRELASSIGNSTOGROUP('r',$,$,$,(#110),$,#120);\n"
                         "#122=IFCGROUP('g',$,'Building "
                         "services',$,$);\n#123=IFCRELASSIGNSTOGROUP('q',$,$,$,(#120),$,#122);\n#124="
                         "IFCRELASSIGNSTOGROUP('o',$,$,$,(#122),$,#120);\n"  // and in a circle
                         "#125=IFCRELREFERENCEDINSPATIALSTRUCTURE('f',$,$,$,(#110),#22);\n"));
  EXPECT_EQ(productOf(model, "#110").groups,
            (std::vector<std::string>{"IfcSystem Heating", "IfcGroup Building services",
                                      "IfcBuildingStorey Ground (referenced)"}));
}

TEST(IfcProperties, ClassificationsDocumentsAndPresentationLayersAreProperties) {
  const ImportedModel model = importText(
      ifcText(boxSolid(100, "4.", "0.3", "3.") + product(110, "IFCWALL", "#102") +
              "#120=IFCCLASSIFICATION('NBS',$,$,'Uniclass',$,$,$);\n#121=IFCCLASSIFICATIONREFERENCE($,'Ss_25','Wall "
              "systems',#120,$,$);\n#122=IFCCLASSIFICATIONREFERENCE($,'Ss_25_10','Framed walls',#121,$,$);\n"
              "#123=IFCRELASSOCIATESCLASSIFICATION('c',$,$,$,(#110),#122);\n#124=IFCPRESENTATIONLAYERASSIGNMENT('A-"
              "WALL',$,(#112),$);\n"));
  EXPECT_EQ(text(productOf(model, "#110").properties),
            "Classification.Uniclass=Ss_25_10 Framed walls\nPresentation layer.Name=A-WALL\n");
}

TEST(IfcProperties, PresentationLayersOfItemsRepresentationsAndMapsAreToldOnceEach) {
  const ImportedModel model =
      importText(ifcText(boxSolid(100, "4.", "0.3", "3.") + product(110, "IFCWALL", "#102") +
                         "#113=IFCREPRESENTATIONMAP(#2,#112);\n#114=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#1,$,$);"
                         "\n#115=IFCMAPPEDITEM(#113,#114);\n" +
                         product(120, "IFCWALL", "#115", "MappedRepresentation") +
                         "#130=IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,(#112,#102),$);\n#131="
                         "IFCPRESENTATIONLAYERWITHSTYLE('A-MAPPED',$,(#115),$,.T.,.F.,.F.,());\n"));
  EXPECT_EQ(text(productOf(model, "#110").properties), "Presentation layer.Name=A-WALL\n");
  EXPECT_EQ(text(productOf(model, "#120").properties),
            "Presentation layer.Name=A-MAPPED\nPresentation layer.Name=A-WALL\n");
}

TEST(IfcProperties, APlaceHasItsPropertiesToo) {
  const ImportedModel model = importText(
      ifcText("#110=IFCSPACE('s',$,'101',$,$,#3,$,'Kitchen',.ELEMENT.,.INTERNAL.,$);\n#111=IFCRELAGGREGATES('a',$,$,$,#"
              "22,(#110));\n"
              "#120=IFCQUANTITYAREA('NetFloorArea',$,$,12.5,$);\n#121=IFCELEMENTQUANTITY('q',$,'Qto_"
              "SpaceBaseQuantities',$,$,(#120));\n#122=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#110),#121);\n"));
  ASSERT_EQ(model.environment.spatial.size(), 4U);
  EXPECT_EQ(
      text(model.environment.spatial[3].properties),
      "Attributes.PredefinedType=INTERNAL\nAttributes.LongName=Kitchen\nQto_SpaceBaseQuantities.NetFloorArea=12.5\n");
  EXPECT_EQ(text(model.environment.spatial[2].properties), "Attributes.Elevation=2.5 m\n");
}

TEST(IfcProperties, ConstituentsProfilesAndTheMaterialsOwnPropertiesAreTold) {
  const ImportedModel model = importText(ifcText(
      "#110=IFCWINDOW('a',$,'A',$,$,#3,$,$,$,$,$,$,$);\n#111=IFCBEAM('b',$,'B',$,$,#3,$,$,$);\n"
      "#120=IFCMATERIAL('Oak',$,'wood');\n#121=IFCMATERIAL('Glass',$,$);\n#122=IFCMATERIALCONSTITUENT('Lining',$,#120,"
      "0.3,$);\n#123=IFCMATERIALCONSTITUENT('Glazing',$,#121,$,$);\n"
      "#124=IFCMATERIALCONSTITUENTSET('Window',$,(#122,#123));\n#125=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#124);\n"
      "#126=IFCPROPERTYSINGLEVALUE('MassDensity',$,IFCREAL(720.),$);\n#127=IFCMATERIALPROPERTIES('Pset_MaterialCommon',"
      "$,(#126),#120);\n"
      "#130=IFCRECTANGLEPROFILEDEF(.AREA.,'10x20',#7,0.1,0.2);\n#131=IFCMATERIALPROFILE($,$,#120,#130,$,$);\n#132="
      "IFCMATERIALPROFILESET('Joist',$,(#131),$);\n#133=IFCMATERIALPROFILESETUSAGE(#132,5,$);\n"
      "#134=IFCRELASSOCIATESMATERIAL('n',$,$,$,(#111),#133);\n"));
  EXPECT_EQ(productOf(model, "#110").materials, (std::vector<std::string>{"Oak", "Glass"}));
  EXPECT_EQ(text(productOf(model, "#110").properties),
            "Material.ConstituentSet=Window\nMaterial.Lining=Oak, "
            "0.3\nMaterial.Glazing=Glass\nOak/Pset_MaterialCommon.MassDensity=720\n");
  EXPECT_EQ(text(productOf(model, "#111").properties),
            "Material.ProfileSet=Joist\nMaterial.Profile=Oak, "
            "10x20\nMaterial.CardinalPoint=5\nOak/Pset_MaterialCommon.MassDensity=720\n");
}

TEST(IfcProperties, PropertiesThatMultiplyAreCutWithALoss) {
  std::string bomb;  // eight levels of ten: a hundred million
  for (int level = 0; level < 8; ++level) {
    std::string parts;
    for (int k = 0; k < 10; ++k) parts += (k ? ",#" : "#") + std::to_string(121 + level);
    bomb += "#" + std::to_string(120 + level) + "=IFCCOMPLEXPROPERTY('L',$,'u',(" + parts + "));\n";
  }
  const ImportedModel model =
      importText(ifcText(withSet(bomb + "#128=IFCPROPERTYSINGLEVALUE('V',$,IFCREAL(1.),$);\n", "#120,#121")));
  EXPECT_EQ(productOf(model, "#110").properties.size(), 10000U);
  EXPECT_EQ(issuesOf(model), "loss #110: has more than 10 000 properties; the rest were skipped\n");
}

TEST(IfcProperties, OldOpticalPropertiesOfAMaterialAreTold) {
  const ImportedModel model =
      importText(ifcText("#110=IFCPLATE('a',$,'A',$,$,#3,$,$);\n#120=IFCMATERIAL('Glass');\n#121="
                         "IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#120);\n"
                         "#122=IFCOPTICALMATERIALPROPERTIES(#120,0.8,$,$,$,$,$,0.1,$,$);\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC2X3"));
  EXPECT_EQ(text(productOf(model, "#110").properties),
            "Glass/IfcOpticalMaterialProperties.VisibleTransmittance=0.8\nGlass/"
            "IfcOpticalMaterialProperties.VisibleReflectanceFront=0.1\n");
}

}  // namespace
}  // namespace standpoint::test
