// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/collapse.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

#include "optimizer/collapser.h"
#include "optimizer/features.h"
#include "optimizer/partition.h"

namespace standpoint {

namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kCell = 8'000;         // triangles; what a core's own cache holds
constexpr std::size_t kSplit = 100'000;      // a patch with more is simplified in cells first
constexpr double kOneRound = 0.25;           // of the triangles are left by a round of cells that touch …
constexpr double kDeeper = 0.18;             // … of which each goes this far, so that the cheapest steps of all can be chosen
constexpr std::size_t kRefineFrom = 3;       // times the triangles that shall be left
constexpr double kWorthwhile = 0.9;          // a round that leaves more was the last one

// A cell as a patch of its own.
struct Cell {
  Patch patch;
  std::vector<std::uint32_t> vertices;  // of the whole
};

Cell cut(const Patch& whole, const std::vector<std::uint32_t>& triangles, const std::vector<std::uint8_t>& shared, std::vector<std::uint32_t>& local) {
  Cell cell;
  std::vector<std::uint32_t> outer;  // shared vertices have a number in each of their cells: those are looked up
  for (const auto i : triangles)
    for (const auto v : whole.triangles[i])
      if (shared[v] != 0) outer.push_back(v);
  std::sort(outer.begin(), outer.end());
  outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
  cell.vertices = outer;
  const auto outers = static_cast<std::uint32_t>(outer.size());
  for (const auto i : triangles) {
    auto t = whole.triangles[i];
    for (auto& v : t) {
      if (shared[v] != 0) {
        v = static_cast<std::uint32_t>(std::lower_bound(outer.begin(), outer.end(), v) - outer.begin());
        continue;
      }
      auto& known = local[v];
      if (known == kNone) {
        known = static_cast<std::uint32_t>(cell.vertices.size());
        cell.vertices.push_back(v);
      }
      v = known;
    }
    cell.patch.triangles.push_back(t);
  }
  for (const auto v : cell.vertices) {
    cell.patch.positions.push_back(whole.positions[v]);
    cell.patch.quadrics.push_back(whole.quadrics[v]);
    cell.patch.deviation_m.push_back(whole.deviation_m[v]);
    if (!whole.features.empty()) cell.patch.features.push_back(whole.features[v]);
  }
  if (outers > 0) {
    cell.patch.fixed.assign(cell.vertices.size(), 0);
    std::fill_n(cell.patch.fixed.begin(), outers, std::uint8_t{1});
  }
  return cell;
}

// The logs of all cells as one, cheapest step first: what one queue over all of them would do.
std::vector<Step> merged(std::vector<std::vector<Step>>& logs) {
  std::vector<Step> all;
  std::size_t size = 0;
  for (const auto& log : logs) size += log.size();
  all.reserve(size);
  struct Next {
    double cost;
    std::uint32_t cell;
    bool operator<(const Next& o) const { return cost != o.cost ? cost > o.cost : cell > o.cell; }
  };
  std::vector<Next> heap;
  std::vector<std::size_t> at(logs.size(), 0);
  for (std::uint32_t i = 0; i < logs.size(); ++i)
    if (!logs[i].empty()) heap.push_back({logs[i][0].cost, i});
  std::make_heap(heap.begin(), heap.end());
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const auto cell = heap.back().cell;
    auto& log = logs[cell];
    all.push_back(log[at[cell]++]);
    if (at[cell] < log.size()) {
      heap.back() = {log[at[cell]].cost, cell};
      std::push_heap(heap.begin(), heap.end());
    } else {
      heap.pop_back();
      log = {};
    }
  }
  return all;
}

std::vector<Step> runCells(const Patch& whole, const Partition& parts, const CollapseOptions& options, const Shape& shape, const Progress& progress) {
  std::vector<std::vector<Step>> logs(parts.cells.size());
  std::vector<std::uint32_t> local(whole.positions.size(), kNone);  // each entry is of one cell only
  tbb::parallel_for(std::size_t{0}, logs.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    const auto& triangles = parts.cells[i];
    auto cell = cut(whole, triangles, parts.shared, local);
    const auto floor = parts.any_shared ? static_cast<std::size_t>(kDeeper * static_cast<double>(triangles.size())) : 0;
    logs[i] = Collapser(std::move(cell.patch), options, shape).run(floor, progress);
    for (auto& step : logs[i]) {
      step.collapse.kept = cell.vertices[step.collapse.kept];
      step.collapse.removed = cell.vertices[step.collapse.removed];
    }
  });
  return merged(logs);
}

void takeSteps(Patch& patch, const std::vector<Step>& steps) {
  std::vector<std::uint32_t> joined(patch.positions.size());
  std::iota(joined.begin(), joined.end(), 0U);
  for (const auto& [step, cost, deviation] : steps) {
    joined[step.removed] = step.kept;
    patch.positions[step.kept] = step.position;
    patch.quadrics[step.kept] += patch.quadrics[step.removed];
    if (!patch.features.empty()) patch.features[step.kept] += patch.features[step.removed];
    patch.deviation_m[step.kept] = std::max(patch.deviation_m[step.kept], deviation);
  }
  const auto root = [&](std::uint32_t v) {
    while (joined[v] != v) v = joined[v] = joined[joined[v]];
    return v;
  };
  std::size_t kept = 0;
  for (const auto& t : patch.triangles) {
    const Triangle now{root(t[0]), root(t[1]), root(t[2])};
    if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0]) patch.triangles[kept++] = now;
  }
  patch.triangles.resize(kept);
}

