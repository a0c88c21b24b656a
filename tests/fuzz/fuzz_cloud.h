// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "pointclouds/files/block_check.h"
#include "pointclouds/formats.h"
#include "tests/fuzz/fuzz_file.h"

namespace standpoint::fuzz {

// Keeps nothing; what breaks the promises of core/points.h is a fault.
class CheckingSink final : public PointSink {
 public:
  std::string wrong;
  Result<void> begin(const ScanHeader& header) override {
    header_ = header;
    return take(checkHeader(header));
  }
  Result<void> write(const PointBlock& block) override {
    if (block.size() == 0) return {};
    return take(checkBlock(header_, block).map([](const BlockExtent&) {}));
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  Result<void> take(const Result<void>& checked) {
    if (!checked) wrong = checked.error().message;
    return checked;
  }
  ScanHeader header_;
};

inline int readCloud(const CloudFormat& format, const std::uint8_t* data, std::size_t size) {
  const auto file = fileOf(data, size, format.extension);
  CheckingSink sink;
  Progress progress;
  const auto read = format.read(file, sink, progress);
  const auto told = format.info(file);
  if (sink.wrong.empty() && !read && read.error().source.empty()) sink.wrong = "an error names no place";
  if (sink.wrong.empty() && !told && told.error().source.empty()) sink.wrong = "an error of info names no place";
  if (sink.wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n", sink.wrong.c_str());
  std::abort();
}

}  // namespace standpoint::fuzz
