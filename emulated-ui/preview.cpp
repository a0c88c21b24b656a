// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/preview.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pointclouds/formats.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kMostColumns = 512;

// Keeps the first point of each cell of the coarse grid.
class Thinner final : public PointSink {
 public:
  Result<void> begin(const ScanHeader& header) override {
    if (header.rows == 0 || header.columns == 0)
      return failure(ErrorKind::unusable, "the scan has no grid", header.name);
    step_ = std::max(1U, (header.columns + kMostColumns - 1) / kMostColumns);
    preview_->columns = (header.columns + step_ - 1) / step_;
    preview_->rows = (header.rows + step_ - 1) / step_;
    const std::size_t cells = std::size_t{preview_->columns} * preview_->rows;
    for (auto* values : {&preview_->x_m, &preview_->y_m, &preview_->z_m})
      values->assign(cells, std::numeric_limits<float>::quiet_NaN());
    intensity_.assign(cells, 0);
    preview_->grey.assign(cells, 0);
    if (header.has_colour)
      for (auto* values : {&preview_->red, &preview_->green, &preview_->blue}) values->assign(cells, 0);
    return {};
  }

  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (block.row[i] % step_ != 0 || block.column[i] % step_ != 0) continue;
      const std::size_t cell = std::size_t{block.row[i] / step_} * preview_->columns + block.column[i] / step_;
      if (cell >= intensity_.size() || std::isfinite(preview_->x_m[cell])) continue;
      preview_->x_m[cell] = block.x_m[i];
      preview_->y_m[cell] = block.y_m[i];
      preview_->z_m[cell] = block.z_m[i];
      intensity_[cell] = block.intensity.empty() ? 1 : block.intensity[i];
      if (preview_->red.empty() || block.red.empty()) continue;
      preview_->red[cell] = block.red[i], preview_->green[cell] = block.green[i], preview_->blue[cell] = block.blue[i];
    }
    return {};
  }

  // The picture's greys go from the darkest to the lightest twentieth.
  Result<void> end() override {
    std::vector<float> sorted;
    for (std::size_t i = 0; i < intensity_.size(); ++i)
      if (std::isfinite(preview_->x_m[i])) sorted.push_back(intensity_[i]);
    if (sorted.empty()) return {};
    std::sort(sorted.begin(), sorted.end());
    const float low = sorted[sorted.size() / 20], high = sorted[sorted.size() - 1 - sorted.size() / 20];
    for (std::size_t i = 0; i < intensity_.size(); ++i)
      if (std::isfinite(preview_->x_m[i]))
        preview_->grey[i] = static_cast<std::uint8_t>(
            40 + 215 * std::clamp((intensity_[i] - low) / std::max(1e-6F, high - low), 0.0F, 1.0F));
    return {};
  }
  Result<void> close() override { return {}; }

  std::shared_ptr<ScanPreview> take() { return std::move(preview_); }

 private:
  std::shared_ptr<ScanPreview> preview_ = std::make_shared<ScanPreview>();
  std::vector<float> intensity_;
  std::uint32_t step_ = 1;
};

}  // namespace

std::array<std::uint8_t, 3> pixelOf(const ScanPreview& preview, std::size_t cell, const std::string& colouring) {
  constexpr std::array<std::uint8_t, 3> kRed = {150, 20, 20};
  const std::uint8_t grey = preview.grey[cell];
  if (!std::isfinite(preview.x_m[cell]) && (colouring == "luminance" || colouring == "true_colour")) return kRed;
  if (preview.red.empty() || colouring == "luminance" || colouring.empty()) return {grey, grey, grey};
  return {preview.red[cell], preview.green[cell], preview.blue[cell]};
}

Result<std::shared_ptr<const ScanPreview>> readPreview(const std::filesystem::path& file, Progress& progress) {
  const auto* format = cloudFormatFor(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::unusable, "cannot read the file", file.string());
  Thinner thinner;
  TRY(format->read(file, thinner, progress));
  return thinner.take();
}

}  // namespace standpoint
