// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "editor/desktop/desktop_opener.h"
#include "editor/film/shot.h"
#include "editor/film/shot_setup.h"
#include "project/task.h"

namespace standpoint {

struct Editor;

// The dialog in which pictures and films are made, and the one that is being made.
struct ShotDialog {
  bool open = false;
  ShotKind kind = ShotKind::picture;
  double width = 1920, height = 1080, rate = 30, seconds = 0;
  ShotPlace place;
  WalkStops stops;
  bool labels = true;              // and measurements, over a picture of the view
  std::string problem;             // why the last one was not made
  std::filesystem::path made;      // the last one
  std::vector<std::string> notes;  // what was left out of it
  std::string copy_problem;        // why it is not in the clipboard
  DesktopOpener opener;

  struct Way {
    std::vector<Eigen::Vector3d> feet;
    Report report;
  };
  ShotRequest request;                 // that is being made
  std::unique_ptr<Task<Way>> finding;  // the way of a walk-through
  bool waits_for_ground = false;
  std::unique_ptr<Shoot> shoot;
  bool busy() const { return waits_for_ground || finding || shoot; }
};

void openShotDialog(Editor& editor, ShotKind kind);
// Draws the dialog, and the next picture of what is being made. Called once a frame.
void drawShotDialog(Editor& editor);

}  // namespace standpoint
