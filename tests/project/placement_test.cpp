// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A ground of 20 x 20 m at height 0, and what a test puts on it.
Document ground(const std::function<void(Environment&)>& add = {}) {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>();
  e->surfaces = d.imported->surfaces;
  e->spatial = d.imported->spatial;
  addBox(*e, "ground", "IfcSlab", {-10, -10, -0.5}, {10, 10, 0});
  if (add) add(*e);
  d.imported = e;
  d.georeference = std::make_shared<const Georeference>();
  return d;
}

// One rectangle through (0, 0, 0) that rises along x by `slope_deg`.
void addSlope(Environment& e, double slope_deg) {
  auto m = std::make_shared<Mesh>();
  const auto rise = static_cast<float>(std::tan(slope_deg * std::numbers::pi / 180));
  m->positions = {{-4, -4, -4 * rise}, {4, -4, 4 * rise}, {4, 4, 4 * rise}, {-4, 4, -4 * rise}};
  m->triangles = {{0, 1, 2}, {0, 2, 3}};
  m->surface_of_triangle = {0, 0};
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  e.products.resize(1);
  e.products[0].id = "ramp";
  e.meshes = {m};
}

std::string refusal(const Document& d, json options) {
  options["add"] = "S";
  const auto done = run("station", d, options);
  EXPECT_FALSE(done);
  return done ? "" : done.error().message;
}

TEST(Placement, KeepsTwentyCentimetresFromASurface) {
  const auto d = ground([](Environment& e) { addBox(e, "wall", "IfcWall", {1, -3, 0}, {1.3, 3, 3}); });
  EXPECT_THAT(refusal(d, {{"at", {0.81, 0, 1.6}}}),
              AllOf(HasSubstr("190 mm from IfcWall wall"), HasSubstr("move it 10 mm away")));
  EXPECT_TRUE(run("station", d, {{"add", "S"}, {"at", {0.79, 0, 1.6}}}));
  const auto pole = ground([](Environment& e) {
    addBox(e, "pole", "IfcMember", {0.1, 0.1, 1.5}, {0.102, 0.102, 1.55});
  });
  EXPECT_THAT(refusal(pole, {{"at", {0, 0, 1.525}}}), HasSubstr("IfcMember pole"))
      << "a thread between all beams of a test";
}

TEST(Placement, NamesOnWhereAtHasTheHeightOfAFloor) {
  const auto d = ground([](Environment& e) { addBox(e, "wall", "IfcWall", {1, -3, 0}, {1.3, 3, 3}); });
  EXPECT_THAT(refusal(d, {{"at", {0, 0, 0}}}),
              HasSubstr("if 0 is the height of the floor, specify the place on the floor (--on 0,0,0)"));
  EXPECT_THAT(refusal(d, {{"at", {0, 0, 0.12}}}), HasSubstr("(--on 0,0,0.12)"));
  EXPECT_THAT(refusal(d, {{"at", {0.9, 0, 0}}}), testing::Not(HasSubstr("--on"))) << "it cannot stand there either";
  EXPECT_THAT(refusal(d, {{"at", {0.81, 0, 1.6}}}), testing::Not(HasSubstr("--on"))) << "that is no floor's height";
}

TEST(Placement, RefusesASlopeThatATripodSlidesFromAndSaysHowSteepItIs) {
  const auto ramp = [](double deg) { return ground([&](Environment& e) { addSlope(e, deg); }); };
  EXPECT_TRUE(run("station", ramp(28), {{"add", "S"}, {"on", {0, 0}}}));
  EXPECT_THAT(refusal(ramp(38), {{"on", {0, 0}}}),
              AllOf(HasSubstr("slope of 38 degrees"), HasSubstr("ramp"), HasSubstr("30 degrees")));
  EXPECT_THAT(refusal(ramp(38), {{"at", {0, 0, 1.6}}}), HasSubstr("slope of 38 degrees"));
  EXPECT_THAT(refusal(ramp(70), {{"at", {0, 0, 1.6}}}), HasSubstr("wall of 70 degrees"));
}

TEST(Placement, RefusesTheTopOfAWallWhereThreeFeetHaveNoRoom) {
  const auto d = ground([](Environment& e) { addBox(e, "wall", "IfcWall", {1, -3, 0}, {1.3, 3, 3}); });
  EXPECT_THAT(refusal(d, {{"at", {1.15, 0, 4.6}}}), AllOf(HasSubstr("feet"), HasSubstr("IfcWall wall")));
}

