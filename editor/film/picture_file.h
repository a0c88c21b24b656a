// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"
#include "editor/model/view_state.h"

namespace standpoint {

// Writes a picture by its name: .png, or .jpg. The file is whole or not there. A spherical one says so in a JPEG, in
// the words that viewers of 360° pictures read (Photo Sphere XMP metadata), so that they turn it.
enum class PictureShape { flat, spherical };
Result<void> writePicture(const PixelPicture& picture, const std::filesystem::path& file,
                          PictureShape shape = PictureShape::flat);

// The bytes of the file alone.
Result<std::string> pngOf(const PixelPicture& picture);

}  // namespace standpoint
