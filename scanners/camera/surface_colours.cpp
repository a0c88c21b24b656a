// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/camera/surface_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include <Eigen/Geometry>
#include <stb/stb_image.h>

namespace standpoint {
namespace {

constexpr int kLargestSide = 16384;

const std::array<float, 256>& linearOfByte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = linearOf(static_cast<float>(i) / 255);
    return t;
  }();
  return table;
}

// Shares of a triangle's corners at a point of its plane; the first corner alone where it has no area.
Eigen::Array3d weightsOf(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& p) {
  const Eigen::Vector3d u = corner[1] - corner[0], v = corner[2] - corner[0], w = p - corner[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v), d = uu * vv - uv * uv;
  if (!(d > 0)) return {1, 0, 0};
  const double b = (vv * wu - uv * wv) / d, c = (uu * wv - uv * wu) / d;
  return {1 - b - c, b, c};
}

}  // namespace

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
  for (const auto& image : environment.images) {
    Picture& picture = pictures_.emplace_back();
    const auto* bytes = reinterpret_cast<const stbi_uc*>(image->bytes.data());
    const int size = static_cast<int>(std::min(image->bytes.size(), std::size_t{1} << 30U));
    int width = 0, height = 0, channels = 0;
    const bool known = stbi_info_from_memory(bytes, size, &width, &height, &channels) != 0 && width <= kLargestSide &&
                       height <= kLargestSide;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        known ? stbi_load_from_memory(bytes, size, &width, &height, &channels, 4) : nullptr, stbi_image_free);
    if (!pixels) {
      report.warn(image->name, "cannot decode the image; its surfaces appear in their plain colour");
      continue;
    }
    picture.width = width, picture.height = height;
    picture.rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * static_cast<std::size_t>(width) *
                                                         static_cast<std::size_t>(height));
  }
}

Eigen::Array4f SurfaceColours::Picture::at(const Eigen::Vector2f& uv) const {
  const auto place = [](float t, int size) { return (t - std::floor(t)) * static_cast<float>(size) - 0.5F; };
  const float x = place(uv.x(), width), y = place(uv.y(), height);
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int k = 0; k < 4; ++k) {
    const int column = left + k % 2, row = top + k / 2;
    const float fraction = (k % 2 == 0 ? 1 - (x - static_cast<float>(left)) : x - static_cast<float>(left)) *
                           (k / 2 == 0 ? 1 - (y - static_cast<float>(top)) : y - static_cast<float>(top));
    const std::uint8_t* p =
        &rgba[4 * (static_cast<std::size_t>((row + height) % height) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>((column + width) % width))];
    const auto& linear = linearOfByte();
    sum += fraction * Eigen::Array4f(linear[p[0]], linear[p[1]], linear[p[2]], static_cast<float>(p[3]) / 255);
  }
  return sum;
}

SurfaceColours::Look SurfaceColours::at(const RayHit& hit) const {
  const Surface& surface = environment_.surfaces[hit.surface];
  Look look{plain_[hit.surface], surface.colour.a, surface.unlit};
  const Instance& instance = environment_.instances[hit.instance];
  const Mesh& mesh = *environment_.meshes[instance.mesh];
  const bool painted = surface.image >= 0 && static_cast<std::size_t>(surface.image) < pictures_.size() &&
                       !pictures_[static_cast<std::size_t>(surface.image)].rgba.empty() &&
                       !mesh.texture_coordinates.empty();
  if (!painted && mesh.colours.empty()) return look;
  const Triangle& triangle = mesh.triangles[hit.triangle];
  std::array<Eigen::Vector3d, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = instance.world_from_mesh * mesh.positions[triangle[k]].cast<double>();
  const Eigen::Array3f fraction = weightsOf(corner, hit.position).cast<float>();
  Eigen::Array4f paint = Eigen::Array4f::Ones();
  if (painted) {
    Eigen::Vector2f uv = Eigen::Vector2f::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      uv += fraction[static_cast<Eigen::Index>(k)] * mesh.texture_coordinates[triangle[k]];
    paint *= pictures_[static_cast<std::size_t>(surface.image)].at(uv);
  }
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
