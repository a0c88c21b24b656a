// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/face_normal.h"
#include "core/face_patches.h"
#include "materials/areas.h"
#include "materials/checks.h"
#include "materials/colour.h"
#include "materials/findings.h"
#include "materials/materials.h"
#include "materials/override_table.h"
#include "materials/rule_matcher.h"

namespace standpoint {

namespace {

class Assigner {
 public:
  Assigner(const Environment& environment, const std::vector<PhysicalMaterial>& library, const RuleSet& rules,
           const std::vector<MaterialOverride>& overrides, const Eigen::Vector3d& shift_m)
      : environment_(environment),
        library_(library),
        rules_(rules),
        overrides_(overrides),
        matcher_(rules),
        table_(environment, overrides, shift_m),
        checks_(environment, library, rules, findings_) {
    for (std::size_t i = 0; i < library.size(); ++i) by_id_.emplace(library[i].id, static_cast<std::int32_t>(i));
  }

  Result<void> checkIds() const {
    for (const auto& rule : rules_.rules)
      if (!by_id_.contains(rule.assign))
        return failure(ErrorKind::usage, "'" + rule.assign + "' is not in the library", rule.place);
    for (const auto& o : overrides_)
      if (!by_id_.contains(o.material))
        return failure(ErrorKind::usage, "'" + o.material + "' is not in the library of materials", o.selector);
    return {};
  }

  // Pairs come by rising product and surface. What no beam meets stays as it is, unless the user speaks of it.
  void assign(const SurfaceOfProduct& pair) {
    AssignedSurface result{pair.product, pair.surface, -1, {}, 0};
    const bool in_scene = environment_.products[pair.product].inScene();
    const auto said = table_.of(pair);
    if (said.whole >= 0)
      byUser(said.whole, result);
    else if (in_scene && !byFile(pair, result))
      byRules(pair, result);
    if (result.material >= 0 && isGap(material(result.material))) {
      if (in_scene) checks_.gap(pair, material(result.material));
      result.material = -1;
      result.confidence = 0;
    } else if (in_scene && result.material < 0) {
      checks_.unassigned(pair);
    } else if (in_scene) {
      checks_.assigned(pair, material(result.material));
    }
    if (!said.faces.empty())
      assignFaces(pair, said.faces, result, in_scene);
    else if (in_scene)
      account(pair.product, result.material, result.confidence, pair.area_m2);
    assigned_.push_back(std::move(result));
  }

  // After checkIds.
  void prepare() {
    for (const auto& rule : rules_.rules) of_rule_.push_back(by_id_.at(rule.assign));
  }

  MaterialResult finish(const AssignOptions& options) {
    checks_.finish(options.wavelengths_nm);
    aboutTheUser();
    MaterialResult result;
    result.report.area_m2 = all_.area_m2;
    result.report.coverage = all_.area_m2 > 0 ? all_.assigned_m2 / all_.area_m2 : 0;
    for (auto& [index, use] : uses_) {
      use.material = index < 0 ? "" : material(index).id;
      result.report.uses.push_back(std::move(use));
    }
    std::stable_sort(result.report.uses.begin(), result.report.uses.end(),
                     [](const MaterialUse& a, const MaterialUse& b) { return a.area_m2 > b.area_m2; });
    result.report.by_class = rows(by_class_);
    result.report.by_storey = rows(by_storey_);
    result.report.findings = findings_.findings(environment_, options.accepted);
    keepUsed(result.assignment);
    return result;
  }

 private:
  using Rows = std::map<std::string, CoverageRow>;

  const PhysicalMaterial& material(std::int32_t index) const { return library_[static_cast<std::size_t>(index)]; }

  std::int32_t assignedBy(const RuleMatcher::Decision& decision) const {
    return of_rule_[static_cast<std::size_t>(decision.rule)];
  }

