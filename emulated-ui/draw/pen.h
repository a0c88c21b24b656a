// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "emulated-ui/draw/device_view.h"
#include "emulated-ui/draw/skin.h"
#include "emulated-ui/layout/place.h"

namespace standpoint {

// What the drawing of one widget needs to know: skin, size, what was pressed. `unit` is 0.8 of the text's height.
struct Pen {
  const Device& device;
  DeviceView& view;
  const Layout& layout;
  const Skin& skin;
  float unit;
  float left = 0, width = 0;  // of the column that widgets stand in, in the window
  float height = 0;           // that a picture is to fill; 0: as its width gives it
  std::optional<Press> press = {};
  bool editing = false;     // a field was drawn that is edited
  std::string screen = {};  // that is drawn

  // The press, or the wish to have the widget explained.
  void pressed(const std::string& widget, const std::string& value = {}, Gesture by = Gesture::tap) {
    if (view.scrolling || view.held) return;  // the finger moved the screen, or has done what it came for
    if (view.asking)
      view.explained = widget;
    else
      press = Press{widget, value, by};
  }
  float text() const { return unit / 0.8F; }   // height of letters, in pixels
  float touch() const { return 2.6F * unit; }  // the least height of what is pressed by a finger
  float hair(float points = 1) const { return points * unit / 11.6F; }  // the width of a line; a unit has 11.6 points
};

// Letters of the current window are as high as the pen's from now on.
void useText(const Pen& pen);

ImVec2 screenAt(const Pen& pen);  // the next widget's upper left
bool area(const char* id, ImVec2 at,
          ImVec2 size);  // an invisible button, also of what is grey: the device then says why
// The last area was held as long as that takes; a ring about the pointer grows meanwhile. From then on until the finger
// comes down again nothing else is pressed. The right button of a mouse, and Shift+Enter where the pointer is, hold at
// once.
bool isHeldAtOnce();
bool isHeld(Pen& pen);
// An area that presses the widget when it is tapped, and does what holding it does where it takes that.
void touch(Pen& pen, const Widget& w, const char* id, ImVec2 at, ImVec2 size, const std::string& value = {});
void tip(const std::string& text);  // of the last item, when it is hovered
void centred(ImDrawList* list, ImVec2 at, ImVec2 size, ImU32 colour, const std::string& text);
void chevron(const Pen& pen, ImVec2 tip, bool to_the_right, ImU32 colour);  // points where a press leads
ImU32 faded(ImU32 colour, bool enabled);
void frame(const Pen& pen, const Widget& w, ImVec2 at, ImVec2 size);  // about the widget that a hint points to
float wrappedHeight(const std::string& text, float width);
void wrapped(ImVec2 at, float width, ImU32 colour, const std::string& text);

// A text in a box: broken into lines, and smaller where it has to be. What does not fit then is clipped, and stands in
// the view's `cut`.
enum class Align { left, centre, right };
void fitted(const Pen& pen, const std::string& widget, const Box& box, ImU32 colour, const std::string& text,
            Align align = Align::centre, float scale = 1);
// The icon of this name in the middle of a square at x, y; nothing where there is none.
void drawIcon(const Pen& pen, const std::string& id, ImVec2 centre, float size, ImU32 colour);
const std::string& iconOf(const Pen& pen, const std::string& widget);  // empty: none

// The keyboard below the screen, while a field is edited.
float keyboardHeight(const Pen& pen, float room);
void drawKeyboard(Pen& pen, ImVec2 at, ImVec2 size);
bool keyboardIsPressed(const Pen& pen);  // the pointer is on it, and not on the key that ends the editing

void caption(const Pen& pen, const std::string& text);
void drawWidget(Pen& pen, const Widget& w);

// Rows of label and value; what does not fit beside one another stands below one another.
void drawTile(Pen& pen, const Widget& w);
void drawReadout(Pen& pen, const Widget& w);
void drawBigKey(Pen& pen, const Widget& w);
void drawToggle(Pen& pen, const Widget& w);
void drawRows(Pen& pen, const Widget& w);

// The widgets that are pictures.
void drawLevel(Pen& pen, const Widget& w);
void drawArea(Pen& pen, const Widget& w);
void drawPreview(Pen& pen, const Widget& w);
void drawPlan(Pen& pen, const Widget& w);
void drawSeen(Pen& pen, const Widget& w, bool quality = false);
// A preview that fills the box and is moved under a cross-hair by drag, arrow keys and the keys at its edges.
void drawCross(Pen& pen, const Widget& w, const Box& box);
// The picture of a scan where there is one, else a grid of the sphere; false then.
bool scanPicture(const Pen& pen, const std::shared_ptr<const ScanPreview>& preview, ImVec2 at, ImVec2 size);

// A widget that fills a box, as its region says it is drawn.
void drawCell(Pen& pen, const Widget& w, const Region& region, const Box& box);
// All regions of a screen in the display, which the keyboard covers from `covered` on.
void drawRegions(Pen& pen, const Screen& screen, const Region& root, const Box& display, float covered);
// Body, keys and lamps of a face; `scale` is pixels per point.
void drawBody(Pen& pen, const Screen& screen, const DeviceFace& face, ImVec2 at, float scale);

}  // namespace standpoint
