// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/import_verb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "project/answers.h"
#include "project/materials/materials_verb.h"
#include "project/model/global_ids.h"
#include "project/model/import_clouds.h"
#include "project/model/model_verbs.h"
#include "survey/geodesy.h"

namespace standpoint {

namespace {

using nlohmann::json;

// Appends `model` to `into`, whose frame differs from the model's by whole metres.
void appendEnvironment(Environment& into, Environment&& model, const Eigen::Vector3d& shift_difference_m) {
  const auto mesh_offset = static_cast<std::uint32_t>(into.meshes.size());
  const auto surface_offset = static_cast<std::uint32_t>(into.surfaces.size());
  const auto product_offset = static_cast<std::uint32_t>(into.products.size());
  const auto spatial_offset = static_cast<std::int32_t>(into.spatial.size());
  for (const auto& mesh : model.meshes) {
    auto moved = std::make_shared<Mesh>(*mesh);
    for (auto& s : moved->surface_of_triangle) s += surface_offset;
    into.meshes.push_back(std::move(moved));
  }
  const auto image_offset = static_cast<std::int32_t>(into.images.size());
  for (auto& surface : model.surfaces) {
    if (surface.image >= 0) surface.image += image_offset;
    into.surfaces.push_back(std::move(surface));
  }
  into.images.insert(into.images.end(), model.images.begin(), model.images.end());
  for (auto& product : model.products) {
    if (product.container >= 0) product.container += spatial_offset;
    if (product.whole >= 0) product.whole += static_cast<std::int32_t>(product_offset);
    into.products.push_back(std::move(product));
  }
  for (auto instance : model.instances) {
    instance.mesh += mesh_offset;
    instance.product += product_offset;
    instance.world_from_mesh.pretranslate(shift_difference_m);
    into.instances.push_back(instance);
  }
  for (auto& node : model.spatial) {
    if (node.parent >= 0) node.parent += spatial_offset;
    into.spatial.push_back(std::move(node));
  }
}

bool sameConversion(const Georeference& a, const Georeference& b) {
  if (a.map_from_file.has_value() != b.map_from_file.has_value()) return false;
  if (!a.map_from_file) return true;
  const Eigen::Vector3d probe(10, 20, 3);
  return (mapFromFile(*a.map_from_file, probe) - mapFromFile(*b.map_from_file, probe)).norm() < 1e-4;
}

// Volume in m³ of the placed closed meshes; nothing when one of them is open.
std::vector<std::optional<double>> productVolumes(const Environment& environment) {
  std::vector<double> of_mesh(environment.meshes.size());
  std::vector<bool> closed(environment.meshes.size());
  for (std::size_t i = 0; i < of_mesh.size(); ++i) {
    closed[i] = isClosed(*environment.meshes[i]);
    if (closed[i]) of_mesh[i] = std::abs(volume(*environment.meshes[i]));
  }
  std::vector<std::optional<double>> result(environment.products.size());
  std::vector<bool> open(environment.products.size());
  for (const auto& i : environment.instances) {
    if (!closed[i.mesh]) open[i.product] = true;
    if (open[i.product]) continue;
    const double scaled = of_mesh[i.mesh] * std::abs(i.world_from_mesh.linear().determinant());
    result[i.product] = result[i.product].value_or(0) + scaled;
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    if (open[i]) result[i].reset();
  return result;
}

// From the project down to where it stands: "House / Block A / Ground".
std::string placeOf(const Environment& environment, const Product& product) {
  std::string path;
  for (std::int32_t n = product.container; n >= 0; n = environment.spatial[static_cast<std::size_t>(n)].parent) {
    const auto& node = environment.spatial[static_cast<std::size_t>(n)];
    const auto& word = node.name.empty() ? node.ifc_class : node.name;
    path = path.empty() ? word : word + " / " + path;
  }
  return path;
}

using PropertySets = std::map<std::string, std::map<std::string, std::variant<std::string, std::vector<std::string>>>>;

// {set: {name: value}}; where a name stands several times in a set, its values are a list.
PropertySets propertySets(const std::vector<Property>& properties) {
  PropertySets sets;
  for (const auto& p : properties) {
    const auto [at, is_new] = sets[p.set].try_emplace(p.name, p.value);
    if (is_new) continue;
    auto& values = at->second;
    if (const auto* first = std::get_if<std::string>(&values)) values = std::vector<std::string>{*first};
    std::get<std::vector<std::string>>(values).push_back(p.value);
  }
  return sets;
}

std::vector<ImportedNode> nodeRows(const Environment& environment) {
  std::vector<ImportedNode> rows;
  for (const auto& n : environment.spatial) {
    rows.push_back({{n.id, n.global_id, n.ifc_class, n.name}, {}, n.elevation_m, n.properties});
    if (n.parent >= 0) rows.back().parent = environment.spatial[static_cast<std::size_t>(n.parent)].id;
  }
  return rows;
}

std::vector<ImportedLook> lookRows(const Environment& environment) {
  std::vector<ImportedLook> rows;
  for (const auto& s : environment.surfaces) {
    rows.push_back({s.name, s.source, {s.colour.r, s.colour.g, s.colour.b, s.colour.a}, {}});
    if (s.image >= 0) rows.back().image = environment.images[static_cast<std::size_t>(s.image)]->name;
  }
  return rows;
}

using SurfaceAreas = std::map<std::uint32_t, double>;  // m² by surface

SurfaceAreas surfaceAreas(const Mesh& mesh, const Eigen::Matrix3d& linear) {
  SurfaceAreas areas;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const Eigen::Vector3d a = mesh.positions[t[0]].cast<double>();
    const Eigen::Vector3d u = linear * (mesh.positions[t[1]].cast<double>() - a),
                          v = linear * (mesh.positions[t[2]].cast<double>() - a);
    areas[mesh.surface_of_triangle[k]] += u.cross(v).norm() / 2;
  }
  return areas;
}

// What each product shows: a wall of several layers has several. Meshes that are placed often are measured once.
std::vector<SurfaceAreas> productSurfaces(const Environment& environment) {
  std::vector<SurfaceAreas> of_mesh(environment.meshes.size()), result(environment.products.size());
  for (const auto& i : environment.instances) {
    const Eigen::Matrix3d linear = i.world_from_mesh.linear();
    const bool rigid = (linear.transpose() * linear).isIdentity(1e-9);
    auto& kept = of_mesh[i.mesh];
    if (rigid && kept.empty()) kept = surfaceAreas(*environment.meshes[i.mesh], Eigen::Matrix3d::Identity());
    for (const auto& [surface, area] : rigid ? kept : surfaceAreas(*environment.meshes[i.mesh], linear))
      result[i.product][surface] += area;
  }
  return result;
}

std::vector<ImportedProduct> productRows(const Environment& environment, const Eigen::Vector3d& shift_m) {
  const auto product_bounds = productBounds(environment);
  const auto volumes = productVolumes(environment);
  const auto surfaces = productSurfaces(environment);
  std::vector<std::uint64_t> triangles(environment.products.size());
  for (const auto& i : environment.instances) triangles[i.product] += environment.meshes[i.mesh]->triangles.size();
  std::vector<ImportedProduct> rows;
  for (std::size_t i = 0; i < environment.products.size(); ++i) {
    const auto& p = environment.products[i];
    auto& row = rows.emplace_back(ImportedProduct{identityOf(p)});
    row.predefined_type = p.predefined_type;
    row.type = p.type_name;
    row.storey = p.storey;
    row.place = placeOf(environment, p);
    if (p.whole >= 0) row.whole = environment.products[static_cast<std::size_t>(p.whole)].id;
    row.tangible = p.tangible;
    row.groups = p.groups;
    row.triangles = triangles[i];
    row.bounds_m = fileBounds(product_bounds[i], shift_m);
    row.volume_m3 = volumes[i];
    row.materials = p.materials;
    row.layers = p.layers;
    for (const auto& [surface, area] : surfaces[i])
      row.surfaces.push_back({surface, environment.surfaces[surface].name, area});
    row.properties = p.properties;
  }
  return rows;
}

double metresOf(FileUnit unit) {
  switch (unit) {
    case FileUnit::metre: return 1;
    case FileUnit::centimetre: return 0.01;
    case FileUnit::millimetre: return 0.001;
    case FileUnit::inch: return 0.0254;
    case FileUnit::foot: return 0.3048;
  }
  return 1;
}

ImportOptions importOptions(const AddOptions& options) {
  ImportOptions result;
  result.shift = options.shift.mode;
  result.given_shift_m = options.shift.given_m;
  if (options.up) result.up = *options.up;
  if (options.unit) result.metres_per_unit = metresOf(*options.unit);
  result.types = options.types;
  return result;
}

}  // namespace

Result<Answered<ImportAnswer>> importModels(const Document& document, const std::vector<std::filesystem::path>& files,
                                            const ImportOptions& options, const std::string& crs, Progress& progress) {
  if (files.empty()) return failure(ErrorKind::usage, "specify at least one model file", "import");
  Answered<ImportAnswer> outcome;
  outcome.document.name = document.name.empty() ? files.front().stem().string() : document.name;
  Environment environment;
  Georeference georeference;
  ImportOptions each = options;
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.stage("Import " + files[i].filename().string(), static_cast<double>(i) / static_cast<double>(files.size()),
                   static_cast<double>(i + 1) / static_cast<double>(files.size()));
    TRY_ASSIGN(auto model, importFile(files[i], each, progress));
    if (auto wrong = validate(model.environment); !wrong.empty())
      return failure(ErrorKind::internal, "internal error: the importer produced an inconsistent model: " + wrong,
                     files[i].string());
    if (files.size() > 1)
      for (auto& issue : model.report.issues) issue.source = files[i].filename().string() + " " + issue.source;
    outcome.report.append(model.report);
    outcome.document.sources.push_back(files[i].string());
    if (i == 0) {
      environment = std::move(model.environment);
      georeference = std::move(model.georeference);
      each.shift = ShiftMode::given;
      each.given_shift_m = georeference.shift_m;
      continue;
    }
    if (model.georeference.crs != georeference.crs || !sameConversion(model.georeference, georeference))
      outcome.report.warn(files[i].filename().string(),
                          "georeference differs from the first file; using that of the first file");
    appendEnvironment(environment, std::move(model.environment), model.georeference.shift_m - georeference.shift_m);
  }
  warnOfSharedGlobalIds(environment, 0, outcome.report);
  const bool building = std::any_of(environment.spatial.begin(), environment.spatial.end(),
                                    [](const SpatialNode& n) { return n.ifc_class == "IfcBuilding"; });
  if (building && crs.empty() && georeference.crs.empty() && !georeference.map_from_file)
    outcome.report.warn("georeference",
                        "the model has no georeference; set its coordinate reference system, origin and rotation");
  if (!crs.empty()) {
    TRY_ASSIGN(auto found, findCrs(crs));
    georeference.crs = found.code;
  }
  outcome.answer = {productRows(environment, georeference.shift_m),
                    nodeRows(environment),
                    lookRows(environment),
                    triangleCount(environment),
                    fileBounds(bounds(environment), georeference.shift_m),
                    georeference,
                    {},
                    {}};
  outcome.description = fmt::format("Imported {}: {} products, {} triangles", files.front().filename().string(),
                                    environment.products.size(), sceneTriangleCount(environment));
  outcome.document.imported = std::make_shared<const Environment>(std::move(environment));
  outcome.document.georeference = std::make_shared<const Georeference>(std::move(georeference));
  outcome.document.import_report = std::make_shared<const Report>(outcome.report);
  outcome.document.job = std::make_shared<const Job>(Job{outcome.document.name, {}, {}, {}});
  return outcome;
}

