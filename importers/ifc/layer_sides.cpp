// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/layer_sides.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "importers/ifc/shapes/mapping.h"

namespace standpoint::ifc {
namespace {

constexpr double kNear_m = 1e-4;  // a point this close to a boundary lies on it
constexpr double kAcross = 0.9;   // cosine: a face that looks along the axis within 25°

// Distance along the layers' axis, and the direction in which it grows.
class Across {
 public:
  Across(const LayerUsage& usage, const ReferenceLine& line) : line_(line) {
    axis_ = Eigen::Vector3d::Unit(usage.axis);
    if (usage.axis != 1 || line.size() < 2) return;
    const Eigen::Vector2d along = (line.back() - line.front()).normalized();
    const Eigen::Vector2d left(-along.y(), along.x());
    for (const Eigen::Vector2d& p : line) curved_ = curved_ || std::abs((p - line.front()).dot(left)) > 1e-3;
    if (curved_ || !left.allFinite()) return;
    axis_ = {left.x(), left.y(), 0};
    if (axis_.y() < 0) axis_ = -axis_;  // a line drawn backwards: the placement's y says which side is meant
    start_ = axis_.x() * line.front().x() + axis_.y() * line.front().y();
  }

  bool curved() const { return curved_; }
  double distance(const Eigen::Vector3d& p) const { return curved_ ? nearest(p).first : axis_.dot(p) - start_; }
  Eigen::Vector3d direction(const Eigen::Vector3d& p) const { return curved_ ? nearest(p).second : axis_; }

 private:
  // To the left of the curve is positive.
  std::pair<double, Eigen::Vector3d> nearest(const Eigen::Vector3d& p) const {
    double best = 1e300, side = 0;
    Eigen::Vector3d normal = axis_;
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const Eigen::Vector2d q(p.x(), p.y()), along = line_[i + 1] - line_[i];
      const double length = along.norm();
      if (length < 1e-9) continue;
      const double t = std::clamp((q - line_[i]).dot(along) / (length * length), 0.0, 1.0);
      const double d = (q - line_[i] - t * along).norm();
      if (d >= best) continue;
      const Eigen::Vector2d left(-along.y() / length, along.x() / length);
      best = d, side = (q - line_[i]).dot(left), normal = {left.x(), left.y(), 0};
    }
    return {side, normal};
  }

  const ReferenceLine& line_;
  Eigen::Vector3d axis_;
  double start_ = 0;
  bool curved_ = false;
};

// The layers as intervals along the axis, laid against the body.
class Stack {
 public:
  Stack(const ProductMaterials& materials, double low, double high) : materials_(materials) {
    const LayerUsage& usage = *materials.usage;
    double at = usage.offset_m;
    for (const MaterialLayer& layer : materials.layers) {
      const double next = at + usage.sense * std::max(layer.thickness_m, 0.0);
      from_.push_back(std::min(at, next));
      to_.push_back(std::max(at, next));
      at = next;
    }
    const double first = *std::min_element(from_.begin(), from_.end()),
                 last = *std::max_element(to_.begin(), to_.end());
    fits_ = std::abs((last - first) - (high - low)) <= 1e-3 + 0.01 * (last - first) && last > first;
    const double stretch = fits_ ? (high - low) / (last - first) : 1;
    for (auto* ends : {&from_, &to_})
      for (double& d : *ends) d = low + (d - first) * stretch;
    for (std::size_t i = 1; i < materials.layers.size(); ++i)
      if (materials.layers[i].thickness_m > materials.layers[thickest_].thickness_m ||
          !materials.material_of_layer[thickest_])
        if (materials.material_of_layer[i]) thickest_ = i;
  }

  bool fits() const { return fits_; }
  std::uint32_t thickest() const { return static_cast<std::uint32_t>(thickest_); }

  // The outermost layer with a material, seen from above or below.
  std::uint32_t outermost(bool above) const {
    const bool last = above == (materials_.usage->sense > 0);
    const std::size_t n = from_.size();
    for (std::size_t k = 0; k < n; ++k)
      if (const std::size_t i = last ? n - 1 - k : k; materials_.material_of_layer[i])
        return static_cast<std::uint32_t>(i);
    return thickest();
  }

