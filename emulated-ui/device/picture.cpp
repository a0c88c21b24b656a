// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/picture.h"

#include <algorithm>
#include <cmath>

#include "emulated-ui/device/numbers.h"

namespace standpoint {

std::optional<PicturePlace> placeIn(const std::string& text) {
  const auto numbers = numbersIn(text);
  const auto inside = [](double share) { return share >= 0 && share < 1; };
  if (!numbers || numbers->size() != 2 || !inside((*numbers)[0]) || !inside((*numbers)[1])) return std::nullopt;
  return PicturePlace{(*numbers)[0], (*numbers)[1]};
}

std::size_t cellAt(const ScanPreview& picture, const PicturePlace& place) {
  const auto column = static_cast<std::size_t>(place.u * picture.columns),
             row = static_cast<std::size_t>((1 - place.v) * picture.rows);
  return std::min<std::size_t>(row, picture.rows - 1) * picture.columns + column;
}

std::optional<Eigen::Vector3d> spotIn(const ScanPreview& picture, const std::string& text) {
  const auto place = placeIn(text);
  if (!place || picture.columns == 0 || picture.rows == 0) return std::nullopt;
  const auto cell = cellAt(picture, *place);
  if (!std::isfinite(picture.x_m[cell])) return std::nullopt;
  return Eigen::Vector3d(picture.x_m[cell], picture.y_m[cell], picture.z_m[cell]);
}

}  // namespace standpoint
