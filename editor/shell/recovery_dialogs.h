// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;

// What is said after a crash, each called once a frame.
void drawBareStart(Editor& editor);  // that it crashed again at once, and what was left out therefore
void drawRecovery(Editor& editor);   // what an earlier editor left, one after the other
// Goes on with the scan that dialogs.resume names, once its project is open.
void resumeLeftScan(Editor& editor);
// Colours, and the assessment of the scans, as they were before a crash: the session keeps them for it, and what was
// recovered gets them once it is open; the assessment is made anew.
void keepHowShown(Editor& editor);
void showAsBefore(Editor& editor);

}  // namespace standpoint
