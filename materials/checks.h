// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "materials/areas.h"
#include "materials/findings.h"
#include "materials/materials.h"
#include "materials/rule_matcher.h"

namespace standpoint {

// Looks at each assignment as it is made, by rising product and surface, and tells the collector what is wrong or
// doubtful.
class AssignmentChecks {
 public:
  AssignmentChecks(const Environment& environment, const std::vector<PhysicalMaterial>& library, const RuleSet& rules,
                   FindingCollector& findings);

  void unassigned(const SurfaceOfProduct& pair);
  void gap(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  void byRule(const SurfaceOfProduct& pair, const PhysicalMaterial& material, const RuleMatcher::Decision& decision,
              const std::string& reason);
  void assigned(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  // After the last surface.
  void finish(const std::vector<double>& wavelengths_nm);

 private:
  struct Use {
    double area_m2 = 0;
    std::vector<std::uint32_t> products;
  };
  void transparency(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  void implausible(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  void thickness(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  double modelledThickness(const SurfaceOfProduct& pair);
  const PhysicalMaterial* paneOf(double thickness_m, double index) const;
  void nextProduct(std::uint32_t product);
  void closeProduct();
  static void addUse(FindingCollector::Extent& extent, const Use& fraction);
  void namesAssignedTwoWays();
  void withoutData(const std::vector<double>& wavelengths_nm);

  std::string surfaceText(const SurfaceOfProduct& pair) const;
  std::string selectorOf(const SurfaceOfProduct& pair) const;
  // Tells the finding of this surface; `describe` writes it out when it is the first of its like.
  template <class Describe>
  void tell(const char* kind, bool warning, const SurfaceOfProduct& pair, const PhysicalMaterial* about,
            Describe describe);

  const Environment& environment_;
  const std::vector<PhysicalMaterial>& library_;
  FindingCollector& findings_;
  struct ImplausiblePattern {
    Pattern ifc_class, assigned;
    std::string why;
  };
  WordTable words_;
  std::vector<ImplausiblePattern> implausible_;
  std::map<std::pair<std::string, const PhysicalMaterial*>, int> implausible_of_;  // by class: index, or -1
  using Like =
      std::tuple<const char*, std::uint32_t, const PhysicalMaterial*, std::string>;  // kind, surface, material, product
  std::map<Like, FindingCollector::Extent*> told_;
  std::map<std::pair<std::uint32_t, const PhysicalMaterial*>, Use> uses_;  // of a surface and its material
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> thickness_;    // of a mesh's surface
  std::optional<std::uint32_t> product_;                                   // whose surfaces are being looked at
  double product_m2_ = 0;
  bool has_pane_ = false;
};

}  // namespace standpoint
