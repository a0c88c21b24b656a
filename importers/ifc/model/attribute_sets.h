// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace standpoint::ifc {

// Sets whose properties are the attributes of an entity: which attribute, what it is called, what it measures.
struct SetAttribute {
  int index;
  const char* name;
  const char* measure = "";  // "" where the number has no unit
};
struct AttributeSet {
  const char* entity;
  std::span<const SetAttribute> attributes;
};

// nullptr for other entities.
const AttributeSet* attributeSet(std::string_view upper_case_name);

}  // namespace standpoint::ifc
