// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace standpoint {

// The classes of a labelled set, and which of them a product's IFC class is. Data: pointclouds/classes/*.json.
struct ClassMap {
  struct Class {
    std::string name;
    std::uint32_t id = 0;
  };
  struct Rule {
    std::string ifc_class;                  // or how it begins
    std::array<std::size_t, 2> of_point{};  // of a point below and above the scanner: a slab is a floor or a ceiling
  };
  std::string name;
  std::vector<Class> classes;
  std::vector<Rule> rules;
  std::size_t unknown = 0, noise = 0;  // of every other product, and of a point without a surface

  // Below and above the scanner; the rule with the longest beginning holds.
  std::array<std::size_t, 2> classesOf(std::string_view ifc_class) const;
};

// An unknown key, a class that is not in the list, an id above 65535 are errors with their place.
Result<ClassMap> readClassMap(const std::filesystem::path& file);

}  // namespace standpoint
