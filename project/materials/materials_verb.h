// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "project/fields.h"

namespace standpoint {

// What is said anew of the materials; the document keeps what was said before.
struct MaterialRequest {
  std::filesystem::path rules;                   // a file, or "default"; empty: as they are
  std::vector<std::filesystem::path> libraries;  // of own materials
  std::vector<std::string> forget;               // own materials, by id
  std::vector<MaterialOverride> assign;          // the material "rules" takes back what was said by that selector
  std::vector<std::string> accept, reopen;       // findings, by id
  std::string because;
  std::string instrument;
};
Result<Outcome> assignDocumentMaterials(const Document& document, const MaterialRequest& request, Progress& progress);
// SELECTOR=MATERIAL; a selector may hold "=" itself.
template <>
struct FieldValue<std::vector<MaterialOverride>> {
  static constexpr auto kKind = ParameterKind::pairs;
  static void describe(Parameter&) {}
  static Result<std::vector<MaterialOverride>> read(const nlohmann::json& texts);
  static nlohmann::json write(const std::vector<MaterialOverride>& overrides);
};
struct MaterialsOptions : MaterialRequest {
  std::string where;             // id of a material: its uses are answered
  std::filesystem::path report;  // to write
};
const Fields<MaterialsOptions>& materialsFields();
Result<Outcome> runMaterials(const Document& document, const MaterialsOptions& options, Progress& progress);

}  // namespace standpoint
