// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "materials/colour.h"
#include "materials/pattern.h"
#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

// What the shipped rules make of one square of a product of some class.
std::string assigned(const std::string& surface_name, const std::string& ifc_class = "IfcBuildingElementProxy",
                     Colour colour = {}) {
  Builder b;
  b.product(ifc_class, "", {b.surface(surface_name, colour)});
  return materialId(b.assign(), 0, 0);
}

struct NamedMaterial {
  const char* name;  // as found in real files
  const char* material;
};

class Names : public testing::TestWithParam<NamedMaterial> {};

TEST_P(Names, MeanTheirMaterial) { EXPECT_EQ(assigned(GetParam().name), GetParam().material) << GetParam().name; }

INSTANTIATE_TEST_SUITE_P(
    OfRealFiles, Names,
    testing::Values(
        // English
        NamedMaterial{"Brick, Common", "brick_red_bare"},
        NamedMaterial{"Masonry - Concrete Block", "concrete_cinderblock"},
        NamedMaterial{"Masonry - Grout", "concrete_construction"},
        NamedMaterial{"Concrete, Sand/Cement Screed", "screed_cement"},
        NamedMaterial{"Concrete - Cast-in-Place Concrete - 35 MPa", "concrete_construction"},
        NamedMaterial{"Structural Concrete", "concrete_construction"},
        NamedMaterial{"Gypsum Wall Board", "gypsum_board_painted"}, NamedMaterial{"Plaster - Gypsum", "plaster_gypsum"},
        NamedMaterial{"Glass", "glass_float_clear_6mm"}, NamedMaterial{"Walls:-:glass brick", "glass_double_clear_4mm"},
        NamedMaterial{"Fiberglass Batt", "insulation_board"},
        NamedMaterial{"Metal - Paint Finish - Grey", "paint_grey"},
        NamedMaterial{"Steel, Chrome Plated", "chromium_polished"},
        NamedMaterial{"metal_steel-galvanized", "steel_galvanised_weathered_b"},
        NamedMaterial{"A992 Wide Flange Steel: fu=65  fy=50", "steel_mill_scale"},
        NamedMaterial{"Wood - Sheathing - plywood", "wood_panel"},
        NamedMaterial{"Softwood, Lumber", "wood_pine_sanded"}, NamedMaterial{"Mahogany", "wood_hardwood"},
        NamedMaterial{"Wood - Flooring", "wood_varnished"},
        NamedMaterial{"Roofing - EPDM Membrane", "rubber_black_roof"},
        NamedMaterial{"Roof-Tile French Red", "roof_tile_clay_red"},
        NamedMaterial{"Textile - White", "fabric_cotton_white"}, NamedMaterial{"Ceramic Tile", "tile_glazed_white"},
        NamedMaterial{"Site - Grass", "grass_green_rye"}, NamedMaterial{"bulk-material_topsoil_generic", "soil_all"},
        NamedMaterial{"Arcade sandstone", "sandstone_grey"}, NamedMaterial{"stone_granite_masonry", "granite_grey"},
        NamedMaterial{"Vapor Retarder", "rubber_black"}, NamedMaterial{"Carpet", "carpet"},
        // German
        NamedMaterial{"Kalksandstein", "sand_lime_brick"},
        NamedMaterial{"Leichtbeton 102890359", "concrete_cinderblock"},
        NamedMaterial{"Stahlbeton 65690", "concrete_construction"}, NamedMaterial{"Ziegel", "brick_red_bare"},
        NamedMaterial{"Mauerwerk - Betonblock", "concrete_cinderblock"},
        NamedMaterial{"Gipskarton", "gypsum_board_painted"},
        NamedMaterial{"Metall-Ständerwerk", "steel_galvanised_weathered_b"},
        NamedMaterial{"Metall - Baustahl S235", "steel_mill_scale"}, NamedMaterial{"Unterlagsboden", "screed_cement"},
        NamedMaterial{"Farbe, weiß", "paint_white"}, NamedMaterial{"WÄRMEDÄMMUNG", "insulation_board"},
        NamedMaterial{"Holz Esche", "wood_hardwood"}, NamedMaterial{"Verputz, weiß", "plaster_render"},
        NamedMaterial{"tin_PVC - Lichtgrau", "pvc_grey"},
        // Dutch
        NamedMaterial{"03 Metselwerk - kalkzandsteen C", "sand_lime_brick"},
        NamedMaterial{"03 mw-baksteen - geel (liggend)", "brick_yellow"},
        NamedMaterial{"02 Beton gewapend - prefab", "concrete_bridge_smooth"},
        NamedMaterial{"isolatie_vloer", "insulation_board"}, NamedMaterial{"01 Hout - hardhout", "wood_hardwood"},
        NamedMaterial{"cementdekvloer", "screed_cement"}, NamedMaterial{"gipsplaat", "gypsum_board_painted"},
        NamedMaterial{"05 Staal C", "steel_mill_scale"}, NamedMaterial{"dampremmende_folie", "rubber_black"},
        NamedMaterial{"dak_zink", "zinc_weathered"}, NamedMaterial{"Ytong Separatie Paneel G4/600", "concrete_aerated"},
        // French, Italian, Spanish, Norwegian, Russian, Japanese, Chinese
        NamedMaterial{"Struct. - Béton Mur Porteur #", "concrete_construction"},
        NamedMaterial{"Cloison - Stratifié", "laminate_white"},
        NamedMaterial{"Etanchéité - Pare pluie", "rubber_black"},
        NamedMaterial{"Plaque de plâtre", "gypsum_board_painted"},
        NamedMaterial{"Marbre blanc", "marble_white_weathered"},
        NamedMaterial{"Calcestruzzo armato", "concrete_construction"},
        NamedMaterial{"Muratura in mattoni", "brick_red_bare"}, NamedMaterial{"Acero inoxidable", "stainless_brushed"},
        NamedMaterial{"Ladrillo cerámico", "brick_red_bare"}, NamedMaterial{"Stål - S355", "steel_mill_scale"},
        NamedMaterial{"Dobbelfals Liggende Kledning - RØD", "wood_pine_weathered"},
        NamedMaterial{"Betong Plasstøpt - B35", "concrete_construction"},
        NamedMaterial{"Stender/Isolasjon", "insulation_board"}, NamedMaterial{"Железобетон", "concrete_construction"},
        NamedMaterial{"Деревянный пол", "wood_varnished"}, NamedMaterial{"コンクリート-構造2", "concrete_construction"},
        NamedMaterial{"ガラス - 透明", "glass_float_clear_6mm"},
        NamedMaterial{"メタル-ステンレス", "stainless_brushed"}, NamedMaterial{"玻璃", "glass_float_clear_6mm"}));

