// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/rule_matcher.h"

#include <algorithm>
#include <cmath>

#include "materials/colour.h"

namespace standpoint {

namespace {

constexpr int kNoPattern = -2;

// Hue 0..360, saturation and value 0..1 (Smith 1978).
struct Hsv {
  float hue, saturation, value;
};

Hsv hsv(const Colour& c) {
  const float high = std::max({c.r, c.g, c.b});
  const float range = high - std::min({c.r, c.g, c.b});
  if (range <= 0) return {0, 0, high};
  const float sextant = high == c.r   ? (c.g - c.b) / range
                        : high == c.g ? 2 + (c.b - c.r) / range
                                      : 4 + (c.r - c.g) / range;
  return {sextant < 0 ? 60 * sextant + 360 : 60 * sextant, range / high, high};
}

std::string_view hueBand(const Hsv& c) {
  if (c.hue < 18 || c.hue >= 340) return c.value < 0.35F ? "brown" : "red";
  if (c.hue < 48) return c.saturation < 0.45F && c.value > 0.6F ? "beige" : c.value < 0.75F ? "brown" : "orange";
  if (c.hue < 70) return c.saturation < 0.45F && c.value > 0.6F ? "beige" : "yellow";
  return c.hue < 170 ? "green" : c.hue < 260 ? "blue" : "violet";
}

}  // namespace

// The default colour means that the file says none: no band, so no colour rule decides on it.
std::string_view colourBand(const Colour& colour) {
  if (colour == Colour{}) return "";
  if (isTransparent(colour)) return "transparent";
  const auto c = hsv(colour);
  if (c.value < 0.15F) return "black";
  if (c.saturation < 0.12F) return c.value > 0.85F ? "white" : "grey";
  return hueBand(c);
}

RuleMatcher::RuleMatcher(std::span<const AssignmentRule> rules) {
  for (const auto& rule : rules)
    rules_.push_back({Pattern(rule.ifc_class), Pattern(rule.material), Pattern(rule.name), Pattern(rule.colour)});
}

const RuleMatcher::Fits& RuleMatcher::fits(Memo& memo, Field field, const std::string& text) {
  const auto [place, is_new] = memo.try_emplace(text);
  if (!is_new) return place->second;
  const auto plain = folded(text);
  for (const auto& rule : rules_) {
    const auto& pattern = rule.*field;
    place->second.push_back(pattern.empty()                       ? kNoPattern
                            : field == &RulePatterns::ifc_class ? fitClass(pattern, text)
                                                                  : pattern.fit(plain));
  }
  return place->second;
}

bool RuleMatcher::knows(const std::string& material_name) {
  if (material_name.empty()) return false;
  const auto& all = fits(materials_, &RulePatterns::material, material_name);
  return std::any_of(all.begin(), all.end(), [](int glob) { return glob >= 0; });
}

// The surface's own name where a rule knows it; else the product's materials, and of layers the outer ones first: what
// lies between them meets no beam. A named surface of a product with several materials may be any of them ("Sash" of
// "Glass, Sash"), so none is taken for it.
std::string RuleMatcher::knownMaterialName(const Product& product, const Surface& surface) {
  if (knows(surface.name)) return surface.name;
  if (!product.layers.empty()) {
    for (const auto* layer : {&product.layers.front(), &product.layers.back()})
      if (knows(layer->name)) return layer->name;
  } else if (!surface.name.empty() && product.materials.size() > 1) {
    return {};
  }
  for (const auto& name : product.materials)
    if (knows(name)) return name;
  return {};
}

RuleMatcher::Decision RuleMatcher::decide(const Product& product, const Surface& surface) {
  Decision decision;
  decision.text = knownMaterialName(product, surface);
  const auto& by_class = fits(classes_, &RulePatterns::ifc_class, product.ifc_class);
  const auto& by_material = fits(materials_, &RulePatterns::material, decision.text);
  const auto& by_name = fits(names_, &RulePatterns::name, product.name);
  const auto band = colourBand(surface.colour);
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
