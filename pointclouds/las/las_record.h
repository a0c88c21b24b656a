// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pointclouds/files/raw_bytes.h"

namespace standpoint::las {

// Bytes before the data of a variable length record, and of an extended one.
constexpr std::size_t kRecordHead = 54, kExtendedHead = 60;

// The extra bytes of a record that are ours (LAS 1.4 R15, table 24, "LASF_Spec" 4), by their names in the file.
enum class Extra : std::uint8_t {
  product,
  material,
  row,
  column,
  channel,
  true_x,
  true_y,
  true_z,
  true_range,
  incidence,
  received_power,
  flags
};
struct ExtraKind {
  const char* name;
  const char* description;  // at most 31 characters
  std::uint8_t type;        // 1 u8, 3 u16, 5 u32, 6 i32, 9 f32
  std::uint8_t bytes;
};
inline constexpr ExtraKind kExtras[] = {{"product", "index into the products' table", 5, 4},
                                        {"material", "index into the materials' table", 5, 4},
                                        {"row", "of the scan grid", 5, 4},
                                        {"column", "of the scan grid", 5, 4},
                                        {"channel", "of a head with several lasers", 1, 1},
                                        {"true_x", "of the surface that returned, m", 6, 4},
                                        {"true_y", "of the surface that returned, m", 6, 4},
                                        {"true_z", "of the surface that returned, m", 6, 4},
                                        {"true_range", "that the light travelled, m", 9, 4},
                                        {"incidence", "beam to normal, rad", 9, 4},
                                        {"received_power", "over a white target at 1 m, dB", 9, 4},
                                        {"flags", "core/points.h: point_flag", 1, 1}};
inline constexpr std::size_t kExtraKinds = std::size(kExtras);

// Where the extra bytes of a kind stand in a record; those of a file that are not ours have no place here.
struct ExtraPlaces {
  std::optional<std::uint32_t> at[kExtraKinds];
  std::uint32_t end = 0;  // where the next one would stand
  const std::optional<std::uint32_t>& operator[](Extra kind) const { return at[static_cast<std::size_t>(kind)]; }
};

inline constexpr const char* kOurRecord = "Standpoint";  // user id of the record with the lines of scan_text.h
inline constexpr std::uint16_t kOurRecordId = 1;
inline constexpr double kAdjustedGps_s = 1e9;  // "adjusted standard GPS time" is less by that

}  // namespace standpoint::las
