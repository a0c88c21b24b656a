// SPDX-License-Identifier: GPL-3.0-or-later
// Every exercise is solved in the editor's window of 1280 by 800 at 100 %, device and equipment with the pointer alone.
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/instrument/instrument.h"
#include "editor/widgets/theme.h"
#include "emulated-ui/menus.h"
#include "tests/editor/graded.h"
#include "tests/editor/mouse_player.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

std::vector<std::string> idsOfExercises() {
  std::vector<std::string> ids;
  for (const auto& [exercise, file] : knownExercises().readable) ids.push_back(exercise.id);
  return ids;
}

class ByMouse : public testing::TestWithParam<std::string> {
 protected:
  ByMouse() {
    setenv("HOME", folder_.path().c_str(), 1);
    editor.workspace = Workspace::instrument;
  }

  TemporaryFolder folder_;
  Editor editor{verbsWithDemo(), [] {}};
  InstrumentDesk& desk = attachInstrument(editor);
  GuiDriver gui{editor};
};

TEST_P(ByMouse, IsSolved) {
  const auto known = findExercise(GetParam());
  ASSERT_TRUE(known);
  const auto& exercise = known->exercise;
  gui.frames(3);
  if (!exercise.devices.empty() && !isFor(exercise, desk.device->id))
    chooseDevice(desk, editor, *findDevice(exercise.devices.front()), "");
  startExercise(desk, editor, exercise);
  ASSERT_NE(desk.rehearsal, nullptr) << desk.refused;
  gui.settle();
  desk.time_factor = 1;  // what the player needs is not taken for a long time on the device
  MousePlayer player(desk, gui);
  int number = 0;
  for (const auto& action : exercise.solution) {
    const auto wrong = player.play(action);
    ASSERT_EQ(wrong, "") << "action " << number << ": " << toJson(action).dump();
    ++number;
  }
  finishAndGrade(desk, editor);
  ASSERT_TRUE(desk.marks);
  EXPECT_TRUE(desk.marks->passed) << marksText(*desk.marks);
  RecordProperty("clicks", player.clicks());
  leaveExercise(desk, editor);
}

INSTANTIATE_TEST_SUITE_P(Exercises, ByMouse, testing::ValuesIn(idsOfExercises()), [](const auto& id) {
  std::string name = id.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});

}  // namespace
}  // namespace standpoint
