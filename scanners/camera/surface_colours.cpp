// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/camera/surface_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace standpoint {
float linearOf(float srgb) { return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F); }

// By where each of the 256 values begins: a power for each pixel of a panorama took as long as its rays.
std::uint8_t srgbOf(float linear) {
  constexpr int kSteps = 1024;
  struct Table {
    std::array<float, 257> begins{};  // the last is never reached
    std::array<std::uint8_t, kSteps + 1> at_step{};
    Table() {
      for (std::size_t i = 1; i < 256; ++i) begins[i] = linearOf((static_cast<float>(i) - 0.5F) / 255);
      begins[256] = 2;
      for (std::size_t k = 0, value = 0; k <= kSteps; ++k) {
        while (begins[value + 1] <= static_cast<float>(k) / kSteps) ++value;
        at_step[k] = static_cast<std::uint8_t>(value);
      }
    }
  };
  static const Table table;
  const float x = linear > 0 ? std::min(linear, 1.0F) : 0;
  std::size_t value = table.at_step[static_cast<std::size_t>(x * kSteps)];
  while (table.begins[value + 1] <= x) ++value;
  return static_cast<std::uint8_t>(value);
}

SurfaceColours::SurfaceColours(const Environment& environment, Report& report) : environment_(environment) {
  for (const Surface& surface : environment.surfaces)
    plain_.emplace_back(linearOf(surface.colour.r), linearOf(surface.colour.g), linearOf(surface.colour.b));
  for (const auto& image : environment.images)
    if (pictures_.emplace_back(*image).empty())
      report.warn(image->name, "cannot decode the image; its surfaces appear in their plain colour");
}

SurfaceColours::Look SurfaceColours::at(const RayHit& hit) const {
  const Surface& surface = environment_.surfaces[hit.surface];
  Look look{plain_[hit.surface], surface.colour.a, surface.unlit};
  const Instance& instance = environment_.instances[hit.instance];
  const Mesh& mesh = *environment_.meshes[instance.mesh];
  const bool painted = surface.image >= 0 && static_cast<std::size_t>(surface.image) < pictures_.size() &&
                       !pictures_[static_cast<std::size_t>(surface.image)].empty() && !mesh.texture_coordinates.empty();
  if (!painted && mesh.colours.empty()) return look;
  const Triangle& triangle = mesh.triangles[hit.triangle];
  std::array<Eigen::Vector3d, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = instance.world_from_mesh * mesh.positions[triangle[k]].cast<double>();
  const Eigen::Array3f fraction = cornerWeights(corner, hit.position).cast<float>();
  Eigen::Array4f paint = Eigen::Array4f::Ones();
  if (painted)
    paint *= pictures_[static_cast<std::size_t>(surface.image)].at(texturePlace(mesh, hit.triangle, fraction));
  if (!mesh.colours.empty()) {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = mesh.colours[triangle[k]];
      const auto& linear = linearOfByte();
      sum += fraction[static_cast<Eigen::Index>(k)] *
             Eigen::Array4f(linear[c[0]], linear[c[1]], linear[c[2]], static_cast<float>(c[3]) / 255);
    }
    paint *= sum.max(0);
  }
  look.colour *= paint.head<3>();
  look.opacity *= paint[3];
  return look;
}

}  // namespace standpoint
