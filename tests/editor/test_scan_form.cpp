// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "demo_verbs.h"
#include "editor/clouds/live_cloud.h"
#include "editor/desktop/user_folders.h"
#include "editor/model/points_in_sight.h"
#include "editor/model/scan_form.h"
#include "editor/model/scan_outlook.h"
#include "editor/model/walking.h"
#include "editor/panels/scan_panel.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "project/survey/scan_request.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

ScanChoice everythingAsked() {
  return {.instrument = "leica-rtc360",
          .settings = {{"resolution", "12mm"}},
          .seed = 9,
          .effects = Effects().without(Effect::striping),
          .weather = {5, 2.5, 0.5, 150, 900},
          .truth = true,
          .compensator = false,
          .panorama = true,
          .panorama_columns = 1024,
          .quality = ScanQuality::reference};
}

TEST(ScanForm, AsksTheVerbForWhatItShows) {
  const auto document = demoHouse();
  auto wanted = everythingAsked();
  const auto ask = [&](const ScanChoice& choice) {
    auto options = jobOptions(scanFields(), optionsOf(choice));
    options["output"] = "x.e57";
    const auto checked = checkOptions(*findVerb(verbs(), "scan"), options);
    EXPECT_TRUE(checked) << describe(checked.error());
    const auto request = scanRequestFrom(document, *optionsFrom(scanFields(), *checked));
    EXPECT_TRUE(request) << describe(request.error());
    return choiceOf(*request);
  };
  wanted.settings = ask(wanted).settings;  // with the defaults filled in
  EXPECT_EQ(ask(wanted), wanted);
  wanted.effects = Effects::none();
  EXPECT_EQ(ask(wanted), wanted);
  EXPECT_TRUE(optionsOf(wanted).ideal);
  const ScanChoice plain{.instrument = "leica-rtc360", .settings = wanted.settings};
  EXPECT_EQ(ask(plain), plain);
  EXPECT_FALSE(optionsOf(plain).weather);
}

TEST(ScanForm, SaysInAWordWhatIsFolded) {
  EXPECT_EQ(effectsSummary(Effects()), "all effects");
  EXPECT_EQ(effectsSummary(Effects::none()), "ideal");
  EXPECT_EQ(effectsSummary(Effects().without(Effect::striping)), "without striping");
  EXPECT_EQ(effectsSummary(Effects().without(Effect::striping).without(Effect::panes).without(Effect::bias)),
            fmt::format("{} of {} effects", effectNames().size() - 3, effectNames().size()));
  EXPECT_EQ(weatherSummary({}), "clear air");
  EXPECT_EQ(weatherSummary({5, 10, 0, 0, 0}), "rain 10 mm/h, visibility 5 km");
}

TEST(ScanOutlook, IsThatOfThePlanAndKnowsWhatTheFileHolds) {
  const auto document = demoHouse();
  Progress progress;
  const auto instrument = *readInstrument(dataFolder() / "scanners" / "instruments" / "leica-rtc360.json");
  OutlookRequest request{
      *RayScene::build(document.environment(), progress), nullptr, document.job, {0, 1}, {.instrument = instrument.id}};
  chooseInstrument(request.asked, instrument);
  ScanOutlookView view({});
  view.want(request, instrument);
  view.wait();
  const auto plain = view.outlook();
  ASSERT_TRUE(plain);
  const auto settings = *resolveSettings(instrument, request.asked.settings);
  EXPECT_EQ(plain->seconds, 2 * (settings.scan_seconds + settings.imaging_seconds));
  EXPECT_GT(plain->points, 1e6);
  EXPECT_LE(plain->points, 2.0 * settings.columns * settings.rows);
  request.asked.truth = true;
  view.want(request, instrument);
  EXPECT_FALSE(view.outlook() && view.outlook()->bytes == plain->bytes)
      << "what is shown is never that of another wish";
  view.wait();
  // Time of 8 bytes, return and count of 1 each, six floats and the flags.
  EXPECT_NEAR((view.outlook()->bytes - plain->bytes) / plain->points, 35.0 * 1024 / 1020, 0.01);
}

