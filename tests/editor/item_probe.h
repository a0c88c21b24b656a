// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/shell/editor.h"

namespace standpoint {

// Reads what Dear ImGui draws, without changing a line of it: the test program is linked with --wrap for the functions
// that every widget goes through, so each frame leaves a list of its items.
struct GuiItem {
  ImGuiID id = 0;
  ImRect rect;
  std::string label;  // as the code wrote it, with "###"
  std::string window;
  bool clipped = false;
  bool disabled = false;
};

struct ItemProbe {
  std::vector<GuiItem> items;  // of the frame drawn last
  std::unordered_map<ImGuiID, std::string> labels;
  std::vector<std::string> texts;  // as they were drawn, while listens
  bool listens = false;
  const GuiItem* find(const std::string& part) const;  // the first whose label ends with it, or is it
};
ItemProbe& itemProbe();

// The editor without window and GL: frames, pointer, keys.
class GuiDriver {
 public:
  explicit GuiDriver(Editor& editor, ImVec2 size = {1280, 800});
  ~GuiDriver();
  GuiDriver(const GuiDriver&) = delete;
  GuiDriver& operator=(const GuiDriver&) = delete;

  void frame();
  void frames(int count);
  void settle();  // tasks done, their results drawn
  void moveTo(ImVec2 place);
  void press(int button = 0);            // and release
  bool click(const std::string& label);  // false when there is no such item
  void activate(ImGuiID id);             // as the keyboard would
  void key(int glfw_key, bool ctrl = false, bool shift = false);
  void type(const std::string& text);
  const GuiItem* find(const std::string& label) { return itemProbe().find(label); }
  std::vector<std::string> texts();       // of another frame, as they are drawn
  bool says(const std::string& english);  // in another frame, within one of its texts
  std::function<void()> draws;            // what is looked at; empty: the editor

 private:
  Editor& editor_;
};

}  // namespace standpoint
