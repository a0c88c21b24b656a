// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "core/progress.h"
#include "core/result.h"
#include "materials/pattern.h"

namespace standpoint {

// The library: every *.json of a folder, sorted by file name; entries by id. Unknown keys, missing sources and figures
// out of range are errors with their place.
Result<std::vector<PhysicalMaterial>> readMaterialLibrary(const std::filesystem::path& folder);

// A user's file of the same form. It may refer to the sources of the shipped library, and wet its materials.
Result<std::vector<PhysicalMaterial>> readOwnMaterials(const std::filesystem::path& file,
                                                       const std::filesystem::path& shipped_folder);

// Own materials stand in for those of the library that have their id.
std::vector<PhysicalMaterial> withOwn(std::vector<PhysicalMaterial> library, const std::vector<PhysicalMaterial>& own);

// What nobody measured of a material, in words.
std::vector<std::string> gapsOf(const PhysicalMaterial& material);

struct ValueRange {
  float from = 0, to = 1;
};

// A rule fits when each of its patterns that is not empty and each of its ranges fits. The first rule that fits
// decides.
struct AssignmentRule {
  std::string ifc_class;  // of the product: "IfcWindow*"
  std::string material;   // of the surface or, where no rule knows its name, of the product: "{concrete}&!{wood}"
  std::string name;       // of the product
  std::string
      colour;  // named band of the surface's colour: transparent, white, grey, black, red, brown, green, blue, …
  std::string assign;     // PhysicalMaterial::id
  bool hidden = false;    // such a material lies inside (insulation, studs): where a product has others, they are seen
  double confidence = 1;  // 0..1
  std::string type;       // name of the product's type
  std::string storey;
  std::string group;  // "IfcSystem Heating", or what else the product is assigned to
  std::string layer;  // one of the drawing's, on which the product's shape lies: "A-WALL"
  std::optional<ValueRange> metallic, roughness,
      transmission;   // of the surface; where the file is silent, it does not fit
  std::string place;  // "rule 14 of default.json"
};

// What no building has, whatever assigned it: "a mirror for a floor".
struct Implausible {
  std::string ifc_class;  // pattern
  std::string assigned;   // pattern for PhysicalMaterial::id
  std::string why;
};

struct RuleSet {
  RuleSet() = default;
  RuleSet(std::vector<AssignmentRule> rules_) : rules(std::move(rules_)) {}
  WordLists words;  // that patterns refer to
  std::vector<AssignmentRule> rules;
  std::vector<Implausible> implausible;
  std::size_t own = 0;  // so many of the first rules are the user's, before the default ones
};

// A file of rules: {"words": {…}, "rules": […], "implausible": […], "then": "default"}. With `then` the default rules
// come after its own, with their words; without it the file's are all there are.
Result<RuleSet> readAssignmentRules(const std::filesystem::path& file, const std::vector<PhysicalMaterial>& library,
                                    const std::filesystem::path& default_file = {});
// The same from the text of such a file.
Result<RuleSet> parseAssignmentRules(const std::string& text, const std::string& file_name,
                                     const std::vector<PhysicalMaterial>& library,
                                     const std::filesystem::path& default_file);
// The text of a file of rules, when it is not too large.
Result<std::string> readRulesText(const std::filesystem::path& file);

// What the user says for some products or surfaces; later ones win over earlier ones and all win over rules.
// A selector is `#id`, a GlobalId, or conditions joined by `&`: class:IfcWall, type:…, name:*glass*, storey:…, group:…,
// layer:…, material:…, colour:red. With @x,y,z behind it, it means only the faces that look within 10° of that
// direction; with @x,y,z@X,Y,Z only that one of them which is at this point of the file frame, as far as it reaches
// over shared edges.
struct MaterialOverride {
  std::string selector;
  std::string material;  // PhysicalMaterial::id
};

// Indices of the products that a selector means, ascending; empty when none.
std::vector<std::uint32_t> select(const Environment& environment, const std::string& selector);

// The id or GlobalId that a selector begins with, without what follows it; empty when it begins with a condition.
std::string_view selectedProduct(std::string_view selector);

// A user has seen a finding and lets it stand, as long as its cause is the same.
struct AcceptedFinding {
  std::string finding;  // MaterialFinding::id
  std::string cause;    // MaterialFinding::cause, then
  std::string because;
};

struct MaterialUse {
  std::string material;  // id; "" = unassigned
  double area_m2 = 0;
  std::vector<std::uint32_t> products;
};

// One click: what to assign. An empty material is the user's to choose.
struct Remedy {
  std::string text;  // "take them for glass"
  std::string selector;
  std::string material;
  std::vector<std::string> more = {};  // selectors that it goes for as well
};
// That follow it with that material, and as the verb `materials` takes them as `assign`.
std::vector<MaterialOverride> overridesBy(const Remedy& remedy, const std::string& material);
std::vector<std::string> assignWords(const Remedy& remedy, const std::string& material);

struct MaterialFinding {
  std::string severity;  // "warning", "note"
  std::string source;    // "#1234", the first product
  std::string message;   // "no rule fits material 'Isolatie' of IfcCovering 'Dak'"
  std::string id;        // "unassigned-1f2e3d4c": of kind and subject, the same in every run
  std::string kind;      // "unassigned", "weak-rule", …: docs/reference/materials.md lists them
  std::string why;       // why it matters
  std::string cause;     // a fingerprint: changes when other products, rules or materials are behind it
  std::string because;   // the user accepted it; empty = open
  double area_m2 = 0;
  std::vector<std::uint32_t> products;
  std::vector<Remedy> remedies;
};

// Of a class, a storey, or the whole.
struct CoverageRow {
  std::string name;
  double area_m2 = 0;
  double assigned_m2 = 0;
  double weak_m2 = 0;  // of what is assigned: by a rule of little confidence
};
struct MaterialReport {
  double coverage = 0;  // share of the tangible products' area that has a material
  double area_m2 = 0;
  std::vector<MaterialUse> uses;                 // by falling area
  std::vector<MaterialFinding> findings;         // what is not assigned, and what contradicts itself; open ones first
  std::vector<CoverageRow> by_class, by_storey;  // by falling area
};
struct MaterialResult {
  MaterialAssignment assignment;
  MaterialReport report;
};

// Below this a rule is a guess that one should look at.
constexpr double kWeakConfidence = 0.5;

struct AssignOptions {
  std::vector<AcceptedFinding> accepted;
  std::vector<double> wavelengths_nm;  // of the instruments that shall scan: a material without data there is a finding
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();  // Georeference::shift_m: selectors name points of the file frame
};

Result<MaterialResult> assignMaterials(const Environment& environment, const std::vector<PhysicalMaterial>& library,
                                       const RuleSet& rules, const std::vector<MaterialOverride>& overrides,
                                       const AssignOptions& options, Progress& progress);

}  // namespace standpoint
