// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

namespace standpoint {

// Codes of keys and buttons are GLFW's numbers: letters and digits are their ASCII capitals.
struct InputEvent {
  enum class Kind { move, button, scroll, key, character };
  Kind kind = Kind::move;
  double x = 0, y = 0;  // pointer position; of scroll, the steps
  int code = 0;         // button, key or Unicode code point
  bool down = false;
  int modifiers = 0;
};

// Hands the interface at most one transition of each key and button per frame. Dear ImGui sees the state once a frame,
// so a key that goes down and up between two slow frames would otherwise never have been pressed.
class InputQueue {
 public:
  void push(const InputEvent& event);
  bool pending() const { return !events_.empty(); }
  // What the next frame may see, in order; the rest waits.
  std::vector<InputEvent> takeFrame();

 private:
  std::deque<InputEvent> events_;
};

}  // namespace standpoint
