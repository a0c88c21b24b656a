// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/rule_matcher.h"

#include <algorithm>

#include "materials/colour.h"

namespace standpoint {

namespace {

constexpr int kNoPattern = -2;

}  // namespace

RuleMatcher::RuleMatcher(std::span<const AssignmentRule> rules) {
  for (const auto& rule : rules)
    rules_.push_back(
        {Pattern(rule.ifc_class), Pattern(rule.material), Pattern(rule.name), Pattern(rule.colour), rule.hidden});
}

const RuleMatcher::Fits& RuleMatcher::fits(Memo& memo, Field field, const std::string& text) {
  const auto [place, is_new] = memo.try_emplace(text);
  if (!is_new) return place->second;
  const auto plain = folded(text);
  for (const auto& rule : rules_) {
    const auto& pattern = rule.*field;
    place->second.push_back(pattern.empty()                     ? kNoPattern
                            : field == &RulePatterns::ifc_class ? fitClass(pattern, text)
                                                                : pattern.fit(plain));
  }
  return place->second;
}

RuleMatcher::Known RuleMatcher::known(const std::string& material_name) {
  if (material_name.empty()) return Known::no;
  const auto& all = fits(materials_, &RulePatterns::material, material_name);
  const auto first = std::find_if(all.begin(), all.end(), [](int glob) { return glob >= 0; });
  if (first == all.end()) return Known::no;
  return rules_[static_cast<std::size_t>(first - all.begin())].hidden ? Known::hidden : Known::visible;
}

// The surface's own name where a rule knows it; else the product's materials, and of layers the outer ones first: what
// lies between them meets no beam. Several materials that are no layers may each be anywhere ("Glass, Sash" of a
// window), so none of them is taken for a surface.
std::string RuleMatcher::knownMaterialName(const Product& product, const Surface& surface) {
  std::vector<const std::string*> candidates{&surface.name};
  if (!product.layers.empty())
    for (const auto* layer : {&product.layers.front(), &product.layers.back()}) candidates.push_back(&layer->name);
  if (!product.layers.empty() || product.materials.size() == 1)
    for (const auto& name : product.materials) candidates.push_back(&name);
  for (const auto wanted : {Known::visible, Known::hidden})
    for (const auto* name : candidates)
      if (known(*name) == wanted) return *name;
  return {};
}

RuleMatcher::Decision RuleMatcher::decide(const Product& product, const Surface& surface) {
  Decision decision;
  decision.text = knownMaterialName(product, surface);
  const auto& by_class = fits(classes_, &RulePatterns::ifc_class, product.ifc_class);
  const auto& by_material = fits(materials_, &RulePatterns::material, decision.text);
  const auto& by_name = fits(names_, &RulePatterns::name, product.name);
  const auto band = colourBand(surface);
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    if (by_class[i] == -1 || by_material[i] == -1 || by_name[i] == -1) continue;
    if (!rules_[i].colour.empty() && (band.empty() || rules_[i].colour.fit(band) < 0)) continue;
    decision.rule = static_cast<std::int32_t>(i);
    decision.generic = rules_[i].material.empty() && rules_[i].name.empty();
    break;
  }
  return decision;
}

std::string RuleMatcher::reason(const Decision& decision, const Product& product) {
  const auto index = static_cast<std::size_t>(decision.rule);
  const auto& rule = rules_[index];
  std::string text;
  const auto add = [&](const char* what, const Pattern& pattern, int glob) {
    if (glob >= 0) text += (text.empty() ? ": " : ", ") + std::string(what) + ' ' + pattern.glob(glob);
  };
  add("class", rule.ifc_class, fits(classes_, &RulePatterns::ifc_class, product.ifc_class)[index]);
  add("material", rule.material, fits(materials_, &RulePatterns::material, decision.text)[index]);
  add("name", rule.name, fits(names_, &RulePatterns::name, product.name)[index]);
  return "rule /" + std::to_string(index) + text;
}

}  // namespace standpoint