Result<ShiftChoice> FieldValue<ShiftChoice>::read(const json& value) {
  const auto text = value.get<std::string>();
  if (text == "auto") return ShiftChoice{};
  if (text == "none") return ShiftChoice{ShiftMode::none, Eigen::Vector3d::Zero()};
  const auto numbers = parseNumbers(text);
  if (!numbers || numbers->size() != 3)
    return failure(ErrorKind::usage, fmt::format("invalid shift '{}': use auto, none or E,N,H in metres", text));
  return ShiftChoice{ShiftMode::given, vectorFrom(*numbers)};
}

json FieldValue<ShiftChoice>::write(const ShiftChoice& shift) {
  if (shift.mode == ShiftMode::given)
    return fmt::format("{},{},{}", shift.given_m.x(), shift.given_m.y(), shift.given_m.z());
  return shift.mode == ShiftMode::none ? "none" : "auto";
}

std::span<const Choice<FileUnit>> choices(FileUnit) {
  static constexpr std::array kUnits = {Choice<FileUnit>{"m", FileUnit::metre},
                                        Choice<FileUnit>{"cm", FileUnit::centimetre},
                                        Choice<FileUnit>{"mm", FileUnit::millimetre},
                                        Choice<FileUnit>{"in", FileUnit::inch}, Choice<FileUnit>{"ft", FileUnit::foot}};
  return kUnits;
}