class ScanPanel : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.workspace = Workspace::survey;
    editor.wanted_tab[1] = "scan";
    gui.frames(3);
  }
  ScanChoice& asked() { return editor.scan_choice; }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor, {1280, 1400}};
};

TEST_F(ScanPanel, SwitchesEffectsOneByOneAndAllTogether) {
  ASSERT_TRUE(gui.click("###effects"));
  gui.frames(2);
  for (const auto& effect : effectNames()) {
    ASSERT_TRUE(gui.click("###effect-" + std::string(effect.name))) << effect.name;
    gui.frames(2);
    EXPECT_EQ(asked().effects, Effects().without(effect.effect));
    gui.click("###effect-" + std::string(effect.name));
    gui.frames(2);
  }
  EXPECT_EQ(asked().effects, Effects());
  ASSERT_TRUE(gui.click("###ideal"));
  gui.frames(2);
  EXPECT_EQ(asked().effects, Effects::none());
}

struct BrokenOwnInstrument {
  BrokenOwnInstrument() {
    folder.write("mine.json", "{ \"id\": \"mine\", ");
    setenv("STANDPOINT_INSTRUMENTS", folder.path().c_str(), 1);
  }
  ~BrokenOwnInstrument() { unsetenv("STANDPOINT_INSTRUMENTS"); }
  TemporaryFolder folder;
};
class ScanPanelBesideABrokenInstrument : BrokenOwnInstrument, public ScanPanel {};

TEST_F(ScanPanelBesideABrokenInstrument, ListsItAndGoesOnWithTheOthers) {
  EXPECT_NE(editor.instrument("leica-rtc360"), nullptr);
  ASSERT_TRUE(gui.click("###instrument"));
  gui.frames(2);
  const auto* broken = gui.find("Broken: mine.json");
  ASSERT_NE(broken, nullptr);
  EXPECT_TRUE(broken->disabled);
}

TEST_F(ScanPanel, NeedsNoSavedProjectToScanIn) {
  ASSERT_TRUE(editor.session.folder().empty());
  gui.frames(2);
  EXPECT_FALSE(gui.find("###run-scan")->disabled);
  const auto own = editor.session.ownFolder();
  EXPECT_EQ(own.parent_path(), unsavedRoot());
  EXPECT_EQ(editor.session.ownFolder(), own) << "and it stays there";
  editor.session.clear();
  EXPECT_NE(editor.session.ownFolder().filename().string().substr(0, 5), own.filename().string().substr(0, 5));
}

TEST_F(ScanPanel, OneButtonOpensItAndItsOwnSaysWhatItScans) {
  editor.wanted_tab[1] = "plan";
  gui.frames(3);
  ASSERT_FALSE(gui.find("###tool_scan")->disabled);
  EXPECT_TRUE(gui.find("###tool_scan")->label.ends_with("Scan…###tool_scan")) << "as what asks before it acts";
  ASSERT_TRUE(gui.click("###tool_scan"));
  gui.frames(3);
  EXPECT_EQ(editor.front_tab[1], "scan");
  EXPECT_TRUE(gui.find("###tool_scan")->disabled) << "of two buttons in sight one scans";
  EXPECT_TRUE(gui.find("###run-scan")->label.ends_with("Scan all stations###run-scan"));
  const TemporaryFolder folder;
  editor.panels.of<ScanState>() = {.all_stations = false, .folder = folder.path().string()};
  editor.survey.station = 0;
  asked().settings = {{"resolution", "12mm"}};
  gui.frames(3);
  EXPECT_TRUE(gui.find("###run-scan")->label.ends_with("Scan station S1###run-scan"));
  ASSERT_TRUE(gui.click("###run-scan"));
  gui.frames(2);
  EXPECT_EQ(editor.session.whyNot("scan"), "Wait for 'Scan station S1' to finish, or cancel it");
  editor.session.cancelAll();
  gui.settle();
}