  // The layer at d; a layer of air shows nothing, then the thickest stands for it.
  std::uint32_t at(double d) const {
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (d >= from_[i] && d <= to_[i] && to_[i] > from_[i])
        return materials_.material_of_layer[i] ? static_cast<std::uint32_t>(i) : thickest();
    return outermost(!from_.empty() && d > to_[thickest_]);
  }

  // Where two layers of different materials meet, rising.
  std::vector<double> boundaries() const {
    std::vector<double> found;
    const auto solid = [&](std::size_t i) { return to_[i] > from_[i]; };
    std::size_t before = from_.size();
    for (std::size_t i = 0; i < from_.size(); ++i) {
      if (!solid(i)) continue;
      if (before < from_.size() && materials_.material_of_layer[before] != materials_.material_of_layer[i])
        found.push_back(materials_.usage->sense > 0 ? from_[i] : to_[i]);
      before = i;
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  const ProductMaterials& materials_;
  std::vector<double> from_, to_;
  std::size_t thickest_ = 0;
  bool fits_ = false;
};

// Cuts all triangles along a plane of the axis. An edge has one cut, whichever of its triangles asks for it.
class Cutter {
 public:
  Cutter(LayeredBody& body, std::vector<double>& distances) : body_(body), distances_(distances) {}

  void cut(double d) {
    made_.clear();
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> tags;
    for (std::size_t k = 0; k < body_.triangles.size(); ++k) {
      const std::size_t before = triangles.size();
      cutOne(body_.triangles[k], d, triangles);
      tags.insert(tags.end(), triangles.size() - before, body_.tags[k]);
    }
    body_.triangles = std::move(triangles);
    body_.tags = std::move(tags);
  }

 private:
  int side(std::uint32_t i, double d) const {
    return distances_[i] > d + kNear_m ? 1 : distances_[i] < d - kNear_m ? -1 : 0;
  }

  // The order of the ends is that of their coordinates: points may stand twice in the list.
  std::uint32_t on(std::uint32_t a, std::uint32_t b, double d) {
    const auto& p = body_.positions;
    const auto less = [&](std::uint32_t i, std::uint32_t j) {
      return std::tie(p[i].x(), p[i].y(), p[i].z()) < std::tie(p[j].x(), p[j].y(), p[j].z());
    };
    if (less(b, a)) std::swap(a, b);
    const auto [it, is_new] = made_.try_emplace({a, b}, static_cast<std::uint32_t>(p.size()));
    if (!is_new) return it->second;
    const double t = (d - distances_[a]) / (distances_[b] - distances_[a]);
    const Eigen::Vector3d q = p[a].cast<double>() + t * (p[b].cast<double>() - p[a].cast<double>());
    body_.positions.push_back(q.cast<float>());
    distances_.push_back(d);
    return it->second;
  }

  void cutOne(const Triangle& t, double d, std::vector<Triangle>& out) {
    const int s[3] = {side(t[0], d), side(t[1], d), side(t[2], d)};
    if (std::max({s[0], s[1], s[2]}) <= 0 || std::min({s[0], s[1], s[2]}) >= 0) return out.push_back(t);
    std::vector<std::uint32_t> above, below;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (s[i] >= 0) above.push_back(t[i]);
      if (s[i] <= 0) below.push_back(t[i]);
      if (s[i] * s[j] < 0) {
        const std::uint32_t q = on(t[i], t[j], d);
        above.push_back(q);
        below.push_back(q);
      }
    }
    for (const auto* part : {&above, &below})
      for (std::size_t i = 1; i + 1 < part->size(); ++i) out.push_back({(*part)[0], (*part)[i], (*part)[i + 1]});
  }

  LayeredBody& body_;
  std::vector<double>& distances_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

bool severalMaterials(const ProductMaterials& m) {
  Id first = 0;
  for (const Id id : m.material_of_layer) {
    if (!id) continue;
    if (first && id != first) return true;
    first = id;
  }
  return false;
}

}  // namespace

ReferenceLine referenceLine(const Entity& product, const Model& model) {
  for (const Entity& representation : product.ref(6).refs(2)) {
    if (representation[1].text() != "Axis") continue;
    for (const Entity& item : representation.refs(3)) {
      Scope scope(model);
      const auto path = curve(item, scope);
      if (!path || path->points.size() < 2 || path->closed) continue;
      ReferenceLine line;
      for (const Eigen::Vector3d& p : path->points)
        if (p.allFinite()) line.emplace_back(p.x(), p.y());
      return line;
    }
  }
  return {};
}

std::optional<LayeredBody> layeredBody(const Body& body, const Eigen::Affine3d& product_from_items,
                                       const ProductMaterials& materials, const ReferenceLine& line) {
  if (!materials.usage || !severalMaterials(materials)) return {};
  LayeredBody result{body.positions, body.triangles, body.tags, {}};
  const Across across(*materials.usage, line);
  const auto inProduct = [&](std::uint32_t i) {
    return Eigen::Vector3d(product_from_items * (result.positions[i].cast<double>() + body.origin));
  };
  std::vector<double> distances;
  for (std::uint32_t i = 0; i < result.positions.size(); ++i) distances.push_back(across.distance(inProduct(i)));
  if (distances.empty()) return {};
  const auto [low, high] = std::minmax_element(distances.begin(), distances.end());
  const Stack stack(materials, *low, *high);
  const double bottom = *low, top = *high;
  const auto boundaries = stack.boundaries();
  bool cut = stack.fits() && !across.curved();
  if (cut) {
    LayeredBody sliced = result;
    std::vector<double> of_sliced = distances;
    Cutter cutter(sliced, of_sliced);
    const std::size_t most = kMostGrowth * body.triangles.size();
    for (const double d : stack.boundaries())
      if (d > bottom + kNear_m && d < top - kNear_m && sliced.triangles.size() <= most) cutter.cut(d);
    cut = sliced.triangles.size() <= most;
    if (cut) result = std::move(sliced), distances = std::move(of_sliced);
  }
  const double slack_m = across.curved() ? 1e-2 : 2e-3;  // of a side that is drawn with chords
  const double hand = product_from_items.linear().determinant() < 0 ? -1 : 1;
  for (const Triangle& t : result.triangles) {
    const Eigen::Vector3d a = inProduct(t[0]), b = inProduct(t[1]), c = inProduct(t[2]);
    const double d = (distances[t[0]] + distances[t[1]] + distances[t[2]]) / 3;
    const double facing = hand * (b - a).cross(c - a).normalized().dot(across.direction((a + b + c) / 3));
    std::uint32_t layer = stack.thickest();
    if (std::abs(facing) > kAcross) {
      const bool outside = facing > 0 ? d > top - slack_m : d < bottom + slack_m;
      layer = outside || !stack.fits() ? stack.outermost(facing > 0) : stack.at(d - std::copysign(2 * kNear_m, facing));
    } else if (cut) {
      layer = stack.at(d);
    }
    result.layer.push_back(layer);
  }
  return result;
}

std::vector<double> layeringKey(const Eigen::Affine3d& product_from_items, const ProductMaterials& materials,
                                const ReferenceLine& line) {
  if (!materials.usage || !severalMaterials(materials)) return {};
  std::vector<double> key{static_cast<double>(materials.usage->axis), materials.usage->sense,
                          materials.usage->offset_m};
  for (std::size_t i = 0; i < materials.layers.size(); ++i) {
    key.push_back(materials.layers[i].thickness_m);
    key.push_back(static_cast<double>(materials.material_of_layer[i]));
  }
  const Eigen::Matrix<double, 3, 4> placed = product_from_items.affine();
  for (Eigen::Index i = 0; i < placed.size(); ++i) key.push_back(std::round(placed.data()[i] * 1e6) / 1e6);
  if (materials.usage->axis == 1)
    for (const Eigen::Vector2d& p : line) key.push_back(p.x()), key.push_back(p.y());
  return key;
}

}  // namespace standpoint::ifc
