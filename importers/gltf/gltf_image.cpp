// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstring>
#include <string_view>

#include "importers/gltf/gltf_material.h"

namespace standpoint {

namespace {

// Extensions by which a texture names an image in a format that is not PNG or JPEG.
struct OtherFormat {
  const char* extension;
  const char* format;
};
constexpr std::array kOtherFormats{OtherFormat{"KHR_texture_basisu", "KTX2"}, OtherFormat{"EXT_texture_webp", "WebP"},
                                   OtherFormat{"EXT_texture_avif", "AVIF"}, OtherFormat{"MSFT_texture_dds", "DDS"}};

std::string_view textOf(std::span<const std::byte> bytes, std::size_t from, std::size_t length) {
  if (bytes.size() < from + length) return {};
  return {reinterpret_cast<const char*>(bytes.data()) + from, length};
}

// What an image that is not kept is, for the report.
std::string formatOf(std::span<const std::byte> bytes) {
  if (bytes.empty()) return "empty";
  if (textOf(bytes, 1, 6) == "KTX 20" || textOf(bytes, 1, 6) == "KTX 11") return "KTX";
  if (textOf(bytes, 0, 4) == "RIFF" && textOf(bytes, 8, 4) == "WEBP") return "WebP";
  if (textOf(bytes, 0, 4) == "DDS ") return "DDS";
  if (textOf(bytes, 4, 8) == "ftypavif") return "AVIF";
  if (textOf(bytes, 0, 3) == "GIF") return "GIF";
  if (textOf(bytes, 0, 2) == "BM") return "BMP";
  return "of an unknown format";
}

}  // namespace

std::string gltfMediaType(std::span<const std::byte> bytes) {
  if (textOf(bytes, 0, 8) == "\x89PNG\r\n\x1A\n") return "image/png";
  if (textOf(bytes, 0, 3) == "\xFF\xD8\xFF") return "image/jpeg";
  return {};
}

std::int32_t GltfImages::ofTexture(std::size_t texture, const std::string& asked_by) {
  const auto& gltf = file_.element(file_.model().textures, "textures", texture, asked_by);
  const std::string place = "/textures/" + std::to_string(texture);
  const auto source = gltfIndex(gltf.source);
  if (file_.failed()) return -1;
  const char* other = nullptr;
  for (const auto& [extension, format] : kOtherFormats)
    if (gltf.extensions.contains(extension)) other = format;
  if (source) {
    if (other != nullptr && !known_.contains(*source))
      report_.note(
          place, std::string("its ") + other + " image is not supported; the " + "texture's alternative image is used");
    return ofImage(*source, place, asked_by);
  }
  report_.lose(asked_by, other != nullptr ? std::string("its image (") + place + ") is " + other +
                                                ", which is not supported and has no PNG or JPEG alternative"
                                          : "its texture (" + place + ") names no image");
  return -1;
}

std::int32_t GltfImages::ofImage(std::size_t index, const std::string& texture_place, const std::string& asked_by) {
  if (const auto found = known_.find(index); found != known_.end()) return found->second;
  const std::string place = "/images/" + std::to_string(index);
  const auto& gltf = file_.element(file_.model().images, "images", index, texture_place + "/source");
  auto& result = known_[index] = -1;
  auto bytes = bytesOf(gltf, place);
  if (file_.failed()) return -1;
  if (!bytes) {
    report_.lose(asked_by, "cannot read its image: " + describe(bytes.error()));
    return -1;
  }
  Image image;
  image.bytes.resize(bytes->size());
  if (!bytes->empty()) std::memcpy(image.bytes.data(), bytes->data(), bytes->size());
  image.media_type = gltfMediaType(image.bytes);
  if (image.media_type.empty()) {
    report_.lose(asked_by, "its image (" + place + ") is " + formatOf(image.bytes) + "; PNG and JPEG are supported");
    return -1;
  }
  const auto& uri = gltf.uri;
  image.name = uri.empty() || uri.starts_with("data:") ? gltf.name : percentDecoded(uri);
  images_.push_back(std::make_shared<const Image>(std::move(image)));
  return result = static_cast<std::int32_t>(images_.size() - 1);
}

Result<std::vector<std::uint8_t>> GltfImages::bytesOf(const tinygltf::Image& image, const std::string& place) {
  if (const auto buffer_view = gltfIndex(image.bufferView)) {
    const auto bytes = file_.view(*buffer_view, place);
    if (file_.failed() || !file_.spend(bytes.size(), place)) return {};
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  }
  if (image.uri.empty()) return failure(ErrorKind::unusable, "has neither a bufferView nor a uri", place);
  auto bytes = file_.resource(image.uri, place);
  if (bytes && !file_.spend(bytes->size(), place)) return {};
  return bytes;
}

}  // namespace standpoint
