// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "editor/model/log.h"

namespace standpoint {

class Actions;
struct Model;

struct ImportPreviewState {
  std::uint64_t closed = 0;  // ImportPreview::closed() when this began
  LogFilter filter;          // of its issues
};

// What was read, and what to do with it.
void drawImportPreview(const Model& model, ImportPreviewState& state, Actions& actions);

}  // namespace standpoint
