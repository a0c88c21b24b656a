// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>

#include "importers/ifc/material.h"
#include "importers/ifc/model/image.h"
#include "importers/ifc/model/texture_generator.h"

namespace standpoint::ifc {

// The environment's surfaces, each kept once: a material's name with a style's colour and picture.
class SurfacePool {
 public:
  SurfacePool(const Model& model, Environment& environment, std::filesystem::path folder, Report& report)
      : model_(model),
        environment_(environment),
        report_(report),
        images_(model, std::move(folder), environment, report),
        style_of_material_(stylesOfMaterials(model.file)),
        physical_of_style_(physicalMaterialsOfStyles(model.file)),
        generators_(model.file, report) {}

  // Of faces with this tag (else with that of the part that they are in), of a product of these materials. Of several
  // materials that are no layers the constituent of the named part's name is meant, else the style tells: the one of
  // its name, or the one that has this style itself.
  std::uint32_t surface(std::uint32_t tag, std::uint32_t otherwise, const ProductMaterials& materials);
  // Of faces that show this layer: its material's name, and its material's look where the faces have none of their own.
  std::uint32_t surfaceOfLayer(std::uint32_t tag, Id material);
  // The picture on faces with that (textured) tag.
  Entity textureOf(std::uint32_t tag) const;
  // The picture of faces whose style has one that a rule places; the null entity: theirs has none.
  Entity generatedTexture(std::uint32_t tag, std::uint32_t otherwise) const;
  const TextureGenerators& generators() const { return generators_; }

 private:
  struct Look;
  std::uint32_t styleTag(std::uint32_t tag, std::uint32_t otherwise) const;
  Look lookOf(std::uint32_t tag, bool has_coordinates = true);
  void placePicture(Look& look, const Entity& texture);
  Look lookOfMaterial(Id material);
  void apply(Surface& surface, const Look& look) const;
  std::uint32_t keep(Surface surface);

  const Model& model_;
  Environment& environment_;
  Report& report_;
  Images images_;
  std::map<Id, Id> style_of_material_;
  std::map<Id, std::string> physical_of_style_;
  TextureGenerators generators_;
  std::set<Id> told_;
  std::map<std::tuple<std::string, float, float, float, float, std::int32_t, float, std::string>, std::uint32_t> known_;
};

}  // namespace standpoint::ifc
