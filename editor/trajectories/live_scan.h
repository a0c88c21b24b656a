// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "editor/trajectories/live_cast.h"

namespace standpoint {

// How a live scan goes.
struct LiveFigures {
  std::uint64_t points = 0;   // in all
  std::size_t shown = 0;      // that are still there
  double points_per_s = 0;    // over the last second of the walk
  double behind_s = 0;        // what has been walked and not been cast yet
  unsigned one_pulse_in = 1;  // of the instrument's; more where the machine does not keep up
  std::string problem;        // why no more come; "" mostly
};

// A scanner that somebody carries through the model sends its pulses while they walk, in the background: whoever draws
// says once a frame where it is, and never waits. There is no thread where nobody scans. The points stay when it has
// ended, until it is dropped or begins anew.
class LiveScan {
 public:
  LiveScan() = default;
  ~LiveScan() { drop(); }
  LiveScan(const LiveScan&) = delete;
  LiveScan& operator=(const LiveScan&) = delete;

  void begin(LiveScanSetup setup, const Eigen::Vector3d& origin_m);
  void follow(const WalkMoment& moment);
  void end();  // what has been walked is still cast
  void drop();

  bool active() const { return active_; }            // between begin() and end()
  bool casts() const { return worker_.joinable(); }  // a thread is there; poll() joins it when all is cast
  bool empty() const { return shown_.empty(); }      // no points are there
  const LiveFigures& figures() const { return figures_; }
  const std::vector<ShownUnderlay>& shown() const { return shown_; }
  LiveColour colour() const { return colour_; }
  void colourBy(LiveColour colour);
  // Once a frame: takes in what has come.
  void poll();
  void wait();  // until all is cast that has been walked; ends it

 private:
  struct State {  // what both threads see
    std::mutex mutex;
    std::condition_variable news;
    std::vector<WalkMoment> walked;
    bool ended = false, done = false;
    std::optional<LiveColour> colour;
    std::vector<ShownUnderlay> shown;
    LiveFigures figures;
  };
  void work();
  bool cast(double until_s);
  bool castInStretches(double until_s);
  void publish();

  bool active_ = false;
  LiveColour colour_ = LiveColour::height;
  LiveFigures figures_;
  std::vector<ShownUnderlay> shown_;
  State state_;
  // Of the thread, and of the other one when it has ended.
  LiveScanSetup setup_;
  WalkedPoses poses_;
  LivePoints points_;
  std::unique_ptr<Progress> progress_;
  double cast_s_ = 0;
  unsigned one_pulse_in_ = 1;
  std::string problem_;
  std::deque<std::pair<double, std::uint64_t>> pace_;  // walked seconds that were cast, and points until then
  std::thread worker_;
};

}  // namespace standpoint
