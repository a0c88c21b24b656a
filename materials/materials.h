// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// The library: every *.json of a folder, sorted by file name; entries by id. Unknown keys, missing sources and figures
// out of range are errors with their place.
Result<std::vector<PhysicalMaterial>> readMaterialLibrary(const std::filesystem::path& folder);

// A rule fits when each of its patterns that is not empty fits. Patterns are case-insensitive globs (`*`, `?`), several
// separated by `|`. The first rule that fits decides.
struct AssignmentRule {
  std::string ifc_class;      // of the product: "IfcWindow*"
  std::string material;       // of the surface or, where no rule knows its name, of the product: "*beton*|*concrete*"
  std::string name;           // of the product
  std::string colour;         // named band of the surface's colour: transparent, white, grey, black, red, brown, green, blue, …
  std::string assign;         // PhysicalMaterial::id
  bool hidden = false;        // such a material lies inside (insulation, studs): where a product has others, they are seen
};
Result<std::vector<AssignmentRule>> readAssignmentRules(const std::filesystem::path& file,
                                                        const std::vector<PhysicalMaterial>& library);

// What the user says for some products; later ones win over earlier ones and all win over rules.
// A selector is `#id`, a GlobalId, `class:IfcWall`, `name:*glass*`, `storey:…`, `material:…`.
struct MaterialOverride {
  std::string selector;
  std::string material;       // PhysicalMaterial::id
};

// Indices of the products that a selector means, ascending; empty when none. `material:` selects surfaces, see assign.
std::vector<std::uint32_t> select(const Environment& environment, const std::string& selector);

struct MaterialUse {
  std::string material;       // id; "" = unassigned
  double area_m2 = 0;
  std::vector<std::uint32_t> products;
};
struct MaterialFinding {
  std::string severity;       // "warning", "note"
  std::string source;         // "#1234"
  std::string message;        // "no rule fits material 'Isolatie' of IfcCovering 'Dak'"
};
struct MaterialReport {
  double coverage = 0;        // share of the tangible products' area that has a material
  double area_m2 = 0;
  std::vector<MaterialUse> uses;          // by falling area
  std::vector<MaterialFinding> findings;  // what is not assigned, and what contradicts itself (glass that is opaque, …)
};
struct MaterialResult {
  MaterialAssignment assignment;
  MaterialReport report;
};

Result<MaterialResult> assignMaterials(const Environment& environment, const std::vector<PhysicalMaterial>& library,
                                       const std::vector<AssignmentRule>& rules,
                                       const std::vector<MaterialOverride>& overrides, Progress& progress);

}  // namespace standpoint
