// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "core/json_file.h"
#include "demo_verbs.h"
#include "editor/instrument/desk.h"
#include "editor/instrument/instrument.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "emulated-ui/classroom/signed_result.h"
#include "emulated-ui/classroom/verify.h"
#include "item_probe.h"
#include "project/storage/project_files.h"
#include "tests/editor/graded.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

// The instrument's workspace, with results in a folder of the test's own.
class InstrumentGui : public testing::Test {
 protected:
  InstrumentGui() {
    setenv("HOME", folder_.path().c_str(), 1);
    attachInstrument(editor);
    editor.workspace = Workspace::instrument;
  }
  void openTab(const std::string& label) {
    gui.frames(3);
    ASSERT_TRUE(gui.click(label));
    gui.frames(2);
  }
  void begin(const std::string& exercise) {
    openTab("Exercise");
    ASSERT_TRUE(gui.click("###" + exercise));
    gui.settle();
    ASSERT_NE(gui.find("###finish"), nullptr);
  }

  TemporaryFolder folder_;
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(InstrumentGui, ShowsTheWholeNameOfEveryExerciseAtEverySize) {
  const auto known = knownExercises();
  for (const float scale : {1.0F, 1.5F, 2.0F}) {
    editor.scale = scale;
    applyTheme(scale);
    editor.fonts = buildFonts(scale);
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    openTab("Exercise");
    int seen = 0;
    for (const auto& [exercise, file] : known.readable) {
      const auto* button = gui.find("###" + exercise.id);
      if (button == nullptr) continue;
      ++seen;
      const auto padding = ImGui::GetStyle().FramePadding;
      const auto text = exercise.id + "  " + exercise.title.in("en");
      const float needs = ImGui::CalcTextSize(text.c_str(), nullptr, false, button->rect.GetWidth() - 2 * padding.x).y;
      EXPECT_GE(button->rect.GetHeight() + 0.5F, needs + 2 * padding.y) << text << " at " << scale;
    }
    EXPECT_GT(seen, 5) << scale;
  }
}

TEST_F(InstrumentGui, KeepsTheKeysFromTheViewWhileThePointerOrAFingerIsOnTheDevice) {
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  gui.settle();
  gui.frames(3);
  const auto hidden = [&] { return editor.visibility.hidden(1); };
  const auto inDevice = [](const GuiItem& item) { return item.window.find("device_") != std::string::npos; };
  const auto& items = itemProbe().items;
  const auto on_device = std::find_if(items.begin(), items.end(), inDevice);
  ASSERT_NE(on_device, items.end());
  const ImVec2 place = on_device->rect.GetCenter();
  const auto type = [&] {
    editor.select(1, true);
    gui.frames(2);
    gui.key('H');
    gui.frames(2);
    return hidden();
  };
  gui.moveTo(place);
  EXPECT_FALSE(type()) << "the pointer is on it";
  gui.key('3');
  gui.key(kKeyDelete);
  gui.frames(2);
  const ImVec2 beside = gui.find("###scene")->rect.GetCenter();
  gui.moveTo(place);
  gui.press();
  gui.moveTo({beside.x, 5});
  EXPECT_FALSE(type()) << "a finger was there last";
  gui.moveTo(beside);
  EXPECT_TRUE(type()) << "the view's own";
}

TEST_F(InstrumentGui, KeepsItsButtonsInPlaceWhenAHintIsShown) {
  begin("T-RTC360");
  const auto before = gui.find("###finish")->rect;
  ASSERT_TRUE(gui.click("###hinton")) << "the first step's";
  gui.frames(2);
  EXPECT_EQ(gui.find("###hinton"), nullptr);
  const auto after = gui.find("###finish")->rect;
  EXPECT_EQ(before.Min.y, after.Min.y);
  EXPECT_EQ(before.Min.x, after.Min.x);
}

TEST_F(InstrumentGui, TellsWhatIsMarkedOnlyWhereHelpIsAllowed) {
  begin("T-RTC360");
  EXPECT_NE(gui.find("###demands"), nullptr);
  ASSERT_TRUE(gui.click("###leave"));
  gui.settle();
  ASSERT_TRUE(gui.click("##guidance"));
  ASSERT_TRUE(gui.click("Test"));
  begin("T-RTC360");
  EXPECT_EQ(gui.find("###demands"), nullptr);
}

// The tablet on which it was worked last is not what one switches the next device on with.
TEST_F(InstrumentGui, BeginsEachDeviceAtItsFirstFace) {
  InstrumentDesk desk;
  const auto& device = *findDevice("leica-rtc360");
  chooseDevice(desk, editor, device, "");
  desk.view.face = "tablet";
  chooseDevice(desk, editor, device, "");
  EXPECT_EQ(desk.view.face, "");
  desk.view.face = "tablet";
  startExercise(desk, editor, findExercise("T-RTC360")->exercise);
  ASSERT_NE(desk.rehearsal, nullptr) << desk.refused;
  EXPECT_EQ(desk.view.face, "");
  leaveExercise(desk, editor);
}

TEST_F(InstrumentGui, OffersTheCertificateAndANewStartOnceItIsMarked) {
  begin("T-RTC360");
  EXPECT_EQ(gui.find("###certificate"), nullptr);
  ASSERT_TRUE(gui.click("###finish"));
  for (int i = 0; i < 2000 && gui.find("###certificate") == nullptr; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    gui.frame();
  }
  EXPECT_EQ(gui.find("###finish"), nullptr) << "it has ended";
  ASSERT_NE(gui.find("###certificate"), nullptr);
  ASSERT_TRUE(gui.click("###again"));
  gui.settle();
  EXPECT_NE(gui.find("###finish"), nullptr);
  EXPECT_EQ(gui.find("###certificate"), nullptr);
}

// As a lecturer gives it, and as a student works on it with the mouse.
TEST_F(InstrumentGui, OpensAnAssignedExerciseForItsStudentsOnlyAndLeavesAResultThatIsVerified) {
  setenv("XDG_CONFIG_HOME", (folder_.path() / "config").c_str(), 1);
  const auto key = SigningKey::make(folder_.path() / "key");
  ASSERT_TRUE(key);
  const auto known = findExercise("T-RTC360");
  const auto exercise = readJsonFile(known->file);
  const auto given = assign({*exercise, "class", {{"s-001", "", "s-001", ""}}, "", {{7, {}}}}, *key);
  const auto file = folder_.path() / "assigned.json";
  std::ofstream(file) << fileText(given.seal);
  InstrumentDesk desk;
  openAssignment(desk, file);
  ASSERT_TRUE(desk.assignment) << desk.refused;
  EXPECT_NE(whyNotStartAssigned(desk), "");
  desk.student = "s-002";
  EXPECT_NE(whyNotStartAssigned(desk), "");
  desk.student = "s-001";
  EXPECT_EQ(whyNotStartAssigned(desk), "");
  const auto* shown = assignedExercise(desk);
  ASSERT_NE(shown, nullptr);
  EXPECT_EQ(shown->id, "T-RTC360");
  const auto* steps = shown->steps.data();
  EXPECT_EQ(assignedExercise(desk)->steps.data(), steps) << "read once, not once a frame";
  startAssigned(desk, editor);
  ASSERT_NE(desk.rehearsal, nullptr) << desk.refused;
  EXPECT_TRUE(desk.rehearsal->exercise().solution.empty());
  // Time passes between the presses, in frames, as it does in the window.
  desk.rehearsal->host().time_factor = 100;
  const auto passTime = [&](int frames) {
    for (int i = 0; i < frames; ++i) desk.rehearsal->pass(0.0371);
  };
  passTime(40);
  for (const auto& action : known->exercise.solution) {
    if (action.kind == RehearsalAction::Kind::wait || action.kind == RehearsalAction::Kind::finish) {
      const auto& host = desk.rehearsal->host();
      // However long the simulation takes: with sanitizers it is minutes.
      for (int i = 0; i < 20000 && (i < 60 || (host.busy() && host.device().state().dialog.empty()));) {
        desk.rehearsal->pass(0.0371);
        if (desk.rehearsal->host().task() == nullptr)
          ++i;
        else
          std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      continue;
    }
    act(desk, action);
    EXPECT_TRUE(desk.said.empty()) << desk.said;
    passTime(9);
  }
  finishAndGrade(desk, editor);
  EXPECT_TRUE(desk.marks->passed) << marksText(*desk.marks);
  ASSERT_FALSE(desk.result.empty()) << desk.refused;
  const auto result = readResult(desk.result);
  ASSERT_TRUE(result) << describe(result.error());
  Progress quiet;
  const auto verified = verifyAlone(*result, "en", quiet);
  ASSERT_TRUE(verified) << describe(verified.error());
  EXPECT_TRUE(verified->verified()) << verified->why;
  EXPECT_EQ(verified->marks->score, desk.marks->score);
  EXPECT_NEAR(verified->marks->seconds, desk.marks->seconds, 0.01);
  leaveExercise(desk, editor);
}

TEST_F(InstrumentGui, SaysWhyAFileIsNoAssignedExercise) {
  const auto file = folder_.path() / "other.json";
  std::ofstream(file) << "{}";
  InstrumentDesk desk;
  openAssignment(desk, file);
  EXPECT_FALSE(desk.assignment);
  EXPECT_NE(desk.refused.find("other.json"), std::string::npos) << desk.refused;
  openTab("Exercise");
  ASSERT_TRUE(gui.click("###open-assignment"));
  gui.frames(2);
  EXPECT_TRUE(editor.dialogs.file.open);
}

TEST_F(InstrumentGui, LocksOnlyTheFieldsOfDeviceAndScannerDuringAnExercise) {
  begin("T-RTC360");
  const auto* device = gui.find("##device");
  ASSERT_NE(device, nullptr);
  EXPECT_TRUE(device->disabled);
  ASSERT_TRUE(gui.click("###leave"));
  gui.settle();
  EXPECT_FALSE(gui.find("##device")->disabled);
}

TEST_F(InstrumentGui, TurnsTheFootScrewsByItsButtons) {
  openTab("Equipment");
  ASSERT_TRUE(gui.click("###screw0"));
  gui.key('A', true);
  gui.type("0.5");
  gui.key(257);
  gui.frames(3);
  ASSERT_TRUE(gui.click("+###more")) << "of the first screw";
  gui.frames(3);
  ASSERT_TRUE(gui.click("###screw0"));
  gui.key('A', true);
  gui.key('C', true);
  EXPECT_STREQ(ImGui::GetClipboardText(), "0.52");
}

// The desk without a window.
class Desk : public testing::Test {
 protected:
  Desk() {
    setenv("HOME", folder_.path().c_str(), 1);
    connect(desk, editor.session);
  }
  void begin(const std::string& id) {
    const auto known = findExercise(id);
    ASSERT_TRUE(known);
    chooseDevice(desk, editor, *desk.device, {});
    startExercise(desk, editor, known->exercise);
    ASSERT_NE(desk.rehearsal, nullptr) << desk.refused;
    editor.session.wait();
    desk.was_busy = true;
  }
  void pass(int milliseconds) {
    for (int i = 0; i < milliseconds; i += 10) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      advance(desk, editor);
    }
  }
  // As the survey's panels and the viewport do.
  void survey(const RehearsalAction& action) {
    EXPECT_EQ(editor.session.whyNot(action.name), "");
    ASSERT_TRUE(editor.session.start(action.name, action.options));
    editor.session.wait();
    advance(desk, editor);
  }
  TemporaryFolder folder_;
  Editor editor{verbsWithDemo(), [] {}};
  InstrumentDesk desk;
};

TEST_F(Desk, WhatIsDoneInTheSurveyBelongsToTheExercise) {
  desk.device = findDevice("faro-focus");
  begin("E06");
  for (const auto& action : desk.rehearsal->exercise().solution) survey(action);
  EXPECT_EQ(editor.session.document().job, desk.rehearsal->document().job);
  finishAndGrade(desk, editor);
  EXPECT_TRUE(desk.marks->passed) << marksText(*desk.marks);
  const auto& actions = desk.rehearsal->actions();
  const auto waits = std::count_if(actions.begin(), actions.end(), [](const RehearsalAction& action) {
    return action.kind == RehearsalAction::Kind::wait;
  });
  EXPECT_EQ(actions.size() - static_cast<std::size_t>(waits), desk.rehearsal->exercise().solution.size())
      << "for the replay, with the time between them";
}

TEST_F(Desk, SpeaksAsTheEditorDoesUntilItsLanguageIsChosenOnTheDevice) {
  followProject(desk, editor);
  ASSERT_NE(desk.host, nullptr);
  const auto language = [&] { return std::as_const(*desk.host).device().state().language; };
  followLanguage(desk);
  ASSERT_EQ(language(), "en");
  speak("de");
  followLanguage(desk);
  EXPECT_EQ(language(), "de");
  auto& state = desk.host->device().change();
  state.values["language"] = state.language = "uk";
  speak("en");
  followLanguage(desk);
  EXPECT_EQ(language(), "uk");
  speak("de");
  followLanguage(desk);
  EXPECT_EQ(language(), "uk");
  speak("en");
}

// Nobody has to save a project to scan in it: its scans have a place of their own until it has a name.
TEST_F(Desk, ScansInAProjectWithoutAName) {
  setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
  Document document = demoHouse();
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "opened"}));
  ASSERT_TRUE(editor.session.folder().empty());
  followProject(desk, editor);
  desk.time_factor = 1000;
  desk.was_busy = true;
  const auto until = [&](const std::function<bool()>& there) {
    for (int i = 0; i < 3000 && !there(); ++i) pass(10);
    return there();
  };
  const auto press = [&](const std::string& widget, const std::string& value = "") {
    act(desk, {RehearsalAction::Kind::press, widget, value, 0, {}});
    EXPECT_EQ(desk.said, "") << widget;
    ASSERT_TRUE(until([&] { return !desk.host->busy(); })) << widget;
  };
  press("power");
  carryTo(desk, document, document.job->stations[0].name);
  ASSERT_NE(std::as_const(*desk.host).device().project(), nullptr) << "nobody has to make one first";
  press("settings");
  press("resolution", "12mm");
  press("images", "off");
  press("back");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "standpoint")) << "nothing is written before somebody scans";
  press("scan");
  ASSERT_TRUE(until([&] { return !editor.session.document().job->stations[0].scans.empty(); }));
  const std::filesystem::path file = editor.session.document().job->stations[0].scans[0].file;
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_NE(file.string().find(editor.session.ownFolder().string()), std::string::npos) << file;
}