  void byUser(int index, AssignedSurface& result) const {
    const auto& o = overrides_[static_cast<std::size_t>(index)];
    result.material = by_id_.at(o.material);
    result.reason = "override " + o.selector;
    result.confidence = 1;
  }

  // What an exported environment says of itself; an id that the library lacks is the rules' again.
  bool byFile(const SurfaceOfProduct& pair, AssignedSurface& result) const {
    const auto found = by_id_.find(environment_.surfaces[pair.surface].physical_material);
    if (found == by_id_.end()) return false;
    result.material = found->second;
    result.reason = "from the file";
    result.confidence = 1;
    return true;
  }

  void byRules(const SurfaceOfProduct& pair, AssignedSurface& result) {
    const auto& product = environment_.products[pair.product];
    const auto& surface = environment_.surfaces[pair.surface];
    asked_rules_ = true;
    auto decision = matcher_.decide(product, surface);
    // "Glass door" tells of a pane somewhere; this surface is not drawn as one.
    if (decision.rule >= 0 && decision.named >= RuleMatcher::Named::type && !isTransparent(surface) &&
        transmits(material(assignedBy(decision))))
      decision = matcher_.decide(product, surface, false);
    if (decision.rule < 0) return;
    own_decided_ = own_decided_ || static_cast<std::size_t>(decision.rule) < rules_.own;
    result.material = assignedBy(decision);
    result.confidence = decision.confidence;
    result.reason = matcher_.reason(decision, product, surface);
    if (!isGap(material(result.material))) checks_.byRule(pair, material(result.material), decision, result.reason);
  }

  void assignFaces(const SurfaceOfProduct& pair, const std::vector<int>& said, const AssignedSurface& whole,
                   bool in_scene) {
    MaterialAssignment own;  // what is said of this surface, in indices of the library
    own.surfaces.push_back(whole);
    for (const int index : said) {
      const auto& o = overrides_[static_cast<std::size_t>(index)];
      own.faces.push_back({pair.product, pair.surface, table_.direction(index), by_id_.at(o.material),
                           "override " + o.selector, table_.point(index)});
    }
    faces_.insert(faces_.end(), own.faces.begin(), own.faces.end());
    if (!in_scene) return;
    const AssignedTriangles triangles(environment_, own);
    std::map<std::int32_t, double> area;
    const auto& instances = environment_.instances;
    auto i = std::lower_bound(instances.begin(), instances.end(), pair.product,
                              [](const Instance& a, std::uint32_t p) { return a.product < p; });
    for (; i != instances.end() && i->product == pair.product; ++i) {
      const Mesh& mesh = *environment_.meshes[i->mesh];
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.surface_of_triangle[t] == pair.surface)
          area[triangles.materialOf(static_cast<std::uint32_t>(i - instances.begin()), t)] +=
              placedArea(mesh, mesh.triangles[t], i->world_from_mesh);
    }
    for (const auto& [material, m2] : area)
      account(pair.product, material, material == whole.material ? whole.confidence : 1, m2);
  }

  void account(std::uint32_t product, std::int32_t index, double confidence, double area_m2) {
    if (product_ != product) {
      const auto& p = environment_.products[product];
      product_ = product;
      rows_ = {&all_, &by_class_[p.ifc_class], &by_storey_[p.storey]};
    }
    for (auto* row : rows_) {
      row->area_m2 += area_m2;
      if (index >= 0) row->assigned_m2 += area_m2;
      if (index >= 0 && confidence < kWeakConfidence) row->weak_m2 += area_m2;
    }
    auto& use = uses_[index];
    use.area_m2 += area_m2;
    if (use.products.empty() || use.products.back() != product) use.products.push_back(product);
  }

  static std::vector<CoverageRow> rows(const Rows& by_name) {
    std::vector<CoverageRow> result;
    for (const auto& [name, row] : by_name) {
      result.push_back(row);
      result.back().name = name;
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const CoverageRow& a, const CoverageRow& b) { return a.area_m2 > b.area_m2; });
    return result;
  }

