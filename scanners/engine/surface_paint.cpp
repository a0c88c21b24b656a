// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/surface_paint.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace standpoint {

namespace {

float luminance(const Eigen::Array4f& linear) {
  return 0.2126F * linear[0] + 0.7152F * linear[1] + 0.0722F * linear[2];
}

// Places spread evenly over a triangle: the middles of the n² alike ones that it falls into.
template <class Use>
void forPlaces(int n, Use use) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
      const int up = j / 2;
      const float third = j % 2 == 0 ? 1.0F / 3 : 2.0F / 3;
      const float b = (static_cast<float>(i) + third) / static_cast<float>(n);
      const float c = (static_cast<float>(up) + third) / static_cast<float>(n);
      use(Eigen::Array3f(1 - b - c, b, c));
    }
}

}  // namespace

SurfacePaint::SurfacePaint(const Environment& environment) : environment_(environment) {
  pictures_.resize(environment.images.size());
  paints_.resize(environment.surfaces.size());
  for (std::uint32_t s = 0; s < environment.surfaces.size(); ++s) {
    const Surface& surface = environment.surfaces[s];
    if (surface.unlit || surface.image < 0 || static_cast<std::size_t>(surface.image) >= pictures_.size()) continue;
    auto& picture = pictures_[static_cast<std::size_t>(surface.image)];
    if (!picture) picture.emplace(*environment.images[static_cast<std::size_t>(surface.image)]);
    if (picture->empty()) continue;
    paints_[s].picture = &*picture;
    findMean(s);
  }
}

void SurfacePaint::findMean(std::uint32_t surface) {
  constexpr double kPlaces = 65536;
  const auto each = [&](auto use) {
    for (const auto& instance : environment_.instances) {
      const Mesh& mesh = *environment_.meshes[instance.mesh];
      if (mesh.texture_coordinates.empty() || !environment_.products[instance.product].inScene()) continue;
      const auto& of = mesh.surface_of_triangle;  // sorted
      const auto [from, to] = std::equal_range(of.begin(), of.end(), surface);
      for (auto t = from; t != to; ++t) use(instance, mesh, static_cast<std::uint32_t>(t - of.begin()));
    }
  };
  double triangles = 0;
  each([&](const Instance&, const Mesh&, std::uint32_t) { ++triangles; });
  const int n = static_cast<int>(std::clamp(std::sqrt(kPlaces / std::max(1.0, triangles)), 1.0, 256.0));
  double area = 0, light = 0;
  each([&](const Instance& instance, const Mesh& mesh, std::uint32_t t) {
    const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
      return instance.world_from_mesh * mesh.positions[mesh.triangles[t][k]].cast<double>();
    };
    const double own = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
    double sum = 0;
    forPlaces(n, [&](const Eigen::Array3f& weights) {
      sum += static_cast<double>(luminance(paints_[surface].picture->at(texturePlace(mesh, t, weights))));
    });
    area += own;
    light += own * sum / (n * n);
  });
  if (light > 1e-3 * area)
    paints_[surface].inverse_mean = static_cast<float>(area / light);
  else
    paints_[surface].picture = nullptr;  // black all over: nothing to scale by
}

bool SurfacePaint::empty() const {
  return std::none_of(paints_.begin(), paints_.end(), [](const Paint& p) { return p.picture != nullptr; });
}

bool SurfacePaint::paints(const Facet& facet) const {
  return facet.stays() && paints_[facet.surface].picture != nullptr &&
         !environment_.meshes[environment_.instances[facet.instance].mesh]->texture_coordinates.empty();
}

float SurfacePaint::factor(const Facet& facet, const Eigen::Vector3d& place) const {
  const Instance& instance = environment_.instances[facet.instance];
  const Mesh& mesh = *environment_.meshes[instance.mesh];
  std::array<Eigen::Vector3d, 3> corner;
  for (std::size_t k = 0; k < 3; ++k)
    corner[k] = instance.world_from_mesh * mesh.positions[mesh.triangles[facet.triangle][k]].cast<double>();
  const auto& paint = paints_[facet.surface];
  const auto uv = texturePlace(mesh, facet.triangle, cornerWeights(corner, place).cast<float>());
  return luminance(paint.picture->at(uv)) * paint.inverse_mean;
}

}  // namespace standpoint