// Words that hold the name of another material.
INSTANTIATE_TEST_SUITE_P(ThatMislead, Names,
                         testing::Values(NamedMaterial{"Douglas", "wood_pine_sanded"},
                                         NamedMaterial{"Küchenelement", ""}, NamedMaterial{"Speicher", ""},
                                         NamedMaterial{"Plattenspeicher", ""}, NamedMaterial{"Street", ""},
                                         NamedMaterial{"Air Space", ""}, NamedMaterial{"Glaswolle", "insulation_board"},
                                         NamedMaterial{"Default Wall", ""},
                                         NamedMaterial{"Plexiglas", "pmma_clear_4mm"}));

TEST(Classes, DecideWhereTheNameSaysNothing) {
  EXPECT_EQ(assigned("Default Wall", "IfcWallStandardCase"), "plaster_render");
  EXPECT_EQ(assigned("", "IfcSlab"), "concrete_construction");
  EXPECT_EQ(assigned("", "IfcSite", {0.2F, 0.6F, 0.1F, 1}), "grass_green_rye");
  EXPECT_EQ(assigned("", "IfcDoor", {0.45F, 0.3F, 0.15F, 1}), "wood_varnished");
  EXPECT_EQ(assigned("", "IfcRailing", {0.8F, 0.9F, 0.9F, 0.2F}), "glass_float_clear_10mm");
}

