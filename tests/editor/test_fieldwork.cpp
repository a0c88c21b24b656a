// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/film/shot_setup.h"
#include "editor/instrument/desk.h"
#include "editor/model/fieldwork.h"
#include "editor/model/walking.h"
#include "editor/walking/hiding.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"

namespace standpoint {
namespace {

// Somebody in the demo house beside an RTC360 on its station.
class Fieldworker : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.held.instrument = "leica-rtc360";
    editor.held.station = station().name;
    editor.fieldwork.carry = [this](const std::string& to) { carried_to = to; };
    editor.fieldwork.spend = [this](double seconds) { spent_s += seconds; };
    editor.fieldwork.stand = [this](const std::optional<Eigen::Vector3d>& feet) { stood.push_back(feet.has_value()); };
    editor.picker.wait();
  }
  const Station& station() { return editor.session.document().job->stations.front(); }
  void walk() {
    jumpToStation(editor, 0);
    editor.walk_ground.wait();
    gui.frames(3);
    ASSERT_TRUE(editor.walk.active());
    gui.frames(30);
  }
  // Seen from afar: whoever stands in an instrument does not see it.
  std::size_t bodies() {
    const auto scene = StandingKeeper().of(*editor.session.document().job, editor.held, "", {0, -20, 5},
                                           [](const Station&) { return true; });
    return (scene.still ? scene.still->still.size() : 0) + (scene.working ? 1 : 0);
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
  std::string carried_to;
  double spent_s = 0;
  std::vector<bool> stood;  // in the instrument's view
};

TEST_F(Fieldworker, LooksAtTheInstrumentsScreenAndUpAgainFromWhereHeStands) {
  walk();
  ASSERT_TRUE(instrumentInReach(editor));
  const auto feet = editor.walk.feet();
  gui.key('F');
  gui.frames(2);
  ASSERT_TRUE(editor.fieldwork.at_screen);
  EXPECT_EQ(editor.workspace, Workspace::instrument);
  const auto& body = bodyOf(editor.held.instrument);
  const Pose& pose = station().true_pose;
  EXPECT_NEAR((editor.view.camera.target - pose * body.face_m).norm(), 0, 1e-6);
  EXPECT_LT((editor.view.camera.eye() - editor.view.camera.target).norm(), 0.6);
  EXPECT_LT(editor.view.camera.forward().dot(pose.rotation * body.face_faces), -0.9) << "from before the display";
  gui.key('F');
  gui.frames(2);
  EXPECT_FALSE(editor.fieldwork.at_screen);
  ASSERT_TRUE(editor.walk.active());
  EXPECT_NEAR((editor.walk.feet() - feet).norm(), 0, 0.01);
}

TEST_F(Fieldworker, FindsTheDisplayWhereTheHeadHasTurnedIt) {
  walk();
  editor.held.motion.head_rad = 1.2;
  lookAtInstrument(editor);
  const auto& body = bodyOf(editor.held.instrument);
  const Eigen::Vector3d turned = Eigen::AngleAxisd(-1.2, Eigen::Vector3d::UnitZ()) * body.face_m;
  EXPECT_NEAR((editor.view.camera.target - station().true_pose * turned).norm(), 0, 1e-6);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.fieldwork.at_screen);
  EXPECT_TRUE(editor.walk.active());
}

