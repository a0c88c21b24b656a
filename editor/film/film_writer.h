// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/result.h"
#include "editor/model/view_state.h"

namespace standpoint {

// Pictures in, an MP4 file out. Whoever does not finish() leaves nothing behind.
class FilmWriter {
 public:
  // Width and height in pixels, even and at most 8192; `rate` in pictures per second, 1 to 240.
  static Result<std::unique_ptr<FilmWriter>> create(const std::filesystem::path& file, int width, int height,
                                                    double rate);
  virtual ~FilmWriter() = default;
  virtual Result<void> append(const PixelPicture& picture) = 0;
  virtual Result<void> finish() = 0;
};

}  // namespace standpoint