TEST_F(ScanPanel, SaysWithoutBeingAskedWhyItCannotScanYet) {
  Document document = editor.session.document();
  Job job = *document.job;
  job.stations.clear();
  document.job = std::make_shared<const Job>(std::move(job));
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "no stations yet"}));
  gui.frames(2);
  EXPECT_TRUE(gui.says("Add a station first"));
}

TEST_F(ScanPanel, PlansNoCoverageWithoutAStationButFindsAPlaceForTheFirst) {
  Document document = editor.session.document();
  Job job = *document.job;
  job.stations.clear();
  document.job = std::make_shared<const Job>(std::move(job));
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "no stations yet"}));
  editor.wanted_tab[1] = "plan";
  gui.frames(3);
  ASSERT_NE(gui.find("###run-plan"), nullptr);
  EXPECT_TRUE(gui.find("###run-plan")->disabled);
  EXPECT_TRUE(gui.says("Add a station first"));
  ASSERT_TRUE(gui.click("###first-place"));
  gui.settle();
  gui.frames(2);
  EXPECT_NE(gui.find("###add-proposed"), nullptr);
  for (const auto& text : gui.texts()) EXPECT_FALSE(text.starts_with("Ifc")) << "a class has one name: " << text;
}

TEST_F(ScanPanel, KeepsTheHeadsOfItsPartsInItsColumn) {
  gui.frames(3);
  const auto* button = gui.find("###run-scan");
  ASSERT_NE(button, nullptr);
  for (const char* id : {"###effects", "###weather"}) {
    const auto* head = gui.find(id);
    ASSERT_NE(head, nullptr) << id;
    EXPECT_NEAR(head->rect.Min.x, button->rect.Min.x, 1) << id;
    EXPECT_LE(head->rect.Max.x, button->rect.Max.x + 1) << id;
  }
}

TEST_F(ScanPanel, RefusesWeatherThatCannotBe) {
  editor.panels.of<ScanState>().folder = "/anywhere";
  gui.frames(2);
  ASSERT_FALSE(gui.find("###run-scan")->disabled);
  asked().weather.visibility_km = 0;
  gui.frames(2);
  EXPECT_TRUE(gui.find("###run-scan")->disabled);
}

TEST_F(ScanPanel, RefusesSettingsThatDoNotGoTogether) {
  editor.panels.of<ScanState>().folder = "/anywhere";
  chooseInstrument(asked(), *editor.instrument("faro-focus-s350"));
  for (auto& [key, value] : asked().settings)
    if (key == "resolution") value = "1/32";
  gui.frames(2);
  ASSERT_NE(gui.find("###run-scan"), nullptr);
  EXPECT_TRUE(gui.find("###run-scan")->disabled);
}

TEST_F(ScanPanel, ScansTheAreaWhoseEdgeIsSet) {
  chooseInstrument(asked(), *editor.instrument("leica-rtc360"));
  gui.frames(3);
  const auto valueOf = [&](const std::string& key) {
    for (const auto& [name, value] : asked().settings)
      if (name == key) return value;
    return std::string();
  };
  ASSERT_EQ(valueOf("field_of_view"), "full_dome");
  const auto& settings = editor.instrument("leica-rtc360")->settings;
  const auto edge = std::find_if(settings.begin(), settings.end(), [](auto& s) { return s.key == "horizontal_to"; });
  ASSERT_NE(edge, settings.end());
  std::vector<ImRect> fields;
  for (const auto& item : itemProbe().items)
    if (item.label.ends_with("###value")) fields.push_back(item.rect);
  gui.moveTo(fields.at(static_cast<std::size_t>(edge - settings.begin())).GetCenter());
  gui.press();
  gui.frames(2);
  gui.type("90-45");
  gui.key(kKeyEnter);
  gui.frames(3);
  EXPECT_EQ(valueOf("horizontal_to"), "45");
  EXPECT_EQ(valueOf("field_of_view"), "target_area");
  EXPECT_FALSE(gui.find("###run-scan")->disabled);
}

