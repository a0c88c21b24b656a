// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/labels/label_layout.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace standpoint {

using Box = Eigen::AlignedBox2d;

std::vector<std::optional<PlacedLabel>> layOut(const std::vector<WantedLabel>& labels, const Eigen::Vector2d& size_px) {
  const Box picture(Eigen::Vector2d::Zero(), size_px);
  std::vector<Box> taken;
  std::vector<std::optional<PlacedLabel>> result(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t t = 0; t < labels[i].texts.size() && !result[i]; ++t) {
      const Eigen::Vector2d size = labels[i].texts[t].size_px;
      const Eigen::Vector2d corner =
          labels[i].at_px - Eigen::Vector2d(size.x() / 2, labels[i].centred ? size.y() / 2 : size.y());
      const Box box(corner, corner + size);
      const auto covers = [&](const Box& other) {
        return (box.max().array() > other.min().array()).all() && (other.max().array() > box.min().array()).all();
      };
      if (!picture.contains(box) || std::any_of(taken.begin(), taken.end(), covers)) continue;
      taken.push_back(box);
      result[i] = {corner, t};
    }
  return result;
}

}  // namespace standpoint
