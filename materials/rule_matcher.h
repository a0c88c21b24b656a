// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
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
  explicit RuleMatcher(const RuleSet& set);
  RuleMatcher(const RuleMatcher&) = delete;
  RuleMatcher& operator=(const RuleMatcher&) = delete;

  // Where the name of the material that decided comes from.
  enum class Named { surface, product, type, name };
  struct Decision {
    std::int32_t rule = -1;  // -1: none fits
    std::string text;        // the material's name that the rules were asked with; "" when no rule knows any name
    Named named = Named::surface;
    double confidence = 0;
  };
  // `by_names`: the names of the product and its type may say what it is made of, where nothing better does.
  Decision decide(const Product& product, const Surface& surface, bool by_names = true);

  // "material 'Stahlbeton' (*beton*), rule 17 of default.json", for people; `text` as in the decision.
  std::string reason(const Decision& decision, const Product& product, const Surface& surface);

 private:
  struct RulePatterns {
    Pattern ifc_class, material, name, type, storey, group, layer, colour;
  };
  using Field = Pattern RulePatterns::*;
  using Memo =
      std::map<std::string, std::vector<bool>, std::less<>>;  // by name: for each rule, whether it lets that pass

  const std::vector<bool>& passes(Memo& memo, Field field, const std::string& text);
  bool asks(Field field) const;
  bool passesGroups(std::size_t rule, const Product& product);
  bool passesLayers(std::size_t rule, const Product& product);
  // By the first rule that asks for a material and fits the name.
  enum class Known { no, hidden, visible };
  Known known(const std::string& material_name);
  Decision knownMaterial(const Product& product, const Surface& surface, bool by_names);

  const RuleSet& set_;
  WordTable words_;
  std::vector<RulePatterns> patterns_;
  std::vector<bool> all_pass_;  // for what no rule asks of
  bool asks_name_ = false, asks_type_ = false;
  Memo classes_, materials_, names_, types_, storeys_, groups_, layers_;
  std::map<std::string, Known, std::less<>> known_;
};

}  // namespace standpoint