std::span<const Choice<UpAxis>> choices(UpAxis) {
  static constexpr std::array kAxes = {Choice<UpAxis>{"y", UpAxis::y}, Choice<UpAxis>{"z", UpAxis::z}};
  return kAxes;
}

namespace {
constexpr const char* kTypesHelp =
    "IFC: import types that no product shows, with their shapes, as products at the origin";
}  // namespace

const Fields<AddOptions>& addFields() {
  using O = AddOptions;
  static const Fields<O> fields = {{"files", &O::files, "the model files", {.positional = true, .required = true}},
                                   {"shift", &O::shift, "global shift: auto, none, or E,N,H", {.unit = "m"}},
                                   {"crs", &O::crs, "coordinate reference system, as EPSG:n"},
                                   {"up", &O::up, "up axis of the file (default: that of the format)"},
                                   {"unit", &O::unit, "unit of the file's coordinates (default: that of the format)"},
                                   {"types", &O::types, kTypesHelp}};
  return fields;
}

const Fields<ImportVerbOptions>& importFields() {
  using O = ImportVerbOptions;
  static const Fields<O> fields = {
      {"files", &O::files, "the model and point-cloud files", {.positional = true, .required = true}},
      {"output", &O::output, "folder of the new project"},
      {"replace", &O::replace, "replace the contents of that folder"},
      {"update", &O::update, "read a changed model; keep stations, targets and materials, and list the changes"},
      {"shift", &O::shift, "global shift: auto, none, or E,N,H", {.unit = "m"}},
      {"crs", &O::crs, "coordinate reference system, as EPSG:n"},
      {"up", &O::up, "up axis of the file (default: that of the format)"},
      {"unit", &O::unit, "unit of the file's coordinates (default: that of the format)"},
      {"types", &O::types, kTypesHelp}};
  return fields;
}

