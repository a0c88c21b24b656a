// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/live_scan.h"

#include <algorithm>
#include <exception>

#include "editor/words/sentences.h"
#include "project/task.h"

namespace standpoint {

namespace {

constexpr double kStretch_s = 0.06;  // that is cast at once: a picture or two
constexpr double kLongestStretch_s = 0.3;
constexpr double kLate_s = 0.4;  // from where on fewer pulses are sent, and half as many for each as long again
constexpr unsigned kMostHalvings = 6;
constexpr double kPaceOver_s = 1;

}  // namespace

void LiveScan::begin(LiveScanSetup setup, const Eigen::Vector3d& origin_m) {
  drop();
  setup_ = std::move(setup);
  points_ = LivePoints(origin_m);
  points_.colourBy(colour_);
  pace_.push_back({0, 0});
  progress_ = std::make_unique<Progress>();
  active_ = true;
  worker_ = std::thread([this] {
    computeInBackground();
    work();
  });
}

void LiveScan::follow(const WalkMoment& moment) {
  if (!active_ || !casts()) return;
  const std::lock_guard lock(state_.mutex);
  state_.walked.push_back(moment);
  state_.news.notify_one();
}

void LiveScan::end() {
  if (!std::exchange(active_, false)) return;
  const std::lock_guard lock(state_.mutex);
  state_.ended = true;
  state_.news.notify_one();
}

void LiveScan::drop() {
  end();
  if (progress_) progress_->cancel();
  if (worker_.joinable()) worker_.join();
  state_.walked.clear();
  state_.ended = state_.done = false;
  state_.colour.reset();
  state_.shown.clear();
  state_.figures = figures_ = {};
  shown_.clear();
  setup_ = {};
  poses_ = {};
  points_ = LivePoints();
  pace_.clear();
  cast_s_ = 0;
  one_pulse_in_ = 1;
  problem_.clear();
}

void LiveScan::colourBy(LiveColour colour) {
  if (std::exchange(colour_, colour) == colour) return;
  if (!casts()) {
    points_.colourBy(colour);
    shown_ = points_.shown();
    return;
  }
  const std::lock_guard lock(state_.mutex);
  state_.colour = colour;
  state_.news.notify_one();
}

void LiveScan::poll() {
  if (!casts()) return;
  bool done = false;
  {
    const std::lock_guard lock(state_.mutex);
    if (!(shown_ == state_.shown)) shown_ = state_.shown;
    figures_ = state_.figures;
    done = state_.done;
  }
  if (!done) return;
  worker_.join();
  points_.colourBy(colour_);  // a wish that came too late
  shown_ = points_.shown();
}

void LiveScan::wait() {
  end();
  if (!casts()) return;
  worker_.join();
  shown_ = state_.shown;
  figures_ = state_.figures;
}

void LiveScan::work() {
  bool ended = false;
  std::vector<WalkMoment> walked;
  while (!ended) {
    {
      std::unique_lock lock(state_.mutex);
      state_.news.wait(lock, [&] { return state_.ended || !state_.walked.empty() || state_.colour; });
      walked.swap(state_.walked);
      ended = state_.ended;
      if (state_.colour) points_.colourBy(*std::exchange(state_.colour, std::nullopt));
    }
    for (const auto& moment : walked) poses_.add(moment);
    walked.clear();
    if (!poses_.empty()) {
      const double until_s = ended ? poses_.last_s() : poses_.settled_s();
      if (ended || until_s - cast_s_ >= kStretch_s) ended = !cast(until_s) || ended;
    }
    publish();
  }
  const std::lock_guard lock(state_.mutex);
  state_.done = true;
}

// False: it cannot go on.
bool LiveScan::cast(double until_s) {
  try {
    return castInStretches(until_s);
  } catch (const std::exception& e) {  // memory
    problem_ = e.what();
    return false;
  }
}

bool LiveScan::castInStretches(double until_s) {
  const double late_s = until_s - cast_s_;
  const auto halvings = std::min(kMostHalvings, static_cast<unsigned>(late_s / kLate_s));
  one_pulse_in_ = usualThinning(setup_) << halvings;
  while (until_s - cast_s_ > 0) {
    const double to_s = std::min(until_s, cast_s_ + kLongestStretch_s);
    auto made = castAlong(setup_, poses_, cast_s_, to_s, one_pulse_in_, points_.origin_m(), *progress_);
    if (!made) {
      if (made.error().kind != ErrorKind::cancelled) problem_ = trError(made.error());
      return false;
    }
    if (made->until_s <= cast_s_) break;  // less than a block is left
    cast_s_ = made->until_s;
    points_.add(std::move(made->points));
    pace_.push_back({cast_s_, points_.seen()});
    while (pace_.size() > 2 && pace_[1].first <= cast_s_ - kPaceOver_s) pace_.pop_front();
  }
  return true;
}

void LiveScan::publish() {
  LiveFigures figures{.points = points_.seen(), .shown = points_.kept(), .one_pulse_in = one_pulse_in_};
  if (pace_.size() > 1 && pace_.back().first > pace_.front().first)
    figures.points_per_s =
        static_cast<double>(pace_.back().second - pace_.front().second) / (pace_.back().first - pace_.front().first);
  if (!poses_.empty()) figures.behind_s = std::max(0.0, poses_.last_s() - cast_s_);
  figures.problem = problem_;
  auto shown = points_.shown();
  const std::lock_guard lock(state_.mutex);
  state_.figures = std::move(figures);
  state_.shown = std::move(shown);
}

}  // namespace standpoint
