// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/checks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "materials/colour.h"

namespace standpoint {

namespace {

constexpr double kThickestGlass = 0.06;  // m; a triple glazing is thinner
constexpr double kThicknessTolerance =
    0.5;                               // share of the build-up's thickness; models draw panes as thick as they like
constexpr double kBeyondData_nm = 25;  // a figure still holds so far from where it was measured

bool isWindow(const std::string& ifc_class) { return ifc_class.starts_with("IfcWindow"); }

}  // namespace

AssignmentChecks::AssignmentChecks(const Environment& environment, const std::vector<PhysicalMaterial>& library,
                                   const RuleSet& rules, FindingCollector& findings)
    : environment_(environment), library_(library), findings_(findings), words_(rules.words) {
  for (const auto& entry : rules.implausible)
    implausible_.push_back({Pattern(entry.ifc_class, words_), Pattern(entry.assigned, words_), entry.why});
}

std::string AssignmentChecks::surfaceText(const SurfaceOfProduct& pair) const {
  const auto& surface = environment_.surfaces[pair.surface];
  if (!surface.name.empty()) return "surface '" + surface.name + "'";
  std::string names;
  for (const auto& name : environment_.products[pair.product].materials) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "the nameless surface" : "material '" + names + "'";
}

// Means this surface and those like it, for one click.
std::string AssignmentChecks::selectorOf(const SurfaceOfProduct& pair) const {
  const auto& product = environment_.products[pair.product];
  const auto& surface = environment_.surfaces[pair.surface];
  std::string text = product.ifc_class.empty() ? "" : "class:" + product.ifc_class;
  const auto add = [&](const std::string& condition) { text += (text.empty() ? "" : "&") + condition; };
  if (!surface.name.empty())
    add("material:" + literalPattern(surface.name));
  else if (product.materials.size() == 1)
    add("material:" + literalPattern(product.materials.front()));
  else if (const auto band = colourBand(surface); !band.empty())
    add("colour:" + std::string(band));
  return text.empty() ? product.id : text;
}

template <class Describe>
void AssignmentChecks::tell(const char* kind, bool warning, const SurfaceOfProduct& pair, const PhysicalMaterial* about,
                            Describe describe) {
  const auto& product = environment_.products[pair.product];
  std::string like = product.ifc_class;
  if (environment_.surfaces[pair.surface].name.empty())
    for (const auto& name : product.materials) like += '/' + name;
  if (like.empty()) like = product.id;  // nothing but its number to select it by
  auto*& extent = told_[{kind, pair.surface, about, std::move(like)}];
  if (extent == nullptr) {
    FindingCollector::Cause cause;
    cause.kind = kind;
    cause.warning = warning;
    cause.subject = selectorOf(pair) + " / " + surfaceText(pair) + " / " + (about == nullptr ? "" : about->id);
    describe(cause);
    extent = &findings_.of(std::move(cause));
  }
  FindingCollector::add(*extent, pair.product, pair.area_m2);
}

void AssignmentChecks::nextProduct(std::uint32_t product) {
  if (product_ != product) closeProduct();
  product_ = product;
}

void AssignmentChecks::unassigned(const SurfaceOfProduct& pair) {
  nextProduct(pair.product);
  product_m2_ += pair.area_m2;
  tell("unassigned", true, pair, nullptr, [&](FindingCollector::Cause& c) {
    c.what = "no rule fits " + surfaceText(pair) + " of";
    c.why = "A scan then takes the luminance of its colour for its reflectance, which says nothing of the infrared.";
    c.remedies = {{"Choose a material for these", selectorOf(pair), ""}};
  });
}

void AssignmentChecks::gap(const SurfaceOfProduct& pair, const PhysicalMaterial& material) {
  nextProduct(pair.product);
  product_m2_ += pair.area_m2;
  tell("gap", true, pair, &material, [&](FindingCollector::Cause& c) {
    c.what = surfaceText(pair) + " of";
    c.then = " would be " + material.label + ", of which there are no figures";
    c.why = material.gaps.front();
    c.remedies = {{"Choose a material that comes near", selectorOf(pair), ""}};
  });
}

void AssignmentChecks::byRule(const SurfaceOfProduct& pair, const PhysicalMaterial& material,
                              const RuleMatcher::Decision& decision, const std::string& reason) {
  if (decision.confidence >= kWeakConfidence) return;
  tell("weak-rule", false, pair, &material, [&](FindingCollector::Cause& c) {
    c.what = (decision.text.empty() ? "only class and colour decided for " : "a weak rule decided for ") +
             surfaceText(pair) + " of";
    c.then = ": " + material.id + ", " + reason;
    c.why = fmt::format(
        "The rule's confidence is {:.2g}: it knows what such things are often made of, not what this one is.",
        decision.confidence);
    c.remedies = {{"Keep " + material.label, selectorOf(pair), material.id},
                  {"Choose another material", selectorOf(pair), ""}};
  });
}

void AssignmentChecks::assigned(const SurfaceOfProduct& pair, const PhysicalMaterial& material) {
  nextProduct(pair.product);
  product_m2_ += pair.area_m2;
  has_pane_ = has_pane_ || transmits(material);
  transparency(pair, material);
  implausible(pair, material);
  if (transmits(material)) thickness(pair, material);
  auto& use = uses_[{pair.surface, &material}];
  if (use.products.empty() || use.products.back() != pair.product) use.products.push_back(pair.product);
  use.area_m2 += pair.area_m2;
}

void AssignmentChecks::transparency(const SurfaceOfProduct& pair, const PhysicalMaterial& material) {
  const auto& surface = environment_.surfaces[pair.surface];
  const auto& ifc_class = environment_.products[pair.product].ifc_class;
  if (isTransparent(surface) && !transmits(material)) {
    tell("opaque-glass", true, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = "transparent " + surfaceText(pair) + " of";
      c.then = " has the opaque material " + material.id;
      c.why = "The model draws it as something to look through; a beam would stop at it.";
      c.remedies = {{"Take these for glass", selectorOf(pair),
                     isWindow(ifc_class) ? "glass_double_clear_4mm" : "glass_float_clear_6mm"},
                    {"Choose another material", selectorOf(pair), ""}};
    });
  }
  if (!isTransparent(surface) && surface.colour != Colour{} && transmits(material)) {
    tell("clear-solid", true, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = "opaque " + surfaceText(pair) + " of";
      c.then = " has the transparent material " + material.id;
      c.why = "The model draws it as something that one cannot look through; beams would pass it.";
      c.remedies = {{"Choose an opaque material", selectorOf(pair), ""}};
    });
  }
}

