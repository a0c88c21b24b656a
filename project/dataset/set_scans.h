// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "project/dataset/recipe.h"

namespace standpoint {

// A place of a strategy in an environment: what shards are made of, so that a task builds few ray scenes.
struct SetPlace {
  std::size_t environment = 0, strategy = 0, number = 0;  // indices; `number` within the strategy
  std::string station;                                    // "greedy-1", or the name that a project has
};
// All of a recipe in the order of its environments, whether a tripod can stand there or not: no model is needed.
std::vector<SetPlace> placesOf(const Recipe& recipe);
// Those of one shard: places that follow each other, in shares that differ by no more than one.
std::vector<SetPlace> placesOf(const Recipe& recipe, const Shard& shard);

// What is done at each place: one entry of each axis.
struct SetVariant {
  std::size_t materials = 0, instrument = 0, weather = 0, fault = 0, seed = 0, effects = 0;  // indices
};
std::vector<SetVariant> variantsOf(const Recipe& recipe);
// "rtc360_clear_assigned_none_1_noisy": ids hold no underscore.
std::string nameOf(const Recipe& recipe, const SetVariant& variant);

// The seed of a scan comes from what it is, never from when it is made; what differs in effects alone shares it.
std::uint64_t seedOf(const Recipe& recipe, const SetPlace& place, const SetVariant& variant);

// Where a set keeps what, from its folder on.
struct SetFiles {
  std::string scan;  // "house/greedy-1/rtc360_…": what it is called
  std::filesystem::path cloud, instances, record;
  std::vector<std::filesystem::path> labels;  // of each map of classes
};
SetFiles filesOf(const Recipe& recipe, const SetPlace& place, const SetVariant& variant);
std::filesystem::path environmentFile(const RecipeEnvironment& environment);
std::filesystem::path pictureFile(const RecipeEnvironment& environment);  // its plans

}  // namespace standpoint
