// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/readable_name.h"
#include "demo_document.h"
#include "demo_verbs.h"
#include "editor/labels/alphabetical.h"
#include "editor/labels/label_layout.h"
#include "editor/labels/room_labels.h"
#include "editor/model/floor_plan.h"
#include "item_probe.h"
#include "project/survey/measure_verb.h"

namespace standpoint {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> sortedNames(std::vector<std::string> names) {
  std::sort(names.begin(), names.end(),
            [](const auto& a, const auto& b) { return alphabeticalKey(a) < alphabeticalKey(b); });
  return names;
}

TEST(Alphabetical, CountsNumbersAndPutsUmlautsAndCapitalsBesideTheirLetters) {
  EXPECT_THAT(sortedNames({"Room 10", "room 2", "Room 1", "Zimmer", "Ärztezimmer", "Bad", "1.10", "1.9"}),
              ElementsAre("1.9", "1.10", "Ärztezimmer", "Bad", "Room 1", "room 2", "Room 10", "Zimmer"));
}

TEST(Alphabetical, FindsCapitalsInAnyScriptAndLettersWithoutTheirMarks) {
  EXPECT_EQ(forSearch("Сканувати ÜBER Scan"), forSearch("сканувати über scan"));
  EXPECT_EQ(forSearch("6 Küche"), "6 kuche");
  EXPECT_EQ(forSearch("Salle à manger"), "salle a manger");
  EXPECT_NE(forSearch("Scan"), forSearch("Span"));
  EXPECT_FALSE(forSearch("\xff\xfe").empty());
}

TEST(Alphabetical, TakesBrokenTextAndLongNames) {
  EXPECT_NE(alphabeticalKey("\xff\xfe"), alphabeticalKey("\xff"));
  EXPECT_LT(alphabeticalKey(std::string(5000, 'a')), alphabeticalKey(std::string(5000, 'a') + "b"));
  EXPECT_LT(alphabeticalKey(""), alphabeticalKey("0"));
}

WantedLabel wanted(LabelOf of, double x, double y, std::vector<Eigen::Vector2d> sizes) {
  WantedLabel label;
  label.of = of;
  label.at_px = {x, y};
  label.centred = of.kind == LabelKind::room;
  label.gap_px = 10;
  for (const auto& size : sizes) label.texts.push_back({"", size});
  return label;
}

WantedLabel wantedRoom(std::size_t index, double x, double y, std::vector<Eigen::Vector2d> sizes) {
  return wanted({LabelKind::room, index}, x, y, std::move(sizes));
}

std::vector<std::optional<PlacedLabel>> laidOut(const std::vector<WantedLabel>& labels, double slack_px = 0) {
  return LabelLayout().layOut(labels, {200, 200}, slack_px);
}

TEST(LabelLayout, GivesTheRightOfWayToWhoComesFirst) {
  const auto placed = laidOut(
      {wantedRoom(0, 50, 50, {{40, 20}}), wantedRoom(1, 60, 55, {{40, 20}}), wantedRoom(2, 50, 80, {{40, 20}})});
  ASSERT_TRUE(placed[0]);
  EXPECT_EQ(placed[0]->corner_px, Eigen::Vector2d(30, 40));
  EXPECT_FALSE(placed[1]);
  EXPECT_TRUE(placed[2]);
}

TEST(LabelLayout, PutsMeasurementsBeforeStationsAndThoseBeforeRoomsAndWhatIsChosenBeforeAll) {
  const Eigen::Vector2d size(40, 20);
  const auto station = wanted({LabelKind::station, 0}, 100, 110, {size});
  const auto measurement = wanted({LabelKind::measurement, 0}, 100, 112, {size});
  auto placed = laidOut({wantedRoom(0, 100, 90, {size}), station, measurement});
  EXPECT_FALSE(placed[0]);
  ASSERT_TRUE(placed[1] && placed[2]);
  EXPECT_EQ(placed[2]->side, LabelSide::above);
  EXPECT_EQ(placed[1]->side, LabelSide::below);
  auto chosen = station;
  chosen.chosen = true;
  placed = laidOut({chosen, measurement});
  ASSERT_TRUE(placed[0] && placed[1]);
  EXPECT_EQ(placed[0]->side, LabelSide::above);
  EXPECT_EQ(placed[1]->side, LabelSide::below);
}

TEST(LabelLayout, TakesAShorterTextWhereTheFullOneDoesNotFit) {
  const auto placed = laidOut({wantedRoom(0, 50, 50, {{40, 20}}), wantedRoom(1, 90, 50, {{60, 20}, {30, 20}})});
  ASSERT_TRUE(placed[1]);
  EXPECT_EQ(placed[1]->text, 1U);
}

TEST(LabelLayout, LeavesThePictureToNobody) {
  const auto placed =
      laidOut({wantedRoom(0, 5, 50, {{40, 20}}), wantedRoom(1, 195, 199, {{4, 20}}), wantedRoom(2, -500, 0, {{1, 1}})});
  EXPECT_FALSE(placed[0] || placed[1] || placed[2]);
}

TEST(LabelLayout, KeepsAwayFromWhatIsDrawnOverIt) {
  const std::vector<Eigen::AlignedBox2d> controls = {{Eigen::Vector2d(0, 0), Eigen::Vector2d(200, 60)}};
  const auto placed =
      LabelLayout().layOut({wanted({LabelKind::station, 0}, 100, 70, {{40, 20}}), wantedRoom(0, 100, 30, {{40, 20}})},
                           {200, 200}, 0, controls);
  ASSERT_TRUE(placed[0]);
  EXPECT_EQ(placed[0]->side, LabelSide::below) << "above are controls";
  EXPECT_FALSE(placed[1]);
}

TEST(LabelLayout, CoversNoMark) {
  auto station = wanted({LabelKind::station, 0}, 100, 100, {{40, 20}});
  station.mark_px = 4;
  const auto placed = laidOut({station, wantedRoom(0, 100, 108, {{40, 20}}), wantedRoom(1, 100, 120, {{40, 20}})});
  EXPECT_TRUE(placed[0]);
  EXPECT_FALSE(placed[1]) << "over the station itself";
  EXPECT_TRUE(placed[2]);
}

TEST(LabelLayout, DoesNotFlickerWhereTwoLabelsMeet) {
  LabelLayout layout;
  const auto at = [&](double x) {
    return layout.layOut({wantedRoom(0, 50, 50, {{40, 20}}), wantedRoom(1, x, 50, {{40, 20}})}, {200, 200}, 5)[1]
        .has_value();
  };
  EXPECT_TRUE(at(96));
  EXPECT_TRUE(at(91)) << "it stays as long as nothing is covered";
  EXPECT_FALSE(at(89));
  EXPECT_FALSE(at(91)) << "and comes back where there is room enough";
  EXPECT_FALSE(at(94));
  EXPECT_TRUE(at(96));
  EXPECT_TRUE(at(91));
}

TEST(LabelLayout, ChangesTheSideSeldom) {
  LabelLayout layout;
  const auto sideAt = [&](double x) {
    const auto placed = layout.layOut(
        {wanted({LabelKind::measurement, 0}, 50, 60, {{40, 20}}), wanted({LabelKind::station, 0}, x, 60, {{40, 20}})},
        {200, 200}, 5);
    return placed[1] ? placed[1]->side : LabelSide::left;
  };
  EXPECT_EQ(sideAt(100), LabelSide::above);
  EXPECT_EQ(sideAt(89), LabelSide::below);
  EXPECT_EQ(sideAt(91), LabelSide::below);
  EXPECT_EQ(sideAt(96), LabelSide::above);
  EXPECT_EQ(sideAt(91), LabelSide::above);
}

Product space(const std::string& name, const std::string& long_name) {
  Product product;
  product.ifc_class = "IfcSpace";
  product.id = "#7";
  product.name = name;
  if (!long_name.empty()) product.properties.push_back({"Attributes", "LongName", long_name});
  return product;
}

TEST(RoomLabels, HaveNumberAndLongNameAsFarAsTheModelHasThem) {
  EXPECT_EQ(readableName(space("4", "Schlafzimmer")), "4 Schlafzimmer");
  EXPECT_EQ(readableName(space("Bad", "Bad")), "Bad");
  EXPECT_EQ(readableName(space("", "Küche")), "Küche");
  EXPECT_EQ(readableName(space("", "")), "#7");
}

// An L of two arms, 10 m long and 2 m wide: the middle of its box is outside of it.
Environment angledRoom() {
  Environment e;
  e.surfaces.resize(1);
  e.products.push_back(space("1.12", "Corridor"));
  Mesh mesh;
  const auto box = [&](Eigen::Vector3f low, Eigen::Vector3f high) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
    for (const auto& t : std::initializer_list<Triangle>{{0, 2, 3},
                                                         {0, 3, 1},
                                                         {4, 5, 7},
                                                         {4, 7, 6},
                                                         {0, 1, 5},
                                                         {0, 5, 4},
                                                         {2, 6, 7},
                                                         {2, 7, 3},
                                                         {0, 4, 6},
                                                         {0, 6, 2},
                                                         {1, 3, 7},
                                                         {1, 7, 5}})
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  box({0, 0, 0}, {10, 2, 3});
  box({0, 2, 0}, {2, 10, 3});
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
  e.meshes.push_back(std::make_shared<const Mesh>(mesh));
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  return e;
}

TEST(RoomLabels, StandWithinTheRoomAwayFromItsWalls) {
  const auto labels = roomLabels(angledRoom());
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].number, "1.12");
  EXPECT_EQ(labels[0].name, "Corridor");
  const auto& p = labels[0].anchor;
  EXPECT_TRUE(p.x() < 2 || p.y() < 2) << p.transpose();
  EXPECT_GT(std::min(p.x(), p.y()), 0.4);
  EXPECT_NEAR(p.z(), 1, 1e-9);
}

