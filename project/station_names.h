// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options that say a small thing in a notation of their own.

#include <string>
#include <vector>

#include "project/fields.h"

namespace standpoint {

// "all", or names separated by commas.
struct StationNames {
  std::vector<std::string> names;  // empty: all
};
template <>
struct FieldValue<StationNames> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<StationNames> read(const nlohmann::json& text);
  static nlohmann::json write(const StationNames& stations);
};

// "i/n": every n-th station from the i-th; 1 <= i <= n.
struct Shard {
  unsigned index = 1, count = 1;
};
template <>
struct FieldValue<Shard> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<Shard> read(const nlohmann::json& text);
  static nlohmann::json write(const Shard& shard);
};

}  // namespace standpoint