TEST_F(Desk, AnExerciseThatRunsKeepsItsModelAndItsPast) {
  desk.device = findDevice("faro-focus");
  begin("E06");
  survey(desk.rehearsal->exercise().solution.front());
  for (const char* verb : {"import", "materials", "optimize", "open-project"})
    EXPECT_NE(editor.session.whyNot(verb).find("E06"), std::string::npos) << verb;
  EXPECT_NE(editor.session.whyNotUndo().find("E06"), std::string::npos);
  EXPECT_EQ(editor.session.whyNotSave(), "");
  leaveExercise(desk, editor);
  editor.session.wait();
  EXPECT_EQ(editor.session.whyNot("materials"), "");
}

TEST_F(Desk, AWayIsTimedByItsSpeeds) {
  desk.device = findDevice("leica-blk2go");
  begin("E19");
  const auto way = timedWay({{0, 0, 0, 9}, {3, 4, 0, 0.5}, {3, 3, 0, 1}});
  EXPECT_EQ(way, nlohmann::json::parse("[[0.0, 0.0, 0.0], [3.0, 4.0, 10.0], [3.0, 3.0, 11.0]]"));
  act(desk, {RehearsalAction::Kind::walk, "", "", 0, way});
  EXPECT_NEAR(desk.rehearsal->fact("walk.length")->number.value(), 6, 1e-9);
}

