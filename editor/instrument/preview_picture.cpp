// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/preview_picture.h"

namespace standpoint {

std::shared_ptr<const PixelPicture> pictureOf(const ScanPreview& preview) {
  auto picture = std::make_shared<PixelPicture>();
  picture->width = static_cast<int>(preview.columns);
  picture->height = static_cast<int>(preview.rows);
  picture->rgba.resize(preview.grey.size());
  for (std::uint32_t row = 0; row < preview.rows; ++row)
    for (std::uint32_t column = 0; column < preview.columns; ++column) {
      const std::uint8_t grey = preview.grey[std::size_t{preview.rows - 1 - row} * preview.columns + column];
      picture->rgba[std::size_t{row} * preview.columns + column] = {grey, grey, grey, 255};
    }
  return picture;
}

}  // namespace standpoint
