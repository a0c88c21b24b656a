// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>
#include <utility>

#include "importers/gltf/gltf_companions.h"
#include "importers/gltf/gltf_extensions.h"
#include "importers/gltf/gltf_georeference.h"
#include "importers/gltf/gltf_mesh.h"
#include "importers/gltf/gltf_product.h"
#include "importers/gltf/gltf_scene.h"

namespace standpoint {

namespace {

// Beyond this a float step is above 0.1 mm, so a mesh gets a whole-metre origin of its own.
constexpr double kFarFromOrigin_m = 2000;

// (x, y, z) of a Y-up world is (x, −z, y) of ours: an exchange of axes, so no bit of a coordinate changes.
Eigen::Affine3d zUp(const ImportOptions& options) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (options.up != UpAxis::z) result.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (options.metres_per_unit > 0) result.linear() *= options.metres_per_unit;
  return result;
}

class GltfImport {
 public:
  GltfImport(GltfFile& file, const ImportOptions& options, Progress& progress)
      : file_(file), options_(options), progress_(progress), world_from_gltf_(zUp(options)) {}

  Result<ImportedModel> run() {
    if (const std::size_t left = file_.bytesLeft(); left > 0)
      model_.report.lose(
          "byte 8", "the file is " + std::to_string(left) + " bytes longer than its header states; they were not read");
    checkGltfExtensions(file_, model_.report);
    centre_ = centreOfFile();
    auto stored = readGltfGeoreference(file_);
    materials_ = readGltfMaterials(file_, model_.report);
    environment().surfaces = std::move(materials_.surfaces);
    environment().images = std::move(materials_.images);
    no_material_ = static_cast<std::uint32_t>(environment().surfaces.size());
    const auto seen = walkScene(file_, [&](const GltfNode& node) { visit(node); });
    TRY(file_.whole());
    TRY(progress_.check());
    if (no_material_used_) environment().surfaces.push_back({"", {1, 1, 1, 1}, "no material"});  // glTF 2.0, 3.9.6
    listGltfRest(file_, seen, model_.report);
    if (collision_shapes_ > 0)
      model_.report.note("/nodes", std::to_string(collision_shapes_) +
                                       " collision shapes for game engines (UCX_, -colonly) were skipped");
    if (triangleCount(environment()) == 0) model_.report.warn("/nodes", "no node has surfaces: nothing to scan");
    georeference(stored);
    if (auto wrong = validate(environment()); !wrong.empty()) file_.fail("", wrong);
    TRY(file_.whole());
    return std::move(model_);
  }

 private:
  Environment& environment() { return model_.environment; }

  void visit(const GltfNode& node) {
    const auto mesh = gltfIndex(node.gltf->mesh);
    if (file_.failed() || progress_.cancelled() || !mesh) return;
    if (isGltfCollision(*node.gltf)) {
      ++collision_shapes_;
      return;
    }
    const auto& gltf_mesh = file_.element(file_.model().meshes, "meshes", *mesh, node.place + "/mesh");
    const GltfPose pose = poseOf(node, gltf_mesh);
    if (file_.failed()) return;
    const Version& version = versionOf(*mesh, pose);
    const auto places = instancesOf(file_, node);
    const auto rows = rowsOfInstances(node, places.size());
    // glTF 2.0 §3.7.3.3: a skinned mesh stands where its joints are, not where its node is.
    const Eigen::Affine3d world_from_node =
        world_from_gltf_ * (pose.joints.empty() ? node.world_from_node : Eigen::Affine3d::Identity());
    for (const auto& part : version.parts) {
      const Mesh& ours = *environment().meshes[part.mesh];
      if (file_.failed() || !count(places.size(), ours, node.place)) return;
      std::uint32_t product = rows.empty() ? productOf(node, gltf_mesh, part.feature, ours) : 0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (!rows.empty()) product = productOf(node, gltf_mesh, rows[i], ours);
        const Eigen::Affine3d placed = world_from_node * places[i] * Eigen::Translation3d(part.origin);
        environment().instances.push_back({part.mesh, product, Eigen::Translation3d(centre_) * placed});
      }
    }
    progress_.advance(static_cast<double>(++visited_) / static_cast<double>(file_.model().nodes.size()));
  }

