// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "materials/colour.h"
#include "materials/json_file.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

Result<void> checkGlobs(const std::string& globs, const JsonPlace& at) {
  for (std::size_t begin = 0; begin <= globs.size();) {
    const auto end = std::min(globs.find('|', begin), globs.size());
    const auto glob = globs.substr(begin, end - begin);
    if (glob.find_first_not_of(" \t") == std::string::npos) return at.unusable("holds an empty pattern");
    begin = end + 1;
  }
  return {};
}

Result<void> checkColours(const std::string& globs, const JsonPlace& at) {
  for (std::size_t begin = 0; begin < globs.size();) {
    const auto end = std::min(globs.find('|', begin), globs.size());
    const auto colour = globs.substr(begin, end - begin);
    if (std::find(kColourBands.begin(), kColourBands.end(), colour) == kColourBands.end()) {
      std::string known;
      for (const auto band : kColourBands) known += (known.empty() ? "" : ", ") + std::string(band);
      return at.unusable("'" + colour + "' is no colour; known are " + known);
    }
    begin = end + 1;
  }
  return {};
}

Result<AssignmentRule> readRule(const nlohmann::json& entry, const JsonPlace& at, const std::set<std::string>& ids) {
  if (auto checked = checkKeys(entry, at, {"ifc_class", "material", "name", "colour", "assign", "hidden"}); !checked)
    return failure(checked.error());
  AssignmentRule rule;
  for (const auto& [key, field] : {std::pair{"ifc_class", &AssignmentRule::ifc_class},
                                   std::pair{"material", &AssignmentRule::material},
                                   std::pair{"name", &AssignmentRule::name},
                                   std::pair{"colour", &AssignmentRule::colour}}) {
    if (!entry.contains(key)) continue;
    auto globs = readText(entry, at, key);
    if (!globs) return failure(globs.error());
    if (auto checked = checkGlobs(*globs, at / key); !checked) return failure(checked.error());
    rule.*field = std::move(*globs);
  }
  if (auto checked = checkColours(rule.colour, at / "colour"); !checked) return failure(checked.error());
  if (rule.ifc_class.empty() && rule.material.empty() && rule.name.empty() && rule.colour.empty())
    return at.unusable("has no pattern, so it would fit everything");
  auto assign = readText(entry, at, "assign");
  if (!assign) return failure(assign.error());
  if (!ids.contains(*assign)) return (at / "assign").unusable("'" + *assign + "' is not in the library");
  rule.assign = std::move(*assign);
  if (const auto hidden = entry.find("hidden"); hidden != entry.end()) {
    if (!hidden->is_boolean()) return (at / "hidden").unusable("must be true or false");
    if (rule.material.empty()) return (at / "hidden").unusable("needs a pattern for the material");
    rule.hidden = hidden->get<bool>();
  }
  return rule;
}

}  // namespace

Result<std::vector<AssignmentRule>> readAssignmentRules(const std::filesystem::path& file,
                                                        const std::vector<PhysicalMaterial>& library) {
  const auto entries = readJsonArray(file);
  if (!entries) return failure(entries.error());
  std::set<std::string> ids;
  for (const auto& material : library) ids.insert(material.id);
  std::vector<AssignmentRule> rules;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    auto rule = readRule((*entries)[i], JsonPlace{file.filename().string(), {}} / i, ids);
    if (!rule) return failure(rule.error());
    rules.push_back(std::move(*rule));
  }
  return rules;
}

}  // namespace standpoint