TEST_F(Fieldworker, CarriesTheInstrumentToANewPlaceAndPutsItDownThere) {
  walk();
  const auto before = bodies();
  gui.key('G');
  gui.frames(2);
  ASSERT_TRUE(editor.held.carried);
  EXPECT_EQ(bodies(), before - 1) << "nothing is left where it was taken away";
  gui.key('G');  // where it stood there is a station
  gui.frames(2);
  EXPECT_FALSE(editor.held.carried);
  EXPECT_EQ(carried_to, station().name);
  const std::string first = station().name;
  editor.held.station = first;
  gui.key('G');
  gui.frames(2);
  ASSERT_TRUE(editor.held.carried);
  keyboard::change('W', true);
  for (int i = 0; i < 200 && (editor.walk.feet() - station().true_pose.translation).head<2>().norm() < 1.3; ++i)
    gui.frames(1);
  keyboard::change('W', false);
  gui.frames(20);
  const auto stations = editor.session.document().job->stations.size();
  gui.key('G');
  gui.settle();
  gui.frames(3);
  if (editor.session.document().job->stations.size() == stations) {
    EXPECT_TRUE(editor.held.carried) << "a refused place leaves it in the hands";
  } else {
    EXPECT_FALSE(editor.held.carried);
    EXPECT_EQ(carried_to, editor.session.document().job->stations.back().name);
  }
}

TEST_F(Fieldworker, LeavesAnInstrumentThatScansWhereItIs) {
  walk();
  editor.held.motion.fans.resize(2);
  gui.key('G');
  gui.frames(2);
  EXPECT_FALSE(editor.held.carried);
  EXPECT_NE(whyNotPickUp(editor), "");
}

TEST_F(Fieldworker, PutsUpASphereOnTheFloorAndThatTakesTime) {
  walk();
  const auto targets = editor.session.document().job->targets.size();
  auto& camera = editor.view.camera;
  const Eigen::Vector3d eye = camera.eye();
  camera.elevation_rad = 1.1;
  camera.target = eye + camera.forward() * camera.distance_m;
  gui.key('B');
  gui.settle();
  ASSERT_EQ(editor.session.document().job->targets.size(), targets + 1);
  EXPECT_EQ(editor.session.document().job->targets.back().kind, TargetKind::sphere);
  EXPECT_EQ(spent_s, kPutUpTarget_s);
}

// Of a column as wide and high as somebody, the share of whose skin a beam of the instrument would meet.
double seenShare(const RayScene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& feet) {
  int all = 0, met = 0;
  for (double height = 0.05; height < 1.75; height += 0.1)
    for (double angle = 0; angle < 6.28; angle += 0.2) {
      const Eigen::Vector3d p = feet + Eigen::Vector3d(0.25 * std::cos(angle), 0.25 * std::sin(angle), height);
      const double range = (p - eye).norm();
      ++all;
      met += scene.intersect(eye, (p - eye) / range, range) ? 0 : 1;
    }
  return static_cast<double>(met) / all;
}

TEST_F(Fieldworker, StepsOutOfTheInstrumentsSightAndReturnsToIt) {
  walk();
  const auto scene = editor.picker.scene();
  const Eigen::Vector3d eye = station().true_pose.translation, began = editor.walk.feet();
  ASSERT_GT(seenShare(*scene, eye, began), 0.3);
  gui.key('H');
  gui.frames(2);
  ASSERT_TRUE(editor.walk.active());
  const Eigen::Vector3d hidden = editor.walk.feet();
  EXPECT_LT(seenShare(*scene, eye, hidden), 0.03) << hidden.transpose();
  EXPECT_GE(spent_s, (hidden - began).norm() / 1.2 - 0.1) << "the way there takes its time on the device's clock";
  EXPECT_LT(spent_s, 60);
  EXPECT_EQ(stood, std::vector<bool>{false});
  EXPECT_FALSE(instrumentInReach(editor));
  const double out_s = spent_s;
  gui.key('R');
  gui.frames(2);
  EXPECT_TRUE(instrumentInReach(editor));
  EXPECT_GT(spent_s, out_s);
  EXPECT_EQ(stood, (std::vector<bool>{false, true}));
  EXPECT_NE(whyNotReturn(editor), "") << "one is there";
  editor.held.carried = true;
  EXPECT_NE(whyNotStepOutOfSight(editor), "") << "nothing looks while it is carried";
}

