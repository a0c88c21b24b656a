// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/points.h"
#include "core/result.h"

namespace standpoint {

// The classes of a labelled set, and which of them a product's IFC class is. Data: pointclouds/classes/*.json.
struct ClassMap {
  struct Class {
    std::string name;
    std::uint32_t id = 0;
    bool ignored = false;  // not trained on and not scored
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
  bool hasRuleFor(std::string_view ifc_class) const;
  std::optional<std::size_t> withId(std::uint32_t id) const;  // index of the class
};

// The classes of the points of one scan. `map` must outlive it.
class PointClasses {
 public:
  PointClasses(const ClassMap& map, const ScanHeader& header);
  // Index into the map's classes.
  std::size_t of(const PointBlock& block, std::size_t point) const {
    return isSurfaceless(block, point) ? map_.noise : class_of_product_[block.product[point]][block.z_m[point] > 0];
  }
  // A drop, a flake, or the receiver's noise: no product returned it.
  bool isSurfaceless(const PointBlock& block, std::size_t point) const {
    return has_truth_ && (block.truth.flags[point] & (point_flag::kNoise | point_flag::kWeather)) != 0;
  }

 private:
  const ClassMap& map_;
  bool has_truth_;
  std::vector<std::array<std::size_t, 2>> class_of_product_;
};

// The shipped map of that name ("s3dis"), or that of a file, which ends in .json.
Result<ClassMap> classMapNamed(const std::string& name_or_file);
std::vector<std::string> shippedClassMaps();  // names, sorted
std::filesystem::path shippedClassMap(const std::string& name);

// An unknown key, a class that is not in the list, an id above 65535 are errors with their place.
Result<ClassMap> readClassMap(const std::filesystem::path& file);

}  // namespace standpoint