TEST(RoomLabels, StandBesideTheStairOfTheirRoom) {
  auto e = angledRoom();
  const auto before = roomLabels(e).at(0).anchor;
  Mesh stair = *e.meshes[0];
  for (auto& p : stair.positions)  // a box around the place, through the whole height
    p = {static_cast<float>(before.x()) + (p.x() > 1 ? 0.6F : -0.6F),
         static_cast<float>(before.y()) + (p.y() > 1 ? 0.6F : -0.6F), p.z()};
  e.products.push_back(e.products[0]);
  e.products[1].ifc_class = "IfcStairFlight";
  e.meshes.push_back(std::make_shared<const Mesh>(stair));
  e.instances.push_back({1, 1, Eigen::Affine3d::Identity()});
  const auto labels = roomLabels(e);
  ASSERT_EQ(labels.size(), 1U);
  const auto& p = labels[0].anchor;
  EXPECT_TRUE(p.x() < 2 || p.y() < 2) << "still in its room";
  EXPECT_GT(std::max(std::abs(p.x() - before.x()), std::abs(p.y() - before.y())), 0.6) << p.transpose();
}

TEST(StairLabels, AreOneForAllFlightsOfAStairAndNoneForAFewSteps) {
  Environment e;
  e.surfaces.resize(1);
  const auto add = [&](const char* ifc_class, std::int32_t whole, float low, float high) {
    Mesh mesh;
    mesh.positions = {{0, 0, low}, {1, 0, low}, {1, 1, high}};
    mesh.triangles = {{0, 1, 2}};
    mesh.surface_of_triangle = {0};
    Product product;
    product.ifc_class = ifc_class;
    product.whole = whole;
    e.products.push_back(product);
    e.meshes.push_back(std::make_shared<const Mesh>(mesh));
    const auto index = static_cast<std::uint32_t>(e.products.size() - 1);
    e.instances.push_back({index, index, Eigen::Affine3d::Identity()});
  };
  add("IfcStair", -1, 0, 0.1F);
  add("IfcStairFlight", 0, 0, 1.4F);
  add("IfcStairFlight", 0, 1.4F, 2.8F);
  add("IfcStair", -1, 0, 0.5F);
  const auto labels = stairLabels(e);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].product, 0U);
  EXPECT_NEAR(labels[0].box.max.z(), 2.8, 1e-6);
}

