// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/instrument/desk.h"
#include "tests/editor/item_probe.h"

namespace standpoint {

// Plays recorded actions in the editor's window with pointer, wheel and keyboard alone, as somebody would who knows
// what is to be pressed: it finds the widget on the drawn device, turns tabs and scrolls until it is in sight, and
// clicks, types or drags there. Waits, the survey's verbs, walks and answers, which are no press on the device, are
// done without the pointer.
class MousePlayer {
 public:
  MousePlayer(InstrumentDesk& desk, GuiDriver& gui) : desk_(desk), gui_(gui) {}
  // Empty: done. Else what is in the way.
  std::string play(const RehearsalAction& action);
  int clicks() const { return clicks_; }

 private:
  std::string press(const RehearsalAction& action);
  std::string hand(const RehearsalAction& action);
  std::string choose(const Widget& widget, const std::string& value);
  std::string enter(const Widget& widget, const std::string& value);
  std::string dragEdges(const Widget& widget, const std::string& value);
  std::string refusal() const;
  void click(ImVec2 at);
  void drag(ImVec2 from, ImVec2 to);
  const Widget* onDevice(const std::string& id);
  // In sight: the part of it that a pointer reaches; tabs are turned and lists scrolled for it.
  std::optional<ImRect> reach(const Widget& widget, const std::string& option = {});
  std::optional<ImRect> visible(const Widget& widget, const std::string& option, std::string* scroll) const;

  InstrumentDesk& desk_;
  GuiDriver& gui_;
  Screen screen_;  // that was asked last
  int clicks_ = 0;
};

}  // namespace standpoint
