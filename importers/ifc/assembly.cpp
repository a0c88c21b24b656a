// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/assembly.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "importers/ifc/model/style.h"

namespace standpoint::ifc {

// How the layers of one product lie; inactive when it has no usage.
struct Assembly::Layering {
  bool active = false;
  Eigen::Affine3d product_from_file = Eigen::Affine3d::Identity();
  ReferenceLine line;
};

void Assembly::add(std::uint32_t product, const Entity& entity, const std::vector<PlacedBody>& bodies,
                   const Eigen::Vector3d& shift_m) {
  if (bodies.empty()) return;
  const ProductMaterials materials = materialsOf(entity, relations_, model_);
  Layering layering;
  if (materials.usage) {
    Report told_before;  // placements were reported with the geometry
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
  std::uint32_t last = 0, of_last = UINT32_MAX;  // tags come in runs
  Mesh m;
  m.surface_of_triangle.reserve(body.tags.size());
  for (const std::uint32_t tag : body.tags) {
    if (of_last == UINT32_MAX || tag != last) {
      const auto [it, is_new] = surface_of_tag.try_emplace(tag, 0);
      if (is_new) it->second = pool_.surface(tag, placed.style, materials);
      last = tag, of_last = it->second;
    }
    m.surface_of_triangle.push_back(of_last);
  }
  std::vector<std::uint32_t> used;
  for (const auto& [tag, index] : surface_of_tag) used.push_back(index);
  Key key{placed.body.get(), std::move(used), std::vector<double>()};
  if (const auto it = meshes_.find(key); it != meshes_.end()) return it->second;
  m.positions = body.positions;
  m.triangles = body.triangles;
  placePictures(m, placed);
  return keep(std::move(key), std::move(m));
}

std::uint32_t Assembly::layeredMesh(const PlacedBody& placed, const ProductMaterials& materials,
                                    const Layering& layering, std::vector<double> key) {
  const auto before = layered_.find({placed.body.get(), placed.style, key});
  if (before != layered_.end()) return before->second;
  auto layered =
      layeredBody(*placed.body, layering.product_from_file * placed.file_from_items, materials, layering.line);
  std::uint32_t index = 0;
  const bool pictured = isPictured(placed);
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

bool Assembly::isPictured(const PlacedBody& placed) const {
  std::uint32_t last = kNoStyle;
  bool of_last = static_cast<bool>(pool_.generatedTexture(kNoStyle, placed.style));
  return std::any_of(placed.body->tags.begin(), placed.body->tags.end(), [&](std::uint32_t tag) {
    if (tag != last) last = tag, of_last = TextureMaps::isTextured(tag) || pool_.generatedTexture(tag, placed.style);
    return of_last;
  });
}

// Where the corners of a face with a list of coordinates lie on its picture; nothing when the list does not fit the
// face.
std::optional<Assembly::Corners> Assembly::listedCorners(const Body& body, std::size_t k) {
  const auto source = model_.textures.source(body.tags[k]);
  auto it = textured_.find(source.item);
  if (it == textured_.end())
    it = textured_.emplace(source.item, TexturedItem(source, pool_.textureOf(body.tags[k]), model_)).first;
  const TexturedFace face = it->second.face(source.face);
  Corners on;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto at = face.at(body.positions[body.triangles[k][c]].cast<double>() + body.origin);
    if (!at || !at->allFinite()) return {};
    on[c] = at->cast<float>();
  }
  return on;
}

Assembly::Corners Assembly::generatedCorners(const Body& body, std::size_t k, const Entity& texture) const {
  const auto at = [&](std::size_t c) {
    return Eigen::Vector3d(body.positions[body.triangles[k][c]].cast<double>() + body.origin);
  };
  const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  Corners on;
  for (std::size_t c = 0; c < 3; ++c)
    on[c] =
        onPicture(pool_.generators().at(texture.id(), at(c) / model_.units.length_m, normal), texture).cast<float>();
  return on;
}

// Each corner of a face with a picture gets its place on it; where faces meet at a seam the position stands twice.
void Assembly::placePictures(Mesh& mesh, const PlacedBody& placed_body) {
  if (!isPictured(placed_body)) return;
  const Body& body = *placed_body.body;
  mesh.positions.clear();
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> placed;
  std::set<Id> lost;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    Corners on{Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()};
    if (TextureMaps::isTextured(body.tags[k])) {
      if (const auto listed = listedCorners(body, k))
        on = *listed;
      else if (const Id item = model_.textures.source(body.tags[k]).item; lost.insert(item).second)
        report_.lose("#" + std::to_string(item),
                     "some faces do not match their texture coordinates and stay untextured");
    } else if (const Entity texture = pool_.generatedTexture(body.tags[k], placed_body.style)) {
      on = generatedCorners(body, k, texture);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint32_t& corner = mesh.triangles[k][c];
      const auto [it, is_new] =
          placed.try_emplace({corner, on[c].x(), on[c].y()}, static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) {
        mesh.positions.push_back(body.positions[corner]);
        mesh.texture_coordinates.push_back(on[c]);
      }
      corner = it->second;
    }
  }
}

}  // namespace standpoint::ifc
