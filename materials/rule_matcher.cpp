// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/rule_matcher.h"

#include <algorithm>

#include <fmt/format.h>

#include "materials/colour.h"

namespace standpoint {

namespace {

// A type's name tells of the whole product ("Basic wall: brick 240"), not of this surface: it makes a weak rule at best.
constexpr double kByType = 0.5;

bool within(const std::optional<ValueRange>& range, const std::optional<float>& value) {
  return !range || (value && *value >= range->from && *value <= range->to);
}

}  // namespace

RuleMatcher::RuleMatcher(const RuleSet& set) : set_(set), words_(set.words) {
  for (const auto& rule : set.rules) {
    const auto pattern = [&](const std::string& text) { return Pattern(text, words_); };
    patterns_.push_back({pattern(rule.ifc_class), pattern(rule.material), pattern(rule.name), pattern(rule.type),
                         pattern(rule.storey), pattern(rule.group), pattern(rule.colour)});
  }
}

const std::vector<bool>& RuleMatcher::passes(Memo& memo, Field field, const std::string& text) {
  const auto [place, is_new] = memo.try_emplace(text);
  if (!is_new) return place->second;
  Folded plain(text, words_);
  place->second.reserve(patterns_.size());
  for (const auto& rule : patterns_) {
    const auto& pattern = rule.*field;
    place->second.push_back(pattern.empty() || (field == &RulePatterns::ifc_class ? fitClass(pattern, text) >= 0 : pattern.fit(plain) >= 0));
  }
  return place->second;
}

RuleMatcher::Known RuleMatcher::known(const std::string& name) {
  if (name.empty()) return Known::no;
  const auto [place, is_new] = known_.try_emplace(name, Known::no);
  if (!is_new) return place->second;
  const auto& fits = passes(materials_, &RulePatterns::material, name);
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits[i] && !patterns_[i].material.empty()) {
      place->second = set_.rules[i].hidden ? Known::hidden : Known::visible;
      break;
    }
  return place->second;
}

// The surface's own name where a rule knows it; else the product's materials, and of layers the outer ones first: what
// lies between them meets no beam. Several materials that are no layers may each be anywhere ("Glass, Sash" of a
// window), so none of them is taken for a surface. Last the type's name, but not for a pane.
RuleMatcher::Decision RuleMatcher::knownMaterial(const Product& product, const Surface& surface, std::string_view band) {
  std::vector<std::pair<const std::string*, Named>> candidates{{&surface.name, Named::surface}};
  if (!product.layers.empty())
    for (const auto* layer : {&product.layers.front(), &product.layers.back()}) candidates.emplace_back(&layer->name, Named::product);
  if (!product.layers.empty() || product.materials.size() == 1)
    for (const auto& name : product.materials) candidates.emplace_back(&name, Named::product);
  Decision decision;
  for (const auto wanted : {Known::visible, Known::hidden})
    for (const auto& [name, named] : candidates)
      if (known(*name) == wanted) {
        decision.text = *name;
        decision.named = named;
        return decision;
      }
  if (band != "transparent" && product.materials.size() <= 1 && known(product.type_name) == Known::visible) {
    decision.text = product.type_name;
    decision.named = Named::type;
  }
  return decision;
}

bool RuleMatcher::passesGroups(std::size_t rule, const Product& product) {
  if (patterns_[rule].group.empty()) return true;
  return std::any_of(product.groups.begin(), product.groups.end(),
                     [&](const std::string& group) { return passes(groups_, &RulePatterns::group, group)[rule]; });
}

RuleMatcher::Decision RuleMatcher::decide(const Product& product, const Surface& surface) {
  const auto band = colourBand(surface);
  auto decision = knownMaterial(product, surface, band);
  const auto& by_class = passes(classes_, &RulePatterns::ifc_class, product.ifc_class);
  const auto& by_material = passes(materials_, &RulePatterns::material, decision.text);
  const auto& by_name = passes(names_, &RulePatterns::name, product.name);
  const auto& by_type = passes(types_, &RulePatterns::type, product.type_name);
  const auto& by_storey = passes(storeys_, &RulePatterns::storey, product.storey);
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    if (!by_class[i] || !by_material[i] || !by_name[i] || !by_type[i] || !by_storey[i] || !passesGroups(i, product)) continue;
    const auto& rule = set_.rules[i];
    if (!rule.colour.empty() && (band.empty() || patterns_[i].colour.fit(band) < 0)) continue;
    if (!within(rule.metallic, surface.metallic) || !within(rule.roughness, surface.roughness) || !within(rule.transmission, surface.transmission)) continue;
    decision.rule = static_cast<std::int32_t>(i);
    decision.confidence = rule.confidence * (decision.named == Named::type && !rule.material.empty() ? kByType : 1);
    break;
  }
  return decision;
}

std::string RuleMatcher::reason(const Decision& decision, const Product& product, const Surface& surface) {
  const auto index = static_cast<std::size_t>(decision.rule);
  const auto& patterns = patterns_[index];
  const auto& rule = set_.rules[index];
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  const auto found = [&](const Pattern& pattern, const std::string& name) {
    Folded plain(name, words_);
    return pattern.found(std::max(0, pattern.fit(plain)), plain);
  };
  if (!rule.material.empty()) {
    constexpr const char* kFrom[] = {"material", "the product's material", "type"};
    add(fmt::format("{} '{}' ({})", kFrom[static_cast<int>(decision.named)], decision.text, found(patterns.material, decision.text)));
  }
  if (!rule.ifc_class.empty()) add("class " + product.ifc_class);
  if (!rule.name.empty()) add(fmt::format("name '{}' ({})", product.name, found(patterns.name, product.name)));
  if (!rule.type.empty()) add(fmt::format("type '{}' ({})", product.type_name, found(patterns.type, product.type_name)));
  if (!rule.storey.empty()) add("storey '" + product.storey + "'");
  if (!rule.group.empty()) add("group " + rule.group);
  if (!rule.colour.empty()) {
    std::string colour = "colour " + std::string(colourBand(surface));
    if (isTransparent(surface) && !isTransparent(surface.colour)) {
      colour += fmt::format(" (transmission {:.2f}", *surface.transmission);
      if (surface.index_of_refraction) colour += fmt::format(", index of refraction {:.2f}", *surface.index_of_refraction);
      colour += ")";
    }
    add(colour);
  }
  for (const auto& [range, name, value] : {std::tuple{&rule.metallic, "metallic", &surface.metallic}, {&rule.roughness, "roughness", &surface.roughness},
                                           {&rule.transmission, "transmission", &surface.transmission}})
    if (*range) add(fmt::format("{} {:.2f}", name, value->value_or(0)));
  return text + ", " + (rule.place.empty() ? "rule " + std::to_string(index) : rule.place);
}

}  // namespace standpoint
