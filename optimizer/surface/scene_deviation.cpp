// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/scene_deviation.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostSceneVertices = 3'000'000;  // that are looked at for the maximum, each way
constexpr int kSteps = 6;                              // along the edges of a long triangle
constexpr double kSceneSettled =
    1.04 * 1.04;                      // what can only be 4 % further than what was found is not looked at (farthest.h)
constexpr std::size_t kFirstFew = 8;  // instances that are looked at before others are
constexpr std::size_t kSceneChunk = 1024;  // points that one task looks at
constexpr double kMeanError = 0.01;        // standard error of the mean, relative, that is good enough
constexpr double kMostSamples = 800'000;   // each way

struct SceneOneWay {
  double max_squared = 0, sum = 0, sum_squared = 0;
  std::size_t count = 0;
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
  double relativeError() const {
    if (!(sum > 0)) return 0;
    const double n = static_cast<double>(count);
    return std::sqrt(std::max(0.0, sum_squared / n - mean() * mean()) / n) / mean();
  }
};

// Which instances stand in the other environment as they stand in this one.
std::vector<bool> unchanged(const Environment& here, const Environment& there) {
  std::vector<bool> result;
  auto other = there.instances.begin();
  for (const auto& instance : here.instances) {  // both are sorted by product
    while (other != there.instances.end() && other->product < instance.product) ++other;
    bool found = false;
    for (auto i = other; i != there.instances.end() && i->product == instance.product && !found; ++i)
      found = there.meshes[i->mesh] == here.meshes[instance.mesh] &&
              i->world_from_mesh.matrix() == instance.world_from_mesh.matrix();
    result.push_back(found);
  }
  return result;
}

std::vector<std::uint32_t> countsByArea(const PlacedSurfaces& surfaces, std::uint32_t samples) {
  double all = 0;
  for (std::size_t i = 0; i < surfaces.instances(); ++i) all += surfaces.area(i);
  std::vector<std::uint32_t> counts(surfaces.instances(), 0);
  double walked = 0;
  std::uint32_t given = 0;
  for (std::size_t i = 0; i < counts.size() && all > 0; ++i) {
    walked += surfaces.area(i);
    const auto until = static_cast<std::uint32_t>(samples * std::min(1.0, walked / all) + 0.5);
    counts[i] = until - given;
    given = until;
  }
  return counts;
}

SceneOneWay ofPoints(const PlacedSurfaces& from, const PlacedSurfaces& to, const std::vector<bool>& same,
                     std::uint32_t samples, const Progress& progress) {
  const auto counts = countsByArea(from, samples);
  std::vector<SceneOneWay> parts(from.instances());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {  // each into its own slot, summed in order below
    if (progress.cancelled()) return;
    if (same[i]) {
      parts[i].count = counts[i];
      return;
    }
    const auto points = from.points(i, counts[i]);
    std::vector<double> squared(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kSceneChunk), [&](const auto& range) {
      for (auto k = range.begin(); k < range.end(); ++k) squared[k] = to.squaredDistance(points[k]);
    });
    for (const double s : squared) {
      if (!std::isfinite(s)) continue;  // nothing is left at all
      parts[i].max_squared = std::max(parts[i].max_squared, s);
      parts[i].sum += std::sqrt(s);
      parts[i].sum_squared += s;
      ++parts[i].count;
    }
  });
  SceneOneWay result;
  for (const auto& part : parts) {
    result.max_squared = std::max(result.max_squared, part.max_squared);
    result.sum += part.sum;
    result.sum_squared += part.sum_squared;
    result.count += part.count;
  }
  return result;
}