  // EXT_instance_features: each instance is a product of its own.
  std::vector<GltfFeature> rowsOfInstances(const GltfNode& node, std::size_t places) {
    const auto instancing = gltfExtension(*node.gltf, "EXT_mesh_gpu_instancing");
    const auto ids = featureIdsOf(file_, *node.gltf, "EXT_instance_features", node.place);
    if (!ids.present || !instancing.is_object() || file_.failed()) return {};
    std::vector<GltfFeature> rows;
    const auto accessor = file_.index(memberOf(instancing, "attributes"), ids.attribute.c_str(), node.place);
    const auto values = accessor ? file_.floats(*accessor, 1, node.place + "/" + ids.attribute) : std::vector<float>{};
    for (std::size_t i = 0; i < places && !file_.failed(); ++i) {
      const bool stated = i < values.size() && values[i] >= 0 && values[i] < 4e9F;
      if (!ids.attribute.empty() && !stated)
        file_.fail(node.place + "/extensions/EXT_instance_features",
                   "does not name an attribute with an id per instance");
      rows.push_back({ids.table, stated ? static_cast<std::size_t>(values[i]) : i});
    }
    return rows;
  }

  // A few bytes can place a mesh a million times; what follows visits every placed vertex.
  bool count(std::size_t places, const Mesh& mesh, const std::string& place) {
    constexpr std::size_t kMostPlacedVertices = 1'000'000'000;
    placed_vertices_ += places * (mesh.positions.size() + 1);
    if (!file_.spend(places * sizeof(Instance), place)) return false;
    if (placed_vertices_ > kMostPlacedVertices) file_.fail(place, "exceeds the limit of 1 000 000 000 placed vertices");
    return !file_.failed();
  }

  // A node's own weights stand above its mesh's (glTF 2.0 §3.7.2.2).
  GltfPose poseOf(const GltfNode& node, const tinygltf::Mesh& gltf_mesh) {
    GltfPose pose;
    pose.weights = node.gltf->weights.empty() ? gltf_mesh.weights : node.gltf->weights;
    if (std::all_of(pose.weights.begin(), pose.weights.end(), [](double w) { return w == 0; })) pose.weights.clear();
    if (const auto skin = gltfIndex(node.gltf->skin)) pose.joints = jointsOf(file_, *skin, node.place + "/skin");
    return pose;
  }

  struct Part {
    std::uint32_t mesh = 0;                            // ours
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // what was subtracted from its positions
    std::optional<GltfFeature> feature;
  };
  struct Version {  // a mesh of the file in one pose
    GltfPose pose;
    std::vector<Part> parts;
  };

  const Version& versionOf(std::size_t index, const GltfPose& pose) {
    auto& versions = meshes_[index];
    for (const auto& version : versions)
      if (version.pose == pose) return version;
    Report again;  // what is lost of a mesh is said once
    auto whole = readGltfMesh(file_, index, materials_, no_material_, pose, versions.empty() ? model_.report : again);
    versions.push_back({pose, {}});
    for (auto& [mesh, feature] : splitByFeature(std::move(whole))) {
      const Eigen::Vector3d origin = moveNearOrigin(mesh);
      no_material_used_ |= !mesh.surface_of_triangle.empty() && mesh.surface_of_triangle.back() == no_material_;
      versions.back().parts.push_back({static_cast<std::uint32_t>(environment().meshes.size()), origin, feature});
      environment().meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    }
    return versions.back();
  }

