// SPDX-License-Identifier: GPL-3.0-or-later
// What cannot well be meant is said with its remedy, and the remedy mends it.
#include <gtest/gtest.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

// Two doors of 0.9 × 0.1 × 2.1 and a slab of 10 × 8 × 0.3, times `f`.
std::string house(double f, bool lying = false) {
  const auto n = [&](double v) { return std::to_string(v * f); };
  const std::string door = lying ? boxSolid(100, n(0.9), n(2.1), n(0.1)) : boxSolid(100, n(0.9), n(0.1), n(2.1));
  const std::string slab = lying ? boxSolid(103, n(10), n(0.3), n(8)) : boxSolid(103, n(10), n(8), n(0.3));
  return door + slab + product(110, "IFCDOOR", "#102") + product(120, "IFCDOOR", "#102") +
         product(130, "IFCSLAB", "#105");
}

std::string far(const std::string& x, int n) {
  const auto id = [&](int k) { return "#" + std::to_string(n + k); };
  return id(0) + "=IFCCARTESIANPOINT((" + x + ",0.,0.));\n" + id(1) + "=IFCAXIS2PLACEMENT3D(" + id(0) + ",$,$);\n" +
         id(2) + "=IFCLOCALPLACEMENT($," + id(1) + ");\n";
}

TEST(Plausibility, AUsualHouseGivesNoFinding) { EXPECT_EQ(issuesOf(importText(ifcText(house(1)))), ""); }

TEST(Plausibility, DoorsOfTwoKilometresAreMillimetresTakenForMetres) {
  const std::string text = ifcText(house(1000));
  EXPECT_EQ(issuesOf(importText(text)),
            "warning model: the doors are 2.1 km large: check the unit; if the coordinates are in mm, import the "
            "model with this unit\n");
  ImportOptions mended;
  mended.metres_per_unit = 0.001;
  const ImportedModel model = importText(text, mended);
  EXPECT_NEAR(boundsOf(model, "#110").max.z(), 2.1, 1e-6);
  EXPECT_EQ(issuesOf(model), "note #11: the length unit of the file was overridden by the specified unit\n");
}

TEST(Plausibility, DoorsOfTwoMillimetresAreMetresTakenForMillimetres) {
  EXPECT_EQ(issuesOf(importText(ifcText(house(1), "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"))),
            "warning model: the doors are 2.1 mm large: check the unit; if the coordinates are in m, import the "
            "model with this unit\n");
}

TEST(Plausibility, DoorsThatLieTellThatTheModelLies) {
  const std::string text = ifcText(house(1, true));
  EXPECT_EQ(issuesOf(importText(text)),
            "warning model: 2 of 2 doors are wider than tall: the model may be rotated; if its y axis points "
            "up, import it with this axis up\n");
  ImportOptions mended;
  mended.up = UpAxis::y;
  const ImportedModel model = importText(text, mended);
  EXPECT_EQ(issuesOf(model), "");
  EXPECT_NEAR(boundsOf(model, "#110").max.z() - boundsOf(model, "#110").min.z(), 2.1, 1e-6);
}

TEST(Plausibility, AnObjOfMillimetresIsSeenByItsHeight) {
  std::string obj;  // a box of 10000 × 6000 (up, Y) × 8000
  for (int i = 0; i < 8; ++i)
    obj += std::string("v ") + (i & 1 ? "10000 " : "0 ") + (i & 2 ? "6000 " : "0 ") + (i & 4 ? "8000\n" : "0\n");
  obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const TemporaryFile file(obj, ".obj");
  Progress progress;
  const auto model = importFile(file.path(), {}, progress);
  ASSERT_TRUE(model.has_value());
  EXPECT_NE(issuesOf(*model).find(
                "the whole model is 6 km high: check the unit; if the coordinates are in mm, import the model with "
                "this unit"),
            std::string::npos)
      << issuesOf(*model);
}

TEST(Plausibility, AProductFarFromTheRestIsNamed) {
  const ImportedModel model =
      importText(ifcText(house(1) + far("70000.", 60) + product(140, "IFCSLAB", "#105", "SweptSolid", "#62")));
  EXPECT_NE(issuesOf(model).find("warning #140: 1 of 4 products are 70 km from the rest (#140)"), std::string::npos)
      << issuesOf(model);
}

TEST(Plausibility, AProductBeyondTheEarthIsNamed) {
  const ImportedModel model =
      importText(ifcText(house(1) + far("1.E12", 60) + product(140, "IFCSLAB", "#105", "SweptSolid", "#62")));
  EXPECT_NE(issuesOf(model).find("warning #140: 1 products are outside any map area (#140)"), std::string::npos)
      << issuesOf(model);
}

TEST(Plausibility, TwoBuildingsFarApartAreTwoParts) {
  std::string text = house(1) + far("5000.", 60);
  for (int i = 0; i < 3; ++i) text += product(200 + 10 * i, "IFCSLAB", "#105", "SweptSolid", "#62");
  EXPECT_NE(
      issuesOf(importText(ifcText(text))).find("the model consists of two parts 4.99 km apart, with 3 and 3 products"),
      std::string::npos)
      << issuesOf(importText(ifcText(text)));
}

TEST(Plausibility, GeometryFarFromTheOriginIsToldWithWhatWasDone) {
  std::string text =
      far("500000.", 60) + boxSolid(103, "10.", "8.", "3.") + product(130, "IFCSLAB", "#105", "SweptSolid", "#62");
  EXPECT_NE(issuesOf(importText(ifcText(text)))
                .find("note model: the geometry is 500 km from the file's origin; a global shift of 500000 0 2 "
                      "is applied internally and reversed on export; if these are map coordinates, specify their "
                      "coordinate reference system"),
            std::string::npos)
      << issuesOf(importText(ifcText(text)));
  ImportOptions none;
  none.shift = ShiftMode::none;
  EXPECT_NE(issuesOf(importText(ifcText(text), none))
                .find("warning model: the geometry is 500 km from the file's origin and not shifted"),
            std::string::npos);
}

TEST(Plausibility, AMissingUnitIsToldWithItsRemedy) {
  const ImportedModel model = importText(ifcText(house(1), "IFCSIUNIT(*,.MASSUNIT.,$,.GRAM.)"));
  EXPECT_EQ(
      issuesOf(model),
      "warning #11: the file has no valid length unit; metres assumed; specify the length unit if it is another\n");
}

}  // namespace
}  // namespace standpoint::test
