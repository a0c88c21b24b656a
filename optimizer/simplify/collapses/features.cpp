// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/collapses/features.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kCreaseCosine = 0.866;       // 30°
constexpr double kFeatureWeight = 0.3;        // of a constraint plane, times the squared length of its edge
constexpr std::size_t kFeaturesChunk = 8192;  // vertices looked at together

struct Face {
  Vector3d normal = Vector3d::Zero();  // unit, or zero where rounding decides it
  Vector3d crease = Vector3d::Zero();  // the same, but zero for needles: their noise must not make a crease of a plane
  double length = 0;                   // of the normal before: twice the area
};

struct Feature {
  std::uint32_t a, b, triangle;
};

class Finder {
 public:
  explicit Finder(const Shape& shape);
  // The planes of the triangles around v, and the edges to larger vertices that show.
  Quadric planesAround(std::uint32_t v) const;
  void findFeatures(std::uint32_t v, std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges,
                    std::vector<Feature>& found) const;
  const Face& face(std::uint32_t triangle) const { return faces_[triangle]; }

 private:
  bool shows(std::uint32_t a, std::uint32_t b, const std::pair<std::uint32_t, std::uint32_t>* first,
             const std::pair<std::uint32_t, std::uint32_t>* last) const;
  std::uint32_t wedge(std::uint32_t triangle, std::uint32_t v) const {
    const auto& t = shape_.triangles[triangle];
    return shape_.wedges[triangle][t[0] == v ? 0 : t[1] == v ? 1 : 2];
  }

  const Shape& shape_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> first_, around_;  // triangles by vertex
};

Finder::Finder(const Shape& shape)
    : shape_(shape),
      faces_(shape.triangles.size()),
      first_(shape.positions.size() + 1, 0),
      around_(3 * shape.triangles.size()) {
  const double rounding = shape.rounding();
  tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t i) {
    const auto& t = shape.triangles[i];
    const Vector3d e1 = shape.positions[t[1]] - shape.positions[t[0]],
                   e2 = shape.positions[t[2]] - shape.positions[t[0]];
    const Vector3d normal = e1.cross(e2);
    const double longest_squared = std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
    if (normal.squaredNorm() <= rounding * rounding * longest_squared) return;
    faces_[i].length = normal.norm();
    faces_[i].normal = normal / faces_[i].length;
    if (normal.squaredNorm() > 1e4 * rounding * rounding * longest_squared) faces_[i].crease = faces_[i].normal;
  });
  for (const auto& t : shape.triangles)
    for (const auto v : t) ++first_[v + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  auto next = first_;
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i)
    for (const auto v : shape.triangles[i]) around_[next[v]++] = i;
}

Quadric Finder::planesAround(std::uint32_t v) const {
  Quadric sum;
  for (auto k = first_[v]; k < first_[v + 1]; ++k) {
    const Face& face = faces_[around_[k]];
    if (face.length > 0) sum.addPlane(face.normal, shape_.positions[shape_.triangles[around_[k]][0]], face.length / 6);
  }
  return sum;
}

bool Finder::shows(std::uint32_t a, std::uint32_t b, const std::pair<std::uint32_t, std::uint32_t>* first,
                   const std::pair<std::uint32_t, std::uint32_t>* last) const {
  if (last - first == 1) return true;
  const Vector3d* reference = nullptr;
  for (const auto* edge = first; edge < last; ++edge) {
    if (shape_.surface_of_triangle[edge->second] != shape_.surface_of_triangle[first->second]) return true;
    if (!shape_.wedges.empty() &&
        (wedge(edge->second, a) != wedge(first->second, a) || wedge(edge->second, b) != wedge(first->second, b)))
      return true;
    const Vector3d& normal = faces_[edge->second].crease;
    if (normal.isZero()) continue;
    if (reference != nullptr && reference->dot(normal) < kCreaseCosine) return true;
    if (reference == nullptr) reference = &normal;
  }
  return false;
}

void Finder::findFeatures(std::uint32_t v, std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges,
                          std::vector<Feature>& found) const {
  edges.clear();
  for (auto k = first_[v]; k < first_[v + 1]; ++k)
    for (const auto n : shape_.triangles[around_[k]])
      if (n > v) edges.emplace_back(n, around_[k]);
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j].first == edges[i].first) ++j;
    if (!shows(v, edges[i].first, &edges[i], &edges[i] + (j - i))) continue;
    for (auto k = i; k < j; ++k) found.push_back({v, edges[i].first, edges[k].second});
  }
}

// A plane through the edge, upright on its triangle: it holds the edge where its triangles' own planes do not (borders
// of the mesh and between surfaces), and the rim of thin parts, whose side has too little area to speak for itself.
void addFeature(Patch& patch, const Feature& feature, const Vector3d& normal) {
  const Vector3d edge = patch.positions[feature.b] - patch.positions[feature.a];
  const Vector3d upright = edge.cross(normal);
  const double length = upright.norm();
  if (!(length > 0)) return;
  for (const auto v : {feature.a, feature.b}) {
    patch.quadrics[v].addPlane(upright / length, patch.positions[feature.a], kFeatureWeight * edge.squaredNorm());
    if (!patch.features.empty()) patch.features[v].addPlane(upright / length, patch.positions[feature.a], 1);
  }
}

}  // namespace

Patch patchOf(const Shape& shape, const CollapseOptions& options) {
  Patch patch;
  patch.positions = shape.positions;
  patch.triangles = shape.triangles;
  patch.quadrics.resize(shape.positions.size());
  patch.features.resize(options.lossless ? shape.positions.size() : 0);
  patch.deviation_m.assign(shape.positions.size(), 0);
  const Finder finder(shape);
  std::vector<std::vector<Feature>> found((shape.positions.size() + kFeaturesChunk - 1) / kFeaturesChunk);
  tbb::parallel_for(std::size_t{0}, found.size(),
                    [&](std::size_t chunk) {  // each its own vertices; the features one after the other below
                      std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
                      for (auto v = chunk * kFeaturesChunk;
                           v < std::min(shape.positions.size(), (chunk + 1) * kFeaturesChunk); ++v) {
                        if (!options.memoryless) patch.quadrics[v] = finder.planesAround(static_cast<std::uint32_t>(v));
                        finder.findFeatures(static_cast<std::uint32_t>(v), edges, found[chunk]);
                      }
                    });
  for (const auto& chunk : found)
    for (const auto& feature : chunk) addFeature(patch, feature, finder.face(feature.triangle).crease);
  return patch;
}

}  // namespace standpoint
