// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "importers/gltf_georeference.h"
#include "importers/gltf_mesh.h"
#include "importers/gltf_scene.h"

namespace standpoint {

namespace {

// Extensions that may be required because we read them or because they do not change the geometry.
constexpr std::array<std::string_view, 8> kUnderstood = {
    "KHR_mesh_quantization", "KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing",
    "KHR_texture_transform", "KHR_texture_basisu",         "EXT_texture_webp",        "MSFT_texture_dds"};

// Beyond this a float step is above 0.1 mm, so a mesh gets a whole-metre origin of its own.
constexpr float kFarFromOrigin_m = 2000;

// (x, y, z) of a Y-up world is (x, −z, y) of ours: an exchange of axes, so no bit of a coordinate changes.
Eigen::Affine3d zUp(const ImportOptions& options) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (options.up != UpAxis::z) result.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (options.metres_per_unit > 0) result.linear() *= options.metres_per_unit;
  return result;
}

std::string asText(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void addExtras(const nlohmann::json& extras, std::vector<Property>& properties) {
  if (extras.is_object()) {
    for (const auto& [key, value] : extras.items())
      if (key != "standpoint") properties.push_back({"", key, asText(value)});
  } else if (!extras.is_null()) {
    properties.push_back({"", "extras", asText(extras)});
  }
}

class GltfImport {
 public:
  GltfImport(GltfFile& file, const ImportOptions& options, Progress& progress)
      : file_(file), options_(options), progress_(progress), world_from_gltf_(zUp(options)) {}

  Result<ImportedModel> run() {
    checkExtensions();
    auto stored = readGltfGeoreference(file_);
    environment().surfaces = readGltfSurfaces(file_, model_.report);
    no_material_ = static_cast<std::uint32_t>(environment().surfaces.size());
    mesh_of_.assign(file_.count("meshes"), kNotRead);
    origin_of_.assign(mesh_of_.size(), Eigen::Vector3d::Zero());
    walkScene(file_, [&](const GltfNode& node) { visit(node); });
    if (file_.failed()) return failure(file_.error());
    if (auto ok = progress_.check(); !ok) return failure(ok.error());
    if (no_material_used_) environment().surfaces.push_back({"", {}, "no material", {}, {}});
    listWhatIsNotRead();
    georeference(stored);
    if (auto wrong = validate(environment()); !wrong.empty()) file_.fail("", wrong);
    if (file_.failed()) return failure(file_.error());
    return std::move(model_);
  }

 private:
  static constexpr std::int64_t kNotRead = -1;

  Environment& environment() { return model_.environment; }

  void checkExtensions() {
    const auto& required = memberOf(file_.json(), "extensionsRequired");
    for (std::size_t i = 0; required.is_array() && i < required.size(); ++i) {
      const std::string name = required[i].is_string() ? required[i].get<std::string>() : required[i].dump();
      const bool known = name.starts_with("KHR_materials_") ||
                         std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end();
      if (!known) file_.fail("/extensionsRequired/" + std::to_string(i), "'" + name + "' is not understood");
    }
  }

  void visit(const GltfNode& node) {
    const auto mesh = file_.index(*node.json, "mesh", node.place);
    if (file_.failed() || progress_.cancelled() || !mesh) return;
    if (*mesh >= mesh_of_.size()) return file_.fail(node.place + "/mesh", "refers to /meshes/" + std::to_string(*mesh) + ", which does not exist");
    if (mesh_of_[*mesh] == kNotRead) readMesh(*mesh);
    const auto places = instancesOf(file_, node);
    if (file_.failed()) return;
    const std::uint32_t product = productOf(node, *mesh);
    for (const auto& place : places) {
      Instance instance;
      instance.mesh = static_cast<std::uint32_t>(mesh_of_[*mesh]);
      instance.product = product;
      instance.world_from_mesh = world_from_gltf_ * node.world_from_node * place * Eigen::Translation3d(origin_of_[*mesh]);
      environment().instances.push_back(instance);
    }
    if (!memberOf(*node.json, "skin").is_null()) model_.report.lose(node.place + "/skin", "is not applied; the mesh is as it was modelled");
    progress_.advance(static_cast<double>(++visited_) / static_cast<double>(file_.count("nodes")));
  }

  void readMesh(std::size_t index) {
    auto mesh = readGltfMesh(file_, index, no_material_, model_.report);
    origin_of_[index] = moveNearOrigin(mesh);
    no_material_used_ |= !mesh.surface_of_triangle.empty() && mesh.surface_of_triangle.back() == no_material_;
    mesh_of_[index] = static_cast<std::int64_t>(environment().meshes.size());
    environment().meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  }

  // The subtraction is exact in double; it lets the float positions keep what the file had.
  static Eigen::Vector3d moveNearOrigin(Mesh& mesh) {
    Bounds box;
    for (const auto& p : mesh.positions) box.extend(p.cast<double>());
    if (box.empty() || box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff() < kFarFromOrigin_m) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d origin = (0.5 * (box.min + box.max)).array().round();
    for (auto& p : mesh.positions) p = (p.cast<double>() - origin).cast<float>();
    return origin;
  }

  // One product for each node with a mesh. Our own files have a node for each instance, and say whose it is.
  std::uint32_t productOf(const GltfNode& node, std::size_t mesh) {
    const auto ours = file_.index(memberOf(memberOf(*node.json, "extras"), "standpoint"), "product", node.place + "/extras/standpoint");
    auto& products = environment().products;
    if (ours && !products.empty() && ours == last_product_) return static_cast<std::uint32_t>(products.size() - 1);
    last_product_ = ours;
    const auto& mesh_json = file_.element("meshes", mesh, node.place);
    Product product;
    product.id = node.place;
    product.name = file_.text(*node.json, "name");
    if (product.name.empty()) product.name = file_.text(mesh_json, "name");
    addExtras(memberOf(*node.json, "extras"), product.properties);
    addExtras(memberOf(mesh_json, "extras"), product.properties);
    const auto& used = environment().meshes[static_cast<std::size_t>(mesh_of_[mesh])]->surface_of_triangle;
    for (const auto surface : std::set<std::uint32_t>(used.begin(), used.end()))
      if (surface < environment().surfaces.size()) product.materials.push_back(environment().surfaces[surface].name);
    products.push_back(std::move(product));
    return static_cast<std::uint32_t>(products.size() - 1);
  }

  void listWhatIsNotRead() {
    auto& report = model_.report;
    for (const char* array : {"animations", "cameras"})
      if (const auto n = file_.count(array); n > 0)
        report.note(std::string("/") + array, std::to_string(n) + " not read: a building at rest is scanned");
    if (triangleCount(environment()) == 0) report.warn("/nodes", "no node has a surface: there is nothing to scan");
  }

  void georeference(std::optional<Georeference>& stored) {
    if (stored) model_.georeference = *stored;
    const Eigen::Vector3d file_from_gltf = model_.georeference.shift_m;
    Bounds box = bounds(environment());
    if (!box.empty()) box = {box.min + file_from_gltf, box.max + file_from_gltf};
    if (!stored || options_.shift != ShiftMode::automatic) model_.georeference.shift_m = chooseShift(options_, box);
    const Eigen::Vector3d move = file_from_gltf - model_.georeference.shift_m;
    if (!move.isZero(0))
      for (auto& instance : environment().instances) instance.world_from_mesh.translation() += move;
  }

  GltfFile& file_;
  const ImportOptions& options_;
  Progress& progress_;
  Eigen::Affine3d world_from_gltf_;
  ImportedModel model_;
  std::uint32_t no_material_ = 0;
  bool no_material_used_ = false;
  std::vector<std::int64_t> mesh_of_;            // glTF mesh → ours
  std::vector<Eigen::Vector3d> origin_of_;       // what was subtracted from its positions
  std::optional<std::size_t> last_product_;
  std::size_t visited_ = 0;
};

Result<ImportedModel> readGltf(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading glTF");
  GltfFile file(path);
  file.load();
  if (file.failed()) return failure(file.error());
  return GltfImport(file, options, progress).run();
}

constexpr const char* kExtensions[] = {".gltf", ".glb"};

}  // namespace

const Importer kGltfImporter = {"gltf", "glTF 2.0, text or binary (ISO/IEC 12113)", kExtensions, &readGltf};

}  // namespace standpoint
