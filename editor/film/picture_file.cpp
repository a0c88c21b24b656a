// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/picture_file.h"

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include "core/part_file.h"

namespace standpoint {

namespace {

constexpr int kJpegQuality = 92;

void append(void* to, void* data, int size) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::vector<std::uint8_t> opaque(const PixelPicture& picture) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(picture.rgba.size() * 3);
  for (const auto& p : picture.rgba) rgb.insert(rgb.end(), p.begin(), p.begin() + 3);
  return rgb;
}

std::string jpegOf(const PixelPicture& picture) {
  std::string bytes;
  const auto rgb = opaque(picture);
  if (stbi_write_jpg_to_func(append, &bytes, picture.width, picture.height, 3, rgb.data(), kJpegQuality) == 0)
    bytes.clear();
  return bytes;
}

// A segment APP1 behind the marker of the beginning: https://developers.google.com/streetview/spherical-metadata
std::string saidSpherical(const PixelPicture& picture, const std::string& jpeg) {
  std::string text = "http://ns.adobe.com/xap/1.0/";
  text += '\0';
  text += fmt::format(
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
      "GPano:ProjectionType=\"equirectangular\" GPano:UsePanoramaViewer=\"True\" "
      "GPano:FullPanoWidthPixels=\"{0}\" GPano:FullPanoHeightPixels=\"{1}\" "
      "GPano:CroppedAreaImageWidthPixels=\"{0}\" GPano:CroppedAreaImageHeightPixels=\"{1}\" "
      "GPano:CroppedAreaLeftPixels=\"0\" GPano:CroppedAreaTopPixels=\"0\"/></rdf:RDF></x:xmpmeta>",
      picture.width, picture.height);
  const auto length = text.size() + 2;
  const std::string head = {'\xff', '\xe1', static_cast<char>(length >> 8U), static_cast<char>(length & 0xffU)};
  return jpeg.substr(0, 2) + head + text + jpeg.substr(2);
}

}  // namespace

Result<std::string> pngOf(const PixelPicture& picture) {
  std::string bytes;
  const auto rgb = opaque(picture);
  stbi_flip_vertically_on_write(0);
  if (stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3, rgb.data(), picture.width * 3) == 0)
    return failure(ErrorKind::internal, "cannot encode the picture: not enough memory");
  return bytes;
}

Result<void> writePicture(const PixelPicture& picture, const std::filesystem::path& file, PictureShape shape) {
  const auto extension = file.extension();
  if (extension == ".png") {
    TRY_ASSIGN(const auto bytes, pngOf(picture));
    return writeWholeText(file, bytes);
  }
  if (extension != ".jpg" && extension != ".jpeg")
    return failure(ErrorKind::usage, "unsupported picture format: use .png or .jpg", file.string());
  stbi_flip_vertically_on_write(0);
  auto bytes = jpegOf(picture);
  if (bytes.empty()) return failure(ErrorKind::internal, "cannot encode the picture: not enough memory", file.string());
  if (shape == PictureShape::spherical) bytes = saidSpherical(picture, bytes);
  return writeWholeText(file, bytes);
}

}  // namespace standpoint