TEST_F(ScanPanel, BeginsWithWhatTheProjectWasScannedWithLast) {
  Document document = demoHouse();
  const auto last = everythingAsked();
  document.scanning = std::make_shared<const ScanChoice>(last);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "opened"}));
  gui.frames(2);
  EXPECT_EQ(asked(), last);
  asked().truth = false;
  gui.frames(2);
  EXPECT_FALSE(asked().truth) << "what is set afterwards stays";
}

TEST_F(ScanPanel, ScansWithWhatIsSetAndTheDocumentRemembersIt) {
  const TemporaryFolder folder;
  editor.panels.of<ScanState>().folder = folder.path().string();
  editor.panels.of<ScanState>().all_stations = false;
  editor.survey.station = 0;
  chooseInstrument(asked(), *editor.instrument("faro-focus-s350"));
  for (auto& [key, value] : asked().settings)
    if (key == "resolution" || key == "quality") value = key == "quality" ? "4x" : "1/32";
  asked().truth = true;
  asked().effects = Effects().without(Effect::footprint);
  const auto wanted = asked();
  gui.frames(2);
  ASSERT_NE(gui.find("###run-scan"), nullptr);
  ASSERT_FALSE(gui.find("###run-scan")->disabled);
  ASSERT_TRUE(gui.click("###run-scan"));
  EXPECT_TRUE(editor.cloud()) << "the model gives way to the points at once";
  gui.settle();
  ASSERT_TRUE(editor.cloud()) << "and they stay";
  EXPECT_FALSE(editor.showsLiveScan());
  const auto& scan = editor.session.document().job->stations[0].scans.back();
  EXPECT_EQ(editor.cloud()->points_in_file, scan.points);
  EXPECT_EQ(editor.cloud()->file, folder / "S1.e57") << "all of it, in place of what was seen as it came";
  EXPECT_EQ(editor.cloud()->points.size(), std::min<std::uint64_t>(scan.points, kMostInMemory));
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_TRUE(editor.session.document().scanning);
  EXPECT_EQ(*editor.session.document().scanning, wanted);
  EXPECT_TRUE(std::filesystem::exists(folder / "S1.e57"));
  editor.session.undo();
  gui.settle();
  EXPECT_FALSE(editor.cloud()) << "a scan that is undone is not shown";
}

// Of a cloud around the origin of the local frame.
double shareInView(const Editor& editor) {
  return shareWithPoints(*editor.cloud(), editor.view.camera, editor.view.size, [&](const Eigen::Vector3d& p) {
    return p.z() <= editor.visibility.cut_height_m.value_or(1e9);
  });
}

TEST_F(ScanPanel, TakesTheCameraToPointsThatItWouldNotSeeAndLeavesItWhereItSeesThem) {
  const TemporaryFolder folder;
  editor.panels.of<ScanState>().folder = folder.path().string();
  editor.panels.of<ScanState>().all_stations = false;
  editor.survey.station = 0;
  chooseInstrument(asked(), *editor.instrument("faro-focus-s350"));
  for (auto& [key, value] : asked().settings)
    if (key == "resolution" || key == "quality") value = key == "quality" ? "4x" : "1/32";
  const auto scanFrom = [&](const Camera& camera) {
    editor.wanted_tab[1] = "scan";
    gui.frames(2);
    editor.view.camera = camera;
    EXPECT_TRUE(gui.click("###run-scan"));
    gui.settle();
    EXPECT_TRUE(editor.cloud());
  };
  Camera away;  // in front of the house, with its back to it
  away.target = editor.buildingBounds().min - Eigen::Vector3d(0, 20, 0);
  away.azimuth_rad = std::numbers::pi;
  away.elevation_rad = 0;
  away.distance_m = 1;
  scanFrom(away);
  EXPECT_FALSE(editor.view.camera == away);
  EXPECT_GT(shareInView(editor), 0.1);
  ASSERT_TRUE(editor.visibility.cut_height_m) << "the ceiling would hide the room";
  const auto& station = editor.session.document().job->stations[0];
  EXPECT_LT(*editor.visibility.cut_height_m, station.true_pose.translation.z());
  const Camera seen = editor.view.camera;
  goBackInViews(editor);
  EXPECT_EQ(editor.view.camera, away);
  EXPECT_FALSE(editor.visibility.cut_height_m);
  editor.showClouds({});
  editor.visibility.cut_height_m = station.true_pose.translation.z() - 0.3;
  scanFrom(seen);
  EXPECT_EQ(editor.view.camera, seen) << "it sees them already";
  EXPECT_TRUE(editor.views.empty());
}

