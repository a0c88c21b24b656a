// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes beside the sample solution, as the view has them. The pictures stay in the build folder for people to look
// at.
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "editor/instrument/desk.h"
#include "editor/viewport/offscreen.h"
#include "project/verb.h"
#include "tests/editor/graded.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using Actions = std::vector<RehearsalAction>;

class MistakePictures : public testing::Test {
 protected:
  void SetUp() override {
    setenv("HOME", folder_.path().c_str(), 1);
    auto made = Offscreen::create(1440, 900, 1);
    if (!made) GTEST_SKIP() << describe(made.error());
    offscreen_ = std::move(*made);
    offscreen_->adopt(editor_);
    showExercises(desk_, editor_);
  }
  void shows(const std::string& id, const std::string& device, const std::string& rule_id,
             const std::function<void(Actions&)>& spoil) {
    const auto known = findExercise(id);
    ASSERT_TRUE(known);
    desk_.device = findDevice(device);
    followProject(desk_, editor_);
    startExercise(desk_, editor_, known->exercise);
    ASSERT_NE(desk_.rehearsal, nullptr) << desk_.refused;
    editor_.session.wait();
    auto actions = known->exercise.solution;
    spoil(actions);
    Progress quiet;
    for (const auto& action : actions) EXPECT_TRUE(desk_.rehearsal->act(action, quiet)) << toJson(action).dump();
    finishAndGrade(desk_, editor_);
    offscreen_->frame(editor_);
    const MarkedRule* rule = nullptr;
    for (const auto& r : desk_.marks->rules)
      if (r.id == rule_id) rule = &r;
    ASSERT_NE(rule, nullptr);
    ASSERT_TRUE(rule->shown) << marksText(*desk_.marks);
    offscreen_->frame(editor_);
    desk_.mistakes.show(*desk_.rehearsal, *rule, editor_);
    for (int i = 0; i < 20000 && editor_.proof->points && !(editor_.proof->yours && editor_.proof->good); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      desk_.mistakes.follow(editor_);
    }
    EXPECT_TRUE(editor_.proof->good) << editor_.proof->good_text;
    const auto folder = std::filesystem::path(BINARY_DIR) / "mistakes";
    std::filesystem::create_directories(folder);
    EXPECT_TRUE(offscreen_->picture(editor_, folder / (id + "-" + rule_id + ".png")));
    // One camera, but not one picture.
    const auto yours = offscreen_->scene().pixels(editor_.proofState(editor_.proof->yours), 400, 500);
    const auto good = offscreen_->scene().pixels(editor_.proofState(editor_.proof->good), 400, 500);
    ASSERT_TRUE(yours && good);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < yours->rgba.size(); ++i) differing += yours->rgba[i] != good->rgba[i] ? 1 : 0;
    EXPECT_GT(differing, yours->rgba.size() / 200) << id;
  }
  static void with(Actions& actions, const std::string& name, const std::string& value) {
    for (auto& action : actions)
      if (action.name == name) action.value = value;
  }
  static void insertAfter(Actions& actions, const std::string& name, const RehearsalAction& more) {
    for (std::size_t i = 0; i < actions.size(); ++i)
      if (actions[i].name == name) actions.insert(actions.begin() + static_cast<std::ptrdiff_t>(++i), more);
  }

  TemporaryFolder folder_;
  std::unique_ptr<Offscreen> offscreen_;
  Editor editor_{{verbs().begin(), verbs().end()}, [] {}};
  InstrumentDesk desk_;
};

TEST_F(MistakePictures, ATiltedScanCrossesTheSurface) {
  shows("E05", "faro-focus", "levelled", [](Actions& actions) {
    std::erase_if(actions, [](const RehearsalAction& a) { return a.name == "level"; });
    insertAfter(actions, "start_scan", {RehearsalAction::Kind::press, "continue", "", 0, {}});
  });
}

TEST_F(MistakePictures, ACoarseScanHasGapsBetweenItsPoints) {
  shows("E03", "faro-focus", "fine_enough", [](Actions& actions) { with(actions, "resolution", "1/16"); });
}

TEST_F(MistakePictures, APersonStandsInTheScan) {
  shows("E12", "leica-rtc360", "clean", [](Actions& actions) { with(actions, "double_scan", "off"); });
}

TEST_F(MistakePictures, AWrongTargetHeightLiftsTheFloor) {
  shows("E14", "leica-p-series", "delivered", [](Actions& actions) {
    insertAfter(actions, "view_list", {RehearsalAction::Kind::press, "target_height", "0.18", 0, {}});
  });
}

}  // namespace
}  // namespace standpoint
