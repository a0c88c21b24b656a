// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scene/bodies.h"

#include <cmath>

#include "core/winding_number.h"

namespace standpoint {

namespace {

constexpr double kInside = 0.95;  // of the winding: a body that is closed, but for rounding and hair gaps

// Of the surfaces of one product together.
double windingOf(const Environment& environment, const std::vector<std::uint32_t>& instances,
                 const Eigen::Vector3d& place) {
  double sum = 0;
  for (const auto i : instances) {
    const auto& instance = environment.instances[i];
    const auto& mesh = *environment.meshes[instance.mesh];
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions) positions.emplace_back(instance.world_from_mesh * p.cast<double>());
    const double winding = windingNumber(positions, mesh.triangles, place);
    sum += instance.world_from_mesh.linear().determinant() < 0 ? -winding : winding;  // mirrored: turned inside out
  }
  return sum;
}

}  // namespace

std::vector<Bounds> instanceBounds(const Environment& environment) {
  std::vector<Bounds> all(environment.instances.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& instance = environment.instances[i];
    if (environment.products[instance.product].inScene())
      all[i] = bounds(*environment.meshes[instance.mesh], instance.world_from_mesh);
  }
  return all;
}

double distanceTo(const Bounds& box, const Eigen::Vector3d& place) {
  return (place - place.cwiseMax(box.min).cwiseMin(box.max)).norm();
}

std::optional<std::uint32_t> bodyRound(const Environment& environment, const std::vector<Bounds>& instances,
                                       const Eigen::Vector3d& place) {
  for (std::uint32_t i = 0; i < instances.size();) {
    const auto product = environment.instances[i].product;
    std::vector<std::uint32_t> parts;  // together they may be closed where each has holes
    Bounds whole;
    for (; i < instances.size() && environment.instances[i].product == product; ++i) {
      if (instances[i].empty()) continue;
      parts.push_back(i);
      whole.extend(instances[i]);
    }
    if (whole.empty() || (place.array() < whole.min.array()).any() || (place.array() > whole.max.array()).any())
      continue;
    const double winding = windingOf(environment, parts, place);
    if ((environment.products[product].ifc_class.empty() ? winding : std::abs(winding)) >= kInside) return product;
  }
  return std::nullopt;
}

std::string productText(const Product& p) {
  const std::string text = (p.ifc_class.empty() ? "object" : p.ifc_class) + " " + p.id;
  return p.name.empty() || p.name == p.id ? text : text + " '" + p.name + "'";
}

}  // namespace standpoint
