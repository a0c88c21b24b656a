// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/preview_picture.h"

#include <imgui.h>

#include "emulated-ui/preview.h"

namespace standpoint {

std::shared_ptr<const PixelPicture> pictureOf(const ScanPreview& preview, const std::string& colouring) {
  auto picture = std::make_shared<PixelPicture>();
  picture->width = static_cast<int>(preview.columns);
  picture->height = static_cast<int>(preview.rows);
  picture->rgba.resize(preview.grey.size());
  for (std::uint32_t row = 0; row < preview.rows; ++row)
    for (std::uint32_t column = 0; column < preview.columns; ++column) {
      const auto [red, green, blue] =
          pixelOf(preview, std::size_t{preview.rows - 1 - row} * preview.columns + column, colouring);
      picture->rgba[std::size_t{row} * preview.columns + column] = {red, green, blue, 255};
    }
  return picture;
}

const std::shared_ptr<const PixelPicture>& PreviewPictures::of(const std::shared_ptr<const ScanPreview>& preview,
                                                               const std::string& colouring) {
  std::erase_if(made_, [](const auto& one) { return one.second.preview.expired(); });
  auto& made = made_[{preview.get(), colouring}];
  if (!made.picture) made = {preview, pictureOf(*preview, colouring)};
  return made.picture;
}

ImFont* lettersFor(const Fonts& fonts, float pixels) {
  constexpr float kNear = 0.96F;  // as good as the size itself
  ImFont* best = nullptr;
  for (auto* font : fonts.letters) {
    best = font;
    if (font != nullptr && font->FontSize >= kNear * pixels) break;
  }
  return best;
}

}  // namespace standpoint
