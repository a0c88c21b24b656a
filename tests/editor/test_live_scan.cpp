// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "demo_verbs.h"
#include "editor/model/walk_recording_steps.h"
#include "editor/shell/actions.h"
#include "editor/shell/overlay.h"
#include "editor/trajectories/live_scan.h"
#include "editor/trajectories/walk_pace.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "survey/instruments.h"
#include "survey/trajectories/trajectory_file.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

constexpr double kFrame_s = 1.0 / 60;
constexpr double kHalf_m = 5, kHigh_m = 3;

// A room of 10 m by 10 m and 3 m high, its floor at 0.
std::shared_ptr<const Environment> room() {
  auto environment = std::make_shared<Environment>();
  environment->surfaces = {{"Plaster", {0.8F, 0.8F, 0.8F, 1}, "#1"}};
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back(static_cast<float>((corner & 1) != 0 ? kHalf_m : -kHalf_m),
                                static_cast<float>((corner & 2) != 0 ? kHalf_m : -kHalf_m),
                                static_cast<float>((corner & 4) != 0 ? kHigh_m : 0));
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 1, 3, 2},
                                   {4, 6, 7, 5},
                                   {0, 4, 5, 1},
                                   {2, 3, 7, 6},
                                   {0, 2, 6, 4},
                                   {1, 5, 7, 3}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
    mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, 0);
  }
  environment->meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  environment->instances.push_back({0, 0, Eigen::Affine3d::Identity()});
  Product product;
  product.id = "#2";
  product.ifc_class = "IfcWall";
  environment->products.push_back(std::move(product));
  return environment;
}

LiveScanSetup setupOf(const std::string& id) {
  Progress progress;
  ScanPreparation prepared;
  prepared.world.environment = room();
  prepared.scene = *RayScene::build(prepared.world.environment, progress);
  auto instrument = *instrumentById(id);
  auto settings = *resolveMovingSettings(instrument, {});
  return {std::make_shared<const ScanPreparation>(std::move(prepared)), std::move(instrument), std::move(settings)};
}

Camera eyesAt(const Vector3d& feet, double heading_rad, double tilt_down_rad) {
  Camera camera;
  camera.azimuth_rad = heading_rad;
  camera.elevation_rad = tilt_down_rad;
  camera.distance_m = 1;
  camera.target = feet + Vector3d(0, 0, 1.6) + camera.forward();
  return camera;
}

using TurnedBy = std::function<double(double time_s)>;
double level(double) { return 0; }

// At that speed along y for so long, turning and tilting.
std::vector<WalkMoment> walkOf(double seconds, double speed_mps, const TurnedBy& heading, const TurnedBy& tilt,
                               const std::string& mount = "hand") {
  std::vector<WalkMoment> moments;
  for (int k = 0; k * kFrame_s <= seconds + 1e-9; ++k) {
    const double time_s = k * kFrame_s;
    const Vector3d feet(0, speed_mps * time_s - 1, 0);
    moments.push_back({time_s, feet, scannerOf(eyesAt(feet, heading(time_s), tilt(time_s)), mount)});
  }
  return moments;
}

WalkedPoses posesOf(const std::vector<WalkMoment>& moments) {
  WalkedPoses poses;
  for (const auto& moment : moments) poses.add(moment);
  return poses;
}

std::vector<LivePoint> castOf(const LiveScanSetup& setup, const WalkedPoses& poses, unsigned one_pulse_in = 1) {
  Progress progress;
  auto cast = castAlong(setup, poses, 0, poses.last_s(), one_pulse_in, Vector3d::Zero(), progress);
  EXPECT_TRUE(cast) << (cast ? "" : cast.error().message);
  return cast ? std::move(cast->points) : std::vector<LivePoint>();
}

double offTheRoom_m(const LivePoint& p) {
  const double x = std::abs(p.place_m[0]), y = std::abs(p.place_m[1]), z = p.place_m[2];
  return std::min({std::abs(x - kHalf_m), std::abs(y - kHalf_m), std::abs(z), std::abs(z - kHigh_m)});
}

