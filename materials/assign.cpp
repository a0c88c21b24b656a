// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "materials/colour.h"
#include "materials/findings.h"
#include "materials/materials.h"
#include "materials/rule_matcher.h"
#include "materials/select.h"

namespace standpoint {

namespace {

struct SurfaceArea {
  std::uint32_t surface;
  double area_m2;
};

// A surface of a product with all its placed triangles.
struct Pair {
  std::uint32_t product, surface;
  double area_m2;
};

std::vector<SurfaceArea> placedAreas(const Mesh& mesh, const Eigen::Matrix3d& linear) {
  std::vector<SurfaceArea> areas;  // triangles are sorted by surface
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d origin = mesh.positions[a].cast<double>();
    const Eigen::Vector3d u = linear * (mesh.positions[b].cast<double>() - origin);
    const Eigen::Vector3d v = linear * (mesh.positions[c].cast<double>() - origin);
    if (areas.empty() || areas.back().surface != mesh.surface_of_triangle[i])
      areas.push_back({mesh.surface_of_triangle[i], 0});
    areas.back().area_m2 += 0.5 * u.cross(v).norm();
  }
  return areas;
}

// s where the placement turns, mirrors and scales evenly by s: areas then follow from the mesh's own.
std::optional<double> evenScale(const Eigen::Matrix3d& linear) {
  const Eigen::Matrix3d gram = linear.transpose() * linear;
  const double square = gram.trace() / 3;
  const double off = (gram - square * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return off <= 1e-9 * square ? std::optional(std::sqrt(square)) : std::nullopt;
}

Result<std::vector<Pair>> measuredPairs(const Environment& environment, Progress& progress) {
  std::vector<std::vector<SurfaceArea>> own(environment.meshes.size());
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < environment.instances.size(); ++i) {
    const auto& instance = environment.instances[i];
    const auto& mesh = *environment.meshes[instance.mesh];
    const Eigen::Matrix3d linear = instance.world_from_mesh.linear();
    const auto scale = evenScale(linear);
    auto& kept = own[instance.mesh];
    if (scale && kept.empty()) kept = placedAreas(mesh, Eigen::Matrix3d::Identity());
    for (const auto& [surface, area_m2] : scale ? kept : placedAreas(mesh, linear))
      pairs.push_back({instance.product, surface, scale ? area_m2 * *scale * *scale : area_m2});
    if (i % 256 == 0) {
      if (auto going = progress.check(); !going) return failure(going.error());
      progress.advance(static_cast<double>(i) / static_cast<double>(environment.instances.size()));
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::pair(a.product, a.surface) < std::pair(b.product, b.surface);
  });
  std::size_t count = 0;
  for (const auto& pair : pairs)
    if (count > 0 && pairs[count - 1].product == pair.product && pairs[count - 1].surface == pair.surface)
      pairs[count - 1].area_m2 += pair.area_m2;
    else
      pairs[count++] = pair;
  pairs.resize(count);
  return pairs;
}

// What the user said: the last override that means a product or one of its surfaces.
class OverrideTable {
 public:
  OverrideTable(const Environment& environment, const std::vector<MaterialOverride>& overrides)
      : environment_(environment), of_product_(environment.products.size(), -1), selects_(overrides.size(), false) {
    for (std::size_t i = 0; i < overrides.size(); ++i) {
      if (auto surfaces = SurfaceSelector::parse(environment, overrides[i].selector)) {
        of_surface_.emplace_back(static_cast<int>(i), std::move(*surfaces));
        continue;
      }
      for (const auto product : select(environment, overrides[i].selector)) {
        of_product_[product] = static_cast<int>(i);
        selects_[i] = true;
      }
    }
  }

  int of(const Pair& pair) {
    int last = of_product_[pair.product];
    for (const auto& [index, surfaces] : of_surface_) {
      if (!surfaces.fits(environment_, pair.product, pair.surface)) continue;
      selects_[static_cast<std::size_t>(index)] = true;
      last = std::max(last, index);
    }
    return last;
  }
  bool selects(std::size_t index) const { return selects_[index]; }

