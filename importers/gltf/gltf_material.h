// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/environment.h"
#include "core/report.h"
#include "importers/gltf/gltf_file.h"

namespace standpoint {

// Where a material's image takes its coordinates from.
struct GltfTextureUse {
  std::size_t set = 0;                                           // TEXCOORD_<set>
  Eigen::Affine2d image_from_set = Eigen::Affine2d::Identity();  // KHR_texture_transform
  bool vertex_alpha = false;                                     // counts where the material blends (glTF 2.0 §3.9.4)
};

// The optional figures of a surface that our own files keep in extras to the last bit, by their keys there.
struct GltfSurfaceFigure {
  const char* key;
  std::optional<float> Surface::*value;
};
inline constexpr std::array kGltfSurfaceFigures{GltfSurfaceFigure{"metallic", &Surface::metallic},
                                                GltfSurfaceFigure{"roughness", &Surface::roughness},
                                                GltfSurfaceFigure{"transmission", &Surface::transmission},
                                                GltfSurfaceFigure{"index_of_refraction", &Surface::index_of_refraction},
                                                GltfSurfaceFigure{"thickness_m", &Surface::thickness_m},
                                                GltfSurfaceFigure{"clearcoat", &Surface::clearcoat},
                                                GltfSurfaceFigure{"specular", &Surface::specular}};

struct GltfMaterials {
  std::vector<Surface> surfaces;
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<std::uint32_t> surface_of_material;
  std::vector<GltfTextureUse> texture_of_material;
  GltfTextureUse without_material;
};

// One surface for each of the file's materials, in order, with the images that they show. A file that we wrote gives
// back the surfaces and images that went into it. What a surface does not keep goes to the report, one line for each
// kind.
GltfMaterials readGltfMaterials(GltfFile& file, Report& report);

// The images that base colours need, each once, encoded as they are in the file.
class GltfImages {
 public:
  GltfImages(GltfFile& file, Report& report) : file_(file), report_(report) {}

  // The image of a texture as an index into take(), or −1, said in the report, where there is none that can be kept.
  std::int32_t ofTexture(std::size_t texture, const std::string& asked_by);
  std::vector<std::shared_ptr<const Image>> take() { return std::move(images_); }

 private:
  std::int32_t ofImage(std::size_t index, const std::string& texture_place, const std::string& asked_by);
  Result<std::vector<std::uint8_t>> bytesOf(const tinygltf::Image& image, const std::string& place);

  GltfFile& file_;
  Report& report_;
  std::vector<std::shared_ptr<const Image>> images_;
  std::map<std::size_t, std::int32_t> known_;
};

// "image/png" or "image/jpeg" by the first bytes, which tell the truth more often than a file's name; else empty.
std::string gltfMediaType(std::span<const std::byte> bytes);

// glTF colours are linear, ours are sRGB (IEC 61966-2-1).
float srgbFromLinear(float linear);
float linearFromSrgb(float srgb);

// Vertex colours: eight bits of sRGB are sixteen of linear and the way back is exact.
std::uint8_t srgb8FromLinear16(std::uint16_t linear);
std::uint16_t linear16FromSrgb8(std::uint8_t srgb);

}  // namespace standpoint
