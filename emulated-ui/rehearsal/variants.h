// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/result.h"

namespace standpoint {

// An exercise may leave figures open, so that each student gets others:
//   "variants": {"tilt": {"from": 3, "to": 5.5, "step": 0.1}, "resolution": {"choices": ["1/20", "1/16"]}}
// and says "${tilt}" where they belong. A text that is a figure's place and nothing else becomes its number.
struct VariantFigure {
  std::string name;
  std::vector<nlohmann::json> values;  // in their order; the first is the standard. Numbers or texts.
};
using Figures = std::map<std::string, nlohmann::json>;

// Of the whole exercise as its file has it; none where it has no "variants".
Result<std::vector<VariantFigure>> variantFigures(const nlohmann::json& exercise, const std::string& file_name);
Figures standardFigures(const std::vector<VariantFigure>& figures);
// The same for the same seed on every computer: each figure is drawn by its name, so that a new one changes no other.
Figures drawnFigures(const std::vector<VariantFigure>& figures, std::uint64_t seed);
// How many variants there can be, at most a million.
std::size_t countVariants(const std::vector<VariantFigure>& figures);
// The names of the places of figures in a text.
std::set<std::string> figuresIn(const std::string& text);
// The exercise with its figures in it and without "variants". A place without a figure is an error with its pointer.
Result<nlohmann::json> withFigures(const nlohmann::json& exercise, const Figures& figures,
                                   const std::string& file_name);

}  // namespace standpoint
