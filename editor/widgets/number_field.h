// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

#include "core/number_text.h"

namespace standpoint {

// How a number is shown and what may be typed.
struct NumberFormat {
  NumberKind kind;
  int decimals = -1;           // while it is not edited; less than 0: as many as six figures need
  const char* zero = nullptr;  // a word that stands for 0: "none"
  double step = 0;             // of the buttons beside it, ten times that with Ctrl; 0: no buttons
  double drag = 0;             // by which the number changes per pixel when its unit is dragged; 0: it cannot be
};

namespace ui {

// The one field in which numbers are typed, as wide as the next item is. The number is shown with its unit, and edited
// without. Enter, Tab and a click elsewhere take over what stands there; Esc takes it back. What cannot be read, or
// lies out of range, stays, in a red frame and with the reason below it, and the value stays as it was. Expressions and
// units: numberFromText. True in the frame in which the value has become another.
bool numberField(const char* id, double& value, const NumberFormat& format, const char* help = nullptr);

// Whether what was typed into the field, which has been drawn in this frame, stays there and is not the value.
bool isNumberRefused(const char* id);

// The same for a text, such as a name: taken over and taken back alike.
bool textField(const char* id, std::string& value, const char* hint = "");

// A bar to pull, with the field of the same number beside it. `low` and `high` are the ends of the bar.
bool numberSlider(const char* id, double& value, double low, double high, const NumberFormat& format,
                  const char* help = nullptr, bool logarithmic = false);

}  // namespace ui
}  // namespace standpoint
