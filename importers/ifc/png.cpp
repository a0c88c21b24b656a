// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/png.h"

#include <array>
#include <string_view>

#include <zlib.h>

namespace standpoint::ifc {
namespace {

using Bytes = std::vector<std::byte>;

void append32(Bytes& out, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) out.push_back(static_cast<std::byte>(value >> shift & 255U));
}

void chunk(Bytes& out, std::string_view name, const Bytes& content) {
  append32(out, static_cast<std::uint32_t>(content.size()));
  const std::size_t begin = out.size();
  for (const char c : name) out.push_back(static_cast<std::byte>(c));
  out.insert(out.end(), content.begin(), content.end());
  append32(out, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(out.data() + begin), static_cast<uInt>(out.size() - begin))));
}

}  // namespace

Bytes pngFromPixels(const Bytes& pixels, std::uint32_t width, std::uint32_t height, int components) {
  constexpr std::array<std::uint8_t, 4> kColourType{0, 4, 2, 6};
  Bytes header;
  append32(header, width);
  append32(header, height);
  for (const unsigned b : {8U, static_cast<unsigned>(kColourType[static_cast<std::size_t>(components - 1)]), 0U, 0U, 0U}) header.push_back(static_cast<std::byte>(b));
  const std::size_t row = std::size_t{width} * static_cast<std::size_t>(components);
  Bytes rows;
  for (std::size_t y = 0; y < height; ++y) {
    rows.push_back(std::byte{0});   // no filter
    rows.insert(rows.end(), pixels.begin() + static_cast<std::ptrdiff_t>(y * row), pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
  }
  uLongf size = compressBound(rows.size());
  Bytes packed(size);
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()), rows.size(), Z_BEST_SPEED);
  packed.resize(size);
  Bytes out;
  for (const unsigned b : {0x89U, 0x50U, 0x4EU, 0x47U, 0x0DU, 0x0AU, 0x1AU, 0x0AU}) out.push_back(static_cast<std::byte>(b));
  chunk(out, "IHDR", header);
  chunk(out, "IDAT", packed);
  chunk(out, "IEND", {});
  return out;
}

}  // namespace standpoint::ifc