// Rounds of cells until what is left is small enough for one queue. The cells of a round meet elsewhere than those before.
void runRounds(Patch& patch, const CollapseOptions& options, const Shape& shape, std::vector<Collapse>& log, const Progress& progress) {
  double cut = 0.5;
  while (patch.triangles.size() > kSplit && !progress.cancelled()) {
    const auto parts = partition(patch.positions, patch.triangles, kCell, cut);
    auto steps = runCells(patch, parts, options, shape, progress);
    const auto before = patch.triangles.size();
    const auto enough = parts.any_shared ? static_cast<std::size_t>(kOneRound * static_cast<double>(before)) : 0;
    std::size_t left = before, taken = 0;
    while (taken < steps.size() && left > enough) left -= steps[taken++].collapse.triangles;
    steps.resize(taken);
    for (const auto& step : steps) log.push_back(step.collapse);
    takeSteps(patch, steps);
    if (!parts.any_shared || static_cast<double>(left) > kWorthwhile * static_cast<double>(before)) return;
    cut = cut == 0.5 ? 0.38 : 0.5;
  }
}

}  // namespace

std::vector<Collapse> recordCollapses(const Shape& shape, const CollapseOptions& options, const Progress& progress) {
  if (shape.triangles.empty()) return {};
  CollapseOptions limited = options;
  if (options.lossless) limited.max_deviation_m = 2 * shape.rounding();
  Patch patch = patchOf(shape, limited);
  std::vector<Collapse> log;
  runRounds(patch, limited, shape, log, progress);
  if (patch.triangles.empty()) return log;
  Collapser last(std::move(patch), limited, shape);
  for (const auto& step : last.run(0, progress)) log.push_back(step.collapse);
  // The last step of all: whatever is left goes at once.
  if (!limited.lossless && limited.max_deviation_m >= shape.diagonal() / 2 && last.triangles() > 0 && !progress.cancelled())
    log.push_back({0, 0, static_cast<std::uint32_t>(last.triangles()), false, Eigen::Vector3d::Zero()});
  return log;
}

std::vector<Collapse> refined(const Shape& shape, const std::vector<Collapse>& log, std::size_t triangles, const Progress& progress) {
  std::vector<Collapse> result;
  for (std::size_t left = shape.triangles.size(); result.size() < log.size() && left > kRefineFrom * triangles; result.push_back(log[result.size()]))
    left -= log[result.size()].triangles;
  CollapseOptions options;
  options.memoryless = true;
  options.max_deviation_m = std::numeric_limits<double>::max();
  const Shape start = replay(shape, log, result.size());
  for (const auto& step : Collapser(patchOf(start, options), options, start).run(triangles, progress)) result.push_back(step.collapse);
  return result;
}

LogPlayer::LogPlayer(const Shape& shape, const std::vector<Collapse>& log) : log_(log), form_(shape), joined_(shape.positions.size()), origin_(shape.triangles.size()) {
  form_.wedges.clear();  // they are of the beginning
  std::iota(joined_.begin(), joined_.end(), 0U);
  std::iota(origin_.begin(), origin_.end(), 0U);
}

const Shape& LogPlayer::at(std::size_t steps) {
  if (steps <= done_) return form_;
  for (; done_ < steps; ++done_) {
    const auto& step = log_[done_];
    joined_[step.removed] = step.kept;
    form_.positions[step.kept] = step.position;
  }
  const auto root = [&](std::uint32_t v) {
    while (joined_[v] != v) v = joined_[v] = joined_[joined_[v]];
    return v;
  };
  const bool nothing_left = log_[steps - 1].kept == log_[steps - 1].removed;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < form_.triangles.size() && !nothing_left; ++i) {
    const auto& t = form_.triangles[i];
    const Triangle now{root(t[0]), root(t[1]), root(t[2])};
    if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
    form_.triangles[kept] = now;
    form_.surface_of_triangle[kept] = form_.surface_of_triangle[i];
    origin_[kept++] = origin_[i];
  }
  form_.triangles.resize(kept);
  form_.surface_of_triangle.resize(kept);
  return form_;
}

std::vector<std::uint32_t> LogPlayer::image() const {
  std::vector<std::uint32_t> result(origin_.size(), kNone);
  for (std::uint32_t i = 0; i < form_.triangles.size(); ++i) result[origin_[i]] = i;
  return result;
}

Shape replay(const Shape& shape, const std::vector<Collapse>& log, std::size_t steps, std::vector<std::uint32_t>* image) {
  LogPlayer player(shape, log);
  player.at(steps);
  if (image) *image = player.image();
  return player.take();
}

}  // namespace standpoint
