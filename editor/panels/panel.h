// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <any>
#include <array>
#include <map>
#include <typeindex>

#include "editor/model/settings.h"

namespace standpoint {

class Actions;
struct Model;

// What the panels remember between two frames, each in a type of its own: a plain value, without ImGui and GL, that
// begins as State().
class PanelStates {
 public:
  template <class State>
  State& of() {
    auto& kept = kept_[typeid(State)];
    if (!kept.has_value()) kept = State();
    return *std::any_cast<State>(&kept);
  }

 private:
  std::map<std::type_index, std::any> kept_;
};

enum class Area { left = 0, right = 1, bottom = 2, none = 3 };

struct Panel {
  const char* id;
  const char* title;
  const char* icon;
  std::array<Area, kWorkspaces> area;                  // by Workspace
  void (*draw)(const Model&, PanelStates&, Actions&);  // gives the panel its own state, and no other's
};

}  // namespace standpoint