class Plan : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Plan, LooksStraightDownAtTheGroundFloorAndThenAtTheNextStorey) {
  gui.key('9');
  ASSERT_TRUE(editor.visibility.cut_height_m);
  const double ground = *editor.visibility.cut_height_m;
  EXPECT_NEAR(ground, kCutAboveFloor_m, 0.3);
  EXPECT_TRUE(editor.view.camera.orthographic);
  EXPECT_NEAR(editor.view.camera.forward().z(), -1, 1e-3);
  gui.key('9');
  EXPECT_GT(*editor.visibility.cut_height_m, ground + 2);
  gui.key('9');
  EXPECT_EQ(*editor.visibility.cut_height_m, ground) << "after the top storey the lowest";
}

TEST_F(Plan, WritesAMeasurementRatherThanTheNameOfTheRoomThatItLiesIn) {
  gui.key('9');
  gui.frames(2);
  const auto times = [&](const std::string& name) {  // other panels may have it, too
    const auto texts = gui.texts();
    return std::count(texts.begin(), texts.end(), name);
  };
  const auto inView = [&](const std::string& name) {
    const auto with = times(name);
    editor.view.room_names = false;
    const auto without = times(name);
    editor.view.room_names = true;
    return with > without;
  };
  const auto& rooms = editor.room_labels.of(editor.session.document().imported);
  const auto shown = std::find_if(rooms.begin(), rooms.end(), [&](const auto& r) { return inView(r.name); });
  ASSERT_NE(shown, rooms.end());
  const auto label = *shown;
  MeasureOptions options{.add = "M1"};
  options.kind = MeasurementKind::distance;
  for (const double x : {-0.5, 0.5})
    options.points.push_back(label.anchor + Eigen::Vector3d(x, 0.02, 0) + editor.shift_m());
  ASSERT_TRUE(editor.session.start(options));
  gui.settle();
  gui.frames(2);
  EXPECT_TRUE(gui.says("1.000 m"));
  EXPECT_FALSE(inView(label.name)) << "it would cover the figure";
}

TEST(Camera, OfAParallelViewLooksAtEachPointFromStraightBeforeIt) {
  Camera camera;
  look(camera, StandardView::top);
  const Eigen::Vector3d p(30, -4, 1);
  EXPECT_EQ(camera.eyeOf(p), camera.eye());
  camera.orthographic = true;
  EXPECT_NEAR((p - camera.eyeOf(p)).normalized().dot(camera.forward()), 1, 1e-12);
  EXPECT_NEAR((p - camera.eyeOf(p)).norm(), (p - camera.eye()).dot(camera.forward()), 1e-9);
}

}  // namespace
}  // namespace standpoint