  void aboutTheUser() {
    for (std::size_t i = 0; i < overrides_.size(); ++i) {
      if (table_.selects(i)) continue;
      FindingCollector::Cause c;
      c.kind = "selector";
      c.warning = true;
      c.subject = overrides_[i].selector;
      c.what = "the selector matches no surface";
      c.why = "Its assignment has no effect: a name has changed, or a product was removed.";
      c.remedies = {{"Remove assignment", overrides_[i].selector, "rules"}};
      findings_.addAbout(std::move(c), overrides_[i].selector);
    }
    if (rules_.own == 0 || own_decided_ || !asked_rules_) return;
    FindingCollector::Cause c;
    c.kind = "idle-rules";
    c.warning = true;
    c.subject = rules_.rules.front().place;
    c.what = fmt::format("none of the {} rules in the file matched", rules_.own);
    c.why = "The names, classes or colours in the rules do not occur in this model.";
    findings_.addAbout(std::move(c), rules_.rules.front().place);
  }

  void keepUsed(MaterialAssignment& assignment) {
    std::map<std::string, std::int32_t> used;
    const auto use = [&](std::int32_t index) {
      if (index >= 0) used.emplace(material(index).id, index);
    };
    for (const auto& surface : assigned_) use(surface.material);
    std::erase_if(faces_, [&](const AssignedFaces& f) { return isGap(material(f.material)); });
    for (const auto& face : faces_) use(face.material);
    std::vector<std::int32_t> new_index(library_.size(), -1);
    for (const auto& [id, index] : used) {
      new_index[static_cast<std::size_t>(index)] = static_cast<std::int32_t>(assignment.materials.size());
      assignment.materials.push_back(material(index));
    }
    const auto renumber = [&](std::int32_t& index) {
      index = index < 0 ? -1 : new_index[static_cast<std::size_t>(index)];
    };
    for (auto& surface : assigned_) renumber(surface.material);
    for (auto& face : faces_) renumber(face.material);
    assignment.surfaces = std::move(assigned_);
    assignment.faces = std::move(faces_);
  }

  const Environment& environment_;
  const std::vector<PhysicalMaterial>& library_;
  const RuleSet& rules_;
  const std::vector<MaterialOverride>& overrides_;
  RuleMatcher matcher_;
  OverrideTable table_;
  FindingCollector findings_;
  AssignmentChecks checks_;
  std::map<std::string, std::int32_t> by_id_;
  std::vector<std::int32_t> of_rule_;
  std::vector<AssignedSurface> assigned_;
  std::vector<AssignedFaces> faces_;
  std::map<std::int32_t, MaterialUse> uses_;  // by index into the library, which is sorted by id
  CoverageRow all_;
  Rows by_class_, by_storey_;
  std::optional<std::uint32_t> product_;  // that is being accounted for
  std::array<CoverageRow*, 3> rows_{};    // where it counts
  bool own_decided_ = false, asked_rules_ = false;
};

}  // namespace

Result<MaterialResult> assignMaterials(const Environment& environment, const std::vector<PhysicalMaterial>& library,
                                       const RuleSet& rules, const std::vector<MaterialOverride>& overrides,
                                       const AssignOptions& options, Progress& progress) {
  progress.stage("Measuring surfaces", 0, 0.7);
  TRY_ASSIGN(const auto pairs, measuredSurfaces(environment, progress));
  Assigner assigner(environment, library, rules, overrides, options.shift_m);
  TRY(assigner.checkIds());
  assigner.prepare();
  progress.stage("Assigning materials", 0.7, 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i % 256 == 0) {
      TRY(progress.check());
      progress.advance(static_cast<double>(i) / static_cast<double>(pairs.size()));
    }
    assigner.assign(pairs[i]);
  }
  progress.advance(1);
  return assigner.finish(options);
}

}  // namespace standpoint
