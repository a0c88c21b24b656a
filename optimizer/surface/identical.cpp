// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/identical.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "core/decompositions.h"

namespace standpoint {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSame = 5e-5, kSameFraction = 1e-4;  // m, and of the diagonal
constexpr int kMostTries = 200;                       // of alignments, for shapes whose vertices all look alike
constexpr double kAreaStep = 1e-3;                    // relative; neighbours are looked at, too

double tolerance(const Shape& shape) { return std::min(kSame, kSameFraction * shape.diagonal()) + shape.rounding(); }

// What does not change when a shape is moved.
struct Signature {
  double area = 0;
  Vector3d centroid = Vector3d::Zero();  // by area, so that it does not depend on where the vertices are
  std::vector<double> radii;             // of each vertex, from the centroid
  std::vector<double> sorted_radii;
  std::vector<std::uint32_t> by_x;  // vertices
};

Signature signatureOf(const Shape& shape) {
  Signature s;
  for (const auto& t : shape.triangles) {
    const auto &a = shape.positions[t[0]], &b = shape.positions[t[1]], &c = shape.positions[t[2]];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    s.area += area;
    s.centroid += area * (a + b + c) / 3;
  }
  if (s.area > 0) s.centroid /= s.area;
  for (const auto& p : shape.positions) s.radii.push_back((p - s.centroid).norm());
  s.sorted_radii = s.radii;
  std::sort(s.sorted_radii.begin(), s.sorted_radii.end());
  s.by_x.resize(shape.positions.size());
  std::iota(s.by_x.begin(), s.by_x.end(), 0U);
  std::sort(s.by_x.begin(), s.by_x.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(shape.positions[a].x(), a) < std::pair(shape.positions[b].x(), b);
  });
  return s;
}