double shareOnCeiling(const std::vector<LivePoint>& points) {
  const auto there =
      std::count_if(points.begin(), points.end(), [](const LivePoint& p) { return p.place_m[2] > kHigh_m - 1e-3; });
  return static_cast<double>(there) / static_cast<double>(points.size());
}

TEST(CarriedScanner, IsHeldBesideTheEyesAndTiltedInPlace) {
  const Pose straight = scannerOf(eyesAt({1, 2, 0}, 0, 0), "hand");
  EXPECT_NEAR((straight.translation - Vector3d(1, 2.2, 1.3)).norm(), 0, 1e-9) << "ahead is +Y";
  EXPECT_NEAR((straight.rotation * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 0, 1e-9);
  EXPECT_NEAR((straight.rotation * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 0, 1e-9);
  const Pose tilted = scannerOf(eyesAt({1, 2, 0}, 0, std::numbers::pi / 6), "hand");
  EXPECT_NEAR((tilted.translation - straight.translation).norm(), 0, 1e-9);
  EXPECT_NEAR((tilted.rotation * Vector3d::UnitX()).z(), -0.5, 1e-9);
  const Pose turned = scannerOf(eyesAt({1, 2, 0}, std::numbers::pi / 2, 0), "hand");
  EXPECT_NEAR((turned.translation - Vector3d(0.8, 2, 1.3)).norm(), 0, 1e-9) << "the lever arm turns with the heading";
  EXPECT_NEAR(scannerOf(eyesAt({1, 2, 0}, 0, 0), "body").translation.z(), 1.9, 1e-9);
  EXPECT_EQ(carrierOnFoot("aircraft"), nullptr);
}

TEST(WalkedPoses, MeetEachMomentAndStayAsTheyAreOnceSettled) {
  const auto moments = walkOf(
      1, 1.2, [](double t) { return 3 * t * t; }, [](double t) { return 0.4 * std::sin(5 * t); });
  WalkedPoses growing;
  std::vector<std::pair<double, Pose>> asked;
  for (const auto& moment : moments) {
    growing.add(moment);
    asked.emplace_back(growing.settled_s() - 0.004, growing.pose(growing.settled_s() - 0.004));
  }
  for (const auto& moment : moments) {
    const Pose pose = growing.pose(moment.time_s);
    EXPECT_NEAR((pose.translation - moment.local_from_scanner.translation).norm(), 0, 1e-12);
    EXPECT_NEAR(pose.rotation.angularDistance(moment.local_from_scanner.rotation), 0, 1e-7);
  }
  for (const auto& [time_s, pose] : asked) {
    EXPECT_EQ(growing.pose(time_s).translation, pose.translation) << time_s;
    EXPECT_EQ(growing.pose(time_s).rotation.coeffs(), pose.rotation.coeffs()) << time_s;
  }
}

// Between frames the pose is that of the motion, and not of a chord: a turn of 2 rad/s² and a sway of 0.4 rad.
TEST(WalkedPoses, FollowASmoothMotionBetweenTheFrames) {
  const auto heading = [](double t) { return t * t; };
  const auto tilt = [](double t) { return 0.4 * std::sin(5 * t); };
  const auto poses = posesOf(walkOf(2, 1.2, heading, tilt));
  for (double t = 0.05; t < 1.95; t += 0.0037) {
    const Vector3d feet(0, 1.2 * t - 1, 0);
    const Pose truth = scannerOf(eyesAt(feet, heading(t), tilt(t)), "hand");
    EXPECT_NEAR((poses.pose(t).translation - truth.translation).norm(), 0, 2e-6) << t;
    EXPECT_NEAR(poses.pose(t).rotation.angularDistance(truth.rotation), 0, 3e-5) << t;
  }
}

TEST(WalkPace, SaysHowFastSomebodyGoesAndTurnsAndWhenThatIsTooFast) {
  const auto paceOf = [](double speed_mps, double turn_radps) {
    WalkPace pace;
    pace.begin({1.2, 1.0});
    for (int k = 0; k <= 60; ++k)
      pace.follow(k * kFrame_s, {speed_mps * k * kFrame_s, 0, 0},
                  Eigen::Quaterniond(Eigen::AngleAxisd(turn_radps * k * kFrame_s, Vector3d::UnitZ())));
    return pace;
  };
  const WalkPace calm = paceOf(1.19, 0.99);
  EXPECT_NEAR(calm.speed_mps(), 1.19, 1e-6);
  EXPECT_NEAR(calm.turn_radps(), 0.99, 1e-6);
  EXPECT_FALSE(calm.tooFast() || calm.turnsTooFast());
  EXPECT_EQ(calm.hurried_s(), 0);
  const WalkPace fast = paceOf(1.8, 0);
  EXPECT_NEAR(fast.speed_mps(), 1.8, 1e-6);
  EXPECT_TRUE(fast.tooFast() && !fast.turnsTooFast());
  EXPECT_NEAR(fast.hurried_s(), 1, 0.05);
  EXPECT_TRUE(fast.places().back().hurried);
  EXPECT_NEAR(static_cast<double>(fast.places().size()), 1.8 / 0.25, 2);
  EXPECT_TRUE(paceOf(0, 1.5).turnsTooFast());
  WalkPace unlimited;
  unlimited.begin({});
  for (int k = 0; k <= 60; ++k) unlimited.follow(k * kFrame_s, {9.0 * k, 0, 0}, Eigen::Quaterniond::Identity());
  EXPECT_FALSE(unlimited.tooFast()) << "of an instrument without a limit";
}

TEST(WalkPace, LimitsAreThoseOfTheInstrumentsFile) {
  const auto blk2go = paceLimits(*instrumentById("leica-blk2go"));
  EXPECT_EQ(blk2go.speed_mps, 1.05);
  EXPECT_NEAR(blk2go.turn_radps, 69 * kRadPerDeg, 1e-12);
  EXPECT_EQ(paceLimits(*instrumentById("velodyne-vlp-16")).speed_mps, 0);
  EXPECT_EQ(paceLimits(*instrumentById("leica-rtc360")).turn_radps, 0) << "on a tripod";
}

TEST(LivePoints, ThinTheOldestAndKeepTheNewestWhole) {
  LivePoints points({10, 0, 0}, 4 * LivePoints::kPart);
  constexpr std::size_t kEach = 20000, kTimes = 200;
  for (std::size_t k = 0; k < kTimes; ++k) {
    std::vector<LivePoint> more(kEach);
    for (std::size_t i = 0; i < kEach; ++i) more[i].place_m = {static_cast<float>(k), static_cast<float>(i), 0};
    points.add(std::move(more));
    EXPECT_LE(points.kept(), 4 * LivePoints::kPart);
  }
  EXPECT_EQ(points.seen(), kEach * kTimes);
  EXPECT_GT(points.kept(), LivePoints::kPart);
  EXPECT_LT(points.parts(), 20U);
  std::vector<std::size_t> of(kTimes);
  for (const auto& part : points.shown()) {
    EXPECT_EQ(part.local_from_cloud(0, 3), 10);
    EXPECT_EQ(part.cloud->points.size(), part.cloud->colours.size());
    for (const auto& p : part.cloud->points) ++of[static_cast<std::size_t>(p.position_m[0])];
  }
  EXPECT_EQ(of.back(), kEach);
  EXPECT_GT(of[kTimes / 2], 0U) << "what is old is thin, not gone";
  EXPECT_LT(of[kTimes / 2], kEach / 4);
}

TEST(LivePoints, AreColouredByHeightOrRange) {
  LivePoints points;
  points.add({{{1, 0, 0}, 0, 10}, {{2, 0, 0}, 3, 0}});
  const auto& by_height = points.shown().front().cloud->colours;
  EXPECT_GT(by_height[1][0], by_height[0][0]) << "yellow is high";
  points.colourBy(LiveColour::range);
  const auto shown = points.shown();
  const auto& by_range = shown.front().cloud->colours;
  EXPECT_GT(by_range[0][0], by_range[1][0]);
}

// Whoever goes on and turns at 90°/s meanwhile: of each pulse the pose is its own, so that no wall is bent.
TEST(LiveCast, PutsEachPointOnItsSurfaceWhileOneTurns) {
  const auto setup = setupOf("leica-blk2go");
  const auto points = castOf(setup, posesOf(walkOf(
                                        1, 1.4, [](double t) { return 1.57 * t; }, level)));
  EXPECT_NEAR(static_cast<double>(points.size()), 420000, 15000) << "all pulses of its three quarters of a turn";
  double worst_m = 0;
  for (const auto& p : points) worst_m = std::max(worst_m, offTheRoom_m(p));
  EXPECT_LT(worst_m, 1e-5);
}

// A level VLP-16 in the middle of the room sees 15° up: on the ceiling, 1.7 m above it, nothing nearer than 6.3 m; the
// corners are 7.1 m away. Tilted up by 45° its fan meets it right overhead.
TEST(LiveCast, ATurnedOrTiltedViewChangesWherePointsLand) {
  const auto setup = setupOf("velodyne-vlp-16");
  const auto tilted = [&](double tilt_down_rad) {
    return castOf(setup, posesOf(walkOf(0.5, 0, level, [=](double) { return tilt_down_rad; })));
  };
  const auto straight = tilted(0), up = tilted(-std::numbers::pi / 4);
  ASSERT_GT(straight.size(), 100000U);
  EXPECT_LT(shareOnCeiling(straight), 0.05);
  EXPECT_GT(shareOnCeiling(up), 0.3);
  const auto overhead = [](const LivePoint& p) {
    return p.place_m[2] > kHigh_m - 1e-3 && std::abs(p.place_m[0]) < 3 && p.place_m[1] > -1 && p.place_m[1] < 3;
  };
  EXPECT_EQ(std::count_if(straight.begin(), straight.end(), overhead), 0);
  EXPECT_GT(std::count_if(up.begin(), up.end(), overhead), 1000);

  // A line scanner's plane turns with the heading: none of the BLK2GO's columns is where it was.
  const auto line = setupOf("leica-blk2go");
  const auto turned = [&](double heading_rad) {
    return castOf(line, posesOf(walkOf(
                            0.1, 0, [=](double) { return heading_rad; }, level)));
  };
  const auto north = turned(0), east = turned(-std::numbers::pi / 2);
  ASSERT_FALSE(north.empty());
  EXPECT_GT((Vector3d(north[0].place_m[0], north[0].place_m[1], north[0].place_m[2]) -
             Vector3d(east[0].place_m[0], east[0].place_m[1], east[0].place_m[2]))
                .norm(),
            0.1);
}

TEST(LiveCast, IsTheSameForTheSameWalkInWhateverStretchesItComes) {
  const auto setup = setupOf("navvis-vlx2");
  const auto moments = walkOf(
      0.6, 1.3, [](double t) { return std::sin(4 * t); }, [](double t) { return 0.3 * t; });
  const auto at_once = castOf(setup, posesOf(moments), 2);
  ASSERT_GT(at_once.size(), 100000U);
  WalkedPoses growing;
  std::vector<LivePoint> in_stretches;
  double cast_s = 0;
  Progress progress;
  for (const auto& moment : moments) {
    growing.add(moment);
    auto cast = castAlong(setup, growing, cast_s, growing.settled_s(), 2, Vector3d::Zero(), progress);
    ASSERT_TRUE(cast);
    in_stretches.insert(in_stretches.end(), cast->points.begin(), cast->points.end());
    cast_s = cast->until_s;
  }
  ASSERT_GT(in_stretches.size(), 90000U);
  ASSERT_LE(in_stretches.size(), at_once.size()) << "the last frames are not settled yet";
  for (std::size_t i = 0; i < in_stretches.size(); ++i) ASSERT_EQ(in_stretches[i].place_m, at_once[i].place_m) << i;
}

TEST(LiveCast, SendsOnePulseInAsManyAsTheMachineKeepsUpWith) {
  EXPECT_EQ(usualThinning(setupOf("leica-blk2go")), 1U);
  EXPECT_EQ(usualThinning(setupOf("navvis-vlx3")), 3U);
  const auto setup = setupOf("leica-blk2go");
  const auto poses = posesOf(walkOf(0.5, 1, level, level));
  const auto all = castOf(setup, poses, 1), fourth = castOf(setup, poses, 4);
  EXPECT_NEAR(static_cast<double>(fourth.size()) / static_cast<double>(all.size()), 0.25, 0.02);
  for (const auto& p : fourth) ASSERT_LT(offTheRoom_m(p), 1e-5);
}

TEST(LiveScan, CastsInTheBackgroundWhatIsWalkedAndEndsWithIt) {
  LiveScan live;
  EXPECT_FALSE(live.casts());
  live.begin(setupOf("leica-blk2go"), {0, -1, 0});
  EXPECT_TRUE(live.active() && live.casts());
  for (const auto& moment : walkOf(1, 1, level, level)) live.follow(moment);
  live.wait();
  EXPECT_FALSE(live.active() || live.casts());
  EXPECT_EQ(live.figures().problem, "");
  EXPECT_GT(live.figures().points, 50000U);
  EXPECT_GT(live.figures().points_per_s, 50000);
  ASSERT_FALSE(live.empty());
  for (const auto& part : live.shown())
    for (const auto& p : part.cloud->points)
      ASSERT_LT(offTheRoom_m({{p.position_m[0], p.position_m[1] - 1, p.position_m[2]}}), 1e-5);
  live.colourBy(LiveColour::range);
  EXPECT_FALSE(live.empty()) << "the points stay, and can be coloured anew";
  live.drop();
  EXPECT_TRUE(live.empty());
}

// The demo house; somebody stands in the living room.
class LiveWalk : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
    ASSERT_TRUE(editor.session.save(folder.path() / "house"));
    gui.settle();
  }
  void TearDown() override { itemProbe().listens = false; }
  void walk() {
    gui.key('W');
    editor.walk_ground.wait();
    gui.frames(3);
    ASSERT_TRUE(editor.walk.active());
    editor.view.camera.azimuth_rad = 0;
    gui.frames(30);
  }
  void hold(int key, int frames) {
    keyboard::change(key, true);
    gui.frames(frames);
    keyboard::change(key, false);
  }
  void begin() {
    ASSERT_TRUE(invoke(editor, "scan-walk"));
    editor.scan_readiness.wait();
    gui.frames(2);
    ASSERT_TRUE(editor.recording.live.active());
  }
  void takeIn() {
    if (editor.recording.writes) editor.recording.writes->wait();
    gui.frames(2);
    gui.settle();
  }
  std::vector<std::string> textsOf(const std::function<void()>& act) {
    itemProbe().texts.clear();
    itemProbe().listens = true;
    act();
    itemProbe().listens = false;
    return itemProbe().texts;
  }
  std::string why(const char* action) const { return whyNot(*findAction(action), editor); }
  const Job& job() const { return *editor.session.document().job; }
  TemporaryFolder folder;
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(LiveWalk, NeedsSomebodyWhoWalksAndAScannerThatIsCarriedOnFoot) {
  EXPECT_EQ(why("scan-walk"), "Walk first: the scanner goes where you walk");
  walk();
  EXPECT_EQ(why("scan-walk"), "");
  editor.carried_scan.choice.instrument = "riegl-vux-1uav";
  EXPECT_EQ(why("scan-walk"), "Choose an instrument that is carried on foot in the Scan panel first");
}

TEST_F(LiveWalk, ShowsPointsAsTheyComeAndKeepsTheWalkWithEveryTurn) {
  walk();
  begin();
  hold('W', 40);
  editor.view.camera.elevation_rad = -0.5;  // looks up
  gui.frames(40);
  const double walked_s = editor.recording.record.seconds(), walked_m = editor.recording.record.length_m();
  EXPECT_GT(walked_s, 1.2);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.walk.active()) << "Esc leaves and keeps";
  editor.recording.live.wait();
  EXPECT_GT(editor.recording.live.figures().points, 10000U);
  EXPECT_FALSE(editor.viewState().underlays.empty());
  EXPECT_FALSE(editor.viewState().quick_points);
  takeIn();
  ASSERT_EQ(job().trajectories.size(), 1U);
  const auto& walked = job().trajectories.front();
  EXPECT_EQ(walked.name, "W1");
  ASSERT_TRUE(std::filesystem::exists(walked.file)) << walked.file;
  EXPECT_EQ(editor.survey.trajectory, 0) << "it is chosen";
  Progress progress;
  const auto* format = trajectoryFormat("csv");
  const auto read = format->read(walked.file, *fileFrame(*editor.session.document().georeference, "csv"), progress);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read->samples.time_s.back() - read->samples.time_s.front(), walked_s, 0.1);
  const Vector3d looked = read->samples.pose.back().rotation * Vector3d::UnitX();
  EXPECT_NEAR(std::asin(looked.z()), 0.5, 0.06) << "up, but for the shaking of a hand";
  editor.trajectory_ways.wait();
  ASSERT_NE(editor.trajectory_ways.of(0), nullptr);
  EXPECT_NEAR(editor.trajectory_ways.of(0)->length_m, walked_m, 0.1) << "as it was said while they walked";
}

