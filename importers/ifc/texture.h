// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "importers/ifc/step_file.h"

namespace standpoint::ifc {

struct Model;

// Which faces have texture coordinates (IfcIndexedTriangleTextureMap, IfcIndexedPolygonalTextureMap, IfcTextureMap).
// Such a face has a tag of its own, which triangulation and Booleans carry along; the coordinates are looked up
// afterwards.
class TextureMaps {
 public:
  explicit TextureMaps(const StepFile& file);

  static constexpr std::uint32_t kFirstTag = 0x80000000U, kEndOfTags = 0xB0000000U;
  static bool isTextured(std::uint32_t tag) { return tag >= kFirstTag && tag < kEndOfTags; }

  // The tag of a face set's first face, or of a face; 0 when it has no texture coordinates.
  std::uint32_t firstTag(Id face_set_or_face) const;

  struct Source {
    Id item = 0;           // the face set or face
    Id map = 0;            // IfcTextureCoordinate
    std::size_t face = 0;  // number in the face set
  };
  Source source(std::uint32_t tag) const;

 private:
  struct Range {
    std::uint32_t first = 0;
    std::size_t count = 0;
    Id item = 0, map = 0;
  };
  std::vector<Range> ranges_;  // by rising `first`
  std::map<Id, std::size_t> of_item_;
};

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
