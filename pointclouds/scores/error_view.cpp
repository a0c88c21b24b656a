// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/error_view.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

namespace {

constexpr Rgb kRight = {190, 190, 190}, kNothing = {255, 255, 255};
constexpr double kFaintest = 0.3;  // of the ink in a pixel that has a wrong point

Rgb shadeOf(const Rgb& ink, double strength) {
  Rgb colour{};
  for (std::size_t k = 0; k < colour.size(); ++k)
    colour[k] = static_cast<std::uint8_t>(std::lround(kRight[k] + strength * (ink[k] - kRight[k])));
  return colour;
}

}  // namespace

std::array<int, 2> axesOf(ViewFrom from) {
  return from == ViewFrom::above ? std::array{0, 1} : from == ViewFrom::south ? std::array{0, 2} : std::array{1, 2};
}

ErrorView::ErrorView(ViewFrom from, const Bounds& box, double pixel_m, std::vector<Rgb> inks)
    : from_(from), box_(box), pixel_m_(pixel_m), inks_(std::move(inks)) {
  const auto [right, up] = axesOf(from);
  const Eigen::Vector3d size = box.max - box.min;
  pixel_m_ = std::max(pixel_m_, std::max(size[right], size[up]) / kMostPixels);
  const auto pixelsOf = [&](double length_m) {
    return std::clamp(static_cast<int>(std::ceil(length_m / pixel_m_)), 1, kMostPixels);
  };
  width_ = pixelsOf(size[right]);
  height_ = pixelsOf(size[up]);
  counts_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * (1 + inks_.size()), 0);
}

void ErrorView::count(const Eigen::Vector3d& at, std::size_t what) {
  if (!((at.array() >= box_.min.array()).all() && (at.array() <= box_.max.array()).all())) return;
  const auto [right, up] = axesOf(from_);
  const auto step = [&](int axis, int steps) {
    return std::min(static_cast<int>((at[axis] - box_.min[axis]) / pixel_m_), steps - 1);
  };
  const auto pixel = static_cast<std::size_t>(height_ - 1 - step(up, height_)) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(step(right, width_));
  ++counts_[pixel * (1 + inks_.size()) + what];
}

void ErrorView::addRight(const Eigen::Vector3d& at) { count(at, 0); }
void ErrorView::addWrong(const Eigen::Vector3d& at, std::size_t ink) { count(at, 1 + ink); }

std::vector<std::uint8_t> ErrorView::pixels() const {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(counts_.size() / (1 + inks_.size()) * 3);
  for (auto at = counts_.begin(); at != counts_.end();) {
    const auto first_ink = at + 1, end = first_ink + static_cast<std::ptrdiff_t>(inks_.size());
    double wrong = 0;
    for (auto one = first_ink; one != end; ++one) wrong += *one;
    auto colour = *at == 0 ? kNothing : kRight;
    if (wrong > 0)
      colour = shadeOf(inks_[static_cast<std::size_t>(std::max_element(first_ink, end) - first_ink)],
                       kFaintest + (1 - kFaintest) * wrong / (wrong + *at));
    rgb.insert(rgb.end(), colour.begin(), colour.end());
    at = end;
  }
  return rgb;
}

}  // namespace standpoint
