// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/rule_matcher.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/presentation_layers.h"
#include "materials/colour.h"

namespace standpoint {

namespace {

// A type's name tells of the whole product ("Basic wall: brick 240"), not of this surface: it makes a weak rule at
// best. The product's own name ("Tree 3") as much again less.
constexpr double kByNamed[] = {1, 1, 0.5, 0.4};

// "Baum:352583" is the 352583rd thing called Baum: the number says nothing of what it is made of.
std::string withoutNumber(const std::string& name) {
  const auto last = name.find_last_not_of("0123456789");
  if (last == std::string::npos || last + 1 == name.size() ||
      std::string_view(" :-_.#").find(name[last]) == std::string_view::npos)
    return name;
  return name.substr(0, last);
}

bool within(const std::optional<ValueRange>& range, const std::optional<float>& value) {
  return !range || (value && *value >= range->from && *value <= range->to);
}

}  // namespace

RuleMatcher::RuleMatcher(const RuleSet& set) : set_(set), words_(set.words) {
  for (const auto& rule : set.rules) {
    const auto pattern = [&](const std::string& text) { return Pattern(text, words_); };
    patterns_.push_back({pattern(rule.ifc_class), pattern(rule.material), pattern(rule.name), pattern(rule.type),
                         pattern(rule.storey), pattern(rule.group), pattern(rule.layer), pattern(rule.colour)});
  }
  all_pass_.assign(patterns_.size(), true);
  asks_name_ = asks(&RulePatterns::name);
  asks_type_ = asks(&RulePatterns::type);
}

bool RuleMatcher::asks(Field field) const {
  return std::any_of(patterns_.begin(), patterns_.end(),
                     [&](const RulePatterns& rule) { return !(rule.*field).empty(); });
}

const std::vector<bool>& RuleMatcher::passes(Memo& memo, Field field, const std::string& text) {
  const auto [place, is_new] = memo.try_emplace(text);
  if (!is_new) return place->second;
  Folded plain(text, words_);
  place->second.reserve(patterns_.size());
  for (const auto& rule : patterns_) {
    const auto& pattern = rule.*field;
    place->second.push_back(pattern.empty() || (field == &RulePatterns::ifc_class ? fitClass(pattern, text) >= 0
                                                                                  : pattern.fit(plain) >= 0));
  }
  return place->second;
}

RuleMatcher::Known RuleMatcher::known(const std::string& name) {
  if (name.empty()) return Known::no;
  const auto [place, is_new] = known_.try_emplace(name, Known::no);
  if (!is_new) return place->second;
  Folded text(name, words_);
  for (std::size_t i = 0; i < patterns_.size(); ++i)
    if (!patterns_[i].material.empty() && patterns_[i].material.fit(text) >= 0) {
      place->second = set_.rules[i].hidden ? Known::hidden : Known::visible;
      break;
    }
  return place->second;
}

// The surface's own name where a rule knows it; else the product's materials, and of layers the outer ones first: what
// lies between them meets no beam. Several materials that are no layers may each be anywhere ("Glass, Sash" of a
// window), so none of them is taken for a surface. Last the names of the type and of the product.
RuleMatcher::Decision RuleMatcher::knownMaterial(const Product& product, const Surface& surface, bool by_names) {
  std::vector<std::pair<const std::string*, Named>> candidates{{&surface.name, Named::surface}};
  if (!product.layers.empty())
    for (const auto* layer : {&product.layers.front(), &product.layers.back()})
      candidates.emplace_back(&layer->name, Named::product);
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
  if (!by_names || isTransparent(surface) || product.materials.size() > 1) return decision;
  for (const auto& [name, named] :
       {std::pair{product.type_name, Named::type}, {withoutNumber(product.name), Named::name}})
    if (known(name) == Known::visible) {
      decision.text = name;
      decision.named = named;
      break;
    }
  return decision;
}

bool RuleMatcher::passesGroups(std::size_t rule, const Product& product) {
  if (patterns_[rule].group.empty()) return true;
  return std::any_of(product.groups.begin(), product.groups.end(),
                     [&](const std::string& group) { return passes(groups_, &RulePatterns::group, group)[rule]; });
}

bool RuleMatcher::passesLayers(std::size_t rule, const Product& product) {
  return patterns_[rule].layer.empty() || anyPresentationLayer(product, [&](const std::string& name) {
           return passes(layers_, &RulePatterns::layer, name)[rule];
         });
}

RuleMatcher::Decision RuleMatcher::decide(const Product& product, const Surface& surface, bool by_names) {
  const auto band = colourBand(surface);
  auto decision = knownMaterial(product, surface, by_names);
  const auto& by_class = passes(classes_, &RulePatterns::ifc_class, product.ifc_class);
  const auto& by_material = passes(materials_, &RulePatterns::material, decision.text);
  const auto& by_name = asks_name_ ? passes(names_, &RulePatterns::name, product.name) : all_pass_;
  const auto& by_type = asks_type_ ? passes(types_, &RulePatterns::type, product.type_name) : all_pass_;
  const auto& by_storey = passes(storeys_, &RulePatterns::storey, product.storey);
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    if (!by_class[i] || !by_material[i] || !by_name[i] || !by_type[i] || !by_storey[i] || !passesGroups(i, product) ||
        !passesLayers(i, product))
      continue;
    const auto& rule = set_.rules[i];
    if (!rule.colour.empty() && (band.empty() || patterns_[i].colour.fit(band) < 0)) continue;
    if (!within(rule.metallic, surface.metallic) || !within(rule.roughness, surface.roughness) ||
        !within(rule.transmission, surface.transmission))
      continue;
    decision.rule = static_cast<std::int32_t>(i);
    decision.confidence = rule.confidence * (rule.material.empty() ? 1 : kByNamed[static_cast<int>(decision.named)]);
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
    constexpr const char* kFrom[] = {"material", "the product's material", "type", "name"};
    add(fmt::format("{} '{}' ({})", kFrom[static_cast<int>(decision.named)], decision.text,
                    found(patterns.material, decision.text)));
  }
  if (!rule.ifc_class.empty()) add("class " + product.ifc_class);
  if (!rule.name.empty()) add(fmt::format("name '{}' ({})", product.name, found(patterns.name, product.name)));
  if (!rule.type.empty())
    add(fmt::format("type '{}' ({})", product.type_name, found(patterns.type, product.type_name)));
  if (!rule.storey.empty()) add("storey '" + product.storey + "'");
  if (!rule.group.empty()) add("group " + rule.group);
  if (!rule.layer.empty()) add("layer " + rule.layer);
  if (!rule.colour.empty()) {
    std::string colour = "colour " + std::string(colourBand(surface));
    if (isTransparent(surface) && !isTransparent(surface.colour)) {
      colour += fmt::format(" (transmission {:.2f}", *surface.transmission);
      if (surface.index_of_refraction)
        colour += fmt::format(", index of refraction {:.2f}", *surface.index_of_refraction);
      colour += ")";
    }
    add(colour);
  }
  for (const auto& [range, name, value] : {std::tuple{&rule.metallic, "metallic", &surface.metallic},
                                           {&rule.roughness, "roughness", &surface.roughness},
                                           {&rule.transmission, "transmission", &surface.transmission}})
    if (*range) add(fmt::format("{} {:.2f}", name, value->value_or(0)));
  return text + ", " + (rule.place.empty() ? "rule " + std::to_string(index) : rule.place);
}

}  // namespace standpoint
