// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/instrument/desk.h"

namespace standpoint {

// As one who presses "Finish and grade", and waits.
inline void finishAndGrade(InstrumentDesk& desk, Editor& editor) {
  finishExercise(desk, editor);
  desk.marking->wait();
  takeMarks(desk, editor);
}

}  // namespace standpoint
