// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/points.h"
#include "pointclouds/formats.h"

namespace standpoint::testing {

// Keeps everything, which no sink of the program does.
class KeptScans final : public PointSink {
 public:
  struct Scan {
    ScanHeader header;
    PointBlock points;
    bool ended = false;
  };
  std::vector<Scan> scans;
  std::vector<std::vector<StationPicture>> pictures;  // of the scans that have any

  Result<void> begin(const ScanHeader& header) override { return scans.push_back({header, {}, false}), Result<void>{}; }
  Result<void> write(const PointBlock& b) override {
    PointBlock& all = scans.back().points;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.x_m, b.x_m), append(all.y_m, b.y_m), append(all.z_m, b.z_m), append(all.intensity, b.intensity);
    append(all.row, b.row), append(all.column, b.column);
    append(all.red, b.red), append(all.green, b.green), append(all.blue, b.blue);
    append(all.product, b.product), append(all.material, b.material);
    append(all.time_s, b.time_s), append(all.channel, b.channel);
    append(all.return_number, b.return_number), append(all.return_count, b.return_count);
    PointTruth& truth = all.truth;
    append(truth.x_m, b.truth.x_m), append(truth.y_m, b.truth.y_m), append(truth.z_m, b.truth.z_m);
    append(truth.range_m, b.truth.range_m), append(truth.incidence_rad, b.truth.incidence_rad);
    append(truth.received_db, b.truth.received_db), append(truth.flags, b.truth.flags);
    return {};
  }
  Result<void> picture(const StationPicture& picture) override {
    return pictures.resize(scans.size()), pictures.back().push_back(picture), Result<void>{};
  }
  Result<void> end() override { return scans.back().ended = true, Result<void>{}; }
  Result<void> close() override { return {}; }
};

inline Result<Report> readAll(const std::filesystem::path& file, KeptScans& into) {
  Progress progress;
  return cloudFormatFor(file)->read(file, into, progress);
}

inline std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void putBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::remove(file);  // some file systems wait for the disk when a file is cut to nothing and refilled
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string said(const Report& report) {
  std::string text;
  for (const Issue& issue : report.issues)
    text += std::string(name(issue.severity)) + " " + issue.source + ": " + issue.message + "\n";
  return text;
}

}  // namespace standpoint::testing

#define ASSERT_OK(expression)                                          \
  do {                                                                 \
    const auto& ok_result = (expression);                              \
    ASSERT_TRUE(ok_result.has_value()) << describe(ok_result.error()); \
  } while (false)
