// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/crc32c.h"

#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace standpoint {
namespace {

std::span<const std::uint8_t> text(const char* t) { return {reinterpret_cast<const std::uint8_t*>(t), std::strlen(t)}; }

TEST(Crc32c, GivesTheNumbersOfRfc3720) {
  EXPECT_EQ(crc32c(std::vector<std::uint8_t>(32, 0)), 0x8A9136AAu);
  EXPECT_EQ(crc32c(std::vector<std::uint8_t>(32, 0xFF)), 0x62A8AB43u);
  EXPECT_EQ(crc32c(text("123456789")), 0xE3069283u);  // the check value of the Castagnoli polynomial
}

TEST(Crc32c, IsTheSameByInstructionAndByTable) {
  std::vector<std::uint8_t> bytes;
  for (std::uint32_t n = 0; n < 1100; ++n) {
    ASSERT_EQ(crc32c(bytes), crc32cByTable(bytes)) << n << " bytes";
    bytes.push_back(static_cast<std::uint8_t>(philox({1, 2}, n, 0, 0)[0]));
  }
}

}  // namespace
}  // namespace standpoint
