// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/time_law.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

namespace {

// The least of the `reach` places on each side.
std::vector<double> leastAround(std::span<const double> values, std::size_t reach) {
  std::vector<double> least(values.size());
  std::vector<std::size_t> queue;  // places with rising values, the least first
  std::size_t head = 0, next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (; next < std::min(values.size(), i + reach + 1); ++next) {
      while (queue.size() > head && values[queue.back()] >= values[next]) queue.pop_back();
      queue.push_back(next);
    }
    while (queue[head] + reach < i) ++head;
    least[i] = values[queue[head]];
  }
  return least;
}

}  // namespace

// An even acceleration that jumps by up to twice its limit is averaged over a window in which it so keeps to the jerk.
// The average of speeds must not be above the limit where it is taken, so each place has the limit of all that the
// window may reach; a stop holds for the window longer.
TimeLaw::TimeLaw(std::span<const double> fastest_mps, double step_m, std::span<const Stop> stops,
                 double acceleration_mps2, double jerk_mps3)
    : window_s_(2 * acceleration_mps2 / jerk_mps3) {
  const double reach_m = *std::max_element(fastest_mps.begin(), fastest_mps.end()) * window_s_ / 2;
  auto speed = leastAround(fastest_mps, static_cast<std::size_t>(std::ceil(reach_m / step_m)));
  speed.front() = speed.back() = 0;
  for (const Stop& stop : stops) speed[stop.place] = 0;
  const double gain = 2 * acceleration_mps2 * step_m;  // of the speed's square, from place to place
  for (std::size_t i = 1; i < speed.size(); ++i)
    speed[i] = std::min(speed[i], std::sqrt(speed[i - 1] * speed[i - 1] + gain));
  for (std::size_t i = speed.size() - 1; i > 0; --i)
    speed[i - 1] = std::min(speed[i - 1], std::sqrt(speed[i] * speed[i] + gain));
  knots_.reserve(speed.size() + stops.size());
  double time = 0;
  auto stop = stops.begin();
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (i > 0) time += 2 * step_m / (speed[i - 1] + speed[i]);
    knots_.push_back({time, {static_cast<double>(i) * step_m}, {speed[i]}});
    if (stop == stops.end() || stop->place != i) continue;
    time += stop->hold_s + (i > 0 && i + 1 < speed.size() ? window_s_ : 0);
    if (time > knots_.back().at) knots_.push_back({time, {static_cast<double>(i) * step_m}, {0}});
    ++stop;
  }
  integral_.assign(knots_.size(), 0);
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    const double width = knots_[i].at - knots_[i - 1].at;
    integral_[i] = integral_[i - 1] + width * (knots_[i - 1].value[0] + knots_[i].value[0]) / 2 +
                   width * width * (knots_[i - 1].slope[0] - knots_[i].slope[0]) / 12;
  }
}

// Of the way without the window; it stands before the first knot and after the last.
double TimeLaw::integral(double time_s) const {
  const auto &front = knots_.front(), &back = knots_.back();
  if (time_s <= front.at) return front.value[0] * (time_s - front.at);
  if (time_s >= back.at) return integral_.back() + back.value[0] * (time_s - back.at);
  const std::size_t i = pieceAt<1>(knots_, 0, knots_.size() - 1, time_s);
  const double width = time_s - knots_[i].at;
  const double way = between(knots_[i], knots_[i + 1], time_s)[0];
  const double speed = slopesBetween(knots_[i], knots_[i + 1], time_s)[0][0];
  return integral_[i] + width * (knots_[i].value[0] + way) / 2 + width * width * (knots_[i].slope[0] - speed) / 12;
}

double TimeLaw::way_m(double time_s) const {
  const double middle = time_s - window_s_ / 2;
  const double way = (integral(middle + window_s_ / 2) - integral(middle - window_s_ / 2)) / window_s_;
  return std::clamp(way, 0.0, knots_.back().value[0]);
}

double TimeLaw::reached_s(double way) const {
  double before = 0, after = duration_s();
  for (int k = 0; k < 60; ++k) {
    const double middle = (before + after) / 2;
    (way_m(middle) < way - 1e-9 ? before : after) = middle;
  }
  return after;
}

}  // namespace standpoint
