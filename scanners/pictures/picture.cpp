// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/pictures/picture.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Geometry>
#include <stb/stb_image.h>

#include "core/portable_math.h"

namespace standpoint {

namespace {

constexpr int kLargestSide = 16384;

}  // namespace

const std::array<float, 256>& linearOfByte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double srgb = static_cast<double>(i) / 255;
      t[i] = static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : portable::pow((srgb + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table;
}

Picture::Picture(const Image& image) {
  const auto* bytes = reinterpret_cast<const stbi_uc*>(image.bytes.data());
  const int size = static_cast<int>(std::min(image.bytes.size(), std::size_t{1} << 30U));
  int width = 0, height = 0, channels = 0;
  const bool known = stbi_info_from_memory(bytes, size, &width, &height, &channels) != 0 && width <= kLargestSide &&
                     height <= kLargestSide;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      known ? stbi_load_from_memory(bytes, size, &width, &height, &channels, 4) : nullptr, stbi_image_free);
  if (!pixels) return;
  width_ = width, height_ = height;
  rgba_.assign(pixels.get(),
               pixels.get() + std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

Eigen::Array4f Picture::at(const Eigen::Vector2f& uv) const {
  const auto place = [](float t, int size) { return (t - std::floor(t)) * static_cast<float>(size) - 0.5F; };
  const float x = place(uv.x(), width_), y = place(uv.y(), height_);
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int k = 0; k < 4; ++k) {
    const int column = left + k % 2, row = top + k / 2;
    const float fraction = (k % 2 == 0 ? 1 - (x - static_cast<float>(left)) : x - static_cast<float>(left)) *
                           (k / 2 == 0 ? 1 - (y - static_cast<float>(top)) : y - static_cast<float>(top));
    const std::uint8_t* p =
        &rgba_[4 * (static_cast<std::size_t>((row + height_) % height_) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>((column + width_) % width_))];
    const auto& linear = linearOfByte();
    sum += fraction * Eigen::Array4f(linear[p[0]], linear[p[1]], linear[p[2]], static_cast<float>(p[3]) / 255);
  }
  return sum;
}

Eigen::Array3d cornerWeights(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& point) {
  const Eigen::Vector3d u = corner[1] - corner[0], v = corner[2] - corner[0], w = point - corner[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v), d = uu * vv - uv * uv;
  if (!(d > 0)) return {1, 0, 0};
  const double b = (vv * wu - uv * wv) / d, c = (uu * wv - uv * wu) / d;
  return {1 - b - c, b, c};
}

Eigen::Vector2f texturePlace(const Mesh& mesh, std::uint32_t triangle, const Eigen::Array3f& weights) {
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    uv += weights[static_cast<Eigen::Index>(k)] * mesh.texture_coordinates[mesh.triangles[triangle][k]];
  return uv;
}

}  // namespace standpoint
