// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/result.h"
#include "optimizer/optimizer.h"

namespace standpoint {

// What a level of detail says of some products. All its conditions must hold; the first rule that fits decides.
struct LodRule {
  std::string reason;                    // "fasteners and fittings", as reports print it
  std::vector<std::string> products;     // selectors, of which one must fit; empty = every product
  std::optional<double> smaller_than_m;  // the diagonal of its box
  std::optional<double> thinner_than_m;  // the middle one of its box's edges: the diameter of a pipe along an axis
  std::optional<double>
      sees_sky_less_than;  // of the rays from its surface towards the sky this share gets there (visibility.h)
  bool drop = false;
  bool keep = false;
  std::optional<double> max_deviation_m;  // else that of the level
  double weight = 1;
};

// The rules of one part of the environment: the building that is scanned, or what stands around it.
struct LodLevel {
  std::string part;          // "main" or "surroundings"
  std::string level;         // "LoD 300"
  std::uint64_t budget = 0;  // placed triangles
  double max_deviation_m = 0;
  bool hidden_faces = false;  // triangles that cannot be seen from anywhere go; main only, for the whole environment
  std::optional<double>
      farther_than_m;  // surroundings only: what lies further than this from the main part's products …
  std::vector<std::string> products;  // … and what these selectors mean
  std::vector<LodRule> rules;
};

// optimizer/lod/default.json and files like it: a list of two levels, one for each part. An unknown key, a value out of
// range or an empty selector is an error with file and JSON pointer.
Result<std::vector<LodLevel>> readLodRules(const std::filesystem::path& file);

// Options for optimize(): an allowance for each product. `surroundings` are the author's own selectors, beside those of
// the file; `budget` replaces that of the main part.
struct LodChoice {
  std::optional<std::uint64_t> budget;
  std::vector<std::string> surroundings;
};
OptimizeOptions allowances(const Environment& environment, const std::vector<LodLevel>& levels,
                           const LodChoice& choice);

}  // namespace standpoint
