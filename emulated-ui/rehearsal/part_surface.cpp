// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/part_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace standpoint {

namespace {

constexpr double kPatch_m = 0.25;  // unseen places so near belong to one hole

}  // namespace

PartSurface::PartSurface(const ExercisePart& part, const Environment& environment, const Eigen::Vector3d& shift_m)
    : part_(part), shift_m_(shift_m) {
  for (std::uint32_t i = 0; i < environment.products.size(); ++i)
    if (isMeant(environment.products[i])) {
      products_.insert(i);
      labels_.insert(environment.products[i].global_id + "/" + environment.products[i].id);
    }
}

bool PartSurface::has(const SurfaceSample& sample) const {
  return sample.exposed && products_.contains(sample.product) && inBox(sample.place.position) &&
         (part_.floor.empty() || sample.place.normal.z() > 0.9);
}

bool PartSurface::inBox(const Eigen::Vector3d& local_m) const {
  if (part_.box.empty()) return true;
  const Eigen::Vector3d p = local_m + shift_m_;
  for (int k = 0; k < 3; ++k)
    if (p[k] < part_.box[static_cast<std::size_t>(k)] || p[k] > part_.box[static_cast<std::size_t>(k) + 3])
      return false;
  return true;
}

bool PartSurface::meets(const std::vector<Bounds>& bounds) const {
  if (part_.box.empty()) return true;
  const Eigen::Vector3d low(part_.box[0], part_.box[1], part_.box[2]), high(part_.box[3], part_.box[4], part_.box[5]);
  return std::any_of(products_.begin(), products_.end(), [&](std::uint32_t i) {
    const Bounds& b = bounds[i];
    return !b.empty() && (b.min + shift_m_ - high).maxCoeff() <= 0 && (low - b.max - shift_m_).maxCoeff() <= 0;
  });
}

bool PartSurface::isMeant(const Product& product) const {
  if (!part_.floor.empty())
    return product.storey == part_.floor &&
           (product.ifc_class.starts_with("IfcSlab") || product.ifc_class.starts_with("IfcCovering"));
  return part_.product.empty() || product.name == part_.product || product.global_id == part_.product ||
         product.id == part_.product;
}

std::size_t SeenCells::CellHash::operator()(const Cell& c) const {
  const auto [x, y, z] = c;
  return static_cast<std::size_t>(x) * 73856093U ^ static_cast<std::size_t>(y) * 19349663U ^
         static_cast<std::size_t>(z) * 83492791U;
}

SeenCells::Cell SeenCells::cellOf(const Eigen::Vector3d& p) {
  const auto at = [](double v) { return static_cast<std::int32_t>(std::floor(v / kNear_m)); };
  return {at(p.x()), at(p.y()), at(p.z())};
}

bool SeenCells::near(const Eigen::Vector3d& p) const {
  const auto [x, y, z] = cellOf(p);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        if (cells_.contains({x + i, y + j, z + k})) return true;
  return false;
}

std::vector<Eigen::Vector3d> largestPatch(const std::vector<Eigen::Vector3d>& places) {
  if (places.empty()) return {};
  std::vector<std::size_t> group(places.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  std::vector<std::size_t> by_x(places.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(), [&](auto a, auto b) { return places[a].x() < places[b].x(); });
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t k = i + 1; k < by_x.size() && places[by_x[k]].x() - places[by_x[i]].x() <= kPatch_m; ++k)
      if ((places[by_x[i]] - places[by_x[k]]).squaredNorm() <= kPatch_m * kPatch_m)
        group[root(by_x[i])] = root(by_x[k]);
  std::map<std::size_t, std::size_t> count;
  for (std::size_t i = 0; i < places.size(); ++i) ++count[root(i)];
  const auto most =
      std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<Eigen::Vector3d> patch;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (root(i) == most->first) patch.push_back(places[i]);
  return patch;
}

}  // namespace standpoint
