// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <imgui.h>

#include "emulated-ui/draw/device_view.h"
#include "emulated-ui/draw/skin.h"

namespace standpoint {

// What the drawing of one widget needs to know: skin, size, what was pressed. `unit` is 0.8 of the text's height.
struct Pen {
  const Device& device;
  DeviceView& view;
  const Skin& skin;
  float unit;
  float left = 0, width = 0;       // of the column that widgets stand in, in the window
  std::optional<Press> press = {};

  // The press, or the wish to have the widget explained.
  void pressed(const std::string& widget, const std::string& value = {}) {
    if (view.asking) view.explained = widget;
    else press = Press{widget, value};
  }
  float touch() const { return 2.6F * unit; }   // the least height of what is pressed by a finger
};

ImVec2 screenAt(const Pen& pen);                // the next widget's upper left
bool area(Pen& pen, const char* id, ImVec2 at, ImVec2 size, bool enabled);   // an invisible button
void reasonOf(const Widget& w);                  // as a tooltip of the last item
void centred(ImDrawList* list, ImVec2 at, ImVec2 size, ImU32 colour, const std::string& text);

// The widgets that are pictures; the others are in widgets.cpp.
void drawWidget(Pen& pen, const Widget& w);
void drawLevel(Pen& pen, const Widget& w);
void drawArea(Pen& pen, const Widget& w);
void drawPreview(Pen& pen, const Widget& w);
void drawPlan(Pen& pen, const Widget& w);

}  // namespace standpoint