TEST(PointsInSight, LeavesOutTheFewThatWereMetFarAway) {
  Cloud cloud;
  for (int i = 0; i < 1000; ++i)
    cloud.points.emplace_back().position_m = {static_cast<float>(i % 10), static_cast<float>(i / 10 % 10),
                                              static_cast<float>(i / 100)};
  for (int i = 0; i < 20; ++i) cloud.points.emplace_back().position_m = {500, 0, 0};
  const auto all = [](const Eigen::Vector3d&) { return true; };
  EXPECT_LT(boundsOfMost(cloud, all).max.x(), 10);
  EXPECT_GT(boundsOfMost(cloud, all).max.x(), 8);
  EXPECT_EQ(boundsOfMost(cloud, [](const Eigen::Vector3d& p) { return p.x() > 100; }).min.x(), 500);
  EXPECT_TRUE(boundsOfMost(cloud, [](const Eigen::Vector3d&) { return false; }).empty());
}

PointBlock pointsAlongX(int from, int count) {
  PointBlock block;
  for (int i = from; i < from + count; ++i) {
    block.x_m.push_back(static_cast<float>(i));
    block.y_m.push_back(0);
    block.z_m.push_back(0);
    block.intensity.push_back(0.5F);
  }
  return block;
}

TEST(CloudSampler, KeepsAnEvenPartOfAnyNumberOfPoints) {
  CloudSampler sampler(1, 100, {10, 0, 0});
  ASSERT_TRUE(sampler.begin(ScanHeader()));
  for (int from = 0; from < 1000; from += 50) ASSERT_TRUE(sampler.write(pointsAlongX(from, 50)));
  const auto cloud = sampler.coloured();
  EXPECT_EQ(cloud.points_in_file, 1000U);
  ASSERT_GT(cloud.points.size(), 50U);
  ASSERT_LE(cloud.points.size(), 100U);
  const float step = cloud.points[1].position_m[0] - cloud.points[0].position_m[0];
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    EXPECT_EQ(cloud.points[i].position_m[0], static_cast<float>(i) * step - 10) << "shifted, none left out";
  EXPECT_GT(static_cast<float>(cloud.points.size()) * step, 999);
}

TEST(LiveCloud, WakesWithTheFirstPointsAndGivesNothingTwice) {
  int woken = 0;
  LiveCloud live(Eigen::Vector3d::Zero(), [&] { ++woken; });
  EXPECT_EQ(live.newer(), nullptr);
  ASSERT_TRUE(live.begin(ScanHeader()));
  ASSERT_TRUE(live.write(pointsAlongX(0, 3)));
  EXPECT_EQ(woken, 1);
  const auto first = live.newer();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->colours.size(), 3U);
  EXPECT_EQ(live.newer(true), nullptr);
  ASSERT_TRUE(live.write(pointsAlongX(3, 2)));
  EXPECT_EQ(live.newer(true)->colours.size(), 5U);
}

}  // namespace
}  // namespace standpoint
