// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/instrument/desk.h"

namespace standpoint {

// The editor shows the desk's exercise, without its device.
inline void showExercises(InstrumentDesk& desk, Editor& editor) {
  connect(desk, editor.session);
  editor.workspace = Workspace::instrument;
  editor.draw_instrument = [&desk](Editor& e) {
    followProject(desk, e);
    advance(desk, e);
    drawExercises(desk, e);
  };
}

// As one who presses "Finish and grade", and waits.
inline void finishAndGrade(InstrumentDesk& desk, Editor& editor) {
  finishExercise(desk, editor);
  desk.marking->wait();
  takeMarks(desk, editor);
}

}  // namespace standpoint
