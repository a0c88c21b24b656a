// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace standpoint {

// What an emulated instrument shows at one moment, as data: the draw half shows it in the device's skin, a test or an
// exercise reads it and acts on it.
enum class WidgetKind {
  status,   // in the status row: battery, memory, …
  readout,  // label and value
  button,
  key,       // a hard key on the body, or the one that starts and stops the laser
  lamp,      // on the body: `value` is "green", "red flashing", "off"
  choice,    // one of `options`; act with the option's value
  toggle,    // "on" or "off"; act with either, or with nothing to turn it over
  text,      // an entry field; act with the new text
  number,    // an entry field or slider from minimum to maximum; act with the number as text
  list,      // `options` are rows; act with the row's value
  progress,  // `number` is the share
  area,      // the field of view, drawn on the preview; act with "from_h,to_h,from_v,to_v" in degrees
  level,     // a bubble: `options` holds the two tilts in degrees
  preview,   // the picture of the scan that is shown
  plan,      // the stations from above with their links
  seen,      // what a carried scanner has seen so far, from above
  note,      // a paragraph
};
inline constexpr const char* kWidgetKindNames[] = {"status", "readout", "button", "key",  "lamp",     "choice",
                                                   "toggle", "text",    "number", "list", "progress", "area",
                                                   "level",  "preview", "plan",   "seen", "note"};

// What a finger does with a widget beside tapping it. The value of the press says on what: the row of a list, the
// set-up of a mark on a plan.
enum class Gesture {
  tap,
  hold,  // it stays down for half a second
  join,  // of a plan: drawn from the mark of one set-up to that of another, "2,0"
  part,  // of a plan: a link is held; the set-up that has the link
  lay,   // of a plan: a cloud is moved and turned on another, "x,y,turn" in metres and degrees
};
inline constexpr const char* kGestureNames[] = {"tap", "hold", "join", "part", "lay"};
inline constexpr const char* nameOf(Gesture gesture) { return kGestureNames[static_cast<int>(gesture)]; }

// A cloud that can be laid by hand onto another before it is fitted.
struct LaidCloud {
  int setup = -1, onto = -1;                          // of the open project
  double shift_x_m = 0, shift_y_m = 0, turn_deg = 0;  // from where it lay; about itself, anticlockwise
  double start_turn_deg = 0;                          // that it lay turned, with nobody's doing
};

// Where a press leads: a mark of it is drawn.
enum class Leads { nowhere, onwards, back };

struct WidgetOption {
  std::string value, label;
  bool enabled = true;
  std::string why_not;
  int setup = -1;  // of the open project, for its picture
};

struct Widget {
  std::string id;
  WidgetKind kind = WidgetKind::readout;
  std::string label;
  std::string value;                  // as it is shown
  std::vector<WidgetOption> options;  // of a choice or list
  double number = 0, minimum = 0, maximum = 0;
  std::string unit;
  bool enabled = true;
  std::string why_not;  // when it is not enabled; a warning when it is
  Leads leads = Leads::nowhere;
  bool acts = true;               // a press does something; a list that only shows has rows that do not
  std::vector<Gesture> gestures;  // that do something, beside a tap
  std::optional<LaidCloud> laid;  // of a plan on which a cloud is laid

  bool takes(Gesture gesture) const { return std::find(gestures.begin(), gestures.end(), gesture) != gestures.end(); }
};

struct Dialog {
  std::string id;
  std::string text;
  std::vector<Widget> buttons;
};

struct Screen {
  std::string id;  // empty: the display is dark
  std::string title;
  std::vector<Widget> widgets;
  std::vector<Widget> body;  // keys and lamps; always there
  bool has_dialog = false;
  Dialog dialog;     // over the widgets, which wait meanwhile
  double light = 1;  // of the display, as a share
};

// On the dialogue, the screen or the body, in this order; null when it is nowhere.
const Widget* findWidget(const Screen& screen, const std::string& id);

}  // namespace standpoint