TEST_F(LiveWalk, HasItsLegendAmongTheChipsWhereNothingElseOfTheViewIs) {
  ImGui::GetIO().DisplaySize = {1280, 800};
  walk();
  begin();
  hold('W', 40);
  editor.recording.live.wait();
  gui.frames(3);
  ASSERT_FALSE(editor.recording.live.empty());
  const auto* chip = gui.find("###live-colour");
  const auto* window = ImGui::FindWindowByName("###viewport");
  ASSERT_TRUE(chip != nullptr && window != nullptr);
  EXPECT_TRUE(gui.says("Height above the feet"));
  EXPECT_TRUE(gui.says("m or more"));
  const ImVec2 end = controlsCorner(editor, window->Pos);
  EXPECT_LE(chip->rect.Max.y, end.y);
  EXPECT_LE(end.x, window->Pos.x + window->Size.x);
  EXPECT_LT(end.y, window->Pos.y + window->Size.y / 2) << "what is scanned stays in sight";
}

TEST_F(LiveWalk, ItsButtonsSayInWordsWhatTheyDoAt1280By800InEachLanguage) {
  ImGui::GetIO().DisplaySize = {1280, 800};
  walk();
  const auto* window = ImGui::FindWindowByName("###viewport");
  for (const char* language : {"en", "de", "uk"}) {
    chooseLanguage(editor, language);
    gui.frames(3);
    const auto *record = gui.find("###tool_record-walk"), *scan = gui.find("###tool_scan-walk"),
               *scanner = gui.find("###live-instrument");
    ASSERT_TRUE(record != nullptr && scan != nullptr && scanner != nullptr);
    EXPECT_THAT(record->label, testing::HasSubstr(tr("Record")));
    EXPECT_THAT(scan->label, testing::HasSubstr(tr("Scan live")));
    const ImGuiWindow& view = *window;
    for (const auto* item : {record, scan, scanner}) {
      EXPECT_LE(item->rect.Max.x, view.Pos.x + view.Size.x) << language << ": " << item->label;
      EXPECT_LT(item->rect.Max.y, view.Pos.y + view.Size.y / 4) << language << ": " << item->label;
    }
    EXPECT_FALSE(record->rect.Overlaps(scan->rect) || scan->rect.Overlaps(scanner->rect)) << language;
  }
}

