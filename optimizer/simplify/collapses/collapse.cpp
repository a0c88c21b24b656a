// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/collapses/collapse.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "optimizer/simplify/collapses/collapser.h"
#include "optimizer/simplify/collapses/features.h"
#include "optimizer/simplify/collapses/rounds.h"

namespace standpoint {

namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kSplit = 100'000;    // triangles; a shape with more is simplified in cells first …
constexpr std::size_t kOneQueue = 40'000;  // … until so many are left
constexpr double kAllButLast = 1.1;        // times what shall be left is left to one queue over all
constexpr std::size_t kChunk = 16'384;     // triangles that one task looks at
constexpr double kWorthwhile = 0.9;        // a round that leaves more was the last one

constexpr double kFractionOfRound = 0.25, kFractionOfRefining = 0.6;

void appendNamed(const std::vector<Step>& steps, const std::vector<std::uint32_t>& names, std::vector<Collapse>& log) {
  log.reserve(log.size() + steps.size());
  for (const auto& step : steps) {
    log.push_back(step.collapse);
    log.back().kept = names[step.collapse.kept];
    log.back().removed = names[step.collapse.removed];
  }
}

void runRounds(Region& region, std::size_t floor, double fraction, const CollapseOptions& options, const Shape& shape,
               std::vector<Collapse>& log, const Progress& progress) {
  const auto enough = static_cast<std::size_t>(kAllButLast * static_cast<double>(floor));
  Round round{0.5, fraction, enough};
  for (std::size_t before = 0; region.patch.triangles.size() > std::max(kOneQueue, enough) && !progress.cancelled();) {
    before = region.patch.triangles.size();
    runRound(region, round, options, shape, log, progress);
    if (static_cast<double>(region.patch.triangles.size()) > kWorthwhile * static_cast<double>(before)) return;
    round.cut = round.cut == 0.5 ? 0.38 : 0.5;
  }
}

}  // namespace

std::vector<Collapse> recordCollapses(const Shape& shape, const CollapseOptions& options, const Progress& progress) {
  if (shape.triangles.empty()) return {};
  CollapseOptions limited = options;
  if (options.lossless) limited.max_deviation_m = 2 * shape.rounding();
  Region region = wholeRegion(patchOf(shape, limited));
  std::vector<Collapse> log;
  if (shape.triangles.size() > kSplit)
    runRounds(region, options.floor, kFractionOfRound, limited, shape, log, progress);
  if (region.patch.triangles.empty()) return log;
  Collapser last(std::move(region.patch), limited, shape);
  appendNamed(last.run(options.floor, progress), region.names, log);
  // The last step of all: whatever is left goes at once.
  if (!limited.lossless && limited.max_deviation_m >= shape.diagonal() / 2 && last.triangles() > options.floor &&
      !progress.cancelled())
    log.push_back({0, 0, static_cast<std::uint32_t>(last.triangles()), false, Eigen::Vector3d::Zero()});
  return log;
}

std::vector<Collapse> refined(const Shape& shape, std::size_t triangles, const Progress& progress,
                              const std::vector<bool>* stays) {
  CollapseOptions options;
  options.memoryless = true;
  options.max_deviation_m = std::numeric_limits<double>::max();
  Region region = wholeRegion(patchOf(shape, options));
  std::vector<Collapse> log;
  runRounds(region, triangles, kFractionOfRefining, options, shape, log, progress);
  if (stays != nullptr && log.empty()) region.patch.fixed.assign(stays->begin(), stays->end());
  if (region.patch.triangles.size() > triangles)
    appendNamed(Collapser(std::move(region.patch), options, shape).run(triangles, progress), region.names, log);
  return log;
}

LogPlayer::LogPlayer(const Shape& shape, const std::vector<Collapse>& log)
    : shape_(shape), log_(log), form_(shape), joined_(shape.positions.size()), origin_(shape.triangles.size()) {
  form_.wedges.clear();  // they are of the beginning
  std::iota(joined_.begin(), joined_.end(), 0U);
  std::iota(origin_.begin(), origin_.end(), 0U);
}

