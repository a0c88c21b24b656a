// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {

// Parts of a shape that have a name (IfcShapeAspect), so that the constituent of that name is what they are made of.
// The faces of such an item have a tag that stands for the item; its style is looked up afterwards.
class ShapeAspects {
 public:
  explicit ShapeAspects(const StepFile& file);

  static constexpr std::uint32_t kFirstTag = 0xB0000000U, kEndOfTags = 0xC0000000U;
  static bool isAspect(std::uint32_t tag) { return tag >= kFirstTag && tag < kEndOfTags; }

  std::uint32_t tagOf(const Entity& item) const;  // 0: the item is no named part
  Id item(std::uint32_t tag) const { return parts_[tag - kFirstTag].item; }
  const std::string& name(std::uint32_t tag) const { return parts_[tag - kFirstTag].name; }

 private:
  struct Part {
    Id item = 0;
    std::string name;
  };
  std::vector<Part> parts_;
  std::map<Id, std::uint32_t> tag_of_item_;
};

}  // namespace standpoint::ifc
