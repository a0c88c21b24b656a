// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/surface_pool.h"

#include <utility>

#include "importers/ifc/model/style.h"

namespace standpoint::ifc {

// What is known of a tag: nothing, a style, or a style with a picture.
struct SurfacePool::Look {
  std::optional<Style> style;
  Id style_id = 0;
  std::int32_t image = -1;
};

Entity SurfacePool::textureOf(std::uint32_t tag) const {
  for (const Entity& texture : model_.file.entity(model_.textures.source(tag).map).refs(0)) return texture;
  return {};
}

// The tag of the style alone, which a named part stands before.
std::uint32_t SurfacePool::styleTag(std::uint32_t tag, std::uint32_t otherwise) const {
  if (ShapeAspects::isAspect(tag)) tag = styleOf(model_.file.entity(model_.aspects.item(tag)), model_);
  if (tag != kNoStyle) return tag;
  return ShapeAspects::isAspect(otherwise) ? styleOf(model_.file.entity(model_.aspects.item(otherwise)), model_)
                                           : otherwise;
}

Entity SurfacePool::generatedTexture(std::uint32_t tag, std::uint32_t otherwise) const {
  const std::uint32_t style_tag = styleTag(tag, otherwise);
  if (TextureMaps::isTextured(style_tag)) return {};
  const auto style = styleOfTag(model_.file, style_tag);
  return style && generators_.has(style->texture) ? model_.file.entity(style->texture) : Entity();
}

SurfacePool::Look SurfacePool::lookOf(std::uint32_t tag, bool has_coordinates) {
  Look look;
  if (!TextureMaps::isTextured(tag)) {
    look.style = styleOfTag(model_.file, tag);
    look.style_id = look.style && tag < TextureMaps::kFirstTag ? tag : 0;
    if (has_coordinates && look.style && generators_.has(look.style->texture))
      placePicture(look, model_.file.entity(look.style->texture));
    else if (look.style && look.style->texture && told_.insert(look.style->texture).second)
      report_.note("#" + std::to_string(look.style->texture),
                   "some textured faces have no texture coordinates and stay untextured");
    return look;
  }
  const Entity item = model_.file.entity(model_.textures.source(tag).item);
  const std::uint32_t own = item ? model_.style_of_item[model_.file.indexOf(item)] : 0;
  if (!TextureMaps::isTextured(own)) look.style = styleOfTag(model_.file, own), look.style_id = look.style ? own : 0;
  if (!look.style) look.style.emplace();
  placePicture(look, textureOf(tag));
  return look;
}

// A picture replaces the colour unless it says that it is multiplied with it.
void SurfacePool::placePicture(Look& look, const Entity& texture) {
  look.image = texture ? images_.image(texture) : -1;
  if (look.image >= 0 && texture[2].text() != "MODULATE") look.style->colour = {1, 1, 1, look.style->colour.a};
}

SurfacePool::Look SurfacePool::lookOfMaterial(Id material) {
  const auto of_material = style_of_material_.find(material);
  return of_material == style_of_material_.end() ? Look() : lookOf(of_material->second, false);
}

std::uint32_t SurfacePool::keep(Surface s) {
  const auto key = std::make_tuple(s.name, s.colour.r, s.colour.g, s.colour.b, s.colour.a, s.image,
                                   s.index_of_refraction.value_or(0), s.physical_material);
  const auto [it, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(environment_.surfaces.size()));
  if (is_new) environment_.surfaces.push_back(std::move(s));
  return it->second;
}

void SurfacePool::apply(Surface& surface, const Look& look) const {
  if (!look.style) return;
  surface.colour = look.style->colour;
  surface.index_of_refraction = look.style->index_of_refraction;
  surface.image = look.image;
  if (const auto it = physical_of_style_.find(look.style_id); it != physical_of_style_.end())
    surface.physical_material = it->second;
}

std::uint32_t SurfacePool::surface(std::uint32_t tag, std::uint32_t otherwise, const ProductMaterials& materials) {
  std::size_t which = 0;
  bool sure = materials.layered || materials.names.size() == 1;
  if (const std::uint32_t part = ShapeAspects::isAspect(tag) ? tag : ShapeAspects::isAspect(otherwise) ? otherwise : 0)
    for (const auto& [name, material] : materials.constituents)
      for (std::size_t i = 0; i < materials.ids.size() && !sure; ++i)
        if (name == model_.aspects.name(part) && materials.names[i] == model_.file.entity(material)[0].text())
          which = i, sure = true;
  Look look = lookOf(styleTag(tag, otherwise));
  for (std::size_t i = 0; look.style && !sure && i < materials.names.size(); ++i) {
    const auto of_material = style_of_material_.find(materials.ids[i]);
    if (materials.names[i] == look.style->name ||
        (of_material != style_of_material_.end() && of_material->second == look.style_id && look.style_id))
      which = i, sure = true;
  }
  if (!look.style && !materials.ids.empty()) look = lookOfMaterial(materials.ids[which]);
  Surface s;
  apply(s, look);
  if (look.style) s.name = look.style->name;
  if (!materials.names.empty() && (sure || s.name.empty()))
    s.name = materials.names[which], s.source = "#" + std::to_string(materials.ids[which]);
  else if (look.style_id)
    s.source = "#" + std::to_string(look.style_id);
  return keep(std::move(s));
}

std::uint32_t SurfacePool::surfaceOfLayer(std::uint32_t tag, Id material) {
  Look look = lookOf(styleTag(tag, kNoStyle));
  if (!look.style) look = lookOfMaterial(material);
  Surface s;
  apply(s, look);
  s.name = model_.file.entity(material)[0].text();
  s.source = "#" + std::to_string(material);
  return keep(std::move(s));
}

}  // namespace standpoint::ifc
