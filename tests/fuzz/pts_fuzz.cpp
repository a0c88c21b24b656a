// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/text/text_points.h"
#include "tests/fuzz/fuzz_cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return standpoint::fuzz::readCloud(standpoint::kPts, data, size);
}
