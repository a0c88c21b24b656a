// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/pcd/pcd.h"
#include "tests/fuzz/fuzz_cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return standpoint::fuzz::readCloud(standpoint::kPcd, data, size);
}
