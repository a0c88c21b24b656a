// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/frame_pacer.h"

#include <algorithm>

namespace standpoint {

namespace {

constexpr double kKeyRepeats_s = 1.0 / 30, kWalkerMoves_s = 1.0 / 60, kCursorBlinks_s = 0.4, kBarMoves_s = 0.1;

// The shortest of what there is to wait for; less than 0: nothing but events.
double longestWait(const FramePacer::Reasons& r) {
  double wait = -1;
  const auto atMost = [&](bool reason, double seconds) {
    if (reason) wait = wait < 0 ? seconds : std::min(wait, seconds);
  };
  atMost(r.key_held, kKeyRepeats_s);
  atMost(r.walker_moves, kWalkerMoves_s);
  atMost(r.text_edited, kCursorBlinks_s);
  atMost(r.job_runs, kBarMoves_s);
  atMost(r.refining, 0);
  atMost(r.until_fine_s >= 0, std::max(0.01, r.until_fine_s));
  atMost(r.until_due_s >= 0, std::max(0.01, r.until_due_s));
  return wait;
}

}  // namespace

bool FramePacer::takeWake() {
  if (!dirty_.exchange(false, std::memory_order_acq_rel)) return false;
  drawSome();
  return true;
}

// The event that a worker posts says nothing once poll() has swallowed it: a job that ends while a frame is drawn would
// be shown at the next move of the mouse. So the flag is asked after the poll. What is set after that posts after it,
// too, and ends the wait.
void FramePacer::waitForWork(EventSource& events, const std::function<Reasons()>& reasons) {
  events.poll();
  takeWake();
  const Reasons now = reasons();
  if (now.input || wanted_ > 0) return;
  if (const double wait = longestWait(now); wait >= 0)
    events.waitAtMost(wait);
  else
    events.wait();
  takeWake();
  wanted_ = std::max(wanted_, 1);
}

}  // namespace standpoint
