// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>

namespace standpoint {

// Where input comes from, and where the window's thread sleeps.
class EventSource {
 public:
  virtual ~EventSource() = default;
  virtual void poll() = 0;  // also swallows what was posted to wake the thread
  virtual void wait() = 0;
  virtual void waitAtMost(double seconds) = 0;
};

// How long after the last input a picture is made fine, if that takes so long: at once, so that it is sharp within
// 100 ms, unless that would hold up whoever goes on moving after a moment.
inline double stillFor_s(double fine_picture_s) { return fine_picture_s <= 0.08 ? 0.02 : 0.25; }

// When the next picture is drawn. Nothing is drawn while nothing happens.
class FramePacer {
 public:
  // Why there is something to draw though nothing came in.
  struct Reasons {
    bool input = false;         // is waiting to be drawn
    bool key_held = false;      // repeats once a frame
    bool walker_moves = false;  // slows down, falls or rises by itself; or the camera flies
    bool text_edited = false;   // its cursor blinks
    bool job_runs = false;      // its bar moves
    bool refining = false;      // the picture gets better by being drawn again
    double until_fine_s = -1;   // until the picture may be made fine; less than 0: it is
    double until_due_s = -1;    // until something else is to be done once; less than 0: nothing is
  };

  // From any thread: what was published before this call will be drawn. Whoever calls it posts an event after it.
  void wake() { dirty_.store(true, std::memory_order_release); }
  // Hovering and layouts settle one frame late, a result's panels another.
  void drawSome() { wanted_ = kFrames; }
  void drawn() {
    if (wanted_ > 0) --wanted_;
  }
  int wanted() const { return wanted_; }
  // Returns when a frame is to be drawn.
  void waitForWork(EventSource& events, const std::function<Reasons()>& reasons);

 private:
  static constexpr int kFrames = 3;
  bool takeWake();
  std::atomic<bool> dirty_{false};
  int wanted_ = kFrames;
};

}  // namespace standpoint
