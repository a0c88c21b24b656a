// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "pointclouds/files/file_access.h"
#include "pointclouds/files/local_points.h"

namespace standpoint {

// Records of one size in a file, a point each.
struct PointRecords {
  const char* noun;  // "vertex": what the format calls one
  std::uint64_t at = 0, count = 0;
  std::size_t bytes = 0;  // of one
};

constexpr std::uint64_t kPointsAtOnce = 65536;  // that are handed on together; records hold at most 8 MiB meanwhile

// `take(index, bytes, points)` reads one; what is wrong with it is told with its place in the file.
template <class Take>
Result<void> readRecordPoints(const std::filesystem::path& path, const PointRecords& records, LocalPoints& local,
                              Progress& progress, Take take) {
  constexpr std::uint64_t kMostBytes = 8 << 20;
  TRY_ASSIGN(auto file, InputFile::open(path));
  const auto place = [&](std::uint64_t index) {
    return file.name() + " " + records.noun + " " + std::to_string(index);
  };
  const std::uint64_t at_once = std::clamp<std::uint64_t>(kMostBytes / records.bytes, 1, kPointsAtOnce);
  std::vector<std::uint8_t> bytes;
  FoundPoints found;
  for (std::uint64_t done = 0; done < records.count;) {
    const std::uint64_t count = std::min(at_once, records.count - done);
    bytes.resize(count * records.bytes);
    TRY_ASSIGN(const auto n, file.read(records.at + done * records.bytes, bytes));
    if (n < bytes.size()) return failure(ErrorKind::unusable, "the file was truncated while reading", place(done));
    for (std::uint64_t i = 0; i < count; ++i)
      if (auto taken = take(done + i, bytes.data() + i * records.bytes, found); !taken)
        return failure(ErrorKind::unusable, taken.error().message, place(done + i));
    if (auto written = local.write(found); !written) return written;
    done += count;
    progress.advance(static_cast<double>(done) / static_cast<double>(records.count));
    if (auto going = progress.check(); !going) return going;
  }
  return {};
}

}  // namespace standpoint
