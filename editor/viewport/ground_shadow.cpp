// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/ground_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace standpoint {

namespace {

constexpr int kSide = GroundShadow::kSide;
// Of a shadow, for each metre of height: seen from the usual corner, to the right.
const Eigen::Vector2d kSunShift(0.52, 0.18);
constexpr std::uint64_t kMostTriangles = 4000000;  // half a second
constexpr double kPenumbra_m = 0.35, kSkyBlur_m = 1.6;
constexpr double kSunPart = 0.5, kSkyPart = 0.45;

using Corners = std::array<Eigen::Vector3d, 3>;

// Calls `draw` with each opaque triangle that lies below the cut with some of it.
template <class Draw>
void eachTriangle(const MergedTriangles& part, double cut_m, const Draw& draw) {
  for (std::size_t c = 0; c + 2 < part.corners.size(); c += 3) {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto p = static_cast<std::size_t>(part.corners[c + k]) * 3;
      t[k] = {part.positions[p], part.positions[p + 1], std::min<double>(part.positions[p + 2], cut_m)};
    }
    if (std::min({t[0].z(), t[1].z(), t[2].z()}) < cut_m) draw(t);
  }
}

template <class Draw>
void eachTriangle(const MergedScene& scene, double cut_m, const Draw& draw) {
  eachTriangle(scene.opaque, cut_m, draw);
  eachTriangle(scene.graded, cut_m, draw);
  for (const auto& [image, painted] : scene.painted) eachTriangle(painted.triangles, cut_m, draw);
}

// A picture of the ground from above: what is marked is 1.
class Mask {
 public:
  Mask(Eigen::Vector2d corner, Eigen::Vector2d cell) : corner_(std::move(corner)), cell_(std::move(cell)) {}

  // The cells whose middle is in the triangle.
  void mark(const std::array<Eigen::Vector2d, 3>& t) {
    std::array<Eigen::Vector2d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (t[k] - corner_).cwiseQuotient(cell_);
    const auto [low, high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const int from = std::max(0, static_cast<int>(std::ceil(low - 0.5))),
              to = std::min(kSide - 1, static_cast<int>(std::floor(high - 0.5)));
    for (int row = from; row <= to; ++row) markRow(p, row);
  }

  // Three passes of a running mean are nearly a bell.
  void blur(double radius_m) {
    for (int pass = 0; pass < 3; ++pass) {
      blurLines(static_cast<int>(std::lround(radius_m / cell_.x() / 1.7)), 1, kSide);
      blurLines(static_cast<int>(std::lround(radius_m / cell_.y() / 1.7)), kSide, 1);
    }
  }

  float at(std::size_t i) const { return cells_[i]; }

 private:
  void markRow(const std::array<Eigen::Vector2d, 3>& p, int row) {
    const double y = row + 0.5;
    double left = std::numeric_limits<double>::max(), right = -left;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &a = p[k], &b = p[(k + 1) % 3];
      if ((a.y() > y) == (b.y() > y)) continue;
      const double x = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int from = std::max(0.0, std::ceil(left - 0.5)), to = std::min<double>(kSide - 1, std::floor(right - 0.5));
    for (int x = from; x <= to; ++x) cells_[static_cast<std::size_t>(row) * kSide + static_cast<std::size_t>(x)] = 1;
  }

  void blurLines(int radius, std::size_t step, std::size_t line_step) {
    if (radius < 1) return;
    const auto reach = static_cast<std::ptrdiff_t>(radius);
    std::vector<float> line(kSide);
    for (std::size_t l = 0; l < kSide; ++l) {
      float* first = &cells_[l * line_step];
      for (std::size_t i = 0; i < kSide; ++i) line[i] = first[i * step];
      float sum = 0;
      for (std::ptrdiff_t i = -reach; i < kSide; ++i) {
        if (i + reach < kSide) sum += line[static_cast<std::size_t>(i + reach)];
        if (i - reach > 0) sum -= line[static_cast<std::size_t>(i - reach - 1)];
        if (i >= 0) first[static_cast<std::size_t>(i) * step] = sum / static_cast<float>(2 * reach + 1);
      }
    }
  }

  Eigen::Vector2d corner_, cell_;
  std::vector<float> cells_ = std::vector<float>(static_cast<std::size_t>(kSide) * kSide);
};

ViewState withoutTerrain(const ViewState& state) {
  ViewState standing = state;
  HiddenProducts hidden(state.environment->products.size(), 0);
  for (std::uint32_t p = 0; p < hidden.size(); ++p)
    hidden[p] = isTerrain(state.environment->products[p]) || !isShown(state, p) ? 1 : 0;
  standing.hidden = std::make_shared<const HiddenProducts>(std::move(hidden));
  return standing;
}

// The mean of the terrain's, else the lowest of what stands there.
double groundOf(const ViewState& state, const MergedScene& standing) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& i : state.environment->instances) {
    if (!isTerrain(state.environment->products[i.product])) continue;
    for (const auto& p : state.environment->meshes[i.mesh]->positions)
      sum += (i.world_from_mesh * p.cast<double>()).z(), ++count;
  }
  if (count > 0) return sum / static_cast<double>(count);
  double lowest = std::numeric_limits<double>::max();
  eachTriangle(standing, lowest, [&](const Corners& t) { lowest = std::min({lowest, t[0].z(), t[1].z(), t[2].z()}); });
  return lowest;
}

}  // namespace

GroundShadow castShadow(const ViewState& state) {
  GroundShadow shadow;
  if (!state.environment || triangleCount(*state.environment) > kMostTriangles) return shadow;
  const auto scene = mergeVisible(withoutTerrain(state));
  const double cut_m = state.cut_height_m.value_or(std::numeric_limits<double>::max());
  const double ground_m = groundOf(state, scene);
  const auto fallen = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(p.head<2>() + std::max(0.0, p.z() - ground_m) * kSunShift);
  };
  Eigen::AlignedBox2d box;
  eachTriangle(scene, cut_m, [&](const Corners& t) {
    for (const auto& p : t) box.extend(Eigen::Vector2d(p.head<2>())).extend(fallen(p));
  });
  if (box.isEmpty() || !box.sizes().allFinite()) return shadow;
  const double rim = 3 * kSkyBlur_m;  // as far as the blur reaches, so that it ends in nothing
  box.extend(Eigen::Vector2d(box.min().array() - rim)).extend(Eigen::Vector2d(box.max().array() + rim));
  const Eigen::Vector2d cell = box.sizes() / kSide;
  Mask sun(box.min(), cell), sky(box.min(), cell);
  eachTriangle(scene, cut_m, [&](const Corners& t) {
    sun.mark({fallen(t[0]), fallen(t[1]), fallen(t[2])});
    sky.mark({t[0].head<2>(), t[1].head<2>(), t[2].head<2>()});
  });
  sun.blur(std::max(kPenumbra_m, 1.5 * cell.maxCoeff()));
  sky.blur(std::max(kSkyBlur_m, 1.5 * cell.maxCoeff()));
  shadow.x = box.min().x();
  shadow.y = box.min().y();
  shadow.width_m = box.sizes().x();
  shadow.height_m = box.sizes().y();
  shadow.darkness.resize(static_cast<std::size_t>(kSide) * kSide);
  for (std::size_t i = 0; i < shadow.darkness.size(); ++i)
    shadow.darkness[i] = static_cast<std::uint8_t>(std::lround(255 * (kSunPart * sun.at(i) + kSkyPart * sky.at(i))));
  return shadow;
}

}  // namespace standpoint
