// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/crc32c.h"

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

TEST(Crc32c, OfRunsIsThatOfEachOfThem) {
  constexpr std::size_t kStride = 24, kMost = 8;
  std::vector<std::uint8_t> bytes;
  for (std::uint32_t n = 0; n < kMost * kStride; ++n)
    bytes.push_back(static_cast<std::uint8_t>(philox({1, 3}, n, 0, 0)[0]));
  for (std::size_t size = 0; size <= kStride; ++size)
    for (std::size_t count = 0; count <= kMost; ++count) {
      std::vector<std::uint32_t> sums(count);
      crc32cOfRuns(bytes.data(), size, kStride, count, sums.data());
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(sums[i], crc32cByTable({bytes.data() + i * kStride, size})) << size << " bytes, run " << i;
    }
}

}  // namespace
}  // namespace standpoint
