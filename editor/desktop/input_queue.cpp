// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/input_queue.h"

#include <algorithm>

namespace standpoint {

namespace {

using EventKind = InputEvent::Kind;

// Keys that make no character and need not come first: Shift, Alt, AltGr.
bool onlyModifies(int code) { return code == 340 || code == 344 || code == 342 || code == 346; }

bool modifies(int code) { return code >= 340 && code <= 347; }  // Shift, Ctrl, Alt, Super, left and right

// Ctrl, Backspace, arrows, Enter: what comes after them is another edit.
bool editsBeforeCharacters(const InputEvent& e) {
  return e.kind == EventKind::key && e.down && e.code >= 256 && !onlyModifies(e.code);
}

// A click belongs to the place where the pointer was, so nothing moves after a button within a frame; and what is
// clicked must have been hovered in the frame before: Dear ImGui lets tabs, and rows with buttons in them, know of a
// press only then, so a press waits for the move that led there. Dear ImGui takes the characters of a frame before its
// keys: a character waits for such a key before it, and no key for a character. A key goes down with the modifiers of
// its moment, so these change in the next frame.
bool mustWait(const InputEvent& event, const std::vector<InputEvent>& taken) {
  const auto has = [&](EventKind kind) {
    return std::any_of(taken.begin(), taken.end(), [&](const InputEvent& e) { return e.kind == kind; });
  };
  switch (event.kind) {
    case EventKind::move:
      return has(EventKind::button) || has(EventKind::scroll) || has(EventKind::key) || has(EventKind::character);
    case EventKind::button:
      return has(EventKind::button) || has(EventKind::scroll) || (event.down && has(EventKind::move));
    case EventKind::scroll: return has(EventKind::button);
    case EventKind::character:
      return has(EventKind::button) || std::any_of(taken.begin(), taken.end(), editsBeforeCharacters);
    case EventKind::key:
      return has(EventKind::button) || std::any_of(taken.begin(), taken.end(), [&](const InputEvent& e) {
               if (e.kind != EventKind::key) return false;
               return e.code == event.code || (modifies(event.code) && e.down && !modifies(e.code));
             });
  }
  return false;
}

}  // namespace

void InputQueue::push(const InputEvent& event) {
  if (event.kind == EventKind::move && !events_.empty() && events_.back().kind == EventKind::move)
    events_.back() = event;
  else
    events_.push_back(event);
}

std::vector<InputEvent> InputQueue::takeFrame() {
  std::vector<InputEvent> taken;
  while (!events_.empty() && !mustWait(events_.front(), taken)) {
    taken.push_back(events_.front());
    events_.pop_front();
  }
  return taken;
}

}  // namespace standpoint
