// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/report.h"
#include "importers/files/model_folder.h"

namespace standpoint {

// The images that a city model's textures name, within its folder, each once.
class CityImages {
 public:
  CityImages(const std::filesystem::path& model, Report& report) : folder_(model), report_(report) {}

  // Its index; −1 of one that cannot be read, which is told once. `place`: of the texture.
  std::int32_t add(const std::string& name, const std::string& place);
  std::vector<std::shared_ptr<const Image>> images() && { return std::move(images_).images(); }

 private:
  ModelFolder folder_;
  Report& report_;
  ImageFiles images_;
  std::map<std::string, std::int32_t> known_;
};

// Of the image's upper left corner; the formats' (0, 0) is the lower left one. Nothing where it is not finite.
std::optional<Eigen::Vector2f> cityTextureCoordinate(double u, double v);

}  // namespace standpoint