TEST_F(Desk, GoesOnWithAnExerciseWhoseMarkingIsCancelled) {
  begin("T-RTC360");
  desk.marking = std::make_unique<Task<Graded>>(
      "", [](Progress&) -> Result<Graded> { return failure(ErrorKind::cancelled, "cancelled"); });
  EXPECT_TRUE(desk.ended());
  act(desk, {RehearsalAction::Kind::press, "power", "", 0, {}});
  EXPECT_NE(desk.said, "");
  desk.marking->wait();
  takeMarks(desk, editor);
  EXPECT_FALSE(desk.ended());
  EXPECT_EQ(desk.refused, "");
  act(desk, {RehearsalAction::Kind::press, "power", "", 0, {}});
  EXPECT_EQ(desk.said, "");
  finishAndGrade(desk, editor);
  EXPECT_TRUE(desk.marks);
}

TEST_F(Desk, NothingIsDoneAndNoTimePassesOnceAnExerciseIsMarked) {
  begin("T-RTC360");
  act(desk, {RehearsalAction::Kind::press, "power", "", 0, {}});
  EXPECT_EQ(desk.said, "");
  pass(100);
  EXPECT_GT(desk.rehearsal->seconds(), 0);
  finishAndGrade(desk, editor);
  EXPECT_TRUE(desk.ended());
  EXPECT_TRUE(std::filesystem::exists(desk.marks_folder / "result.html"));
  const double seconds = desk.rehearsal->seconds(), battery = desk.shown()->state().around.battery;
  pass(200);
  EXPECT_EQ(desk.rehearsal->seconds(), seconds);
  EXPECT_EQ(desk.shown()->state().around.battery, battery);
  const auto phase = desk.shown()->state().phase;
  act(desk, {RehearsalAction::Kind::press, "power", "", 0, {}});
  EXPECT_EQ(desk.shown()->state().phase, phase);
  EXPECT_NE(desk.said.find("ended"), std::string::npos);
}

