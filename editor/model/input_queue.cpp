// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/input_queue.h"

#include <algorithm>

namespace standpoint {

namespace {

using Kind = InputEvent::Kind;

// A click belongs to the place where the pointer was, so nothing moves after a button within a frame, and a key or a
// character never overtakes the other.
bool mustWait(const InputEvent& event, const std::vector<InputEvent>& taken) {
  const auto has = [&](Kind kind) {
    return std::any_of(taken.begin(), taken.end(), [&](const InputEvent& e) { return e.kind == kind; });
  };
  switch (event.kind) {
    case Kind::move: return has(Kind::button) || has(Kind::scroll) || has(Kind::key) || has(Kind::character);
    case Kind::button: return has(Kind::button) || has(Kind::scroll);
    case Kind::scroll: return has(Kind::button);
    case Kind::character: return has(Kind::button);
    case Kind::key:
      return has(Kind::button) || has(Kind::character) ||
             std::any_of(taken.begin(), taken.end(),
                         [&](const InputEvent& e) { return e.kind == Kind::key && e.code == event.code; });
  }
  return false;
}

}  // namespace

void InputQueue::push(const InputEvent& event) {
  if (event.kind == Kind::move && !events_.empty() && events_.back().kind == Kind::move)
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
