// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/collapses/rounds.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "optimizer/simplify/collapses/cheapest_steps.h"
#include "optimizer/surface/partition.h"

namespace standpoint {

namespace {

constexpr auto kNoVertex = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kCell = 8'000;  // triangles; what a core's own cache holds
constexpr double kDeeper = 0.72;      // of what all leave together, a cell leaves

using Log = std::vector<Step>;

// Shared vertices have a number in each of their cells: those are looked up. `local` has one entry for each vertex that
// is not.
Region cut(const Patch& whole, const std::vector<std::uint32_t>& triangles, const std::vector<std::uint8_t>& shared,
           std::vector<std::uint32_t>& local) {
  Region cell;
  std::vector<std::uint32_t> outer;
  for (const auto i : triangles)
    for (const auto v : whole.triangles[i])
      if (shared[v] != 0) outer.push_back(v);
  std::sort(outer.begin(), outer.end());
  outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
  cell.names = outer;
  cell.patch.triangles.reserve(triangles.size());
  for (const auto i : triangles) {
    auto t = whole.triangles[i];
    for (auto& v : t) {
      if (shared[v] != 0) {
        v = static_cast<std::uint32_t>(std::lower_bound(outer.begin(), outer.end(), v) - outer.begin());
        continue;
      }
      auto& known = local[v];
      if (known == kNoVertex) {
        known = static_cast<std::uint32_t>(cell.names.size());
        cell.names.push_back(v);
      }
      v = known;
    }
    cell.patch.triangles.push_back(t);
  }
  for (const auto v : cell.names) {
    cell.patch.positions.push_back(whole.positions[v]);
    cell.patch.quadrics.push_back(whole.quadrics[v]);
    cell.patch.deviation_m.push_back(whole.deviation_m[v]);
    if (!whole.features.empty()) cell.patch.features.push_back(whole.features[v]);
  }
  if (!outer.empty()) {
    cell.patch.fixed.assign(cell.names.size(), 0);
    std::fill_n(cell.patch.fixed.begin(), outer.size(), std::uint8_t{1});
  }
  return cell;
}

std::vector<Log> runCells(const Patch& whole, const Partition& parts, double deeper, const CollapseOptions& options,
                          const Shape& shape, const Progress& progress) {
  std::vector<Log> logs(parts.cells.size());
  std::vector<std::uint32_t> local(whole.positions.size(), kNoVertex);  // each entry is of one cell only
  tbb::parallel_for(std::size_t{0}, logs.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    auto cell = cut(whole, parts.cells[i], parts.shared, local);
    const auto floor = static_cast<std::size_t>(deeper * static_cast<double>(cell.patch.triangles.size()));
    logs[i] = Collapser(std::move(cell.patch), options, shape).run(floor, progress);
    for (auto& step : logs[i]) {
      step.collapse.kept = cell.names[step.collapse.kept];
      step.collapse.removed = cell.names[step.collapse.removed];
    }
  });
  return logs;
}

// What one cell's steps do to the vertices that only it has; those that keep to a shared one are left for later, as are
// its sums.
void takeOwn(Patch& patch, const Log& log, std::size_t taken, const std::vector<std::uint8_t>& shared,
             std::vector<std::uint32_t>& joined) {
  for (std::size_t k = 0; k < taken; ++k) {
    const auto& [step, cost, deviation, cell] = log[k];
    if (shared[step.kept] != 0) continue;
    patch.positions[step.kept] = step.position;
    patch.quadrics[step.kept] += patch.quadrics[step.removed];
    if (!patch.features.empty()) patch.features[step.kept] += patch.features[step.removed];
    patch.deviation_m[step.kept] = std::max(patch.deviation_m[step.kept], deviation);
  }
  for (std::size_t k = taken; k-- > 0;)
    joined[log[k].collapse.removed] = joined[log[k].collapse.kept];  // the last first: that one's end is known
}

void takeShared(Patch& patch, const Log& log, std::size_t taken, const std::vector<std::uint8_t>& shared) {
  for (std::size_t k = 0; k < taken; ++k) {
    const auto& [step, cost, deviation, cell] = log[k];
    if (shared[step.kept] == 0) continue;
    patch.quadrics[step.kept] += patch.quadrics[step.removed];
    if (!patch.features.empty()) patch.features[step.kept] += patch.features[step.removed];
    patch.deviation_m[step.kept] = std::max(patch.deviation_m[step.kept], deviation);
  }
}

// Cell after cell, so that near triangles stay close to each other.
void keepProper(Patch& patch, const Partition& parts, const std::vector<std::uint32_t>& joined) {
  std::vector<std::vector<Triangle>> proper(parts.cells.size());
  tbb::parallel_for(std::size_t{0}, proper.size(), [&](std::size_t i) {
    for (const auto index : parts.cells[i]) {
      const auto& t = patch.triangles[index];
      const Triangle now{joined[t[0]], joined[t[1]], joined[t[2]]};
      if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0]) proper[i].push_back(now);
    }
  });
  patch.triangles.clear();
  for (const auto& triangles : proper)
    patch.triangles.insert(patch.triangles.end(), triangles.begin(), triangles.end());
}

