// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;

// What is said after a crash, each called once a frame.
void drawBareStart(Editor& editor);  // that it crashed again at once, and what was left out therefore
void drawRecovery(Editor& editor);   // what an earlier editor left, one after the other
// Goes on with the scan that dialogs.resume names, once its project is open.
void resumeLeftScan(Editor& editor);

}  // namespace standpoint