 private:
  const Environment& environment_;
  std::vector<int> of_product_;
  std::vector<std::pair<int, SurfaceSelector>> of_surface_;
  std::vector<bool> selects_;
};

bool transmits(const PhysicalMaterial& material) { return !material.transmittance.empty(); }

class Assigner {
 public:
  Assigner(const Environment& environment, const std::vector<PhysicalMaterial>& library,
           const std::vector<AssignmentRule>& rules, const std::vector<MaterialOverride>& overrides)
      : environment_(environment),
        library_(library),
        rules_(rules),
        overrides_(overrides),
        matcher_(rules),
        table_(environment, overrides) {
    for (std::size_t i = 0; i < library.size(); ++i) by_id_.emplace(library[i].id, static_cast<std::int32_t>(i));
  }

  Result<void> checkIds() const {
    for (std::size_t i = 0; i < rules_.size(); ++i)
      if (!by_id_.contains(rules_[i].assign))
        return failure(ErrorKind::usage, "'" + rules_[i].assign + "' is not in the library",
                       "rule /" + std::to_string(i));
    for (const auto& o : overrides_)
      if (!by_id_.contains(o.material))
        return failure(ErrorKind::usage, "'" + o.material + "' is not in the library of materials", o.selector);
    return {};
  }

  // Pairs come by rising product and surface. What no beam meets stays as it is, unless the user speaks of it.
  void assign(const Pair& pair) {
    AssignedSurface result{pair.product, pair.surface, -1, {}};
    const auto& product = environment_.products[pair.product];
    if (const int said = table_.of(pair); said >= 0) {
      const auto& o = overrides_[static_cast<std::size_t>(said)];
      result.material = by_id_.at(o.material);
      result.reason = "override " + o.selector;
    } else if (product.inScene()) {
      byRules(pair, result);
    }
    if (product.inScene()) account(pair, result.material);
    assigned_.push_back(std::move(result));
  }

  MaterialResult finish() {
    closeProduct();
    MaterialResult result;
    result.report.area_m2 = area_m2_;
    result.report.coverage = area_m2_ > 0 ? assigned_m2_ / area_m2_ : 0;
    for (auto& [id, use] : uses_) result.report.uses.push_back(std::move(use));
    std::stable_sort(result.report.uses.begin(), result.report.uses.end(),
                     [](const MaterialUse& a, const MaterialUse& b) { return a.area_m2 > b.area_m2; });
    for (std::size_t i = 0; i < overrides_.size(); ++i)
      if (!table_.selects(i))
        result.report.findings.push_back(
            {"warning", overrides_[i].selector, "the selector means no surface of this model"});
    for (auto& finding : findings_.findings(environment_)) result.report.findings.push_back(std::move(finding));
    keepUsed(result.assignment);
    return result;
  }

 private:
  std::string surfaceText(const Pair& pair) const {
    const auto& surface = environment_.surfaces[pair.surface];
    if (!surface.name.empty()) return "surface '" + surface.name + "'";
    std::string names;
    for (const auto& name : environment_.products[pair.product].materials) names += (names.empty() ? "" : ", ") + name;
    return names.empty() ? "the nameless surface" : "material '" + names + "'";
  }

  // "colour transparent (transmission 0.90, index of refraction 1.52)"
  static std::string colourText(const Surface& surface) {
    std::string text = "colour " + std::string(colourBand(surface));
    if (!isTransparent(surface) || isTransparent(surface.colour)) return text;
    text += fmt::format(" (transmission {:.2f}", *surface.transmission);
    if (surface.index_of_refraction) text += fmt::format(", index of refraction {:.2f}", *surface.index_of_refraction);
    return text + ")";
  }

  void byRules(const Pair& pair, AssignedSurface& result) {
    const auto& product = environment_.products[pair.product];
    const auto& surface = environment_.surfaces[pair.surface];
    const auto decision = matcher_.decide(product, surface);
    if (decision.rule < 0) {
      findings_.add({true, "no rule fits " + surfaceText(pair) + " of", product.ifc_class, ""}, pair.product,
                    pair.area_m2);
      return;
    }
    const auto& rule = rules_[static_cast<std::size_t>(decision.rule)];
    result.material = by_id_.at(rule.assign);
    result.reason = matcher_.reason(decision, product);
    if (!rule.colour.empty())
      result.reason += (result.reason.find(':') == std::string::npos ? ": " : ", ") + colourText(surface);
    if (decision.generic)
      findings_.add({false, "only class and colour decided for " + surfaceText(pair) + " of", product.ifc_class,
                     ": " + rule.assign + ", " + result.reason},
                    pair.product, pair.area_m2);
  }

