// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/assembly.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "importers/ifc/style.h"

namespace standpoint::ifc {

// How the layers of one product lie; inactive when it has no usage.
struct Assembly::Layering {
  bool active = false;
  Eigen::Affine3d product_from_file = Eigen::Affine3d::Identity();
  ReferenceLine line;
};

void Assembly::add(std::uint32_t product, const Entity& entity, const std::vector<PlacedBody>& bodies, const Eigen::Vector3d& shift_m) {
  if (bodies.empty()) return;
  const ProductMaterials materials = materialsOf(entity, relations_, model_);
  Layering layering;
  if (materials.usage) {
    Report told_before;   // placements were reported with the geometry
    layering.active = true;
    layering.product_from_file = Eigen::Affine3d(placements_.world(entity.ref(5), told_before).inverse());
    if (materials.usage->axis == 1) layering.line = referenceLine(entity, model_);
  }
  for (const PlacedBody& placed : bodies) {
    Instance instance;
    instance.product = product;
    instance.mesh = mesh(placed, materials, layering);
    const Eigen::Affine3d file_from_items = up_from_file_ * placed.file_from_items;
    Eigen::Affine3d t = file_from_items;
    t.translation() = file_from_items * placed.body->origin - shift_m;
    instance.world_from_mesh = t;
    environment_.instances.push_back(instance);
  }
}

std::uint32_t Assembly::mesh(const PlacedBody& placed, const ProductMaterials& materials, const Layering& layering) {
  if (!layering.active) return plainMesh(placed, materials);
  const auto key = layeringKey(layering.product_from_file * placed.file_from_items, materials, layering.line);
  return key.empty() ? plainMesh(placed, materials) : layeredMesh(placed, materials, layering, key);
}

std::uint32_t Assembly::plainMesh(const PlacedBody& placed, const ProductMaterials& materials) {
  const Body& body = *placed.body;
  std::map<std::uint32_t, std::uint32_t> surface_of_tag;
  std::uint32_t last = 0, of_last = UINT32_MAX;   // tags come in runs
  Mesh m;
  m.surface_of_triangle.reserve(body.tags.size());
  for (const std::uint32_t tag : body.tags) {
    if (of_last == UINT32_MAX || tag != last) {
      const auto [it, is_new] = surface_of_tag.try_emplace(tag, 0);
      if (is_new) it->second = pool_.surface(tag ? tag : placed.style, materials);
      last = tag, of_last = it->second;
    }
    m.surface_of_triangle.push_back(of_last);
  }
  std::vector<std::uint32_t> used;
  for (const auto& [tag, index] : surface_of_tag) used.push_back(index);
  Key key{placed.body.get(), std::move(used), {}};
  if (const auto it = meshes_.find(key); it != meshes_.end()) return it->second;
  m.positions = body.positions;
  m.triangles = body.triangles;
  placePictures(m, body);
  return keep(std::move(key), std::move(m));
}

std::uint32_t Assembly::layeredMesh(const PlacedBody& placed, const ProductMaterials& materials, const Layering& layering, std::vector<double> key) {
  const auto before = layered_.find({placed.body.get(), placed.style, key});
  if (before != layered_.end()) return before->second;
  auto layered = layeredBody(*placed.body, layering.product_from_file * placed.file_from_items, materials, layering.line);
  std::uint32_t index = 0;
  const bool pictured = std::any_of(placed.body->tags.begin(), placed.body->tags.end(), TextureMaps::isTextured);
  if (!layered || pictured) {
    index = plainMesh(placed, materials);
  } else {
    Mesh m{std::move(layered->positions), std::move(layered->triangles), {}, {}, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> surface_of;
    for (std::size_t k = 0; k < m.triangles.size(); ++k) {
      const std::uint32_t tag = layered->tags[k] ? layered->tags[k] : placed.style;
      const auto [it, is_new] = surface_of.try_emplace({tag, layered->layer[k]}, 0);
      if (is_new) it->second = pool_.surfaceOfLayer(tag, materials.material_of_layer[layered->layer[k]]);
      m.surface_of_triangle.push_back(it->second);
    }
    std::vector<std::uint32_t> used;
    for (const auto& [what, surface] : surface_of) used.push_back(surface);
    index = keep({placed.body.get(), std::move(used), key}, std::move(m));
  }
  layered_.emplace(std::tuple(placed.body.get(), placed.style, std::move(key)), index);
  return index;
}

std::uint32_t Assembly::keep(Key key, Mesh mesh) {
  const auto [it, is_new] = meshes_.try_emplace(std::move(key), static_cast<std::uint32_t>(environment_.meshes.size()));
  if (!is_new) return it->second;
  sortBySurface(mesh);
  environment_.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  return it->second;
}

// Each corner of a textured face gets its place on the picture; where faces meet at a seam the position stands twice.
void Assembly::placePictures(Mesh& mesh, const Body& body) {
  if (std::none_of(body.tags.begin(), body.tags.end(), TextureMaps::isTextured)) return;
  const auto positions = std::move(mesh.positions);
  mesh.positions.clear();
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> placed;
  std::set<Id> lost;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    std::array<Eigen::Vector2f, 3> on{Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()};
    if (TextureMaps::isTextured(body.tags[k])) {
      const auto source = model_.textures.source(body.tags[k]);
      auto it = textured_.find(source.item);
      if (it == textured_.end()) it = textured_.emplace(source.item, TexturedItem(source, pool_.textureOf(body.tags[k]), model_)).first;
      const TexturedFace face = it->second.face(source.face);
      bool known = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto at = face.at(positions[mesh.triangles[k][c]].cast<double>() + body.origin);
        known = known && at && at->allFinite();
        if (known) on[c] = at->cast<float>();
      }
      if (!known && lost.insert(source.item).second)
        report_.lose("#" + std::to_string(source.item), "some faces do not fit the coordinates of their texture; the picture is not placed there");
    }
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint32_t& corner = mesh.triangles[k][c];
      const auto [it, is_new] = placed.try_emplace({corner, on[c].x(), on[c].y()}, static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) {
        mesh.positions.push_back(positions[corner]);
        mesh.texture_coordinates.push_back(on[c]);
      }
      corner = it->second;
    }
  }
}

}  // namespace standpoint::ifc
