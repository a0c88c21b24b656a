// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/set_scans.h"

#include <fmt/format.h>

#include "core/random.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kSeedBits = (std::uint64_t{1} << 53U) - 1;  // what a job file can say

}  // namespace

std::vector<SetPlace> placesOf(const Recipe& recipe) {
  std::vector<SetPlace> places;
  for (std::size_t e = 0; e < recipe.environments.size(); ++e) {
    const auto& strategies = recipe.environments[e].stations;
    for (std::size_t s = 0; s < strategies.size(); ++s)
      for (std::size_t k = 0; k < strategies[s].count; ++k)
        places.push_back({e, s, k, fmt::format("{}-{}", strategies[s].id, k + 1)});
  }
  return places;
}

std::vector<SetPlace> placesOf(const Recipe& recipe, const Shard& shard) {
  const auto all = placesOf(recipe);
  const auto edge = [&](unsigned k) {
    return all.begin() + static_cast<std::ptrdiff_t>(all.size() * std::size_t{k} / shard.count);
  };
  return {edge(shard.index - 1), edge(shard.index)};
}

// Materials are the outermost: what beams meet is made once for each.
std::vector<SetVariant> variantsOf(const Recipe& recipe) {
  std::vector<SetVariant> variants;
  for (std::size_t m = 0; m < recipe.materials.size(); ++m)
    for (std::size_t i = 0; i < recipe.instruments.size(); ++i)
      for (std::size_t w = 0; w < recipe.weather.size(); ++w)
        for (std::size_t f = 0; f < recipe.field_faults.size(); ++f)
          for (std::size_t s = 0; s < recipe.seeds.size(); ++s)
            for (std::size_t e = 0; e < recipe.effects.size(); ++e) variants.push_back({m, i, w, f, s, e});
  return variants;
}

std::string nameOf(const Recipe& recipe, const SetVariant& v) {
  return fmt::format("{}_{}_{}_{}_{}_{}", recipe.instruments[v.instrument].id, recipe.weather[v.weather].id,
                     recipe.materials[v.materials].id, recipe.field_faults[v.fault].id, recipe.seeds[v.seed],
                     recipe.effects[v.effects].id);
}

std::uint64_t seedOf(const Recipe& recipe, const SetPlace& place, const SetVariant& v) {
  const auto text =
      fmt::format("{} {} {} {} {} {} {} {}", recipe.seed, recipe.environments[place.environment].id, place.station,
                  recipe.instruments[v.instrument].id, recipe.weather[v.weather].id, recipe.materials[v.materials].id,
                  recipe.field_faults[v.fault].id, recipe.seeds[v.seed]);
  return stableHash(text.c_str()) & kSeedBits;
}

SetFiles filesOf(const Recipe& recipe, const SetPlace& place, const SetVariant& variant) {
  SetFiles files;
  const auto folder = std::filesystem::path(recipe.environments[place.environment].id) / place.station;
  const auto name = nameOf(recipe, variant);
  files.scan = (folder / name).generic_string();
  files.cloud = "scans" / folder / (name + recipe.extension());
  files.instances = "labels" / folder / (name + ".instances.npy");
  files.record = "records" / folder / (name + ".json");
  for (const auto& map : recipe.classes) files.labels.push_back("labels" / folder / (name + "." + map.id + ".npy"));
  return files;
}

std::filesystem::path environmentFile(const RecipeEnvironment& environment) {
  return std::filesystem::path("environments") / (environment.id + ".json");
}

std::filesystem::path pictureFile(const RecipeEnvironment& environment) {
  return std::filesystem::path("environments") / (environment.id + ".svg");
}

}  // namespace standpoint
