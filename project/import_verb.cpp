// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/import_verb.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "project/answers.h"
#include "project/geodesy.h"

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
  for (auto& surface : model.surfaces) {
    if (surface.image >= 0) surface.image += static_cast<std::int32_t>(into.images.size());
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

// Volume in m³ of the placed closed meshes; null when one of them is open.
std::vector<json> productVolumes(const Environment& environment) {
  std::vector<double> of_mesh(environment.meshes.size());
  std::vector<bool> closed(environment.meshes.size());
  for (std::size_t i = 0; i < of_mesh.size(); ++i) {
    closed[i] = isClosed(*environment.meshes[i]);
    if (closed[i]) of_mesh[i] = std::abs(volume(*environment.meshes[i]));
  }
  std::vector<json> result(environment.products.size());
  std::vector<bool> open(environment.products.size());
  for (const auto& i : environment.instances) {
    if (!closed[i.mesh]) open[i.product] = true;
    if (open[i.product]) continue;
    const double scaled = of_mesh[i.mesh] * std::abs(i.world_from_mesh.linear().determinant());
    result[i.product] = (result[i.product].is_null() ? 0.0 : result[i.product].get<double>()) + scaled;
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    if (open[i]) result[i] = nullptr;
  return result;
}

json productRows(const Environment& environment, const Eigen::Vector3d& shift_m) {
  const auto product_bounds = productBounds(environment);
  const auto volumes = productVolumes(environment);
  std::vector<std::uint64_t> triangles(environment.products.size());
  for (const auto& i : environment.instances) triangles[i.product] += environment.meshes[i.mesh]->triangles.size();
  json rows = json::array();
  for (std::size_t i = 0; i < environment.products.size(); ++i) {
    const auto& p = environment.products[i];
    rows.push_back({{"id", p.id},
                    {"global_id", p.global_id},
                    {"class", p.ifc_class},
                    {"name", p.name},
                    {"storey", p.storey},
                    {"triangles", triangles[i]},
                    {"bounds", toJson(product_bounds[i], shift_m)},
                    {"volume", volumes[i]},
                    {"materials", p.materials}});
  }
  return rows;
}

Result<ImportOptions> importOptions(const json& options) {
  ImportOptions result;
  const auto shift = options.at("shift").get<std::string>();
  if (shift == "none") {
    result.shift = ShiftMode::none;
  } else if (shift != "auto") {
    auto numbers = parseNumbers(shift);
    if (!numbers || numbers->size() != 3)
      return failure(ErrorKind::usage, fmt::format("'{}' is not auto, none or E,N,H in metres", shift), "--shift");
    result.shift = ShiftMode::given;
    result.given_shift_m = vectorFrom(*numbers);
  }
  if (options.contains("up")) result.up = options["up"] == "z" ? UpAxis::z : UpAxis::y;
  if (options.contains("unit")) {
    static const std::map<std::string, double> metres = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
    result.metres_per_unit = metres.at(options["unit"].get<std::string>());
  }
  return result;
}

}  // namespace

Result<Outcome> importModels(const Document& document, const std::vector<std::filesystem::path>& files,
                             const ImportOptions& options, const std::string& crs, Progress& progress) {
  if (files.empty()) return failure(ErrorKind::usage, "name at least one model file", "import");
  Outcome outcome;
  outcome.document.name = document.name.empty() ? files.front().stem().string() : document.name;
  Environment environment;
  Georeference georeference;
  ImportOptions each = options;
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.stage("Import " + files[i].filename().string(), static_cast<double>(i) / static_cast<double>(files.size()),
                   static_cast<double>(i + 1) / static_cast<double>(files.size()));
    auto model = importFile(files[i], each, progress);
    if (!model) return failure(model.error());
    if (auto wrong = validate(model->environment); !wrong.empty())
      return failure(ErrorKind::internal, "the importer made an inconsistent model: " + wrong, files[i].string());
    if (files.size() > 1)
      for (auto& issue : model->report.issues) issue.source = files[i].filename().string() + " " + issue.source;
    outcome.report.append(model->report);
    outcome.document.sources.push_back(files[i].string());
    if (i == 0) {
      environment = std::move(model->environment);
      georeference = std::move(model->georeference);
      each.shift = ShiftMode::given;
      each.given_shift_m = georeference.shift_m;
      continue;
    }
    if (model->georeference.crs != georeference.crs || !sameConversion(model->georeference, georeference))
      outcome.report.warn(files[i].filename().string(), "its georeference differs from the first file's, which is used");
    appendEnvironment(environment, std::move(model->environment), model->georeference.shift_m - georeference.shift_m);
  }
  if (!crs.empty()) {
    auto found = findCrs(crs);
    if (!found) return failure(found.error());
    georeference.crs = found->code;
  }
  outcome.answer = {{"products", productRows(environment, georeference.shift_m)},
                    {"triangles", triangleCount(environment)},
                    {"bounds", toJson(bounds(environment), georeference.shift_m)},
                    {"georeference", georeferenceToJson(georeference)}};
  outcome.description = fmt::format("Imported {}: {} products, {} triangles", files.front().filename().string(),
                                    environment.products.size(), triangleCount(environment));
  outcome.document.imported = std::make_shared<const Environment>(std::move(environment));
  outcome.document.georeference = std::make_shared<const Georeference>(std::move(georeference));
  outcome.document.import_report = std::make_shared<const Report>(outcome.report);
  outcome.document.job = std::make_shared<const Job>(Job{outcome.document.name, {}, {}, {}});
  return outcome;
}

Result<Outcome> runImport(const Document& document, const json& options, Progress& progress) {
  auto typed = importOptions(options);
  if (!typed) return failure(typed.error());
  std::vector<std::filesystem::path> files;
  for (const auto& f : options.at("files")) files.emplace_back(f.get<std::string>());
  return importModels(document, files, *typed, options.value("crs", ""), progress);
}

}  // namespace standpoint