void AssignmentChecks::implausible(const SurfaceOfProduct& pair, const PhysicalMaterial& material) {
  const auto& ifc_class = environment_.products[pair.product].ifc_class;
  const auto [place, is_new] = implausible_of_.try_emplace({ifc_class, &material}, -1);
  if (is_new)
    for (std::size_t i = 0; i < implausible_.size() && place->second < 0; ++i) {
      Folded id(material.id, words_);
      if ((implausible_[i].ifc_class.empty() || fitClass(implausible_[i].ifc_class, ifc_class) >= 0) &&
          implausible_[i].assigned.fit(id) >= 0)
        place->second = static_cast<int>(i);
    }
  if (place->second < 0) return;
  tell("implausible", true, pair, &material, [&](FindingCollector::Cause& c) {
    c.what = surfaceText(pair) + " of";
    c.then = " has the material " + material.id;
    c.why = implausible_[static_cast<std::size_t>(place->second)].why;
    c.remedies = {{"Choose another material", selectorOf(pair), ""}};
  });
}

// The thickest solid that the surface bounds in any of the product's meshes; 0 where it bounds none.
double AssignmentChecks::modelledThickness(const SurfaceOfProduct& pair) {
  const auto& instances = environment_.instances;
  auto i = std::lower_bound(instances.begin(), instances.end(), pair.product,
                            [](const Instance& a, std::uint32_t p) { return a.product < p; });
  double thickest = 0;
  for (; i != instances.end() && i->product == pair.product; ++i) {
    const auto [place, is_new] = thickness_.try_emplace({i->mesh, pair.surface}, 0);
    if (is_new) place->second = solidThickness(*environment_.meshes[i->mesh], pair.surface);
    thickest = std::max(thickest, place->second * std::cbrt(std::abs(i->world_from_mesh.linear().determinant())));
  }
  return thickest;
}

const PhysicalMaterial* AssignmentChecks::paneOf(double thickness_m, double index) const {
  const PhysicalMaterial* nearest = nullptr;
  for (const auto& m : library_)
    if (transmits(m) && m.index_of_refraction == index &&
        (nearest == nullptr ||
         std::abs(buildUpThickness(m) - thickness_m) < std::abs(buildUpThickness(*nearest) - thickness_m)))
      nearest = &m;
  return nearest;
}