TEST(Classes, TellAPaneFromItsFrameByTransparency) {
  EXPECT_EQ(assigned("", "IfcWindow", {0.6F, 0.8F, 0.9F, 0.3F}), "glass_double_clear_4mm");
  EXPECT_EQ(assigned("Sash", "IfcWindow", {0.95F, 0.95F, 0.95F, 1}), "paint_white");
  EXPECT_EQ(assigned("Holz Kiefer", "IfcWindow", {0.6F, 0.4F, 0.2F, 1}), "wood_pine_sanded");
}

// A model without classes: glTF and OBJ.
TEST(Colours, DecideLast) {
  EXPECT_EQ(assigned("Material.001", "", {0.9F, 0.9F, 0.9F, 1}), "paint_white");
  EXPECT_EQ(assigned("Material.001", "", {0.5F, 0.8F, 0.9F, 0.4F}), "glass_float_clear_6mm");
  EXPECT_EQ(assigned("Material.001", "", {0.4F, 0.25F, 0.1F, 1}), "wood_pine_new_beam");
  EXPECT_EQ(assigned("brick_wall_02", "", {0.4F, 0.25F, 0.1F, 1}), "brick_brown");
  EXPECT_EQ(assigned("Material.001", ""), "");  // no name, no class, no colour: nothing is made up
}

TEST(Colours, HaveTheNamesThatPeopleGiveThem) {
  struct Sample {
    float r, g, b;
    const char* band;
  };
  for (const auto& [r, g, b, band] :
       {Sample{1, 1, 1, "white"}, Sample{0.5F, 0.5F, 0.5F, "grey"}, Sample{0.05F, 0.05F, 0.05F, "black"},
        Sample{0.8F, 0.1F, 0.1F, "red"}, Sample{0.45F, 0.26F, 0.1F, "brown"}, Sample{1, 0.55F, 0, "orange"},
        Sample{0.96F, 0.87F, 0.7F, "beige"}, Sample{1, 0.95F, 0.1F, "yellow"}, Sample{0.1F, 0.6F, 0.2F, "green"},
        Sample{0.1F, 0.2F, 0.8F, "blue"}, Sample{0.5F, 0.1F, 0.7F, "violet"}})
    EXPECT_EQ(colourBand({r, g, b, 1}), band);
  EXPECT_EQ(colourBand({1, 1, 1, 0.5F}), "transparent");
  EXPECT_EQ(colourBand(Colour{}), "");
}