TEST(Hiding, IsBehindWhatStandsThereAndNotBehindGlass) {
  auto e = std::make_shared<Environment>();
  e->surfaces = {{"grey", {0.5F, 0.5F, 0.5F, 1}}, {"glass", {0.8F, 0.9F, 1, 0.3F}}};
  const auto board = [&](float y, std::uint32_t surface) {
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{2, y - 1, 0}, {2, y + 1, 0}, {2, y + 1, 2.5F}, {2, y - 1, 2.5F}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh->surface_of_triangle = {surface, surface};
    const auto number = static_cast<std::uint32_t>(e->meshes.size());
    e->meshes.push_back(mesh);
    e->products.emplace_back();
    e->instances.push_back({number, number, Eigen::Affine3d::Identity()});
  };
  board(-2, 1);
  board(2, 0);
  Progress progress;
  const auto scene = *RayScene::build(e, progress);
  Mesh floor;
  floor.positions = {{-3, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-3, 4, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  const WalkableMap map(floor);
  const Eigen::Vector3d eye(0, 0, 1.7);
  const Body body{0.25, 1.7};
  EXPECT_TRUE(isInBeam(*scene, eye, {3, -3, 0}, body)) << "through the pane";
  const auto aim = nearestHiding(map, *scene, eye, {0.5, 0, 0}, body);
  ASSERT_TRUE(aim);
  EXPECT_GT(aim->feet.x(), 2);
  EXPECT_GT(aim->feet.y(), 1);
  EXPECT_NEAR(aim->way_m, (aim->feet - Eigen::Vector3d(0.5, 0, 0)).norm(), 0.3);
  Mesh open;
  open.positions = {{-3, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-3, 1, 0}};
  open.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_FALSE(nearestHiding(WalkableMap(open), *scene, eye, {0.5, 0, 0}, body)) << "all of it is seen";
  EXPECT_FALSE(nearestHiding(map, *scene, eye, {30, 0, 0}, body)) << "where nobody can walk";
}

TEST_F(Fieldworker, LeavesInstrumentsOutOfPicturesThatAreTakenFromWhereTheyStand) {
  EXPECT_TRUE(shotOf(editor, ShotKind::picture).view.working);
  EXPECT_TRUE(shotOf(editor, ShotKind::turntable).view.working);
  EXPECT_FALSE(shotOf(editor, ShotKind::panorama).view.working);
  EXPECT_FALSE(shotOf(editor, ShotKind::walk_through).view.working);
  auto request = shotOf(editor, ShotKind::picture);
  ASSERT_TRUE(lookFrom(editor, {.station = station().name}, request));
  EXPECT_FALSE(request.view.working || request.view.instruments);
}

TEST(CarryingTime, IsThatOfTheWayAndOfLevellingOnATribrach) {
  EXPECT_GT(carryingTime_s(bodyOf("leica-p40"), 0), carryingTime_s(bodyOf("leica-rtc360"), 0));
  EXPECT_NEAR(carryingTime_s(bodyOf("leica-rtc360"), 90) - carryingTime_s(bodyOf("leica-rtc360"), 0), 100, 1e-9);
}

TEST(CarryingTime, PassesOnTheDevicesClock) {
  Editor editor(verbsWithDemo(), [] {});
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  editor.session.wait();
  InstrumentDesk desk;
  chooseDevice(desk, editor, *desk.device, {});
  auto document = editor.session.document();
  Job job = *document.job;
  job.stations.push_back(job.stations.front());
  job.stations.back().name = "far";
  job.stations.back().true_pose.translation.x() += 18;
  document.job = std::make_shared<const Job>(job);
  carryTo(desk, document, job.stations.front().name);
  const double before_s = desk.shown()->state().clock_s;
  carryTo(desk, document, "far");
  EXPECT_EQ(desk.shown()->state().around.station, "far");
  const double took_s = desk.shown()->state().clock_s - before_s;
  EXPECT_NEAR(took_s, carryingTime_s(bodyOf(desk.shown()->type().instrument.id), 18), 1e-6);
  carryTo(desk, document, "far");
  EXPECT_EQ(desk.shown()->state().clock_s - before_s, took_s) << "it is there already";
}

}  // namespace
}  // namespace standpoint