TEST_F(Desk, CallsTheProjectOfAnExerciseByItsIdAndTitle) {
  begin("T-RTC360");
  EXPECT_EQ(editor.session.name(), "T-RTC360 " + desk.rehearsal->exercise().title.in("en"));
  EXPECT_EQ(editor.session.folder().parent_path(), desk.rehearsal->folder());
}

TEST_F(Desk, WhatWasDoneToTheEnvironmentIsSavedWhenTheExerciseIsLeft) {
  begin("T-RTC360");
  const auto folder = desk.rehearsal->folder();
  Progress quiet;
  const nlohmann::json options = {{"add", "S9"}, {"on", {4.0, 2.0, 0.0}}};
  ASSERT_TRUE(desk.rehearsal->act({RehearsalAction::Kind::verb, "station", "", 0, options}, quiet));
  advance(desk, editor);
  EXPECT_TRUE(editor.session.modified());
  leaveExercise(desk, editor);
  editor.session.wait();
  EXPECT_FALSE(editor.session.modified());
  EXPECT_TRUE(editor.session.errors().empty());
  const auto again = loadProject(editor.session.folder(), quiet);
  ASSERT_TRUE(again) << describe(again.error());
  const auto& stations = again->job->stations;
  EXPECT_TRUE(std::any_of(stations.begin(), stations.end(), [](const Station& s) { return s.name == "S9"; }));
}

