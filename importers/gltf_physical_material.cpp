// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf_physical_material.h"

namespace standpoint {

nlohmann::json gltfPhysicalMaterial(const PhysicalMaterial& m) {
  nlohmann::json json = {{"id", m.id}, {"label", m.label}};
  if (!m.reflectance.empty()) json["reflectance"] = m.reflectance;
  if (!m.transmittance.empty()) json["transmittance"] = m.transmittance;
  if (m.roughness_rad > 0) json["roughnessRad"] = m.roughness_rad;
  if (m.gloss_slope > 0) json["glossSlope"] = m.gloss_slope;
  if (m.index_of_refraction > 0) json["indexOfRefraction"] = m.index_of_refraction;
  if (m.thickness_m > 0) json["thicknessM"] = m.thickness_m;
  if (!m.source.empty()) json["source"] = m.source;
  return json;
}

}  // namespace standpoint
