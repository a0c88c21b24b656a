// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_writer_material.h"

#include <algorithm>
#include <cmath>

#include "importers/gltf/gltf_material.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

float unit(float value) { return std::clamp(value, 0.0F, 1.0F); }

Json extrasOf(const Surface& s) {
  Json extras = {{"srgb", {s.colour.r, s.colour.g, s.colour.b, s.colour.a}}, {"source", s.source}};
  for (const auto& figure : kGltfSurfaceFigures)
    if (s.*figure.value) extras[figure.key] = *(s.*figure.value);
  if (s.unlit) extras["unlit"] = true;
  if (s.image >= 0) extras["image"] = s.image;
  if (!s.physical_material.empty()) extras["physical_material"] = s.physical_material;
  return extras;
}

// KHR_materials_unlit excludes the others.
Json extensionsOf(const Surface& s) {
  if (s.unlit) return {{"KHR_materials_unlit", Json::object()}};
  Json extensions = Json::object();
  if (s.transmission) extensions["KHR_materials_transmission"] = {{"transmissionFactor", unit(*s.transmission)}};
  if (s.index_of_refraction) extensions["KHR_materials_ior"] = {{"ior", std::max(1.0F, *s.index_of_refraction)}};
  if (s.transmission && s.thickness_m)
    extensions["KHR_materials_volume"] = {{"thicknessFactor", std::max(0.0F, *s.thickness_m)}};
  if (s.clearcoat) extensions["KHR_materials_clearcoat"] = {{"clearcoatFactor", unit(*s.clearcoat)}};
  if (s.specular) extensions["KHR_materials_specular"] = {{"specularFactor", unit(*s.specular)}};
  return extensions;
}

}  // namespace

tinygltf::Material gltfMaterial(const Surface& s) {
  const auto& c = s.colour;
  tinygltf::Material material;
  material.name = gltfName(s.name);
  material.extras = gltfValue({{"standpoint", extrasOf(s)}});
  auto& pbr = material.pbrMetallicRoughness;
  pbr.baseColorFactor = {linearFromSrgb(c.r), linearFromSrgb(c.g), linearFromSrgb(c.b), unit(c.a)};
  pbr.metallicFactor = unit(s.metallic.value_or(0.0F));
  pbr.roughnessFactor = unit(s.roughness.value_or(1.0F));
  if (c.a < 1) material.alphaMode = "BLEND";
  const Json extensions = extensionsOf(s);
  for (const auto& [name, extension] : extensions.items()) material.extensions[name] = gltfValue(extension);
  material.doubleSided = !extensions.contains("KHR_materials_volume");  // a volume has an inside
  return material;
}

bool isFinite(const Surface& s) {
  const auto& c = s.colour;
  float sum = c.r + c.g + c.b + c.a;
  for (const auto& value :
       {s.metallic, s.roughness, s.transmission, s.index_of_refraction, s.thickness_m, s.clearcoat, s.specular})
    sum += value.value_or(0);
  return std::isfinite(sum);
}

}  // namespace standpoint