TEST_F(LiveWalk, TheButtonThatRecordsEndsTheRecordingInItsPlace) {
  walk();
  const ImRect before = gui.find("###tool_record-walk")->rect, beside = gui.find("###tool_scan-walk")->rect;
  ASSERT_TRUE(gui.click("###tool_record-walk"));
  gui.frames(2);
  EXPECT_TRUE(editor.recording.record.active());
  EXPECT_THAT(gui.find("###tool_record-walk")->label, testing::HasSubstr("Stop"));
  EXPECT_EQ(gui.find("###tool_record-walk")->rect.GetWidth(), before.GetWidth());
  EXPECT_EQ(gui.find("###tool_scan-walk")->rect.Min.x, beside.Min.x);
}

TEST_F(LiveWalk, OffersTheRealScanOfTheWalk) {
  EXPECT_EQ(why("scan-walked"), "Scan while walking first");
  walk();
  begin();
  hold('W', 40);
  ASSERT_TRUE(invoke(editor, "scan-walk")) << "the same command ends it";
  editor.recording.live.wait();
  takeIn();
  ASSERT_EQ(job().trajectories.size(), 1U);
  EXPECT_EQ(why("scan-walked"), "");
  ASSERT_TRUE(gui.click("###scan-walked"));
  gui.frames(2);
  EXPECT_TRUE(editor.recording.live.empty()) << "the preview makes room";
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << editor.session.errors().front().error.message;
  ASSERT_EQ(job().trajectories.front().scans.size(), 1U);
  const auto& scan = job().trajectories.front().scans.front();
  EXPECT_EQ(scan.instrument, "leica-blk2go");
  EXPECT_GT(scan.points, 1000U);
  EXPECT_TRUE(std::filesystem::exists(scan.file));
}

