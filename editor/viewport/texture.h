// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "core/environment.h"

namespace standpoint {

// Images of the environment as textures, decoded when they are first shown and kept as long as the image is.
class TextureCache {
 public:
  // Null where the image cannot be decoded or is larger than a texture can be.
  vtkSmartPointer<vtkTexture> of(const std::shared_ptr<const Image>& image);

 private:
  struct Entry {
    std::weak_ptr<const Image> image;
    vtkSmartPointer<vtkTexture> texture;
  };
  std::map<const Image*, Entry> entries_;
};

// Of pixels, the lowest row first, that is not repeated beyond its rim.
vtkSmartPointer<vtkTexture> clampedTexture(int width, int height, std::span<const std::array<std::uint8_t, 4>> pixels);

}  // namespace standpoint