  void account(const Pair& pair, std::int32_t material) {
    if (product_ != pair.product) closeProduct();
    product_ = pair.product;
    area_m2_ += pair.area_m2;
    if (material >= 0) assigned_m2_ += pair.area_m2;
    const auto id = material < 0 ? std::string() : library_[static_cast<std::size_t>(material)].id;
    auto& use = uses_.try_emplace(id, MaterialUse{id, 0, {}}).first->second;
    use.area_m2 += pair.area_m2;
    if (use.products.empty() || use.products.back() != pair.product) use.products.push_back(pair.product);
    product_m2_ += pair.area_m2;
    if (material >= 0) checkTransparency(pair, library_[static_cast<std::size_t>(material)]);
  }

  void checkTransparency(const Pair& pair, const PhysicalMaterial& material) {
    const auto& surface = environment_.surfaces[pair.surface];
    const auto& ifc_class = environment_.products[pair.product].ifc_class;
    has_pane_ = has_pane_ || transmits(material);
    if (isTransparent(surface) && !transmits(material))
      findings_.add(
          {true, "transparent " + surfaceText(pair) + " of", ifc_class, " has the opaque material " + material.id},
          pair.product, pair.area_m2);
    if (!isTransparent(surface) && surface.colour != Colour{} && transmits(material))
      findings_.add(
          {true, "opaque " + surfaceText(pair) + " of", ifc_class, " has the transparent material " + material.id},
          pair.product, pair.area_m2);
  }

  // A window whose file knows no pane of its own would stop every beam.
  void closeProduct() {
    if (product_ && !has_pane_ && environment_.products[*product_].ifc_class.starts_with("IfcWindow"))
      findings_.add({true, "no surface is of glass in", environment_.products[*product_].ifc_class, ""}, *product_,
                    product_m2_);
    has_pane_ = false;
    product_m2_ = 0;
    product_.reset();
  }

  void keepUsed(MaterialAssignment& assignment) {
    std::map<std::string, std::int32_t> used;
    for (const auto& surface : assigned_)
      if (surface.material >= 0)
        used.emplace(library_[static_cast<std::size_t>(surface.material)].id, surface.material);
    std::vector<std::int32_t> new_index(library_.size(), -1);
    for (const auto& [id, index] : used) {
      new_index[static_cast<std::size_t>(index)] = static_cast<std::int32_t>(assignment.materials.size());
      assignment.materials.push_back(library_[static_cast<std::size_t>(index)]);
    }
    for (auto& surface : assigned_)
      if (surface.material >= 0) surface.material = new_index[static_cast<std::size_t>(surface.material)];
    assignment.surfaces = std::move(assigned_);
  }

  const Environment& environment_;
  const std::vector<PhysicalMaterial>& library_;
  const std::vector<AssignmentRule>& rules_;
  const std::vector<MaterialOverride>& overrides_;
  RuleMatcher matcher_;
  OverrideTable table_;
  std::map<std::string, std::int32_t> by_id_;
  FindingCollector findings_;
  std::vector<AssignedSurface> assigned_;
  std::map<std::string, MaterialUse> uses_;
  double area_m2_ = 0, assigned_m2_ = 0;
  std::optional<std::uint32_t> product_;  // whose pairs are being accounted
  double product_m2_ = 0;
  bool has_pane_ = false;
};

}  // namespace

Result<MaterialResult> assignMaterials(const Environment& environment, const std::vector<PhysicalMaterial>& library,
                                       const std::vector<AssignmentRule>& rules,
                                       const std::vector<MaterialOverride>& overrides, Progress& progress) {
  progress.stage("Measuring surfaces", 0, 0.7);
  const auto pairs = measuredPairs(environment, progress);
  if (!pairs) return failure(pairs.error());
  Assigner assigner(environment, library, rules, overrides);
  if (auto checked = assigner.checkIds(); !checked) return failure(checked.error());
  progress.stage("Assigning materials", 0.7, 1);
  for (std::size_t i = 0; i < pairs->size(); ++i) {
    if (i % 256 == 0) {
      if (auto going = progress.check(); !going) return failure(going.error());
      progress.advance(static_cast<double>(i) / static_cast<double>(pairs->size()));
    }
    assigner.assign((*pairs)[i]);
  }
  progress.advance(1);
  return assigner.finish();
}

}  // namespace standpoint
