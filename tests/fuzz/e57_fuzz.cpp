// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include "pointclouds/e57/crc32c.h"
#include "pointclouds/e57/e57.h"
#include "tests/fuzz/fuzz_cloud.h"

// The checksums of the pages are mended first: else nothing that the fuzzer changes gets behind them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kPage = 1024, kPayload = 1020;
  std::vector<std::uint8_t> bytes(data, data + size);
  for (std::size_t page = 0; page + kPage <= size; page += kPage) {
    const std::uint32_t sum = standpoint::crc32c({bytes.data() + page, kPayload});
    for (std::size_t i = 0; i < 4; ++i) bytes[page + kPayload + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
  }
  return standpoint::fuzz::readCloud(standpoint::kE57, bytes.data(), bytes.size());
}