// Axes along a vertex and across it towards another; nothing where the two stand in line with the centroid.
std::optional<Matrix3d> frame(const Vector3d& along, const Vector3d& aside) {
  Matrix3d axes;
  const Vector3d z = along.cross(aside);
  if (!(z.norm() > 1e-3 * along.norm() * along.norm())) return std::nullopt;
  axes.col(0) = along.normalized();
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

class Aligner {
 public:
  Aligner(const Shape& a, const Signature& sa, const Shape& b, const Signature& sb)
      : a_(a), b_(b), sa_(sa), sb_(sb), tolerance_(std::max(tolerance(a), tolerance(b))) {}

  std::optional<Repetition> run() {
    if (!radiiAgree()) return std::nullopt;
    const auto first =
        static_cast<std::uint32_t>(std::max_element(sa_.radii.begin(), sa_.radii.end()) - sa_.radii.begin());
    const Vector3d along = a_.positions[first] - sa_.centroid;
    std::uint32_t second = first;
    double most = 0;
    for (std::uint32_t i = 0; i < a_.positions.size(); ++i)
      if (const double off = along.cross(a_.positions[i] - sa_.centroid).norm(); off > most * (1 + 1e-9))
        most = off, second = i;
    const auto axes = frame(along, a_.positions[second] - sa_.centroid);
    if (!axes) return std::nullopt;
    const double apart = (a_.positions[first] - a_.positions[second]).norm();
    if (auto found = attempt(*axes, first, second))
      return found;  // copies mostly have their vertices in the same order
    int tries = 0;
    for (std::uint32_t i = 0; i < b_.positions.size(); ++i) {
      if (std::abs(sb_.radii[i] - sa_.radii[first]) > tolerance_) continue;
      for (std::uint32_t k = 0; k < b_.positions.size(); ++k) {
        if (std::abs(sb_.radii[k] - sa_.radii[second]) > tolerance_ ||
            std::abs((b_.positions[i] - b_.positions[k]).norm() - apart) > 2 * tolerance_)
          continue;
        if (++tries > kMostTries) return std::nullopt;
        if (auto found = attempt(*axes, i, k)) return found;
      }
    }
    return std::nullopt;
  }

 private:
  bool radiiAgree() const {
    for (std::size_t i = 0; i < sa_.sorted_radii.size(); ++i)
      if (std::abs(sa_.sorted_radii[i] - sb_.sorted_radii[i]) > 2 * tolerance_) return false;
    return true;
  }

  std::optional<Repetition> attempt(const Matrix3d& axes, std::uint32_t first, std::uint32_t second) const {
    const auto other = frame(b_.positions[first] - sb_.centroid, b_.positions[second] - sb_.centroid);
    if (!other) return std::nullopt;
    const Matrix3d rotation = *other * axes.transpose();
    std::vector<std::uint32_t> image(a_.positions.size());
    for (std::uint32_t i = 0; i < image.size(); ++i) {
      const auto found = vertexAt(rotation * (a_.positions[i] - sa_.centroid) + sb_.centroid);
      if (!found) return std::nullopt;
      image[i] = *found;
    }
    return sameTriangles(image) ? proof(image) : std::nullopt;
  }

  std::optional<std::uint32_t> vertexAt(const Vector3d& p) const {
    const double reach = 6 * tolerance_;  // a frame of two vertices is rough
    auto at = std::lower_bound(sb_.by_x.begin(), sb_.by_x.end(), p.x() - reach,
                               [&](std::uint32_t i, double x) { return b_.positions[i].x() < x; });
    std::optional<std::uint32_t> best;
    double nearest = reach * reach;
    for (; at != sb_.by_x.end() && b_.positions[*at].x() <= p.x() + reach; ++at)
      if (const double squared = (b_.positions[*at] - p).squaredNorm(); squared <= nearest)
        nearest = squared, best = *at;
    return best;
  }

  bool sameTriangles(const std::vector<std::uint32_t>& image) const {
    using Key = std::tuple<Triangle, std::uint32_t>;
    const auto key = [](Triangle t, std::uint32_t surface) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      return Key{t, surface};
    };
    std::vector<Key> mapped, own;
    for (std::size_t i = 0; i < a_.triangles.size(); ++i) {
      const auto& t = a_.triangles[i];
      mapped.push_back(key({image[t[0]], image[t[1]], image[t[2]]}, a_.surface_of_triangle[i]));
      own.push_back(key(b_.triangles[i], b_.surface_of_triangle[i]));
    }
    std::sort(mapped.begin(), mapped.end());
    std::sort(own.begin(), own.end());
    return mapped == own;
  }

  // The best motion (Kabsch 1976), and whether it is good enough.
  std::optional<Repetition> proof(const std::vector<std::uint32_t>& image) const {
    Vector3d middle_a = Vector3d::Zero(), middle_b = middle_a;
    const auto n = static_cast<double>(image.size());
    for (std::size_t i = 0; i < image.size(); ++i)
      middle_a += a_.positions[i] / n, middle_b += b_.positions[image[i]] / n;
    Matrix3d covariance = Matrix3d::Zero();
    for (std::size_t i = 0; i < image.size(); ++i)
      covariance += (b_.positions[image[i]] - middle_b) * (a_.positions[i] - middle_a).transpose();
    const auto [u, values, v] = singularValues(covariance);
    Vector3d signs = Vector3d::Ones();
    if ((u * v.transpose()).determinant() < 0) signs.z() = -1;
    Repetition result;
    result.motion.linear() = u * signs.asDiagonal() * v.transpose();
    result.motion.translation() = middle_b - result.motion.linear() * middle_a;
    for (std::size_t i = 0; i < image.size(); ++i)
      result.residual_m =
          std::max(result.residual_m, (result.motion * a_.positions[i] - b_.positions[image[i]]).norm());
    return result.residual_m <= tolerance_ ? std::optional(result) : std::nullopt;
  }

  const Shape &a_, &b_;
  const Signature &sa_, &sb_;
  double tolerance_;
};

}  // namespace

std::vector<Repetition> findRepetitions(const std::vector<Shape>& shapes, const std::vector<std::uint32_t>& kinds) {
  std::vector<Repetition> result(shapes.size());
  for (std::uint32_t i = 0; i < result.size(); ++i) result[i].first = i;
  std::map<std::tuple<std::uint32_t, std::size_t, std::size_t>, std::vector<std::uint32_t>> alike;
  for (std::uint32_t i = 0; i < shapes.size(); ++i)
    if (!shapes[i].triangles.empty() && shapes[i].wedges.empty())
      alike[{kinds[i], shapes[i].positions.size(), shapes[i].triangles.size()}].push_back(i);
  std::vector<const std::vector<std::uint32_t>*> groups;
  for (const auto& [key, members] : alike)
    if (members.size() > 1) groups.push_back(&members);
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {       // a shape is in one group only
    std::map<long, std::vector<std::pair<std::uint32_t, Signature>>> firsts;  // by area
    for (const auto i : *groups[g]) {
      auto signature = signatureOf(shapes[i]);
      if (!(signature.area > 0)) continue;
      const auto step = std::lround(std::log(signature.area) / kAreaStep);
      bool repeats = false;
      for (auto near = step - 1; near <= step + 1 && !repeats; ++near)
        for (const auto& [first, known] : firsts[near]) {
          auto found = Aligner(shapes[first], known, shapes[i], signature).run();
          if (!found) continue;
          result[i] = *found;
          result[i].first = first;
          repeats = true;
          break;
        }
      if (!repeats) firsts[step].emplace_back(i, std::move(signature));
    }
  });
  return result;
}

}  // namespace standpoint
