// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "pointclouds/datasets/class_map.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

// Where stations are looked for in an environment. Each place of a strategy has a number, whether a tripod can stand
// there or not, so that shares of a recipe can be counted without its models.
struct StationStrategy {
  enum class Kind {
    greedy,   // where the next one adds most to what is seen
    grid,     // every so many metres on what is made for standing
    route,    // every so many metres of a way
    places,   // as listed
    project,  // those of the project, by name
  };
  std::string id;  // stations are ID-1, ID-2, …
  Kind kind = Kind::greedy;
  std::size_t count = 0;            // places; of a grid at most so many
  double spacing_m = 0;             // grid and route
  std::vector<FloorPlace> through;  // route, or the places themselves; the model's file frame
  std::vector<std::string> names;   // project
  std::optional<double> height_m;   // of the instrument's centre above the floor
  double levelling_error_deg = 0;   // each station leans by as much at most
};

// One every so many metres of the way, from its beginning on.
std::vector<FloorPlace> routePlaces(const StationStrategy& route);

struct RecipeEnvironment {
  std::string id, building;
  std::filesystem::path model, project;  // one of them
  std::string license;                   // of the model, as an SPDX id or a text
  std::vector<StationStrategy> stations;
};

// One entry of an axis each. The ids of all axes name a scan.
struct RecipeInstrument {
  std::string id, instrument;
  KeyValues settings;
};
struct RecipeWeather {
  std::string id;
  std::optional<Weather> weather;
  std::optional<Sun> sun;
  double interference = 0;
};
struct RecipeMaterials {
  std::string id;
  std::filesystem::path rules;
  std::vector<std::string> assign;  // SELECTOR=MATERIAL
};
struct RecipeFault {
  std::string id;
  FieldFault fault;
};
struct RecipeEffects {  // scans that differ in these alone share all random numbers: they are pairs
  std::string id;
  bool ideal = false;
  std::optional<Effects> without;
};
struct RecipeSplit {
  std::string name;  // "train", "validation", "test"
  std::vector<std::string> buildings;
};
struct RecipeClasses {
  std::string id;  // of the file's name: "s3dis"
  ClassMap map;
  std::string text;  // the file
};

// A set of labelled scans: every station of every environment, with every combination of the axes.
struct Recipe {
  std::string name, description, license, creator, date, url, version;
  std::uint64_t seed = 1;
  std::vector<RecipeEnvironment> environments;
  std::vector<RecipeInstrument> instruments;
  std::vector<RecipeWeather> weather;
  std::vector<RecipeMaterials> materials;
  std::vector<RecipeFault> field_faults;
  std::vector<RecipeEffects> effects;
  std::vector<std::uint64_t> seeds;
  std::vector<RecipeSplit> splits;
  std::vector<RecipeClasses> classes;
  double starved_below = 0.005;  // share of a split's points under which a class is starved
  std::string format = "e57", as;
  bool truth = true;
  ScanQuality quality = ScanQuality::standard;
  std::string text;  // the file, as it is kept in the set

  const std::string& splitOf(const RecipeEnvironment& environment) const;
  std::string extension() const;  // of the clouds: ".e57"
};

// Reads and checks all that can be checked without a model: keys, ids, instruments and their settings, weather, faults,
// effects, classes, and that each building is in one split. Paths are taken from the recipe's folder. An error names
// file and place.
Result<Recipe> readRecipe(const std::filesystem::path& file);
// Of a set: its models and classes need not be there any more; the latter are read from `classes`.
Result<Recipe> readRecipeOfSet(const std::filesystem::path& set);

}  // namespace standpoint
