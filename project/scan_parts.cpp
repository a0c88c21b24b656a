// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/scan_parts.h"

#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestRecord = 1U << 16U;

}  // namespace

ScanParts::ScanParts(const fs::path& output) {
  fs::path file = output.lexically_normal();
  if (!file.has_filename()) file = file.parent_path();  // "scans/"
  folder_ = file;
  folder_ += ".parts";
}

fs::path ScanParts::recordOf(const std::string& station) const { return folder_ / (station + ".json"); }
fs::path ScanParts::pointsOf(const std::string& station) const { return folder_ / (station + ".points"); }

bool ScanParts::hasRecord(const std::string& station) const {
  std::error_code code;
  return fs::exists(recordOf(station), code);
}

std::optional<ScanParts::Finished> ScanParts::finished(const std::string& station, const std::string& guid) const {
  std::error_code code;
  if (const auto size = fs::file_size(recordOf(station), code); code || size > kLargestRecord) return std::nullopt;
  std::ifstream stream(recordOf(station), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const json row = json::parse(text, nullptr, false);
  const auto number = [&](const char* key) {
    return row.contains(key) && row[key].is_number_unsigned() ? row[key].get<std::uint64_t>() : 0;
  };
  if (!row.is_object() || row.value("guid", json()) != json(guid)) return std::nullopt;
  return Finished{{number("pulses"), number("returns"), number("points")}, number("bytes")};
}

Result<void> ScanParts::record(const std::string& station, const std::string& guid, const Finished& finished) const {
  std::error_code code;
  fs::create_directories(folder_, code);
  const auto text = json{
      {"guid", guid},
      {"pulses", finished.count.pulses},
      {"returns", finished.count.returns},
      {"points", finished.count.points},
      {"bytes",
       finished.bytes}}.dump(2);
  return writeWholeText(recordOf(station), text);
}

void ScanParts::remove(const std::string& station) const {
  std::error_code ignored;
  fs::remove(recordOf(station), ignored);
  fs::remove(pointsOf(station), ignored);
  fs::remove(folder_, ignored);  // when it is empty: another machine's shard may have its records there
}

}  // namespace standpoint
