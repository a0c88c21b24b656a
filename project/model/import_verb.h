// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "importers/importers.h"
#include "project/fields.h"

namespace standpoint {

// Reads one or more models into one environment. All of them share the first model's global shift and georeference; a
// file that states another CRS or map conversion than the first is reported.
Result<Outcome> importModels(const Document& document, const std::vector<std::filesystem::path>& files,
                             const ImportOptions& options, const std::string& crs, Progress& progress);

// The outcome of importModels, put beside what `document` has: its georeference, job and underlays stay, materials are
// assigned anew by its rules, and what was derived from the model as it was (lighter model, collision shapes) is
// dropped.
Result<Outcome> addImported(const Document& document, Outcome imported, Progress& progress);

// Takes in a changed model in place of the one that the document came from. The local frame stays (the old global
// shift), and with it stations, targets, control points and underlays; the user's materials follow their products by
// GlobalId (class and name, or id and name, where a file has none); a map position that the project has stays. What no
// longer has a product is kept and listed in `kept`. `changes` of the answer: added, removed and changed products, each
// with what changed. Of several models the one of the same file name is replaced, the others are read again from where
// they were.
Result<Outcome> updateModels(const Document& document, std::vector<std::filesystem::path> files,
                             const ImportOptions& options, const std::string& crs, Progress& progress);

// The global shift of a model: "auto", "none", or "E,N,H" in metres.
struct ShiftChoice {
  ShiftMode mode = ShiftMode::automatic;
  Eigen::Vector3d given_m = Eigen::Vector3d::Zero();
};
template <>
struct FieldValue<ShiftChoice> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<ShiftChoice> read(const nlohmann::json& text);
  static nlohmann::json write(const ShiftChoice& shift);
};

enum class FileUnit { metre, centimetre, millimetre, inch, foot };
std::span<const Choice<FileUnit>> choices(FileUnit);
std::span<const Choice<UpAxis>> choices(UpAxis);

struct AddOptions {
  std::vector<std::filesystem::path> files;
  ShiftChoice shift;
  std::string crs;           // "EPSG:n"; empty: as the model says
  std::optional<UpAxis> up;  // nothing: as the format says
  std::optional<FileUnit> unit;
};
struct ImportVerbOptions : AddOptions {
  std::filesystem::path output;  // the project's folder; for the door that writes it
  bool replace = false;          // likewise
  bool update = false;
};
const Fields<AddOptions>& addFields();
const Fields<ImportVerbOptions>& importFields();
Result<Outcome> runAdd(const Document& document, const AddOptions& options, Progress& progress);
Result<Outcome> runImport(const Document& document, const ImportVerbOptions& options, Progress& progress);

}  // namespace standpoint