void AssignmentChecks::thickness(const SurfaceOfProduct& pair, const PhysicalMaterial& material) {
  const double modelled = modelledThickness(pair), wanted = buildUpThickness(material);
  if (modelled > kThickestGlass) {
    tell("thick-glass", true, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = surfaceText(pair) + " of";
      c.then = fmt::format(" is a solid {:.0f} mm thick and has the material {}", modelled * 1000, material.id);
      c.why = fmt::format(
          "Glass is thin; this library's is {:.0f} mm in all. A frame drawn with its pane as one body, or a block?",
          wanted * 1000);
      c.remedies = {{"Choose another material", selectorOf(pair), ""}};
    });
  } else if (modelled == 0) {
    tell("flat-glass", false, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = surfaceText(pair) + " of";
      c.then = fmt::format(" bounds no solid; a beam meets {} of {:.0f} mm at each face", material.id, wanted * 1000);
      c.why = "A pane without thickness is passed as one pane; two sheets drawn for its two sides count as two.";
    });
  } else if (std::abs(modelled - wanted) > kThicknessTolerance * std::max(wanted, modelled)) {
    tell("pane-thickness", false, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = surfaceText(pair) + " of";
      c.then = fmt::format(" is drawn {:.0f} mm thick, {} is {:.0f} mm", modelled * 1000, material.id, wanted * 1000);
      c.why = "The library's build-up decides what passes, not the thickness in the model: is it the right one?";
      if (const auto* nearest = paneOf(modelled, material.index_of_refraction);
          nearest != nullptr && nearest->id != material.id)
        c.remedies.push_back({"Take " + nearest->label, selectorOf(pair), nearest->id});
      c.remedies.push_back({"Choose another material", selectorOf(pair), ""});
    });
  }
}

// A window whose file knows no pane of its own would stop every beam.
void AssignmentChecks::closeProduct() {
  if (product_ && !has_pane_ && isWindow(environment_.products[*product_].ifc_class)) {
    FindingCollector::Cause c;
    c.kind = "no-pane";
    c.warning = true;
    c.subject = environment_.products[*product_].ifc_class + " / " + environment_.products[*product_].type_name;
    c.what = "no surface is of glass in";
    c.why = "A beam would stop at the window, where a real one passes twice through its panes.";
    FindingCollector::add(findings_.of(std::move(c)), *product_, product_m2_);
  }
  has_pane_ = false;
  product_m2_ = 0;
  product_.reset();
}

void AssignmentChecks::namesAssignedTwoWays() {
  std::map<std::string, std::map<std::string, std::vector<const Use*>>> by_name;  // the surface's, then the material's
  for (const auto& [key, use] : uses_)
    if (const auto& name = environment_.surfaces[key.first].name; !name.empty())
      by_name[name][key.second->id].push_back(&use);
  for (const auto& [name, materials] : by_name) {
    if (materials.size() < 2) continue;
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [id, uses] : materials) {
      order.emplace_back(0, id);
      for (const auto* use : uses) order.back().first -= use->area_m2;
    }
    std::sort(order.begin(), order.end());
    FindingCollector::Cause c;
    c.kind = "two-ways";
    c.subject = name;
    c.what = "surface '" + name + "' is";
    for (const auto& [area, id] : order) {
      c.what += fmt::format("{} {}", c.what.ends_with("is") ? "" : ",", id);
      c.remedies.push_back({"All of them " + id, "material:" + literalPattern(name), id});
    }
    c.what += " of";
    c.why =
        "One name in the model, several materials: rules for a class, a colour or single products decided differently.";
    auto& extent = findings_.of(std::move(c));
    for (const auto& [id, uses] : materials)
      for (const auto* use : uses) addUse(extent, *use);
  }
}

void AssignmentChecks::addUse(FindingCollector::Extent& extent, const Use& use) {
  for (const auto product : use.products)
    FindingCollector::add(extent, product, use.area_m2 / static_cast<double>(use.products.size()));
}

void AssignmentChecks::withoutData(const std::vector<double>& wavelengths_nm) {
  for (const auto& [key, use] : uses_) {
    const auto& material = *key.second;
    for (const double wavelength : wavelengths_nm) {
      const auto covers = [&](const Spectrum& table) {
        return table.empty() || (wavelength >= table.front().first - kBeyondData_nm &&
                                 wavelength <= table.back().first + kBeyondData_nm);
      };
      if (covers(material.reflectance) && covers(material.transmittance)) continue;
      FindingCollector::Cause c;
      c.kind = "no-data";
      c.warning = true;
      c.subject = fmt::format("{} / {:.0f}", material.id, wavelength);
      c.what = fmt::format("{} has no figure at {:.0f} nm:", material.id, wavelength);
      c.then = fmt::format(", the table runs from {:.0f} to {:.0f} nm", material.reflectance.front().first,
                           material.reflectance.back().first);
      c.why = "The instrument would be given the nearest figure, which may be far off.";
      addUse(findings_.of(std::move(c)), use);
    }
  }
}

void AssignmentChecks::finish(const std::vector<double>& wavelengths_nm) {
  closeProduct();
  namesAssignedTwoWays();
  withoutData(wavelengths_nm);
}

}  // namespace standpoint