template <class Value>
std::vector<Value> picked(const std::vector<Value>& values, const std::vector<std::uint32_t>& which) {
  std::vector<Value> result;
  result.reserve(values.empty() ? 0 : which.size());
  if (!values.empty())
    for (const auto v : which) result.push_back(values[v]);
  return result;
}

// Without the vertices that no triangle has, in the order in which triangles name them: what is left of a large shape
// lies close together again.
void compact(Region& region) {
  std::vector<std::uint32_t> index(region.patch.positions.size(), kNoVertex), used;
  for (auto& t : region.patch.triangles)
    for (auto& v : t) {
      if (index[v] == kNoVertex) {
        index[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(v);
      }
      v = index[v];
    }
  region.names = picked(region.names, used);
  auto& patch = region.patch;
  patch.positions = picked(patch.positions, used);
  patch.quadrics = picked(patch.quadrics, used);
  patch.features = picked(patch.features, used);
  patch.deviation_m = picked(patch.deviation_m, used);
}

}  // namespace

Region wholeRegion(Patch patch) {
  Region region{std::move(patch), {}};
  region.names.resize(region.patch.positions.size());
  std::iota(region.names.begin(), region.names.end(), 0U);
  return region;
}

void runRound(Region& region, const Round& round, const CollapseOptions& options, const Shape& shape,
              std::vector<Collapse>& log, const Progress& progress) {
  auto& patch = region.patch;
  const auto parts = partition(patch.positions, patch.triangles, kCell, round.cut);
  const auto before = static_cast<double>(patch.triangles.size());
  const auto enough = std::max(round.enough, parts.any_shared ? static_cast<std::size_t>(round.fraction * before) : 0);
  const auto logs = runCells(patch, parts, parts.any_shared ? kDeeper * static_cast<double>(enough) / before : 0,
                             options, shape, progress);
  const CheapestSteps choice(logs, patch.triangles.size(), enough);
  const auto done = log.size();
  log.resize(done + choice.steps().size());
  tbb::parallel_for(std::size_t{0}, choice.steps().size(), [&](std::size_t k) {
    auto& step = log[done + k] = choice.steps()[k].collapse;
    step.kept = region.names[step.kept];
    step.removed = region.names[step.removed];
  });
  std::vector<std::uint32_t> joined(patch.positions.size());
  std::iota(joined.begin(), joined.end(), 0U);
  tbb::parallel_for(std::size_t{0}, logs.size(),
                    [&](std::size_t i) { takeOwn(patch, logs[i], choice.taken(i), parts.shared, joined); });
  for (std::size_t i = 0; i < logs.size(); ++i) takeShared(patch, logs[i], choice.taken(i), parts.shared);
  keepProper(patch, parts, joined);
  compact(region);
}

}  // namespace standpoint