const Shape& LogPlayer::at(std::size_t steps) {
  if (steps <= done_) return form_;
  for (auto k = done_; k < steps; ++k) form_.positions[log_[k].kept] = log_[k].position;
  for (auto k = steps; k-- > done_;)
    joined_[log_[k].removed] = joined_[log_[k].kept];  // the last first: that one's end is known
  done_ = steps;
  const bool nothing_left = log_[steps - 1].endsAll();
  const auto count = nothing_left ? 0 : form_.triangles.size();
  std::vector<std::size_t> kept((count + kChunk - 1) / kChunk, 0);
  const auto move = [&](std::size_t from, std::size_t to, const Triangle& t) {
    form_.triangles[to] = t;
    form_.surface_of_triangle[to] = form_.surface_of_triangle[from];
    origin_[to] = origin_[from];
  };
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t chunk) {  // each within its own range
    for (auto i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
      const auto& t = form_.triangles[i];
      const Triangle now{joined_[t[0]], joined_[t[1]], joined_[t[2]]};
      if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0]) move(i, chunk * kChunk + kept[chunk]++, now);
    }
  });
  std::size_t left = 0;
  for (std::size_t chunk = 0; chunk < kept.size(); ++chunk)
    for (std::size_t i = 0; i < kept[chunk]; ++i, ++left)
      if (left != chunk * kChunk + i) move(chunk * kChunk + i, left, form_.triangles[chunk * kChunk + i]);
  form_.triangles.resize(left);
  form_.surface_of_triangle.resize(left);
  return form_;
}

std::vector<std::uint32_t> LogPlayer::image() const {
  std::vector<std::uint32_t> at_vertex(form_.positions.size(), kNone), result(origin_.size(), kNone);
  for (std::uint32_t i = 0; i < form_.triangles.size(); ++i) {
    result[origin_[i]] = i;
    for (const auto v : form_.triangles[i]) at_vertex[v] = i;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, result.size(), kChunk), [&](const auto& range) {
    for (auto i = range.begin(); i < range.end(); ++i) {
      auto v = shape_.triangles[i][0];
      while (joined_[v] != v) v = joined_[v];
      if (result[i] == kNone) result[i] = at_vertex[v];
    }
  });
  return result;
}

std::vector<Triangle> LogPlayer::wedges() const {
  if (shape_.wedges.empty()) return {};
  std::vector<bool> here(shape_.triangles.size(), false);
  for (std::size_t i = 0; i < form_.triangles.size(); ++i) here[origin_[i]] = true;
  std::vector<std::uint32_t> same;  // as which another wedge counts
  const auto root = [&](std::uint32_t w) {
    while (same[w] != w) w = same[w] = same[same[w]];
    return w;
  };
  std::uint32_t most = 0;
  for (const auto& t : shape_.wedges) most = std::max({most, t[0], t[1], t[2]});
  same.resize(std::size_t{most} + 1);
  std::iota(same.begin(), same.end(), 0U);
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i]) continue;
    Triangle end = shape_.triangles[i];
    for (auto& v : end)
      while (joined_[v] != v) v = joined_[v];
    for (int k = 0; k < 3; ++k)
      if (const int n = (k + 1) % 3; end[k] == end[n]) {
        const auto one = root(shape_.wedges[i][k]), other = root(shape_.wedges[i][n]);
        same[std::max(one, other)] = std::min(one, other);
      }
  }
  std::vector<Triangle> result;
  result.reserve(form_.triangles.size());
  for (std::size_t i = 0; i < form_.triangles.size(); ++i) {
    const auto& w = shape_.wedges[origin_[i]];
    result.push_back({root(w[0]), root(w[1]), root(w[2])});
  }
  return result;
}

Shape withoutUnused(const Shape& shape, std::vector<std::uint32_t>& names) {
  Shape result;
  result.centre = shape.centre;
  result.half_size = shape.half_size;
  result.surface_of_triangle = shape.surface_of_triangle;
  result.triangles = shape.triangles;
  result.wedges = shape.wedges;
  names.clear();
  std::vector<std::uint32_t> index(shape.positions.size(), kNone);
  for (auto& t : result.triangles)
    for (auto& v : t) {
      if (index[v] == kNone) {
        index[v] = static_cast<std::uint32_t>(names.size());
        names.push_back(v);
        result.positions.push_back(shape.positions[v]);
      }
      v = index[v];
    }
  return result;
}

Shape replay(const Shape& shape, const std::vector<Collapse>& log, std::size_t steps,
             std::vector<std::uint32_t>* image) {
  LogPlayer player(shape, log);
  player.at(steps);
  if (image) *image = player.image();
  return player.take();
}

}  // namespace standpoint
