// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "editor/model/style.h"
#include "editor/model/view_state.h"
#include "emulated-ui/device/orders.h"

namespace standpoint {

// A device's preview as pixels, its first row the uppermost, coloured as the device's user chose.
std::shared_ptr<const PixelPicture> pictureOf(const ScanPreview& preview, const std::string& colouring);

// Pictures of the previews that a device shows, made once for each colouring.
class PreviewPictures {
 public:
  const std::shared_ptr<const PixelPicture>& of(const std::shared_ptr<const ScanPreview>& preview,
                                                const std::string& colouring);

 private:
  struct Made {
    std::weak_ptr<const ScanPreview> preview;
    std::shared_ptr<const PixelPicture> picture;
  };
  std::map<std::pair<const ScanPreview*, std::string>, Made> made_;
};

// Of these letters the ones to draw a device's with, that are to be so many pixels high: the smallest that are no
// smaller, so that they are made smaller rather than larger.
ImFont* lettersFor(const Fonts& fonts, float pixels);

}  // namespace standpoint
