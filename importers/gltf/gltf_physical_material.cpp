// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_physical_material.h"

namespace standpoint {

nlohmann::json gltfPhysicalMaterial(const PhysicalMaterial& m) {
  nlohmann::json json = {{"id", m.id}, {"label", m.label}};
  if (!m.reflectance.empty()) json["reflectance"] = m.reflectance;
  if (m.hemispherical) json["hemispherical"] = true;
  if (!m.transmittance.empty()) json["transmittance"] = m.transmittance;
  if (m.roughness_rad > 0) json["roughnessRad"] = m.roughness_rad;
  if (m.gloss_slope > 0) json["glossSlope"] = m.gloss_slope;
  if (m.index_of_refraction > 0) json["indexOfRefraction"] = m.index_of_refraction;
  if (m.thickness_m > 0) json["thicknessM"] = m.thickness_m;
  for (const auto& c : m.complex_index) json["complexIndex"].push_back({c.wavelength_nm, c.n, c.k});
  if (!m.group_index.empty()) json["groupIndex"] = m.group_index;
  if (m.panes > 1) json["panes"] = m.panes;
  if (m.gap_m > 0) json["gapM"] = m.gap_m;
  if (m.variation > 0) json["variation"] = m.variation;
  if (m.surface_variation > 0) json["surfaceVariation"] = m.surface_variation;
  if (m.texture_scale_m > 0) json["textureScaleM"] = m.texture_scale_m;
  if (m.retro_gain > 0) json["retroGain"] = m.retro_gain;
  if (!m.wet_of.empty()) json["wetOf"] = m.wet_of;
  if (m.water_film_m > 0) json["waterFilmM"] = m.water_film_m;
  for (const auto& gap : m.gaps) json["gaps"].push_back(gap);
  for (const auto& source : m.sources)
    json["sources"].push_back({{"figure", source.figure}, {"text", source.text}, {"licence", source.licence}});
  return json;
}

}  // namespace standpoint
