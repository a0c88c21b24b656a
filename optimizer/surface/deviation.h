// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "optimizer/surface/shape.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

inline constexpr std::uint32_t kDeviationSamples =
    50'000;  // on all placed surfaces, each way; of the whole more where few places hold the loss

// One point per equal share of the area, at a random place in its triangle. The same key gives the same points.
std::vector<SurfacePoint> pointsByArea(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                                       std::uint32_t count, const RandomKey& key);

struct Deviation {
  double max_m = 0;  // symmetric Hausdorff distance, searched; of dense meshes at vertices, middles of faces and edges,
                     // and samples
  double mean_m = 0;   // mean of the two directions' area-weighted means
  double area_m2 = 0;  // of the shape before
  double turn_rad =
      0;  // mean angle between the normals of the shape before and of what is nearest; its area decides. 0..π/2
};

// Measures how far shapes are from the one that they were made of: points spread by area on each, and for the maximum a
// search of every triangle (where both together have more than 200 000: a look at its corners and middles), each
// against the other's nearest triangle. An empty shape counts as the centre: it was dropped. Parallel, the same figures
// for any number of threads. Keeps references to `before` and its tree.
class DeviationMeter {
 public:
  DeviationMeter(const Shape& before, const TriangleTree& tree, std::uint32_t samples, std::uint64_t seed);

  // `image` is replay()'s, or empty: it only makes the search faster. `after` has the same centre.
  Deviation of(const Shape& after, const std::vector<std::uint32_t>& image = {}) const;
  Deviation ofItself() const;
  // Whether the maximum is more than that; much faster than the maximum.
  bool exceeds(const Shape& after, const std::vector<std::uint32_t>& image, double limit_m) const;
  // By about so many samples, and the maximum by no more than those.
  Deviation roughlyOf(const Shape& after, std::uint32_t samples) const { return measure(after, {}, samples, false); }
  // How far `after` reaches out of the shape before, where `counts` says that it matters.
  template <class Counts>
  double reachOf(const Shape& after, Counts counts) const {
    double farthest = 0;
    for (const auto& point : pointsByArea(after.positions, after.triangles, samples_, {seed_, 1})) {
      if (!counts(point.position)) continue;
      const double distance = std::sqrt(tree_.squaredDistance(point.position));
      if (distance > farthest && tree_.isOutside(point.position)) farthest = distance;
    }
    return farthest;
  }

 private:
  Deviation measure(const Shape& after, const std::vector<std::uint32_t>& image, std::uint32_t samples,
                    bool search) const;

  const Shape& before_;
  std::uint32_t samples_;
  std::uint64_t seed_;
  double area_m2_ = 0;
  const TriangleTree& tree_;
  std::vector<SurfacePoint> points_;
};

}  // namespace standpoint
