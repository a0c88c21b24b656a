// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "importers/gltf/gltf_physical_material.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

// Read, or named where they are met: a file may require them.
constexpr std::array<std::string_view, 23> kUnderstood = {"KHR_mesh_quantization",
                                                          kGltfPhysicalMaterial,
                                                          "KHR_draco_mesh_compression",
                                                          "EXT_meshopt_compression",
                                                          "KHR_meshopt_compression",
                                                          "EXT_mesh_gpu_instancing",
                                                          "KHR_texture_transform",
                                                          "KHR_texture_basisu",
                                                          "EXT_texture_webp",
                                                          "EXT_texture_avif",
                                                          "MSFT_texture_dds",
                                                          "CESIUM_RTC",
                                                          "EXT_mesh_features",
                                                          "EXT_instance_features",
                                                          "EXT_structural_metadata",
                                                          "KHR_xmp",
                                                          "KHR_xmp_json_ld",
                                                          "KHR_lights_punctual",
                                                          "KHR_animation_pointer",
                                                          "EXT_lights_image_based",
                                                          "MSFT_lod",
                                                          "KHR_physics_rigid_bodies",
                                                          "KHR_implicit_shapes"};

bool understood(std::string_view name) {
  return name.starts_with("KHR_materials_") ||
         std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end();
}

void variants(GltfFile& file, Report& report) {
  const auto& list = memberOf(memberOf(file.extensions(), "KHR_materials_variants"), "variants");
  if (!list.is_array() || list.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), 8); ++i) {
    if (i > 0) names += ", ";
    names += file.text(list[i], "name");
  }
  if (list.size() > 8) names += ", …";
  report.note("/extensions/KHR_materials_variants", std::to_string(list.size()) + " variants of the materials (" +
                                                        names + ") were not read; the default variant is used");
}

// Marks what stands outside of the scene on purpose, with all below it: simpler levels of nodes, meshes of colliders.
// Returns how many nodes have levels.
std::size_t seeCompanions(GltfFile& file, std::vector<bool>& seen) {
  std::vector<std::size_t> open;
  const auto push = [&](const Json& index) {
    if (index.is_number_unsigned() && index.get<std::size_t>() < seen.size()) open.push_back(index.get<std::size_t>());
  };
  const auto pushAll = [&](const Json& list) {
    if (list.is_array())
      for (const auto& index : list) push(index);
  };
  std::size_t with_levels = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto extensions = gltfExtensions(file.model().nodes[i]);
    const auto& ids = memberOf(memberOf(extensions, "MSFT_lod"), "ids");
    with_levels += ids.is_array() && !ids.empty() ? 1 : 0;
    pushAll(ids);
    push(
        memberOf(memberOf(memberOf(memberOf(extensions, "KHR_physics_rigid_bodies"), "collider"), "geometry"), "node"));
  }
  while (!open.empty()) {
    const auto node = open.back();
    open.pop_back();
    if (seen[node]) continue;
    seen[node] = true;
    for (const int child : file.model().nodes[node].children) push(child);
  }
  return with_levels;
}

}  // namespace

void checkGltfExtensions(GltfFile& file, Report& report) {
  const auto& required = file.model().extensionsRequired;
  for (std::size_t i = 0; i < required.size(); ++i)
    if (!understood(required[i]))
      file.fail("/extensionsRequired/" + std::to_string(i),
                "'" + required[i] + "' is required but not supported; export the model without it");
  const auto& used = file.model().extensionsUsed;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!understood(used[i]))
      report.note("/extensionsUsed/" + std::to_string(i), "'" + used[i] + "' is not supported; its data was skipped");
  variants(file, report);
}

void listGltfRest(GltfFile& file, const std::vector<bool>& in_scene, Report& report) {
  auto seen = in_scene;
  if (const auto levels = seeCompanions(file, seen); levels > 0)
    report.note("/nodes",
                std::to_string(levels) + " nodes have several levels of detail (MSFT_lod); the finest is used");
  std::size_t elsewhere = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) elsewhere += !seen[i] && file.model().nodes[i].mesh >= 0 ? 1 : 0;
  if (elsewhere > 0)
    report.lose("/scenes", std::to_string(elsewhere) + " nodes with meshes are not in the default scene");
  for (const auto& [place, n] : {std::pair("/animations", file.animations()), std::pair("/cameras", file.cameras())})
    if (n > 0) report.note(place, std::to_string(n) + " skipped: the model is imported as static");
  const auto& lights = memberOf(memberOf(file.extensions(), "KHR_lights_punctual"), "lights");
  if (lights.is_array() && !lights.empty())
    report.note("/extensions/KHR_lights_punctual",
                std::to_string(lights.size()) + " lights skipped: not needed for scanning");
}

}  // namespace standpoint
