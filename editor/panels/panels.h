// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "editor/model/settings.h"

namespace standpoint {

struct Editor;

enum class Area { left = 0, right = 1, bottom = 2, none = 3 };

struct Panel {
  const char* id;
  const char* title;
  const char* icon;
  std::array<Area, kWorkspaces> area;  // by Workspace
  void (*draw)(Editor&);
};

// The table of panels; within an area they stand in this order. A new one is one file and one line.
std::span<const Panel> panels();

}  // namespace standpoint