const AnswerFields<ImportedSurface>& answerFields(const ImportedSurface*) {
  using A = ImportedSurface;
  static const AnswerFields<A> fields = {{"surface", &A::surface}, {"name", &A::name}, {"area", &A::area_m2}};
  return fields;
}

const AnswerFields<MaterialLayer>& answerFields(const MaterialLayer*) {
  using A = MaterialLayer;
  static const AnswerFields<A> fields = {{"material", &A::name}, {"thickness", &A::thickness_m}};
  return fields;
}

const AnswerFields<ImportedProduct>& answerFields(const ImportedProduct* product) {
  using A = ImportedProduct;
  static const auto fields = withBases<A>({{"predefined_type", &A::predefined_type},
                                           {"type", &A::type},
                                           {"storey", &A::storey},
                                           {"place", &A::place},
                                           {"whole", &A::whole},
                                           {"tangible", &A::tangible},
                                           {"groups", &A::groups},
                                           {"triangles", &A::triangles},
                                           {"bounds", &A::bounds_m},
                                           {"volume", &A::volume_m3},
                                           {"materials", &A::materials},
                                           {"layers", &A::layers},
                                           {"surfaces", &A::surfaces},
                                           {"properties", &A::properties, propertySets}},
                                          answerFields(static_cast<const ProductIdentity*>(product)));
  return fields;
}

