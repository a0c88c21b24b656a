// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_document.h"
#include "editor/model/log.h"
#include "editor/model/outliner_rows.h"
#include "editor/model/selection.h"
#include "editor/model/visibility.h"

namespace standpoint {
namespace {

std::vector<std::string> labels(const Outliner& tree, const std::vector<OutlinerRow>& rows) {
  std::vector<std::string> result;
  for (const auto& row : rows) result.push_back(tree.node(row.node).label);
  return result;
}

class DemoHouse : public ::testing::Test {
 protected:
  Document document = demoHouse();
  const Environment& environment = *document.imported;
  Outliner tree{environment};
};

TEST_F(DemoHouse, IsAValidEnvironment) {
  EXPECT_EQ(validate(environment), "");
  EXPECT_EQ(environment.products.size(), kDemoProducts);
}

TEST_F(DemoHouse, OpensDownToItsStoreys) {
  const auto shown = labels(tree, tree.rows(environment, ""));
  EXPECT_EQ(shown, (std::vector<std::string>{"Demo house", "Plot", "House", "Ground floor", "Upper floor", "Site"}));
}

TEST_F(DemoHouse, CountsEveryProductOnce) {
  EXPECT_EQ(tree.node(tree.rows(environment, "").front().node).products, environment.products.size());
}

TEST_F(DemoHouse, RevealsAProductByOpeningWhatLiesAboveIt) {
  const auto wall = productNamed(environment, "Wall east OG");
  tree.reveal(wall);
  const auto rows = tree.rows(environment, "");
  const auto found = std::count_if(rows.begin(), rows.end(), [&](const OutlinerRow& r) {
    return r.kind == OutlinerRow::Kind::product && tree.node(r.node).index == wall;
  });
  EXPECT_EQ(found, 1);
}

TEST_F(DemoHouse, FiltersByWordsInAnyOrderAndKeepsTheAncestors) {
  const auto shown = labels(tree, tree.rows(environment, "OG window"));
  EXPECT_EQ(shown, (std::vector<std::string>{"Demo house", "Plot", "House", "Upper floor", "Window", "Window north OG",
                                             "Window south OG"}));
  EXPECT_TRUE(tree.rows(environment, "no such thing").empty());
}

TEST_F(DemoHouse, FindsProductsByIdClassAndMaterial) {
  EXPECT_TRUE(matchesFilter(environment.products[2], "#102"));
  EXPECT_TRUE(matchesFilter(environment.products[2], "ifcwallstandardcase brick"));
  EXPECT_FALSE(matchesFilter(environment.products[2], "glass"));
}

TEST_F(DemoHouse, KnowsItsStoreysInTheLocalFrame) {
  const auto storeys = storeyLevels(environment, document.georeference->shift_m.z());
  ASSERT_EQ(storeys.size(), 2U);
  EXPECT_DOUBLE_EQ(storeys[0].elevation_m, 0);
  EXPECT_DOUBLE_EQ(storeys[1].elevation_m, 3);
}

TEST_F(DemoHouse, TakesStoreyHeightsFromTheGeometryWhenTheFileHasNone) {
  Environment flat = environment;
  for (auto& node : flat.spatial) node.elevation_m = 0;
  const auto storeys = storeyLevels(flat, 0);
  ASSERT_EQ(storeys.size(), 2U);
  EXPECT_LT(storeys[0].elevation_m + 1, storeys[1].elevation_m);
}

TEST(Outliner, OfAModelWithoutStructureIsOneListOfProducts) {
  Environment environment;
  environment.products.resize(3);
  for (int i = 0; i < 3; ++i) environment.products[static_cast<std::size_t>(i)].id = "/nodes/" + std::to_string(i);
  const Outliner tree(environment);
  EXPECT_EQ(tree.rows(environment, "").size(), 4U);  // the group and its three
}

TEST(Outliner, HasOneRowForARoomWithItsNumberAndName) {
  Environment e;
  const auto place = [&](const char* ifc_class, const char* id, std::int32_t parent) {
    SpatialNode node;
    node.ifc_class = ifc_class;
    node.name = node.global_id = id;
    node.parent = parent;
    e.spatial.push_back(node);
    return static_cast<std::int32_t>(e.spatial.size() - 1);
  };
  const auto add = [&](const char* ifc_class, const char* id, std::int32_t container) -> Product& {
    Product product;
    product.ifc_class = ifc_class;
    product.id = product.name = product.global_id = id;
    product.container = container;
    return e.products.emplace_back(product);
  };
  const auto storey = place("IfcBuildingStorey", "Ground floor", -1);
  const auto ten = place("IfcSpace", "10", storey);
  place("IfcSpace", "9", storey);
  add("IfcWall", "Wall", storey);
  add("IfcSpace", "9", storey).properties = {{"Attributes", "LongName", "Hall"}};
  add("IfcSpace", "10", storey).properties = {{"Attributes", "LongName", "Kitchen"}};
  add("IfcFurniture", "Table", ten);
  Outliner tree(e);
  tree.expandAll(true);
  EXPECT_EQ(labels(tree, tree.rows(e, "")),
            (std::vector<std::string>{"Ground floor", "9 Hall", "10 Kitchen", "Furniture", "Table", "Wall", "Wall"}));
  EXPECT_EQ(tree.node(0).products, e.products.size());
  EXPECT_EQ(labels(tree, tree.rows(e, "table")),
            (std::vector<std::string>{"Ground floor", "10 Kitchen", "Furniture", "Table"}));
  EXPECT_EQ(labels(tree, tree.rows(e, "hall")), (std::vector<std::string>{"Ground floor", "9 Hall"}));
}

TEST(Outliner, ReadsClassNamesAloud) {
  EXPECT_EQ(readableClass("IfcWallStandardCase"), "Wall standard case");
  EXPECT_EQ(readableClass(""), "Object");
  EXPECT_EQ(withReadableClasses("IfcSlab 'Dach-1' touches IfcWallStandardCase #12, class IfcDoor"),
            "Slab 'Dach-1' touches Wall standard case #12, class IfcDoor");
  EXPECT_EQ(withReadableClasses("Ifc 'x' MyIfcSlab 'y' IfcSlab"), "Ifc 'x' MyIfcSlab 'y' IfcSlab");
}

TEST(Selection, KeepsItsOrderAndItsLastChoice) {
  Selection selection;
  selection.set(std::vector<std::uint32_t>{7, 3, 7});
  EXPECT_EQ(selection.products(), (std::vector<std::uint32_t>{3, 7}));
  EXPECT_EQ(selection.primary(), 7U);
  selection.toggle(5);
  EXPECT_EQ(selection.primary(), 5U);
  selection.toggle(5);
  EXPECT_FALSE(selection.contains(5));
  EXPECT_TRUE(selection.contains(selection.primary()));
}

TEST(Selection, IsTheSameValueUntilItChanges) {
  Selection selection;
  selection.set(4);
  const auto before = selection.shared();
  selection.set(4);
  EXPECT_EQ(selection.shared(), before);
  selection.set(5);
  EXPECT_NE(selection.shared(), before);
}

TEST(Visibility, HidesIsolatesAndShowsAll) {
  Visibility visibility;
  visibility.reset(5);
  visibility.show(std::vector<std::uint32_t>{1, 3}, false);
  EXPECT_EQ(visibility.hiddenCount(), 2U);
  visibility.isolate(std::vector<std::uint32_t>{1});
  EXPECT_FALSE(visibility.hidden(1));
  EXPECT_EQ(visibility.hiddenCount(), 4U);
  EXPECT_TRUE(visibility.alone());
  visibility.showAll();
  EXPECT_FALSE(visibility.alone());
  EXPECT_FALSE(visibility.anyHidden());
  EXPECT_FALSE(visibility.hidden(99));
}

TEST_F(DemoHouse, FindsTheProductThatALogEntryNames) {
  EXPECT_EQ(productOf(environment, "#104"), 4U);
  EXPECT_EQ(productOf(environment, "demo.ifc #104"), 4U);
  EXPECT_FALSE(productOf(environment, "line 7"));
  EXPECT_FALSE(productOf(environment, ""));
}

TEST(Log, FiltersBySeverityAndText) {
  const LogEntry warning{LogLevel::warning, "10:00:00", "#5", "not planar"};
  EXPECT_TRUE(passes(warning, {}));
  EXPECT_FALSE(passes(warning, {true, false, true, ""}));
  EXPECT_TRUE(passes(warning, {true, true, true, "PLANAR"}));
  EXPECT_FALSE(passes(warning, {true, true, true, "glass"}));
}

TEST(Log, ListsTheFirstOfManyAlikeAndEachWhenAsked) {
  Report report;
  report.warn("line 1", "missing header");
  for (int i = 0; i < 30; ++i)
    report.lose("#" + std::to_string(i), "IfcBolt 'M " + std::to_string(i) + "' has no body");
  const auto entries = entriesOf(report);
  ASSERT_EQ(entries.size(), 31U);
  const auto listed = [&](const LogFilter& filter) {
    return std::count_if(entries.begin(), entries.end(), [&](const LogEntry& e) { return passes(e, filter); });
  };
  EXPECT_EQ(listed({}), 2);
  EXPECT_EQ(entries[1].message, "IfcBolt 'M 0' has no body (first of 30 similar)");
  EXPECT_EQ(listed({.each = true}), 31);
  EXPECT_EQ(listed({.text = "M 17"}), 1) << "what is looked for is found";
}

}  // namespace
}  // namespace standpoint
