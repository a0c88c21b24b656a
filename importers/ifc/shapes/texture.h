// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "importers/ifc/model/texture_maps.h"

namespace standpoint::ifc {

struct Model;

// Where on the picture a texture coordinate lies: (0, 0) is its upper left corner; the texture's own transformation is
// applied.
Eigen::Vector2d onPicture(const Eigen::Vector2d& st, const Entity& texture);

// Corners of a textured face in metres, in the frame of its items, and what of the picture lies on each; (0, 0) is the
// picture's upper left corner, and the texture's own transformation is applied.
struct TexturedFace {
  std::vector<Eigen::Vector3d> corners;
  std::vector<Eigen::Vector2d> coordinates;

  // Of a point on the face: a corner's own, else by the affine map that three corners make; nothing off its plane.
  std::optional<Eigen::Vector2d> at(const Eigen::Vector3d& p) const;
};

// A face set (or face) and its coordinates, read once for all of its faces.
class TexturedItem {
 public:
  TexturedItem(const TextureMaps::Source& source, const Entity& texture, const Model& model);
  TexturedFace face(std::size_t number) const;  // no corners where the map and the face do not fit each other

 private:
  using Indices = std::vector<std::uint32_t>;
  void readFaceSet(const Entity& face_set, const Entity& map, const Model& model);
  void readFace(const Entity& face, const Entity& map, const Model& model);

  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector2d> coordinates_;
  std::vector<Indices> corners_, on_;  // per face
};

}  // namespace standpoint::ifc
