// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
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
    materials_ = readGltfMaterials(file_, model_.report);
    environment().surfaces = std::move(materials_.surfaces);
    environment().images = std::move(materials_.images);
    no_material_ = static_cast<std::uint32_t>(environment().surfaces.size());
    const auto seen = walkScene(file_, [&](const GltfNode& node) { visit(node); });
    if (file_.failed()) return failure(file_.error());
    if (auto ok = progress_.check(); !ok) return failure(ok.error());
    if (no_material_used_) environment().surfaces.push_back({"", {}, "no material"});
    listWhatIsNotRead(seen);
    georeference(stored);
    if (auto wrong = validate(environment()); !wrong.empty()) file_.fail("", wrong);
    if (file_.failed()) return failure(file_.error());
    return std::move(model_);
  }

 private:
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
    const auto& mesh_json = file_.element("meshes", *mesh, node.place + "/mesh");
    const GltfPose pose = poseOf(node, mesh_json);
    if (file_.failed()) return;
    const Placed& placed = meshOf(*mesh, pose);
    // glTF 2.0 §3.7.3.3: a skinned mesh stands where its joints are, not where its node is.
    const Eigen::Affine3d world_from_node = world_from_gltf_ * (pose.joints.empty() ? node.world_from_node : Eigen::Affine3d::Identity());
    const auto places = instancesOf(file_, node);
    if (file_.failed() || !count(places.size(), *environment().meshes[placed.mesh], node.place)) return;
    const std::uint32_t product = productOf(node, mesh_json, *environment().meshes[placed.mesh]);
    for (const auto& place : places)
      environment().instances.push_back({placed.mesh, product, world_from_node * place * Eigen::Translation3d(placed.origin)});
    progress_.advance(static_cast<double>(++visited_) / static_cast<double>(file_.count("nodes")));
  }

  // A few bytes can place a mesh a million times; what follows visits every placed vertex.
  bool count(std::size_t places, const Mesh& mesh, const std::string& place) {
    constexpr std::size_t kMostPlacedVertices = 1'000'000'000;
    placed_vertices_ += places * (mesh.positions.size() + 1);
    if (placed_vertices_ > kMostPlacedVertices) file_.fail(place, "with it the file places more than 1 000 000 000 vertices");
    return !file_.failed();
  }

  // A node's own weights stand above its mesh's (glTF 2.0 §3.7.2.2).
  GltfPose poseOf(const GltfNode& node, const nlohmann::json& mesh_json) {
    GltfPose pose;
    const auto& own = memberOf(*node.json, "weights");
    const auto& weights = own.is_array() ? own : memberOf(mesh_json, "weights");
    if (weights.is_array())
      for (const auto& w : weights) pose.weights.push_back(w.is_number() ? w.get<double>() : 0);
    if (std::all_of(pose.weights.begin(), pose.weights.end(), [](double w) { return w == 0; })) pose.weights.clear();
    if (const auto skin = file_.index(*node.json, "skin", node.place)) pose.joints = jointsOf(file_, *skin, node.place + "/skin");
    return pose;
  }

  struct Placed {
    GltfPose pose;
    std::uint32_t mesh = 0;                                // ours
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();      // what was subtracted from its positions
  };

  const Placed& meshOf(std::size_t index, const GltfPose& pose) {
    auto& versions = meshes_[index];
    for (const auto& version : versions)
      if (version.pose == pose) return version;
    Report again;   // what is lost of a mesh is said once
    auto mesh = readGltfMesh(file_, index, materials_, no_material_, pose, versions.empty() ? model_.report : again);
    const Eigen::Vector3d origin = moveNearOrigin(mesh);
    no_material_used_ |= !mesh.surface_of_triangle.empty() && mesh.surface_of_triangle.back() == no_material_;
    versions.push_back({pose, static_cast<std::uint32_t>(environment().meshes.size()), origin});
    environment().meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    return versions.back();
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
  std::uint32_t productOf(const GltfNode& node, const nlohmann::json& mesh_json, const Mesh& mesh) {
    auto& products = environment().products;
    if (node.product && !products.empty() && node.product == last_product_) return static_cast<std::uint32_t>(products.size() - 1);
    last_product_ = node.product;
    Product product;
    product.id = node.place;
    product.name = file_.text(*node.json, "name");
    if (product.name.empty()) product.name = file_.text(mesh_json, "name");
    addExtras(memberOf(*node.json, "extras"), product.properties);
    addExtras(memberOf(mesh_json, "extras"), product.properties);
    const auto& used = mesh.surface_of_triangle;
    for (const auto surface : std::set<std::uint32_t>(used.begin(), used.end()))
      if (surface < environment().surfaces.size()) product.materials.push_back(environment().surfaces[surface].name);
    products.push_back(std::move(product));
    return static_cast<std::uint32_t>(products.size() - 1);
  }

  void listWhatIsNotRead(const std::vector<bool>& seen) {
    auto& report = model_.report;
    std::size_t elsewhere = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      elsewhere += !seen[i] && memberOf(file_.element("nodes", i, ""), "mesh").is_number() ? 1 : 0;
    if (elsewhere > 0)
      report.lose("/scenes", std::to_string(elsewhere) + " nodes with a mesh are not in the scene that the file shows by default");
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
  GltfMaterials materials_;                            // its surfaces and images have moved to the environment
  std::map<std::size_t, std::deque<Placed>> meshes_;   // of each glTF mesh, ours for each pose in which it is used
  std::size_t placed_vertices_ = 0;
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
