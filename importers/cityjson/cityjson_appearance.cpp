// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/cityjson_appearance.h"

#include <algorithm>

#include "importers/cityjson/cityjson_text.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

const Json kNothing;

float between01(const Json& value, float otherwise) {
  return value.is_number() ? std::clamp(value.get<float>(), 0.F, 1.F) : otherwise;
}

Surface surfaceOfMaterial(const Json& material, std::size_t index) {
  Surface s;
  s.source = "/appearance/materials/" + std::to_string(index);
  if (const auto& name = cityMember(material, "name"); name.is_string()) s.name = name.get<std::string>();
  if (const auto& rgb = cityMember(material, "diffuseColor"); rgb.is_array() && rgb.size() == 3)
    s.colour = {between01(rgb[0], s.colour.r), between01(rgb[1], s.colour.g), between01(rgb[2], s.colour.b), 1};
  s.colour.a = 1 - between01(cityMember(material, "transparency"), 0);
  return s;
}

const Json& themed(const Json& of_geometry, const Json& default_theme) {
  if (!of_geometry.is_object() || of_geometry.empty()) return kNothing;
  if (default_theme.is_string())
    if (const auto found = of_geometry.find(default_theme.get<std::string>()); found != of_geometry.end())
      return *found;
  return *of_geometry.begin();
}

const Json& elementOf(const Json& list, const Json& index) {
  const bool there = list.is_array() && index.is_number_unsigned() && index.get<std::size_t>() < list.size();
  return there ? list[index.get<std::size_t>()] : kNothing;
}

}  // namespace

void CityJsonAppearance::begin(const Json& appearance) {
  appearance_ = appearance;
  surfaces_.clear();
  image_of_.clear();
  const auto& materials = cityMember(appearance_, "materials");
  if (!materials.is_array()) return;
  for (std::size_t i = 0; i < materials.size(); ++i)
    surfaces_.push_back(model_.surface(surfaceOfMaterial(materials[i], i)));
}

const Json& CityJsonAppearance::materialValues(const Json& geometry) const {
  const auto& theme = themed(cityMember(geometry, "material"), cityMember(appearance_, "default-theme-material"));
  const auto& one = cityMember(theme, "value");
  return one.is_null() ? cityMember(theme, "values") : one;
}

const Json& CityJsonAppearance::textureValues(const Json& geometry) const {
  const auto& theme = themed(cityMember(geometry, "texture"), cityMember(appearance_, "default-theme-texture"));
  return cityMember(theme, "values");
}

std::optional<std::uint32_t> CityJsonAppearance::surfaceOf(const Json& material) const {
  if (!material.is_number_unsigned() || material.get<std::size_t>() >= surfaces_.size()) return std::nullopt;
  return surfaces_[material.get<std::size_t>()];
}

CityJsonTexture CityJsonAppearance::textureOf(const Json& rings) {
  if (!rings.is_array() || rings.empty() || !rings[0].is_array() || rings[0].empty()) return {};
  const auto& texture = elementOf(cityMember(appearance_, "textures"), rings[0][0]);
  const auto& image = cityMember(texture, "image");
  if (!image.is_string()) return {};
  const auto index = rings[0][0].get<std::size_t>();
  const auto [known, is_new] = image_of_.try_emplace(index, -1);
  if (is_new) known->second = images_.add(image.get<std::string>(), "/appearance/textures/" + std::to_string(index));
  return known->second < 0 ? CityJsonTexture() : CityJsonTexture{&rings, known->second};
}

std::optional<Eigen::Vector2f> CityJsonAppearance::coordinate(const Json& index) const {
  const auto& uv = elementOf(cityMember(appearance_, "vertices-texture"), index);
  if (!uv.is_array() || uv.size() != 2 || !uv[0].is_number() || !uv[1].is_number()) return std::nullopt;
  return cityTextureCoordinate(uv[0].get<double>(), uv[1].get<double>());
}

}  // namespace standpoint