TEST_F(LiveWalk, WarnsInWordsOfAPaceThatIsTooFast) {
  walk();
  begin();
  EXPECT_THAT(textsOf([&] { hold('W', 30); }),
              testing::Contains(testing::HasSubstr("Slow down: 1.8 m/s, at most 1.05 m/s")));
  gui.frames(60);
  editor.walk.changeSpeed(-3);  // 0.92 m/s
  EXPECT_THAT(textsOf([&] { hold('S', 40); }), testing::Not(testing::Contains(testing::HasSubstr("Slow down"))));
  const auto turned = textsOf([&] {
    for (int k = 0; k < 30; ++k) {
      editor.view.camera.azimuth_rad += 2 * kFrame_s;
      gui.frame();
    }
  });
  EXPECT_THAT(turned, testing::Contains(testing::HasSubstr("Turn more slowly: 115°/s, at most 69°/s")));
}

TEST_F(LiveWalk, WarnsWhileItOnlyRecordsToo) {
  walk();
  ASSERT_TRUE(invoke(editor, "record-walk"));
  EXPECT_THAT(textsOf([&] { hold('W', 30); }),
              testing::Contains(testing::HasSubstr("Slow down: 1.8 m/s, at most 1.05 m/s")));
  EXPECT_FALSE(editor.recording.live.casts());
  ASSERT_TRUE(invoke(editor, "record-walk"));
  takeIn();
  ASSERT_EQ(job().trajectories.size(), 1U);
  EXPECT_EQ(job().trajectories.front().file, "") << "waypoints";
  EXPECT_GE(job().trajectories.front().waypoints.size(), 2U);
}

TEST_F(LiveWalk, TakesNoTimeWhenNobodyScans) {
  walk();
  begin();
  hold('W', 40);
  ASSERT_TRUE(invoke(editor, "scan-walk"));
  takeIn();
  editor.recording.live.wait();
  editor.trajectory_ways.wait();
  gui.frames(2);
  ASSERT_FALSE(editor.recording.live.casts());
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(std::clock() - before < CLOCKS_PER_SEC / 100, true) << "of 200 ms on the clock";
}

TEST_F(LiveWalk, IsInTheDocumentBeforeAnotherOneIsBegun) {
  walk();
  begin();
  hold('W', 40);
  invoke(editor, "new");
  gui.frames(2);
  EXPECT_TRUE(editor.dialogs.unsaved) << "the walk is work that was not saved";
  EXPECT_EQ(job().trajectories.size(), 1U);
}

}  // namespace
}  // namespace standpoint
