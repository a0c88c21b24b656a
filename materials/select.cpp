// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/select.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/presentation_layers.h"
#include "materials/colour.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

constexpr std::array<std::string_view, 8> kKinds = {"class", "type",  "name",     "storey",
                                                    "group", "layer", "material", "colour"};

struct Condition {
  std::string_view kind;  // "class", …; empty: an id or a GlobalId
  std::string_view value;
};

Condition parsed(std::string_view condition) {
  for (const std::string_view kind : kKinds)
    if (condition.size() > kind.size() && condition.starts_with(kind) && condition[kind.size()] == ':')
      return {kind, condition.substr(kind.size() + 1)};
  return {{}, condition};
}

// A `&` separates where a condition follows; names may hold one.
std::size_t endOfCondition(std::string_view text) {
  for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1))
    if (!parsed(text.substr(at + 1)).kind.empty()) return at;
  return text.size();
}

// "@1,2,3" at the end; nothing when what follows an @ is none.
std::optional<Eigen::Vector3d> takeTriple(std::string_view& text) {
  const auto at = text.rfind('@');
  if (at == std::string_view::npos) return std::nullopt;
  Eigen::Vector3d triple;
  const char* place = text.data() + at + 1;
  const char* const end = text.data() + text.size();
  for (int k = 0; k < 3; ++k) {
    const auto [next, error] = std::from_chars(place, end, triple[k]);
    if (error != std::errc() || (k < 2 ? next == end || *next != ',' : next != end)) return std::nullopt;
    place = next + 1;
  }
  if (!(triple.norm() < 1e9)) return std::nullopt;
  text = text.substr(0, at);
  return triple;
}

struct Faces {
  std::optional<Eigen::Vector3d> direction, point;
};

// "@0,0,1", or with a point "@0,0,1@4.5,2,0.8"; both empty when what stands there is no direction.
Faces takeFaces(std::string_view& text) {
  const auto whole = text;
  Faces faces;
  faces.direction = takeTriple(text);
  if (!faces.direction) return {};
  if (auto before = takeTriple(text)) {
    faces.point = faces.direction;
    faces.direction = before;
  }
  const double length = faces.direction->norm();
  if (length > 1e-9) {
    *faces.direction /= length;
    return faces;
  }
  text = whole;
  return {};
}

bool fitsAny(const Pattern& pattern, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return pattern.fit(folded(name)) >= 0; });
}

bool fits(const Condition& condition, const Pattern& pattern, const Product& product) {
  if (condition.kind == "class") return fitClass(pattern, product.ifc_class) >= 0;
  if (condition.kind == "type") return pattern.fit(folded(product.type_name)) >= 0;
  if (condition.kind == "name") return pattern.fit(folded(product.name)) >= 0;
  if (condition.kind == "storey") return pattern.fit(folded(product.storey)) >= 0;
  if (condition.kind == "group") return fitsAny(pattern, product.groups);
  if (condition.kind == "layer")
    return anyPresentationLayer(product, [&](const std::string& name) { return pattern.fit(folded(name)) >= 0; });
  return !condition.value.empty() && (product.id == condition.value || product.global_id == condition.value);
}

}  // namespace

Selector::Selector(const Environment& environment, std::string_view text)
    : environment_(environment), of_product_(environment.products.size(), true) {
  const auto faces = takeFaces(text);
  direction_ = faces.direction;
  point_ = faces.point;
  for (;;) {
    const auto end = endOfCondition(text);
    add(text.substr(0, end));
    if (end == text.size()) return;
    text = text.substr(end + 1);
  }
}

void Selector::add(std::string_view text) {
  const auto condition = parsed(text);
  const Pattern pattern(condition.kind.empty() ? std::string_view() : condition.value);
  if (condition.kind == "material") {
    auto& named = materials_.emplace_back();
    for (const auto& surface : environment_.surfaces)
      named.of_surface.push_back(!surface.name.empty() && pattern.fit(folded(surface.name)) >= 0);
    for (const auto& product : environment_.products) named.of_product.push_back(fitsAny(pattern, product.materials));
  } else if (condition.kind == "colour") {
    auto& coloured = colours_.emplace_back();
    for (const auto& surface : environment_.surfaces) coloured.push_back(pattern.fit(colourBand(surface)) >= 0);
  } else {
    for (std::size_t i = 0; i < of_product_.size(); ++i)
      of_product_[i] = of_product_[i] && standpoint::fits(condition, pattern, environment_.products[i]);
  }
}

bool Selector::fits(std::uint32_t product, std::uint32_t surface) const {
  if (!of_product_[product]) return false;
  const bool nameless = environment_.surfaces[surface].name.empty();
  for (const auto& named : materials_)
    if (!(nameless ? named.of_product[product] : named.of_surface[surface])) return false;
  return std::all_of(colours_.begin(), colours_.end(), [&](const auto& coloured) { return coloured[surface]; });
}

std::vector<std::uint32_t> select(const Environment& environment, const std::string& text) {
  const Selector selector(environment, text);
  std::vector<std::uint32_t> products;
  if (!selector.asksSurface()) {
    for (std::uint32_t i = 0; i < environment.products.size(); ++i)
      if (selector.fits(i)) products.push_back(i);
    return products;
  }
  for (const auto& instance : environment.instances) {
    const auto& used = environment.meshes[instance.mesh]->surface_of_triangle;
    for (auto s = used.begin(); s != used.end(); s = std::upper_bound(s, used.end(), *s))
      if (selector.fits(instance.product, *s)) products.push_back(instance.product);
  }
  std::sort(products.begin(), products.end());
  products.erase(std::unique(products.begin(), products.end()), products.end());
  return products;
}

std::string_view selectedProduct(std::string_view selector) {
  takeFaces(selector);
  const auto first = selector.substr(0, endOfCondition(selector));
  return parsed(first).kind.empty() ? first : std::string_view();
}

}  // namespace standpoint
