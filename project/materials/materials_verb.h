// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "project/answers.h"
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

struct RemedyOptions {  // of this verb: one click
  std::vector<std::string> assign;
};
const AnswerFields<RemedyOptions>& answerFields(const RemedyOptions*);
struct RemedyRow {
  std::string text, selector;
  std::optional<RemedyOptions> options;  // nothing where the material is the user's to choose
};
const AnswerFields<RemedyRow>& answerFields(const RemedyRow*);
struct FindingRow {
  std::string id, kind, severity, source, message, why;
  double area_m2 = 0;
  std::vector<std::string> products;  // ids
  std::vector<RemedyRow> remedies;
  std::string because;  // it was accepted; empty: it is open
};
const AnswerFields<FindingRow>& answerFields(const FindingRow*);
struct CoverageFractions {
  double area_m2 = 0;
  double coverage = 0, weak = 0;  // 0..1: that has a material; that has it by a rule of low confidence
};
const AnswerFields<CoverageFractions>& answerFields(const CoverageFractions*);
struct ClassCoverage : CoverageFractions {
  std::string ifc_class;
};
const AnswerFields<ClassCoverage>& answerFields(const ClassCoverage*);
struct StoreyCoverage : CoverageFractions {
  std::string storey;
};
const AnswerFields<StoreyCoverage>& answerFields(const StoreyCoverage*);
struct MaterialUseRow {
  std::string material;  // id; empty: unassigned
  double area_m2 = 0;
  std::vector<std::string> products;  // ids
};
const AnswerFields<MaterialUseRow>& answerFields(const MaterialUseRow*);
// Surfaces with the same reason stand together: a reason is a sentence, and a building has thousands of surfaces.
struct ReasonRow {
  std::string material;  // id; empty: unassigned
  std::string reason;
  double confidence = 0;                             // 0..1
  std::vector<std::array<std::string, 2>> surfaces;  // id of the product, name of the surface
};
const AnswerFields<ReasonRow>& answerFields(const ReasonRow*);
struct MaterialPlaces {  // where a material is
  std::string material;  // id
  double area_m2 = 0;
  std::vector<ProductIdentity> products;
};
const AnswerFields<MaterialPlaces>& answerFields(const MaterialPlaces*);
struct LibraryRow {  // that was taken in
  std::string file;
  std::vector<std::string> added, changed;  // ids
  std::vector<MaterialPlaces> used;         // of the changed ones
};
const AnswerFields<LibraryRow>& answerFields(const LibraryRow*);
struct MaterialsAnswer {
  double coverage = 0;  // 0..1, of the area
  double area_m2 = 0;
  std::vector<MaterialUseRow> materials;
  std::vector<FindingRow> findings;
  std::size_t open = 0;  // findings
  std::vector<ClassCoverage> by_class;
  std::vector<StoreyCoverage> by_storey;
  std::vector<ReasonRow> reasons;
  std::vector<LibraryRow> libraries;
  std::optional<MaterialPlaces> where;  // of the material that was asked for
};
const AnswerFields<MaterialsAnswer>& answerFields(const MaterialsAnswer*);
Result<Answered<MaterialsAnswer>> assignDocumentMaterials(const Document& document, const MaterialRequest& request,
                                                          Progress& progress);

Result<std::vector<PhysicalMaterial>> shippedMaterials();
// That a file of rules can be read, and assigns materials of `library`.
Result<void> checkRules(const std::filesystem::path& file, const std::vector<PhysicalMaterial>& library);

// From SELECTOR=MATERIAL; a selector may hold "=" itself.
std::vector<MaterialOverride> overridesFrom(const std::vector<std::string>& texts);
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
Result<Answered<MaterialsAnswer>> runMaterials(const Document& document, const MaterialsOptions& options,
                                               Progress& progress);

}  // namespace standpoint
