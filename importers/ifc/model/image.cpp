// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/image.h"

#include <array>
#include <fstream>
#include <iterator>
#include <utility>

#include <png.h>

namespace standpoint::ifc {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{256} << 20U;

std::string mediaType(const std::vector<std::byte>& bytes) {
  const auto starts = [&](std::initializer_list<int> magic) {
    std::size_t i = 0;
    for (const int b : magic)
      if (i >= bytes.size() || static_cast<int>(bytes[i++]) != b) return false;
    return true;
  };
  if (starts({0x89, 'P', 'N', 'G'})) return "image/png";
  if (starts({0xFF, 0xD8, 0xFF})) return "image/jpeg";
  if (starts({'G', 'I', 'F', '8'})) return "image/gif";
  if (starts({'B', 'M'})) return "image/bmp";
  if (starts({'R', 'I', 'F', 'F'})) return "image/webp";
  return {};
}

// The attributes after TextureTransform: IFC4 put Parameter between.
std::size_t firstOwn(const Entity& texture, std::size_t own_count) {
  return texture.arguments().size() >= 5 + own_count ? 5 : 4;
}

// "0FF00…" in double quotes: the first digit says how many bits of the next are unused; whole bytes need none.
std::vector<std::byte> binary(const Value& value) {
  std::vector<std::byte> bytes;
  const std::string_view text = value.inner().raw();
  if (text.size() < 3 || text[0] != '"' || text[1] != '0') return bytes;
  int high = -1;
  for (const char c : text.substr(2)) {
    const int digit = hexDigit(c);
    if (digit < 0) continue;  // the closing quote; a long literal may be broken over lines
    if (high < 0)
      high = digit;
    else
      bytes.push_back(static_cast<std::byte>(high << 4 | digit)), high = -1;
  }
  return bytes;
}

// Of 8-bit grey, grey with alpha, RGB or RGBA points (1 to 4 components), rows from below as IFC counts them.
std::vector<std::byte> pngFromPixels(const std::vector<std::byte>& pixels, std::uint32_t width, std::uint32_t height,
                                     std::size_t components) {
  constexpr std::array<png_uint_32, 4> kFormats{PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = kFormats[components - 1];
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> png(size);
  const auto from_below = -static_cast<png_int_32>(width * components);
  png.resize(png_image_write_to_memory(&image, png.data(), &size, 0, pixels.data(), from_below, nullptr) ? size : 0);
  return png;
}

Result<Image> pixels(const Entity& texture) {
  const std::size_t at = firstOwn(texture, 4);
  const auto width = texture[at].integer(), height = texture[at + 1].integer(), components = texture[at + 2].integer();
  if (width < 1 || height < 1 || width > 16384 || height > 16384 || components < 1 || components > 4)
    return fail(texture, "the pixel texture has no valid size");
  const Value list = texture[at + 3];
  // Counted before anything is allocated for it: a claim of 16384 × 16384 may have no points at all.
  if (list.size() != static_cast<std::size_t>(width * height))
    return fail(texture, "the pixel count of the pixel texture does not match its size");
  std::vector<std::byte> raw;
  for (const Value v : list) {
    const auto point = binary(v);
    if (point.size() != static_cast<std::size_t>(components))
      return fail(texture, "a pixel of the pixel texture has the wrong number of components");
    raw.insert(raw.end(), point.begin(), point.end());
  }
  auto png = pngFromPixels(raw, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                           static_cast<std::size_t>(components));
  if (png.empty()) return fail(texture, "cannot convert the pixel texture to PNG");
  return Image{"IfcPixelTexture " + texture.place(), "image/png", std::move(png)};
}

Result<Image> blob(const Entity& texture) {
  const std::size_t at = firstOwn(texture, 2);
  Image image{"IfcBlobTexture " + texture.place(), {}, binary(texture[at + 1])};
  image.media_type = mediaType(image.bytes);
  if (image.bytes.empty()) return fail(texture, "the embedded image is empty");
  if (image.media_type.empty()) return fail(texture, "the embedded image is not PNG, JPEG, GIF, BMP or WebP");
  return image;
}

}  // namespace

Result<Image> Images::beside(const Entity& texture) const {
  const std::string name = texture[firstOwn(texture, 1)].text();
  const std::string shown = "the image '" + name.substr(0, 200) + "'";
  const std::filesystem::path relative(name);
  std::error_code code;
  const auto root = std::filesystem::weakly_canonical(folder_.empty() ? "." : folder_, code);
  const auto file = std::filesystem::weakly_canonical(root / relative, code);
  const auto inside = file.lexically_relative(root);
  if (name.empty() || name.find("://") != std::string::npos || relative.is_absolute() || inside.empty() ||
      *inside.begin() == "..")
    return fail(texture, shown + " is not in the model's folder and was not read");
  const auto size = std::filesystem::file_size(file, code);
  if (code) return fail(texture, shown + " does not exist; place it next to the model");
  if (size > kMostBytes) return fail(texture, shown + " is larger than 256 MB");
  std::ifstream in(file, std::ios::binary);
  Image image{name, {}, {}};
  image.bytes.resize(static_cast<std::size_t>(size));
  if (!in.read(reinterpret_cast<char*>(image.bytes.data()), static_cast<std::streamsize>(size)))
    return fail(texture, shown + " could not be read");
  image.media_type = mediaType(image.bytes);
  if (image.media_type.empty()) return fail(texture, shown + " is not PNG, JPEG, GIF, BMP or WebP");
  return image;
}

Result<Image> Images::read(const Entity& texture) const {
  if (texture.is("IFCIMAGETEXTURE")) return beside(texture);
  if (texture.is("IFCBLOBTEXTURE")) return blob(texture);
  if (texture.is("IFCPIXELTEXTURE")) return pixels(texture);
  return fail(texture, std::string(texture.typeName()) + " is not a supported texture");
}

std::int32_t Images::image(const Entity& texture) {
  const auto [it, is_new] = known_.try_emplace(texture.id(), -1);
  if (!is_new) return it->second;
  auto found = read(texture);
  if (!found) {
    report_.lose(found.error().source, found.error().message);
    return -1;
  }
  for (const std::size_t repeat : {0U, 1U})
    if (texture[repeat].symbol() == "F") {
      report_.note(texture.place(),
                   "the texture '" + found->name + "' must not repeat, but repeats where coordinates leave it");
      break;
    }
  it->second = static_cast<std::int32_t>(environment_.images.size());
  environment_.images.push_back(std::make_shared<const Image>(std::move(*found)));
  return it->second;
}

}  // namespace standpoint::ifc