// Once more with as many points as it takes: where few places hold the loss, a mean by 50 000 points was 5 % off.
SceneOneWay ofEnoughPoints(const PlacedSurfaces& from, const PlacedSurfaces& to, const std::vector<bool>& same,
                           std::uint32_t samples, const Progress& progress) {
  const SceneOneWay first = ofPoints(from, to, same, samples, progress);
  const double short_of = first.relativeError() / kMeanError;
  const double wanted = std::min(kMostSamples, samples * short_of * short_of);
  if (wanted <= samples) return first;
  return ofPoints(from, to, same, static_cast<std::uint32_t>(wanted), progress);
}

// The largest squared distance of one instance's vertices, or `known`, if none is further: most are settled by a
// surface that is near enough.
double farthestOf(const PlacedSurfaces& from, const PlacedSurfaces& to, std::size_t i, std::size_t stride,
                  double known) {
  const tbb::blocked_range<std::size_t> all(0, (from.vertices(i) + stride - 1) / stride, kSceneChunk);
  double most = tbb::parallel_reduce(
      all, known,
      [&](const auto& range, double so_far) {
        for (auto k = range.begin(); k < range.end(); ++k)
          if (const double s = to.squaredDistance(from.vertex(i, k * stride), so_far); std::isfinite(s))
            so_far = std::max(so_far, s);
        return so_far;
      },
      [](double a, double b) { return std::max(a, b); });  // the maximum is the same in any order
  for (std::size_t k = 0; k < from.triangles(i) && stride == 1;
       ++k) {  // between its corners a long triangle may bulge away
    const auto t = from.triangle(i, k);
    if (std::max({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()}) < 4 * most)
      continue;
    for (int u = 0; u <= kSteps; ++u)
      for (int v = 0; u + v <= kSteps; ++v) {
        const Vector3d p = (t[0] * u + t[1] * v + t[2] * (kSteps - u - v)) / kSteps;
        if (const double s = to.squaredDistance(p, most); std::isfinite(s)) most = std::max(most, s);
      }
  }
  return most;
}

// Of all instances, or `known`. Those that can be furthest come first, so that most others need no look: `most_m`
// bounds each.
double farthest(const PlacedSurfaces& from, const PlacedSurfaces& to, const std::vector<bool>& same,
                const std::vector<double>& max_m, double known, const Progress& progress) {
  std::size_t vertices = 0;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < from.instances(); ++i) {
    if (same[i]) continue;
    vertices += from.vertices(i);
    order.push_back(i);
  }
  const std::size_t stride = 1 + vertices / kMostSceneVertices;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return max_m[a] > max_m[b]; });
  std::vector<double> parts;
  for (std::size_t first = 0, count = kFirstFew; first < order.size();
       first += count, count *= 4) {  // together, so that threads change nothing
    count = std::min(count, order.size() - first);
    parts.assign(count, known);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
      const auto i = order[first + k];
      if (!progress.cancelled() && max_m[i] * max_m[i] > kSceneSettled * known)
        parts[k] = farthestOf(from, to, i, stride, known);
    });
    known = *std::max_element(parts.begin(), parts.end());
  }
  return known;
}

}  // namespace

Deviation sceneDeviation(const Environment& before, const Environment& after, std::uint32_t samples,
                         const KnownOfScene& known, const Progress& progress) {
  if (before.instances.empty() || after.instances.empty()) return {};
  const PlacedSurfaces a(before, known.meshes), b(after);
  const auto same_before = unchanged(before, after), same_after = unchanged(after, before);
  const SceneOneWay there = ofEnoughPoints(a, b, same_before, samples, progress),
                    back = ofEnoughPoints(b, a, same_after, samples, progress);
  double max_squared = std::max(there.max_squared, back.max_squared);
  max_squared = farthest(b, a, same_after, known.max_after_m, max_squared, progress);
  max_squared = farthest(a, b, same_before, known.max_before_m, max_squared, progress);
  Deviation result;
  result.max_m = std::sqrt(max_squared);
  result.mean_m = 0.5 * (there.mean() + back.mean());
  for (std::size_t i = 0; i < a.instances(); ++i) result.area_m2 += a.area(i);
  return result;
}

}  // namespace standpoint
