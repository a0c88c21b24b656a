// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/environment.h"
#include "materials/materials.h"
#include "materials/pattern.h"

namespace standpoint {

// Which rule decides for a surface of a product. Names repeat a thousandfold in a building, so what fits is kept per
// distinct name; a product then costs one look per rule.
class RuleMatcher {
 public:
  explicit RuleMatcher(std::span<const AssignmentRule> rules);

  struct Decision {
    std::int32_t rule = -1;   // -1: none fits
    std::string text;         // the material's name that the rules were asked with; "" when no rule knows any name
    bool generic = false;     // only class or colour decided
  };
  Decision decide(const Product& product, const Surface& surface);

  // "rule /17: material *beton*", for people who look into the file; `text` as in the decision.
  std::string reason(const Decision& decision, const Product& product);

 private:
  struct RulePatterns {
    Pattern ifc_class, material, name, colour;
    bool hidden;
  };
  using Field = Pattern RulePatterns::*;
  using Fits = std::vector<int>;  // per rule: the glob that fits, -1 when none, kNoPattern when the rule does not ask
  using Memo = std::map<std::string, Fits, std::less<>>;

  const Fits& fits(Memo& memo, Field field, const std::string& text);
  // By the first rule that asks for a material and fits the name.
  enum class Known { no, hidden, visible };
  Known known(const std::string& material_name);
  std::string knownMaterialName(const Product& product, const Surface& surface);

  std::vector<RulePatterns> rules_;
  Memo classes_, materials_, names_;
};

}  // namespace standpoint
