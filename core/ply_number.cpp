// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply_number.h"

namespace standpoint {

namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array kTypes = {
    TypeName{"char", PlyType::int8},      TypeName{"int8", PlyType::int8},       TypeName{"uchar", PlyType::uint8},
    TypeName{"uint8", PlyType::uint8},    TypeName{"short", PlyType::int16},     TypeName{"int16", PlyType::int16},
    TypeName{"ushort", PlyType::uint16},  TypeName{"uint16", PlyType::uint16},   TypeName{"int", PlyType::int32},
    TypeName{"int32", PlyType::int32},    TypeName{"uint", PlyType::uint32},     TypeName{"uint32", PlyType::uint32},
    TypeName{"float", PlyType::float32},  TypeName{"float32", PlyType::float32}, TypeName{"double", PlyType::float64},
    TypeName{"float64", PlyType::float64}};

}  // namespace

std::optional<PlyType> plyType(std::string_view word) {
  const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeName& t) { return t.name == word; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->type);
}

std::size_t sizeOf(PlyType type) {
  constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

}  // namespace standpoint
