// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "materials/colour.h"

namespace standpoint {

namespace {

constexpr double kThickestGlass = 0.06;  // m; a triple glazing is thinner
constexpr double kThicknessTolerance =
    0.5;                               // share of the build-up's thickness; models draw panes as thick as they like
constexpr double kBeyondData_nm = 25;  // a figure still holds so far from where it was measured

std::string withId(std::string text, const PhysicalMaterial& material) {
  const auto at = text.find(material.label);
  return at == std::string::npos ? text : text.replace(at, material.label.size(), material.id);
}

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
  return names.empty() ? "the unnamed surface" : "material '" + names + "'";
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
    if (about != nullptr && std::strcmp(kind, "gap") != 0) cause.then_by_id = withId(cause.then, *about);
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
    c.what = "no rule matches " + surfaceText(pair) + " of";
    c.why = "Scans will use the luminance of its colour as reflectance, which is unreliable in the infrared.";
    c.remedies = {{"Assign a material", selectorOf(pair), ""}};
  });
}

void AssignmentChecks::gap(const SurfaceOfProduct& pair, const PhysicalMaterial& material) {
  nextProduct(pair.product);
  product_m2_ += pair.area_m2;
  tell("gap", true, pair, &material, [&](FindingCollector::Cause& c) {
    c.what = surfaceText(pair) + " of";
    c.then = " would be " + material.label + ", for which there is no data";
    c.why = material.gaps.front();
    c.remedies = {{"Assign a similar material", selectorOf(pair), ""}};
  });
}

void AssignmentChecks::byRule(const SurfaceOfProduct& pair, const PhysicalMaterial& material,
                              const RuleMatcher::Decision& decision, const std::string& reason) {
  if (decision.confidence >= kWeakConfidence) return;
  tell("weak-rule", false, pair, &material, [&](FindingCollector::Cause& c) {
    c.what = (decision.text.empty() ? "only class and colour matched: " : "low-confidence rule matched: ") +
             surfaceText(pair) + " of";
    c.then = ": " + material.label + ", " + reason;
    c.why = fmt::format("Rule confidence {:.2g}: the material is typical for such products, but not confirmed.",
                        decision.confidence);
    c.remedies = {{"Keep " + material.label, selectorOf(pair), material.id},
                  {"Assign another material", selectorOf(pair), ""}};
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
      c.then = " has the opaque material " + material.label;
      c.why = "Transparent in the model, but beams would stop at it.";
      c.remedies = {
          {"Assign glass", selectorOf(pair), isWindow(ifc_class) ? "glass_double_clear_4mm" : "glass_float_clear_6mm"},
          {"Assign another material", selectorOf(pair), ""}};
    });
  }
  if (!isTransparent(surface) && surface.colour != Colour{} && transmits(material)) {
    tell("clear-solid", true, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = "opaque " + surfaceText(pair) + " of";
      c.then = " has the transparent material " + material.label;
      c.why = "Opaque in the model, but beams would pass through it.";
      c.remedies = {{"Assign an opaque material", selectorOf(pair), ""}};
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
  const auto& found = implausible_[static_cast<std::size_t>(place->second)];
  tell("implausible", true, pair, &material, [&](FindingCollector::Cause& c) {
    c.what = surfaceText(pair) + " of";
    c.then = " has the material " + material.label;
    c.why = found.why;
    c.remedies = {{"Assign another material", selectorOf(pair), ""}};
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
      c.then = fmt::format(" is a solid {:.0f} mm thick and has the material {}", modelled * 1000, material.label);
      c.why = fmt::format(
          "Glass in the library is {:.0f} mm thick in total. Check whether frame and pane are modelled as one body.",
          wanted * 1000);
      c.remedies = {{"Assign another material", selectorOf(pair), ""}};
    });
  } else if (modelled == 0) {
    tell("flat-glass", false, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = surfaceText(pair) + " of";
      c.then =
          fmt::format(" is not a closed solid; beams pass {} of {:.0f} mm at each face", material.label, wanted * 1000);
      c.why = "A surface without thickness counts as one pane; two parallel surfaces count as two.";
    });
  } else if (std::abs(modelled - wanted) > kThicknessTolerance * std::max(wanted, modelled)) {
    tell("pane-thickness", false, pair, &material, [&](FindingCollector::Cause& c) {
      c.what = surfaceText(pair) + " of";
      c.then =
          fmt::format(" is modelled {:.0f} mm thick, {} is {:.0f} mm", modelled * 1000, material.label, wanted * 1000);
      c.why =
          "Transmission follows the library's build-up, not the modelled thickness. Check that the material is "
          "correct.";
      if (const auto* nearest = paneOf(modelled, material.index_of_refraction);
          nearest != nullptr && nearest->id != material.id)
        c.remedies.push_back({"Take " + nearest->label, selectorOf(pair), nearest->id});
      c.remedies.push_back({"Assign another material", selectorOf(pair), ""});
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
    c.what = "no glass surface in";
    c.why = "Beams would stop at the window, but real ones pass through its panes.";
    FindingCollector::add(findings_.of(std::move(c)), *product_, product_m2_);
  }
  has_pane_ = false;
  product_m2_ = 0;
  product_.reset();
}

void AssignmentChecks::namesAssignedTwoWays() {
  std::map<std::string, std::map<std::string, std::vector<const Use*>>> by_name;  // the surface's, then the material's
  std::map<std::string, std::string> labels;
  for (const auto& [key, use] : uses_) {
    labels[key.second->id] = key.second->label;
    if (const auto& name = environment_.surfaces[key.first].name; !name.empty())
      by_name[name][key.second->id].push_back(&use);
  }
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
    c.what = "surface '" + name + "' has several materials:";
    c.what_by_id = "surface '" + name + "' is";
    for (const auto& [area, id] : order) {
      const auto& label = labels.at(id);
      c.what += fmt::format("{} {}", c.what.ends_with(':') ? "" : ";", label);
      c.what_by_id += fmt::format("{} {}", c.what_by_id.ends_with("is") ? "" : ",", id);
      c.remedies.push_back({fmt::format("Use {} for all", label), "material:" + literalPattern(name), id});
    }
    c.what += " in";
    c.what_by_id += " of";
    c.why = "The same name has several materials because rules for classes, colours or products differ.";
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
      c.what = fmt::format("{} has no data at {:.0f} nm:", material.label, wavelength);
      c.what_by_id = withId(c.what, material);
      c.then = fmt::format(", its table covers {:.0f} to {:.0f} nm", material.reflectance.front().first,
                           material.reflectance.back().first);
      c.why = "Scans will use the nearest value, which may be inaccurate.";
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
