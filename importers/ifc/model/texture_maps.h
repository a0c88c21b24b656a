// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {

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

}  // namespace standpoint::ifc