TEST_F(Desk, PutsWhoeverReturnsIntoThePictureOnlyWhileItScans) {
  begin("E14");
  auto& device = desk.rehearsal->device();
  const auto& document = desk.rehearsal->document();
  const auto& station = document.job->stations.front();
  const Eigen::Vector3d feet = station.true_pose * Eigen::Vector3d(0, -2, -1.5);
  ASSERT_EQ(device.state().around.station, station.name);
  standBy(desk, document, feet);
  EXPECT_FALSE(device.state().around.operator_in_view) << "there is time to go before a scan begins";
  for (const auto& phase : device.type().definition.phases)
    if (phase.laser) device.change().phase = phase.id;
  standBy(desk, document, feet);
  ASSERT_TRUE(device.state().around.operator_in_view) << desk.said;
  EXPECT_NEAR(device.state().around.operator_place.away_m, 2, 0.01);
  EXPECT_NEAR(device.state().around.operator_place.azimuth_deg.value_or(0), 90, 0.1) << "clockwise from X";
  standBy(desk, document, {});
  EXPECT_FALSE(device.state().around.operator_in_view);
}

// A teacher's file beside the program's.
class OwnLayout : public testing::Test {
 protected:
  OwnLayout() : type_(*loadDevice(*findDevice("leica-rtc360"))), device_(type_) {
    setenv("STANDPOINT_LAYOUTS", folder_.path().c_str(), 1);
  }
  ~OwnLayout() override { unsetenv("STANDPOINT_LAYOUTS"); }
  void write(const nlohmann::json& layout) {
    std::ofstream(folder_.path() / "leica-rtc360.json", std::ios::binary) << layout.dump(1);
    // A file system that counts in seconds would not tell two writes apart.
    std::filesystem::last_write_time(
        folder_.path() / "leica-rtc360.json",
        std::filesystem::file_time_type::clock::now() + ++later_ * std::chrono::seconds(2));
  }
  void follow() {
    layouts_.follow(device_, view_, [this] { woken_ = true; });
  }
  std::string first() const { return view_.layout->screens.at("home").root.parts.at(1).widget; }

  TemporaryFolder folder_;
  std::shared_ptr<const DeviceType> type_;
  Device device_;
  DeviceView view_;
  LayoutFollower layouts_;
  std::atomic<bool> woken_ = false;
  int later_ = 0;
};

TEST_F(OwnLayout, IsShownAtOnceWhenItIsSavedAndTheBuiltInOneWhereItIsWrong) {
  follow();
  EXPECT_EQ(first(), "job");
  auto layout = readJsonFile(findDevice("leica-rtc360")->folder() / "layout.json").value();
  auto& rows = layout["screens"]["home"]["region"]["rows"];
  std::swap(rows[1], rows[3]);
  write(layout);
  for (int i = 0; i < 20000 && !woken_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_TRUE(woken_) << "the window is woken without anybody touching it";
  follow();
  EXPECT_EQ(first(), "settings");
  rows[1] = "nothing";
  write(layout);
  follow();
  EXPECT_EQ(first(), "job");
  EXPECT_NE(layouts_.problem().find("leica-rtc360.json /screens/home/region/rows/1"), std::string::npos)
      << layouts_.problem();
  std::filesystem::remove(folder_.path() / "leica-rtc360.json");
  follow();
  EXPECT_EQ(layouts_.problem(), "");
}

}  // namespace
}  // namespace standpoint
