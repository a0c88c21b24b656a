// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Selectors : public testing::Test {
 protected:
  void SetUp() override {
    const auto brick = b.surface("Ziegel rot");
    const auto nameless = b.surface("");
    auto& wall = b.product("IfcWallStandardCase", "Außenwand Süd", {brick});
    wall.global_id = "0DWgwt6o1FOx7466fPk$jl";
    wall.storey = "EG";
    auto& slab = b.product("IfcSlab", "Decke", {nameless});
    slab.materials = {"Stahlbeton"};
    slab.storey = "OG 1";
    auto& window = b.product("IfcWindow", "Fenster [1]", {nameless, brick});
    window.storey = "EG";
    auto& node = b.product("", "Fenster glas", {nameless});
    node.id = "/nodes/7";
  }
  std::vector<std::uint32_t> operator()(const std::string& selector) const { return select(b.environment, selector); }
  Builder b;
};

TEST_F(Selectors, MeanProductsByIdAndGlobalId) {
  EXPECT_THAT((*this)("#101"), ElementsAre(1U));
  EXPECT_THAT((*this)("/nodes/7"), ElementsAre(3U));
  EXPECT_THAT((*this)("0DWgwt6o1FOx7466fPk$jl"), ElementsAre(0U));
  EXPECT_THAT((*this)("0dwgwt6o1fox7466fpk$jl"), IsEmpty());  // GlobalIds differ by case
  EXPECT_THAT((*this)("#1"), IsEmpty());
}

TEST_F(Selectors, MeanClassesWithTheirStandardCase) {
  EXPECT_THAT((*this)("class:IfcWall"), ElementsAre(0U));
  EXPECT_THAT((*this)("class:ifcwallstandardcase"), ElementsAre(0U));
  EXPECT_THAT((*this)("class:IfcW*"), ElementsAre(0U, 2U));
  EXPECT_THAT((*this)("class:Ifc"), IsEmpty());
}

TEST_F(Selectors, MeanNamesAndStoreysByGlob) {
  EXPECT_THAT((*this)("name:*glas*"), ElementsAre(3U));
  EXPECT_THAT((*this)("name:AUSSENWAND*"), ElementsAre(0U));
  EXPECT_THAT((*this)("name:Fenster*|Decke"), ElementsAre(1U, 2U, 3U));
  EXPECT_THAT((*this)("storey:eg"), ElementsAre(0U, 2U));
}

TEST_F(Selectors, MeanTheLayersOfADrawing) {
  b.environment.products[0].properties = {{"Pset_WallCommon", "Name", "A-GLAZ"},
                                          {"Presentation layer", "Name", "A-WALL-FULL"}};
  b.environment.products[2].properties = {{"Presentation layer", "Name", "A-WALL-FULL"},
                                          {"Presentation layer", "Name", "A-GLAZ"}};
  EXPECT_THAT((*this)("layer:a-wall*"), ElementsAre(0U, 2U));
  EXPECT_THAT((*this)("layer:A-GLAZ"), ElementsAre(2U));  // a property that is no layer does not count
  EXPECT_THAT((*this)("layer:*wall*&class:IfcWindow"), ElementsAre(2U));
  EXPECT_THAT((*this)("layer:"), IsEmpty());
  EXPECT_THAT((*this)("layer:0"), IsEmpty());
}

TEST_F(Selectors, MeanSurfacesByNameAndElseByTheProductsMaterial) {
  EXPECT_THAT((*this)("material:*ziegel*"), ElementsAre(0U, 2U));
  EXPECT_THAT((*this)("material:stahlbeton"), ElementsAre(1U));
}

TEST_F(Selectors, MeanNothingWhenEmptyOrUnknown) {
  for (const char* selector : {"", "class:", "name:", "material:", "colour:red", "#", ":"})
    EXPECT_THAT((*this)(selector), IsEmpty()) << selector;
}

}  // namespace
}  // namespace standpoint
