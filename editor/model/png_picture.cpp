// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/png_picture.h"

#include <png.h>

namespace standpoint {

Result<std::shared_ptr<const PixelPicture>> readPngPicture(const std::filesystem::path& file) {
  constexpr png_uint_32 kLargestSide = 4096;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0)
    return failure(ErrorKind::unusable, image.message, file.filename().string());
  if (image.width > kLargestSide || image.height > kLargestSide) {
    png_image_free(&image);
    return failure(ErrorKind::unusable, "the picture has more than 4096 pixels a side", file.filename().string());
  }
  image.format = PNG_FORMAT_RGBA;
  auto picture = std::make_shared<PixelPicture>();
  picture->width = static_cast<int>(image.width);
  picture->height = static_cast<int>(image.height);
  picture->rgba.resize(std::size_t{image.width} * image.height);
  if (png_image_finish_read(&image, nullptr, picture->rgba.data(), 0, nullptr) == 0)
    return failure(ErrorKind::unusable, image.message, file.filename().string());
  return picture;
}

}  // namespace standpoint
