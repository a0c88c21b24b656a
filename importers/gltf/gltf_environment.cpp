// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/files/importer.h"
#include "importers/gltf/gltf_mesh.h"
#include "importers/gltf/gltf_scene.h"
#include "importers/gltf/gltf_writer.h"

namespace standpoint {

namespace {

void readMeshes(GltfFile& file, const nlohmann::json& ours, const GltfMaterials& materials, Environment& environment,
                Progress& progress) {
  const std::string place = "/asset/extras/standpoint/meshes";
  if (!ours.is_object() || !ours.contains("meshes"))
    return file.fail(place, "is missing: this GLB was not written by Standpoint; import it instead");
  const auto& meshes = memberOf(ours, "meshes");  // null where there are none: tinygltf writes no empty array
  Report ignored;                                 // names points and nothing else: we wrote the file
  const auto no_material = static_cast<std::uint32_t>(environment.surfaces.size());
  for (const auto& index : meshes) {
    if (file.failed() || progress.cancelled()) return;
    Mesh mesh;
    if (index.is_number_unsigned()) {
      mesh = readGltfMesh(file, index.get<std::size_t>(), materials, no_material, {}, ignored).mesh;
      if (!file.failed() && mesh.triangles.empty()) mesh = readGltfPoints(file, index.get<std::size_t>());
    } else if (!index.is_null() && index != -1) {  // null: what we wrote before tinygltf, which drops it
      file.fail(place, "contains an invalid index");
    }
    environment.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    progress.advance(static_cast<double>(environment.meshes.size()) / static_cast<double>(meshes.size()));
  }
}

// The children of the root node are the instances, in order; their matrices are ours, before the turn to Y up.
void readInstances(GltfFile& file, Environment& environment) {
  const auto& nodes = file.model().nodes;
  for (const int child : file.element(nodes, "nodes", 0, "").children) {
    const std::string place = "/nodes/" + std::to_string(child);
    const auto& node = file.element(nodes, "nodes", static_cast<std::size_t>(child), "/nodes/0/children");
    const auto extras = gltfExtras(node);
    const auto& ours = memberOf(extras, "standpoint");
    const auto mesh = file.index(ours, "mesh", place + "/extras/standpoint");
    const auto product = file.index(ours, "product", place + "/extras/standpoint");
    if (!mesh || !product) return file.fail(place + "/extras/standpoint", "has no mesh or no product");
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(*mesh);
    instance.product = static_cast<std::uint32_t>(*product);
    auto matrix = file.numbers(ours, "matrix", 16, place + "/extras/standpoint");
    if (file.failed()) return;
    if (matrix.empty()) matrix = node.matrix;
    if (!matrix.empty()) instance.world_from_mesh.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix.data());
    environment.instances.push_back(instance);
  }
}

}  // namespace

Result<Environment> readEnvironmentGlb(const std::filesystem::path& path, Progress& progress) {
  progress.stage("Reading geometry");
  GltfFile file(path);
  file.load();
  Environment environment;
  if (!file.failed()) {
    Report ignored;  // we wrote the file
    const auto extras = gltfExtras(file.model().asset);
    const auto& ours = memberOf(extras, "standpoint");
    auto materials = readGltfMaterials(file, ignored);
    for (auto& use : materials.texture_of_material) use.vertex_alpha = true;  // in our own files nothing is left out
    materials.without_material.vertex_alpha = true;
    environment.surfaces = std::move(materials.surfaces);
    environment.images = std::move(materials.images);
    readMeshes(file, ours, materials, environment, progress);
    const auto products = file.natural(ours, "products", 0, "/asset/extras/standpoint");
    if (!file.failed() && file.spend(products * sizeof(Product) / 64, "/asset/extras/standpoint/products"))
      environment.products.resize(products);
    if (!file.failed()) readInstances(file, environment);
  }
  TRY(progress.check());
  if (!file.failed())
    if (auto wrong = validate(environment); !wrong.empty()) file.fail("", wrong);
  TRY(file.whole());
  return environment;
}

}  // namespace standpoint
