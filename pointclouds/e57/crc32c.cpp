// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/crc32c.h"

#include <array>
#include <cstring>

#if defined(__x86_64__)
#include <nmmintrin.h>
#endif

namespace standpoint {
namespace {

constexpr std::array<std::uint32_t, 256> makeTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1) ? (c >> 1) ^ 0x82F63B78u : c >> 1;
    table[i] = c;
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> kTable = makeTable();

#if defined(__x86_64__)
bool hasInstruction() {
  static const bool has = __builtin_cpu_supports("sse4.2");
  return has;
}

__attribute__((target("sse4.2"))) std::uint32_t crc32cByInstruction(std::span<const std::uint8_t> bytes) {
  std::uint64_t c = 0xFFFFFFFFu;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data() + i, 8);
    c = _mm_crc32_u64(c, word);
  }
  auto rest = static_cast<std::uint32_t>(c);
  for (; i < bytes.size(); ++i) rest = _mm_crc32_u8(rest, bytes[i]);
  return ~rest;
}

__attribute__((target("sse4.2"))) void threeByInstruction(const std::uint8_t* first, std::size_t size,
                                                          std::size_t stride, std::uint32_t* sums) {
  std::uint64_t c[3] = {0xFFFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFFFu};
  std::size_t i = 0;
  for (; i + 8 <= size; i += 8)
    for (std::size_t run = 0; run < 3; ++run) {
      std::uint64_t word;
      std::memcpy(&word, first + run * stride + i, 8);
      c[run] = _mm_crc32_u64(c[run], word);
    }
  for (std::size_t run = 0; run < 3; ++run) {
    auto rest = static_cast<std::uint32_t>(c[run]);
    for (std::size_t k = i; k < size; ++k) rest = _mm_crc32_u8(rest, first[run * stride + k]);
    sums[run] = ~rest;
  }
}
#endif

}  // namespace

std::uint32_t crc32cByTable(std::span<const std::uint8_t> bytes) {
  std::uint32_t c = 0xFFFFFFFFu;
  for (const std::uint8_t byte : bytes) c = kTable[(c ^ byte) & 255] ^ (c >> 8);
  return ~c;
}

std::uint32_t crc32c(std::span<const std::uint8_t> bytes) {
#if defined(__x86_64__)
  if (hasInstruction()) return crc32cByInstruction(bytes);
#endif
  return crc32cByTable(bytes);
}

void crc32cOfRuns(const std::uint8_t* first, std::size_t size, std::size_t stride, std::size_t count,
                  std::uint32_t* sums) {
  std::size_t i = 0;
#if defined(__x86_64__)
  if (hasInstruction())
    for (; i + 3 <= count; i += 3) threeByInstruction(first + i * stride, size, stride, sums + i);
#endif
  for (; i < count; ++i) sums[i] = crc32c({first + i * stride, size});
}

}  // namespace standpoint