  // Along each axis on which all positions are far off and within a factor of 2 of another, so that the difference is
  // exact in float too: what reaches from near the origin to far away stays as the file has it.
  static Eigen::Vector3d moveNearOrigin(Mesh& mesh) {
    Bounds box;
    for (const auto& p : mesh.positions) box.extend(p.cast<double>());
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3 && !box.empty(); ++axis) {
      const double low = box.min[axis], high = box.max[axis];
      const double near = std::min(std::abs(low), std::abs(high)), far = std::max(std::abs(low), std::abs(high));
      if (low * high > 0 && far > kFarFromOrigin_m && far < 2 * near) origin[axis] = std::round(0.5 * (low + high));
    }
    if (!origin.isZero(0))
      for (auto& p : mesh.positions) p = (p.cast<double>() - origin).cast<float>();
    return origin;
  }

  // One product for each node with a mesh, or for each feature of it. Our own files have a node for each instance, and
  // a node that says whose they are.
  std::uint32_t productOf(const GltfNode& node, const tinygltf::Mesh& gltf_mesh,
                          const std::optional<GltfFeature>& feature, const Mesh& mesh) {
    auto& products = environment().products;
    if (node.product && !products.empty() && node.product == last_product_)
      return static_cast<std::uint32_t>(products.size() - 1);
    last_product_ = node.product;
    Product product;
    product.id = node.place;
    const auto& named = node.product_node != nullptr ? *node.product_node : *node.gltf;
    product.name = named.name;
    if (feature) {
      product.id += "/features/" + std::to_string(feature->row);
      const std::string whole = std::exchange(product.name, "");
      addFeature(file_, *feature, product);
      if (product.name.empty()) product.name = whole + (whole.empty() ? "" : " ") + std::to_string(feature->row);
    }
    if (product.name.empty()) product.name = gltf_mesh.name;
    std::vector<std::uint32_t> used;  // triangles are sorted by surface
    std::unique_copy(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end(), std::back_inserter(used));
    for (const auto surface : used)
      if (surface < environment().surfaces.size()) product.materials.push_back(environment().surfaces[surface].name);
    if (node.product_node != nullptr) {
      restoreProduct(file_, gltfExtras(named), product);
    } else {
      addGltfProperties(file_, *node.gltf, product.properties);
      addGltfProperties(file_, gltf_mesh, product.properties);
    }
    products.push_back(std::move(product));
    return static_cast<std::uint32_t>(products.size() - 1);
  }

  // CESIUM_RTC: what the positions are relative to, in the frame that is Z up already (CesiumJS and cesium-native add
  // it after they have turned the axes), in practice metres from the centre of the earth.
  Eigen::Vector3d centreOfFile() {
    const std::string place = "/extensions/CESIUM_RTC";
    const auto centre = file_.numbers(memberOf(file_.extensions(), "CESIUM_RTC"), "center", 3, place);
    if (centre.empty()) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d c(centre[0], centre[1], centre[2]);
    constexpr double kLeastRadiusOfEarth_m = 6.3e6, kMost_m = 6.5e6;
    if (c.norm() > kLeastRadiusOfEarth_m && c.norm() < kMost_m)
      model_.report.warn(
          place, "the coordinates are earth-centred, so up is not along Z; re-export the model in a local frame");
    return c;
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
  std::map<std::size_t, std::deque<Version>> meshes_;  // of each glTF mesh, what we made of it
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  std::size_t placed_vertices_ = 0;
  std::optional<std::size_t> last_product_;
  std::size_t visited_ = 0;
  std::size_t collision_shapes_ = 0;
};

Result<ImportedModel> readGltf(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading glTF");
  GltfFile file(path);
  file.load();
  TRY(file.whole());
  return GltfImport(file, options, progress).run();
}

constexpr const char* kExtensions[] = {".gltf", ".glb"};

}  // namespace

const Importer kGltfImporter = {"gltf", "glTF 2.0, text or binary (ISO/IEC 12113)", kExtensions, &readGltf, UpAxis::y};

}  // namespace standpoint