TEST(Placement, RefusesToFloatAndToStandTooLow) {
  const auto d = ground();
  EXPECT_THAT(refusal(d, {{"at", {0, 0, 5.0}}}),
              AllOf(HasSubstr("too high"), HasSubstr("5.00 m below"), HasSubstr("lower it by at least 2.80 m")));
  EXPECT_THAT(refusal(d, {{"at", {0, 0, 0.5}}}), HasSubstr("needs at least 0.80 m"));
  EXPECT_THAT(refusal(d, {{"at", {30, 0, 5.0}}}), HasSubstr("too high: the lowest level of the model is 5.50 m below"))
      << "next to the model";
  EXPECT_THAT(refusal(d, {{"at", {0, 0, -5.0}}}), HasSubstr("no ground below")) << "below the model";
  EXPECT_THAT(refusal(d, {{"on", {0, 0}}, {"height", 3}}), HasSubstr("0.80 to 2.20 m"));
  EXPECT_TRUE(run("station", d, {{"add", "S"}, {"at", {0, 0, 5.0}}, {"stand", "free"}})) << "floating";
}

TEST(Placement, BesideAModelStandsOnItsLowestHeightAndSaysSo) {
  const auto done = run("station", ground(), {{"add", "S"}, {"at", {30, 0, 1.2}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_THAT(said(done->report), HasSubstr("lowest level"));
  EXPECT_NEAR(done->document.job->stations[0].instrument_height_m, 1.7, 1e-6);
}

TEST(Placement, RefusesTheInsideOfABodyAndNotThatOfARoomDrawnFromInside) {
  const auto block = [](const char* ifc_class, bool inwards) {
    return ground([=](Environment& e) {
      addBox(e, "block", ifc_class, {-3, -3, 0.01}, {3, 3, 4});
      auto mesh = std::make_shared<Mesh>(*e.meshes.back());
      if (inwards)
        for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
      e.meshes.back() = mesh;
    });
  };
  EXPECT_THAT(refusal(block("IfcBuildingElementProxy", false), {{"at", {0, 0, 1.6}}}),
              HasSubstr("inside IfcBuildingElementProxy block"));
  EXPECT_THAT(refusal(block("IfcBuildingElementProxy", true), {{"at", {0, 0, 1.6}}}), HasSubstr("closed body"));
  EXPECT_THAT(refusal(block("", false), {{"at", {0, 0, 3.5}}}), HasSubstr("closed body"))
      << "nothing to stand on in there";
  const auto skin = run("station", block("", false), {{"add", "S"}, {"at", {0, 0, 1.6}}});
  ASSERT_TRUE(skin) << describe(skin.error());
  EXPECT_THAT(said(skin->report), HasSubstr("treated as a room modelled as a single shell"));
  EXPECT_TRUE(run("station", block("", true), {{"add", "S"}, {"at", {0, 0, 1.6}}})) << "a room";
}

TEST(Placement, AsksForHeadroom) {
  const auto d = ground([](Environment& e) { addBox(e, "beam", "IfcBeam", {-1, -1, 1.85}, {1, 1, 2}); });
  EXPECT_THAT(refusal(d, {{"at", {0, 0, 1.6}}}),
              AllOf(HasSubstr("IfcBeam beam is 0.25 m above"), HasSubstr("0.30 m of headroom")));
}

TEST(Placement, TakesTheHeightOfTheInstrumentThatWillStandThere) {
  const auto done = run("station", ground(), {{"add", "S"}, {"on", {0, 0}}, {"instrument", "leica-rtc360"}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_NEAR(done->answer["placed"]["at"][2].get<double>(), 1.7, 1e-6) << "tripod_height_m of its file";
  EXPECT_THAT(refusal(ground(), {{"on", {0, 0}}, {"instrument", "leica-blk2go"}}), HasSubstr("carried"));
}

TEST(Placement, MovingAsksTheSame) {
  const auto d = run("station", ground(), {{"add", "S"}, {"at", {0, 0, 1.6}}})->document;
  const auto moved = run("station", d, {{"move", "S"}, {"at", {0, 0, 5}}});
  ASSERT_FALSE(moved);
  EXPECT_THAT(moved.error().message, HasSubstr("too high"));
}

}  // namespace
}  // namespace standpoint