const AnswerFields<ImportedNode>& answerFields(const ImportedNode* node) {
  using A = ImportedNode;
  static const auto fields = withBases<A>(
      {{"parent", &A::parent}, {"elevation", &A::elevation_m}, {"properties", &A::properties, propertySets}},
      answerFields(static_cast<const ProductIdentity*>(node)));
  return fields;
}

const AnswerFields<ImportedLook>& answerFields(const ImportedLook*) {
  using A = ImportedLook;
  static const AnswerFields<A> fields = {
      {"name", &A::name}, {"source", &A::source}, {"colour", &A::colour}, {"image", &A::image, kLeftOut}};
  return fields;
}

const AnswerFields<ImportAnswer>& answerFields(const ImportAnswer*) {
  using A = ImportAnswer;
  static const AnswerFields<A> fields = {{"products", &A::products},   {"spatial", &A::spatial},
                                         {"surfaces", &A::surfaces},   {"triangles", &A::triangles},
                                         {"bounds", &A::bounds_m},     {"georeference", &A::georeference},
                                         {"underlays", &A::underlays}, {"changes", &A::changes, kLeftOut}};
  return fields;
}

Result<Answered<ImportAnswer>> runImport(const Document& document, const ImportVerbOptions& options,
                                         Progress& progress) {
  const auto typed = importOptions(options);
  const auto [models, clouds] = sorted(options.files);
  if (options.update) {
    if (!clouds.empty())
      return failure(ErrorKind::usage, "a point cloud is no model to update from; add it as an underlay",
                     clouds.front().string());
    return updateModels(document, models, typed, options.crs, progress);
  }
  if (models.empty() && !clouds.empty()) return importClouds(document, clouds, options, progress);
  auto imported = importModels(document, models, typed, options.crs, progress);
  if (imported) TRY(addClouds(*imported, clouds, progress));
  return imported;
}

Result<Answered<ImportAnswer>> addImported(const Document& document, Answered<ImportAnswer> imported,
                                           Progress& progress) {
  const Georeference &mine = *document.georeference, &its = *imported.document.georeference;
  Answered<ImportAnswer> outcome{document, std::move(imported.answer), std::move(imported.report)};
  const std::string source = imported.document.sources.empty()
                                 ? ""
                                 : std::filesystem::path(imported.document.sources.front()).filename().string();
  if (its.crs != mine.crs || !sameConversion(its, mine))
    outcome.report.warn(source, "georeference differs from the environment; using that of the environment");
  auto environment = std::make_shared<Environment>(*document.imported);
  const auto products = imported.document.imported->products.size();
  appendEnvironment(*environment, Environment(*imported.document.imported), its.shift_m - mine.shift_m);
  warnOfSharedGlobalIds(*environment, document.imported->products.size(), outcome.report);
  Report all = *document.import_report;
  all.append(outcome.report);
  Document& d = outcome.document;
  d.imported = std::move(environment);
  d.import_report = std::make_shared<const Report>(std::move(all));
  d.sources.insert(d.sources.end(), imported.document.sources.begin(), imported.document.sources.end());
  if (d.simplified || d.collision)
    outcome.report.note(source, "the simplified model and the collision shapes are out of date; compute them again");
  d.simplified.reset();
  d.collision.reset();
  if (d.materials) {
    TRY_ASSIGN(auto assigned, assignDocumentMaterials(d, {}, progress));
    d.materials = assigned.document.materials;
  }
  outcome.description = fmt::format("Added {}: {} products", source, products);
  return outcome;
}

Result<Answered<ImportAnswer>> runAdd(const Document& document, const AddOptions& options, Progress& progress) {
  if (const auto clouds = sorted(options.files).clouds; !clouds.empty())
    return failure(ErrorKind::usage, "a point cloud is no model; add it as an underlay", clouds.front().string());
  auto imported = importModels(Document(), options.files, importOptions(options), options.crs, progress);
  if (!imported) return imported;
  return addImported(document, *std::move(imported), progress);
}

}  // namespace standpoint
