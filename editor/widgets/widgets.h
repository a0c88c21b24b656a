// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include <imgui.h>

#include "core/environment.h"
#include "core/number_text.h"
#include "editor/model/table_text.h"
#include "editor/words/words.h"

namespace standpoint {

struct Style;

// The few widgets that all panels are made of, so that they look and behave alike.
namespace ui {

// A text to be shown. A literal is the program's own and is said in the user's language (words.h); a string was made
// by whoever gives it, and may be a name in a model: it is shown as it is.
class Text {
 public:
  Text(const char* english) : text_(tr(english)) {}
  Text(std::string made) : text_(std::move(made)) {}
  operator const std::string&() const { return text_; }
  const char* c_str() const { return text_.c_str(); }
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

// The label of a widget in the user's language. Its id for Dear ImGui stays that of the English text, so that what is
// open or chosen stays so when the language changes.
class Label {
 public:
  explicit Label(const char* english);
  operator const char*() const { return text_.c_str(); }

 private:
  std::string text_;
};

// A button that says why it cannot be pressed. `why` empty = it can. Reasons and tooltips are translated here.
bool button(const char* label, const std::string& why = {}, ImVec2 size = {0, 0}, const char* tooltip = nullptr);
// The one button of a panel that does what the panel is for.
bool primaryButton(const char* label, const std::string& why = {}, ImVec2 size = {0, 0});
// As wide as there is room, with all of its text, in as many lines as that takes.
bool wideButton(const char* id, const Text& text, const std::string& why = {}, const char* tooltip = nullptr);
// With an edge, so that an empty one is seen.
bool checkbox(const char* label, bool* on);
bool radioButton(const char* label, bool chosen);
// A menu's entry with its icon, or the room for one, before the text; `label` may have an id.
bool menuItem(const char* icon, const std::string& label, const char* keys, const std::string& why);
bool beginMenu(const char* icon, const char* label, bool enabled = true);
inline const ImVec4 kLit(0.25F, 0.56F, 0.97F, 0.30F);  // of a button whose switch or tool is on
// An icon without a frame, for rows and bars.
bool iconButton(const char* label, const char* tooltip, const std::string& why = {}, bool lit = false);
// Shows or hides rows of one kind, and says how many there are. `list` tells apart those of several lists.
void filterButton(const Style& style, const char* list, const char* icon, const char* name, std::size_t count,
                  ImU32 shade, bool& shown);
// Whether a list shows each issue, also those alike.
void listEach(const char* list, bool& each);
// Of the last item, also when it is disabled, once the pointer has rested on it. It covers no other control of its
// panel.
void tooltip(const Text& text);
void tooltipAbove(const Text& text);  // where there is room, for what has other controls below
double tooltipDue_s();                // until one is to be shown; less than 0: none waits

// The text with a line break wherever Dear ImGui, wrapping it to this width, would part a number in itself ("0." and
// "08") or from its unit.
std::string wholeNumbers(const std::string& text, float width);

void heading(const Style& style, const char* text);
// A part that can be folded, and is; its head is as wide as the column. `label` may have an id.
bool foldedSection(const std::string& label);
void dimText(const Text& text);
void wrapped(const Text& text);
void dimWrapped(const Text& text);
// An empty panel: what would be here, and how to get it.
void emptyState(const Style& style, const char* icon, const char* title, const char* text);
void gap(const Style& style, float points = 4);
void focusNext();  // the next item takes the keyboard

// Rows of label and value with aligned columns. Values can be selected by a double click: it copies them.
bool beginProperties(const char* id, float label_fraction = 0.40F);
void property(const Text& label, const Text& value);
void propertyLabel(const Text& label);  // then draw a widget in the value's column
void endProperties();

// Copies a table as a spreadsheet takes it in: an icon at the end of the line that was drawn last.
void copyTable(const char* id, const std::function<TableRows()>& table);

void meter(const Style& style, double fraction, ImU32 tone, float width = 0);  // 0 = all there is
void swatch(const Style& style, const Colour& colour);
bool searchField(const char* id, const char* hint, std::string& text);
void textRightAligned(const Text& text);
// As TableHeadersRow(), with the heads of these columns above their figures, at the right.
void tableHead(std::initializer_list<int> figures);
// The width of each of `count` widgets that fill a row.
float shareOfRow(int count);
// The label of a button of this width: icon and text, or only what of them fits.
std::string fittingLabel(const char* icon, const char* text, const char* id, float width);
// The text, or as much of it before … as fits: for labels of buttons.
std::string fittingText(const std::string& text, float width);
// The same with … in its middle: names of one kind differ at either end.
std::string fittingMiddle(const std::string& text, float width);
// Cuts the text with … to what fits; the tooltip then has all of it.
void fitted(const Text& text, float width);
void fittedMiddle(const Text& text, float width);

}  // namespace ui

std::string metres(double value, int decimals = 3);  // "1.250 m"
std::string coordinates(const Eigen::Vector3d& v);   // "1.250  2.000  0.000"
std::string durationText(double seconds);            // "1:07 min"
ImU32 packed(const std::array<std::uint8_t, 4>& c);  // RGBA

}  // namespace standpoint
