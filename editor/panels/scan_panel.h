// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "project/document.h"

namespace standpoint {

struct Model;

// Entries at the end of a list of instruments, not to be chosen: the user's own that are wrong, with place and remedy.
void listBrokenInstruments(const Model& model);

struct ScanState {
  std::shared_ptr<const ScanChoice> remembered;  // the document's, that Model::scan_choice was last filled from
  std::optional<ScanChoice> started;             // with the last press of its button
  bool all_stations = true;
  bool resume = true;  // what a cancelled run has finished is taken where it is the same
  int format = 0;
  std::string folder;
};

}  // namespace standpoint
