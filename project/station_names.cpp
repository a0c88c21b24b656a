// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/station_names.h"

#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace standpoint {

using nlohmann::json;

Result<StationNames> FieldValue<StationNames>::read(const json& value) {
  const auto& text = value.get_ref<const std::string&>();
  StationNames stations;
  if (text == "all") return stations;
  for (std::size_t from = 0; from <= text.size();) {
    const auto comma = std::min(text.find(',', from), text.size());
    stations.names.push_back(text.substr(from, comma - from));
    from = comma + 1;
  }
  return stations;
}

json FieldValue<StationNames>::write(const StationNames& stations) {
  return stations.names.empty() ? "all" : fmt::format("{}", fmt::join(stations.names, ","));
}

Result<Shard> FieldValue<Shard>::read(const json& value) {
  const auto& text = value.get_ref<const std::string&>();
  const char* const end = text.data() + text.size();
  Shard shard;
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec == std::errc() && index.ptr != end && *index.ptr == '/') {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    if (count.ec == std::errc() && count.ptr == end && shard.index >= 1 && shard.index <= shard.count) return shard;
  }
  return failure(ErrorKind::usage, fmt::format("'{}' is not i/n with 1 <= i <= n", text));
}

json FieldValue<Shard>::write(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

}  // namespace standpoint
