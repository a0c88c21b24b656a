// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/report.h"
#include "core/result.h"
#include "editor/film/shot_setup.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {

// What the command line asks for: "--turntable FILE --size 1280x720".
struct ShotOptions {
  ShotKind kind = ShotKind::picture;
  std::filesystem::path file;
  std::optional<int> width, height;
  std::optional<double> rate, seconds;
  ShotPlace place;
  WalkStops stops;
  GraphicsLevel graphics = GraphicsLevel::medium;
};

// Takes an option and its value; false where it is none of these.
Result<bool> takeShotOption(const std::string& option, const std::string& value, std::optional<ShotOptions>& options);
bool isShotOption(const std::string& option);
std::string shotUsage();

// Of the project that is open in the editor, without a display.
Result<void> makeShot(Editor& editor, Offscreen& offscreen, const ShotOptions& options, Report& report,
                      Progress& progress);

}  // namespace standpoint
