// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/texture.h"

#include <cstring>

#include <stb/stb_image.h>
#include <vtkImageData.h>
#include <vtkNew.h>

namespace standpoint {

namespace {

constexpr int kLargestSide = 16384;

vtkSmartPointer<vtkTexture> decoded(const Image& image) {
  const auto* bytes = reinterpret_cast<const stbi_uc*>(image.bytes.data());
  const int size = static_cast<int>(image.bytes.size());
  int width = 0, height = 0, channels = 0;
  if (image.bytes.size() > (std::size_t{1} << 30U) ||
      stbi_info_from_memory(bytes, size, &width, &height, &channels) == 0)
    return nullptr;
  if (width > kLargestSide || height > kLargestSide) return nullptr;
  stbi_set_flip_vertically_on_load_thread(1);  // VTK's first row is the lowest
  const int wanted = channels == 2 || channels == 4 ? 4 : 3;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes, size, &width, &height, &channels, wanted), stbi_image_free);
  if (!pixels) return nullptr;
  vtkNew<vtkImageData> data;
  data->SetDimensions(width, height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, wanted);
  std::memcpy(data->GetScalarPointer(), pixels.get(),
              static_cast<std::size_t>(width) * static_cast<std::size_t>(height * wanted));
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(data);
  texture->SetColorModeToDirectScalars();
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOn();
  return texture;
}

}  // namespace

vtkSmartPointer<vtkTexture> clampedTexture(int width, int height, std::span<const std::array<std::uint8_t, 4>> pixels) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(width, height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  std::memcpy(data->GetScalarPointer(), pixels.data(), pixels.size_bytes());
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(data);
  texture->SetColorModeToDirectScalars();
  texture->InterpolateOn();
  texture->RepeatOff();
  texture->EdgeClampOn();
  return texture;
}

vtkSmartPointer<vtkTexture> TextureCache::of(const std::shared_ptr<const Image>& image) {
  std::erase_if(entries_, [](const auto& e) { return e.second.image.expired(); });
  auto& entry = entries_[image.get()];
  if (entry.image.lock() != image) entry = {image, decoded(*image)};
  return entry.texture;
}

}  // namespace standpoint
