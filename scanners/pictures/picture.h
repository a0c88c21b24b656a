// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint {

// An image of an environment, decoded.
class Picture {
 public:
  // Empty where it cannot be decoded, or is larger than 16384 pixels on a side.
  explicit Picture(const Image& image);
  bool empty() const { return rgba_.empty(); }
  // Linear colour and opacity, bilinear, repeated beyond 0..1. The same bits on every processor.
  Eigen::Array4f at(const Eigen::Vector2f& uv) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> rgba_;
};

// Linear light of an sRGB byte.
const std::array<float, 256>& linearOfByte();

// Shares of a triangle's corners at a point of its plane; the first corner alone where it has no area.
Eigen::Array3d cornerWeights(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& point);
// Where the texture is at a point of a triangle of the mesh, which has texture coordinates.
Eigen::Vector2f texturePlace(const Mesh& mesh, std::uint32_t triangle, const Eigen::Array3f& weights);

}  // namespace standpoint
