// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The numbers of PLY files, meshes and clouds alike (Turk, "The PLY Polygon File Format", 1994; the sized names are
// later).

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace standpoint {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// "uchar" and "uint8" are the same; nothing where a word is no type.
std::optional<PlyType> plyType(std::string_view word);

std::size_t sizeOf(PlyType type);

template <class T>
double plyNumber(const void* from, bool big_endian) {
  static_assert(std::endian::native == std::endian::little, "bytes of big-endian files are turned around");
  std::array<std::uint8_t, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return static_cast<double>(std::bit_cast<T>(bytes));
}

// Of sizeOf(type) bytes; here, since rows of millions are read with it.
inline double plyNumber(PlyType type, const void* from, bool big_endian) {
  switch (type) {
    case PlyType::int8: return plyNumber<std::int8_t>(from, big_endian);
    case PlyType::uint8: return plyNumber<std::uint8_t>(from, big_endian);
    case PlyType::int16: return plyNumber<std::int16_t>(from, big_endian);
    case PlyType::uint16: return plyNumber<std::uint16_t>(from, big_endian);
    case PlyType::int32: return plyNumber<std::int32_t>(from, big_endian);
    case PlyType::uint32: return plyNumber<std::uint32_t>(from, big_endian);
    case PlyType::float32: return plyNumber<float>(from, big_endian);
    case PlyType::float64: return plyNumber<double>(from, big_endian);
  }
  return 0;
}

}  // namespace standpoint
