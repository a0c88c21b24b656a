// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "importers/importers.h"
#include "project/answers.h"
#include "project/fields.h"
#include "project/survey/underlays.h"

namespace standpoint {

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
  bool types = false;  // of an IFC file: those that no product shows become products
};
struct ImportVerbOptions : AddOptions {
  std::filesystem::path output;  // the project's folder; for the door that writes it
  bool replace = false;          // likewise
  bool update = false;
};
const Fields<AddOptions>& addFields();
const Fields<ImportVerbOptions>& importFields();

struct ImportedSurface {      // of a product
  std::uint32_t surface = 0;  // index into ImportAnswer::surfaces
  std::string name;
  double area_m2 = 0;
};
const AnswerFields<ImportedSurface>& answerFields(const ImportedSurface*);
const AnswerFields<MaterialLayer>& answerFields(const MaterialLayer*);
struct ImportedProduct : ProductIdentity {
  std::string predefined_type, type, storey;
  std::string place;                 // from the project down: "House / Block A / Ground"
  std::optional<std::string> whole;  // id of the product that it is a part of
  bool tangible = true;
  std::vector<std::string> groups;
  std::uint64_t triangles = 0;
  Bounds bounds_m;                  // in the model's file frame
  std::optional<double> volume_m3;  // where its meshes are closed
  std::vector<std::string> materials;
  std::vector<MaterialLayer> layers;
  std::vector<ImportedSurface> surfaces;
  std::vector<Property> properties;
};
const AnswerFields<ImportedProduct>& answerFields(const ImportedProduct*);
struct ImportedNode : ProductIdentity {  // of the spatial structure
  std::optional<std::string> parent;     // id
  double elevation_m = 0;
  std::vector<Property> properties;
};
const AnswerFields<ImportedNode>& answerFields(const ImportedNode*);
struct ImportedLook {  // of a surface of the file
  std::string name, source;
  std::array<float, 4> colour = {};  // red, green, blue, alpha
  std::optional<std::string> image;
};
const AnswerFields<ImportedLook>& answerFields(const ImportedLook*);

struct UpdatedProduct : ProductIdentity {
  bool geometry = false, material = false;  // what changed
  std::vector<std::string> properties;      // that changed
};
const AnswerFields<UpdatedProduct>& answerFields(const UpdatedProduct*);
struct UpdateKept {  // what was said of a product that is gone
  std::string what, selector;
  std::optional<std::string> treatment, material;  // one of them: that is `what`
  ProductIdentity product;
};
const AnswerFields<UpdateKept>& answerFields(const UpdateKept*);
struct UpdateCounts {  // of products
  std::size_t added = 0, removed = 0, changed = 0, unchanged = 0;
  std::size_t geometry = 0, material = 0, properties = 0;  // of the changed ones
};
const AnswerFields<UpdateCounts>& answerFields(const UpdateCounts*);
struct UpdateChanges {
  UpdateCounts counts;
  std::vector<ProductIdentity> added, removed;
  std::vector<UpdatedProduct> changed;
  std::vector<UpdateKept> kept;
};
const AnswerFields<UpdateChanges>& answerFields(const UpdateChanges*);

struct ImportAnswer {
  std::vector<ImportedProduct> products;
  std::vector<ImportedNode> spatial;
  std::vector<ImportedLook> surfaces;
  std::size_t triangles = 0;
  Bounds bounds_m;  // in the model's file frame
  Georeference georeference;
  std::vector<UnderlayRow> underlays;    // point clouds that came with the models, or alone
  std::optional<UpdateChanges> changes;  // of an update
};
const AnswerFields<ImportAnswer>& answerFields(const ImportAnswer*);

// Reads one or more models into one environment. All of them share the first model's global shift and georeference; a
// file that states another CRS or map conversion than the first is reported.
Result<Answered<ImportAnswer>> importModels(const Document& document, const std::vector<std::filesystem::path>& files,
                                            const ImportOptions& options, const std::string& crs, Progress& progress);

// The outcome of importModels, put beside what `document` has: its georeference, job and underlays stay, materials are
// assigned anew by its rules, and what was derived from the model as it was (lighter model, collision shapes) is
// dropped.
Result<Answered<ImportAnswer>> addImported(const Document& document, Answered<ImportAnswer> imported,
                                           Progress& progress);

// Takes in a changed model in place of the one that the document came from. The local frame stays (the old global
// shift), and with it stations, targets, control points and underlays; the user's materials follow their products by
// GlobalId (class and name, or id and name, where a file has none); a map position that the project has stays. What no
// longer has a product is kept and listed in `kept`. `changes` of the answer:
// added, removed and changed products, each
// with what changed. Of several models the one of the same file name is replaced, the others are read again from where
// they were.
Result<Answered<ImportAnswer>> updateModels(const Document& document, std::vector<std::filesystem::path> files,
                                            const ImportOptions& options, const std::string& crs, Progress& progress);

Result<Answered<ImportAnswer>> runAdd(const Document& document, const AddOptions& options, Progress& progress);
Result<Answered<ImportAnswer>> runImport(const Document& document, const ImportVerbOptions& options,
                                         Progress& progress);

}  // namespace standpoint
