// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "materials/areas.h"
#include "materials/findings.h"
#include "materials/materials.h"
#include "materials/rule_matcher.h"

namespace standpoint {

// Looks at each assignment as it is made, by rising product and surface, and tells the collector what is wrong or doubtful.
class AssignmentChecks {
 public:
  AssignmentChecks(const Environment& environment, const std::vector<PhysicalMaterial>& library, const RuleSet& rules, FindingCollector& findings);

  void unassigned(const SurfaceOfProduct& pair);
  void gap(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  void byRule(const SurfaceOfProduct& pair, const PhysicalMaterial& material, const RuleMatcher::Decision& decision, const std::string& reason);
  void assigned(const SurfaceOfProduct& pair, const PhysicalMaterial& material);
  // After the last surface.
  void finish(const std::vector<double>& wavelengths_nm);

 private:
  struct Share {
    std::uint32_t first_product = 0;
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
  void namesAssignedTwoWays();
  void withoutData(const std::vector<double>& wavelengths_nm);

  std::string surfaceText(const SurfaceOfProduct& pair) const;
  std::string selectorOf(const SurfaceOfProduct& pair) const;
  FindingCollector::Cause cause(const char* kind, bool warning, const SurfaceOfProduct& pair, const std::string& about) const;

  const Environment& environment_;
  const std::vector<PhysicalMaterial>& library_;
  FindingCollector& findings_;
  struct ImplausiblePattern {
    Pattern ifc_class, assigned;
    std::string why;
  };
  WordTable words_;
  std::vector<ImplausiblePattern> implausible_;
  std::map<std::pair<std::string, std::string>, int> implausible_of_;   // class and material: index, or -1
  std::map<std::string, std::map<std::string, Share>> by_name_;         // surface's name, then material
  std::map<std::string, std::pair<const PhysicalMaterial*, Share>> in_use_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> thickness_; // of a mesh's surface
  std::optional<std::uint32_t> product_;                                // whose surfaces are being looked at
  double product_m2_ = 0;
  bool has_pane_ = false;
};

}  // namespace standpoint
