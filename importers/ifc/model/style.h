// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

struct Style {
  std::string name;
  Colour colour;
  std::optional<float> index_of_refraction;
  Id texture = 0;  // the first IfcSurfaceTexture of its IfcSurfaceStyleWithTextures
};

// A face's tag is the id of the style it has; faces with texture coordinates have tags of TextureMaps, faces of an
// indexed colour map have tags from kFirstColour on.
constexpr std::uint32_t kNoStyle = 0;
constexpr std::uint32_t kFirstColour = 0xC0000000U;

// For each record the tag that its faces get: the IfcSurfaceStyle (its id) of an IfcStyledItem, else that of the
// presentation layer it lies on; of an IfcFace with texture coordinates its texture's.
std::vector<Id> stylesOfItems(const StepFile& file, const TextureMaps& textures);
// IfcTessellatedFaceSet → IfcIndexedColourMap.
std::map<Id, Id> colourMaps(const StepFile& file);
// The first surface style of an IfcStyledItem; 0 when it has none.
Id surfaceStyleOf(const Entity& styled_item);
// Of an item; a Boolean result is coloured by its own style or by its first operand's.
std::uint32_t styleOf(Entity item, const Model& model);
// Of a tag; nothing when it is no style.
std::optional<Style> styleOfTag(const StepFile& file, std::uint32_t tag);

// The tags of a tessellated face set's faces, from its IfcIndexedColourMap: 24 bits of colour, 5 of opacity.
class FaceColours {
 public:
  FaceColours(const Entity& face_set, const Model& model);
  std::uint32_t tag(std::size_t face) const { return face < tags_.size() ? tags_[face] : kNoStyle; }

 private:
  std::vector<std::uint32_t> tags_;
};

}  // namespace standpoint::ifc
