// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/shape_aspect.h"

namespace standpoint::ifc {

ShapeAspects::ShapeAspects(const StepFile& file) {
  if (file.all("IFCMATERIALCONSTITUENT").empty()) return;  // then nothing depends on the names
  for (const Entity& aspect : file.all("IFCSHAPEASPECT"))
    for (const Entity& representation : aspect.refs(0))
      for (const Entity& item : representation.refs(3)) {
        const auto tag = kFirstTag + static_cast<std::uint32_t>(parts_.size());
        if (tag >= kEndOfTags || !tag_of_item_.emplace(item.id(), tag).second) continue;
        parts_.push_back({item.id(), aspect[1].text()});
      }
}

std::uint32_t ShapeAspects::tagOf(const Entity& item) const {
  const auto it = tag_of_item_.find(item.id());
  return it == tag_of_item_.end() ? 0 : it->second;
}

}  // namespace standpoint::ifc