TEST(Patterns, AreGlobsWithoutCaseAndAccents) {
  const auto fits = [](const char* globs, const char* text) { return Pattern(globs).fit(folded(text)) >= 0; };
  EXPECT_TRUE(fits("*beton*", "StahlBETON C30"));
  EXPECT_FALSE(fits("beton", "Stahlbeton"));
  EXPECT_TRUE(fits("*ständer*", "METALL-STÄNDERWERK"));
  EXPECT_TRUE(fits("*stander*", "Metall-Ständerwerk"));
  EXPECT_TRUE(fits("stra?e", "STRASSE") == false && fits("stra??e", "Straße"));
  EXPECT_TRUE(fits("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(fits("a*b*c", "a-b-b-d"));
  EXPECT_TRUE(fits("x|?lass", "Glass"));
  EXPECT_TRUE(fits("?ラス", "ガラス"));
  EXPECT_TRUE(fits("*", ""));
  EXPECT_TRUE(fits("*бетон", "ЖЕЛЕЗОБЕТОН"));
  EXPECT_TRUE(fits("*ґрунт*", "Рослинний грунт"));
  EXPECT_EQ(Pattern("a|b|c").fit("b"), 1);
}

TEST(Patterns, TakeBrokenTextAndHugeNamesInTheirStride) {
  EXPECT_EQ(folded("\xff\xc3"), "\xff\xc3");
  EXPECT_EQ(folded("A\xcc\x88"), "a");  // decomposed Ä
  const std::string huge(2'000'000, 'a');
  EXPECT_EQ(Pattern("*a*a*a*a*a*a*a*a*b").fit(folded(huge)), -1);
}

TEST(Rules, FirstOneThatFitsDecides) {
  Builder b;
  b.product("IfcWall", "Garage", {b.surface("Beton")});
  EXPECT_EQ(
      materialId(b.assign({{"IfcWall", "", "", "", "bark"}, {"", "*beton*", "", "", "concrete_construction"}}), 0, 0),
      "bark");
  EXPECT_EQ(
      materialId(b.assign({{"IfcSlab", "", "", "", "bark"}, {"", "*beton*", "", "", "concrete_construction"}}), 0, 0),
      "concrete_construction");
  EXPECT_EQ(materialId(b.assign({{"IfcWall", "*beton*", "*haus*", "", "bark"}}), 0, 0), "");
  EXPECT_EQ(materialId(b.assign({{"IfcWall", "*beton*", "*garage*", "", "bark"}}), 0, 0), "bark");
}

TEST(Rules, AskTheProductsMaterialsWhereTheSurfaceSaysNothing) {
  Builder b;
  const auto nameless = b.surface("");
  const auto odd = b.surface("Style 17");
  b.product("IfcWall", "", {nameless}).materials = {"Ziegel"};
  b.product("IfcWall", "", {odd}).materials = {"Ziegel"};
  auto& layered = b.product("IfcWall", "", {nameless});
  layered.materials = {"Luft", "Isolatie", "Gipskarton"};
  layered.layers = {{"Gipskarton", 0.0125}, {"Isolatie", 0.1}, {"Ziegel", 0.2}};
  auto& stud = b.product("IfcCovering", "", {nameless});
  stud.materials = {"Metal - Stud Layer", "Plasterboard"};
  stud.layers = {{"Metal - Stud Layer", 0.05}, {"Plasterboard", 0.0125}};
  b.product("IfcCovering", "", {nameless}).materials = {"Isolatie"};
  auto& parts = b.product("IfcWindow", "", {b.surface("Sash")});
  parts.materials = {"Glass", "Sash"};
  const auto result = b.assign();
  EXPECT_EQ(materialId(result, 0, nameless), "brick_red_bare");
  EXPECT_EQ(materialId(result, 1, odd), "brick_red_bare");
  EXPECT_EQ(materialId(result, 2, nameless), "gypsum_board_painted");  // an outer layer, not what lies between
  EXPECT_EQ(materialId(result, 3, nameless), "gypsum_board_painted");  // studs stand behind it
  EXPECT_EQ(materialId(result, 4, nameless), "insulation_board");      // unless there is nothing else
  EXPECT_EQ(materialId(result, 5, 2), "paint_white");                  // the sash is not of glass
}

TEST(Rules, TellWhichOneDecided) {
  Builder b;
  b.product("IfcWallStandardCase", "", {b.surface("Stahlbeton")});
  b.product("IfcWall", "", {b.surface("", {1, 1, 1, 1})});
  const auto result = b.assign({{"", "*brick*", "", "", "bark"},
                                {"", "*holz*|*beton*", "", "", "concrete_construction"},
                                {"IfcWall", "", "", "white", "plaster_render"}});
  EXPECT_EQ(result.assignment.surfaces[0].reason, "material 'Stahlbeton' (*beton*), rule 1");
  EXPECT_EQ(result.assignment.surfaces[1].reason, "class IfcWall, colour white, rule 2");
}

}  // namespace
}  // namespace standpoint
