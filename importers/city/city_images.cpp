// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/city/city_images.h"

namespace standpoint {

std::int32_t CityImages::add(const std::string& name, const std::string& place) {
  const auto [known, is_new] = known_.try_emplace(name, -1);
  if (!is_new) return known->second;
  const auto found = folder_.find(name, folder_.root());
  const auto added = found ? images_.add(found->file) : Result<std::int32_t>(failure(found.error()));
  if (added) return known->second = *added;
  report_.lose(place, "colour texture '" + name.substr(0, 200) + "' " + added.error().message +
                          "; using the diffuse colour instead");
  return -1;
}

std::optional<Eigen::Vector2f> cityTextureCoordinate(double u, double v) {
  const Eigen::Vector2f upper_left(static_cast<float>(u), 1 - static_cast<float>(v));
  return upper_left.allFinite() ? std::optional(upper_left) : std::nullopt;
}

}  // namespace standpoint
