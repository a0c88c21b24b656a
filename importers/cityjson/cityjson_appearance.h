// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/report.h"
#include "importers/city/city_images.h"
#include "importers/city/city_model.h"

namespace standpoint {

// What is painted on a polygon: the first ring's list of its values, as the file has them.
struct CityJsonTexture {
  const nlohmann::json* rings = nullptr;  // null: nothing
  std::int32_t image = -1;
};

// Materials and textures of a file, of one theme each: the one that the file calls its default, else the first.
class CityJsonAppearance {
 public:
  CityJsonAppearance(const std::filesystem::path& file, CityModel& model, Report& report)
      : model_(model), images_(file, report) {}

  void begin(const nlohmann::json& appearance);
  // The values of the theme within a geometry's "material" or "texture"; null where there are none.
  const nlohmann::json& materialValues(const nlohmann::json& geometry) const;
  const nlohmann::json& textureValues(const nlohmann::json& geometry) const;

  std::optional<std::uint32_t> surfaceOf(const nlohmann::json& material) const;
  CityJsonTexture textureOf(const nlohmann::json& rings);
  // Of the image's upper left corner; nothing where the file has no such coordinate.
  std::optional<Eigen::Vector2f> coordinate(const nlohmann::json& index) const;
  void finish() { model_.images = std::move(images_).images(); }

 private:
  CityModel& model_;
  CityImages images_;
  nlohmann::json appearance_;
  std::vector<std::uint32_t> surfaces_;           // of the materials
  std::map<std::size_t, std::int32_t> image_of_;  // texture → image, −1 where there is none
};

}  // namespace standpoint
