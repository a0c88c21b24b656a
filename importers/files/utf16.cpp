// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/files/utf16.h"

#include <string_view>

#include "importers/files/utf8.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMaxBytes = 1U << 30U;

}  // namespace

bool isUtf16(const FileBytes& bytes) {
  char mark[2];
  if (bytes.size() < 2 || !bytes.read(0, mark, 2)) return false;
  const std::string_view text(mark, 2);
  return text == "\xFE\xFF" || text == "\xFF\xFE";
}

Result<std::string> utf8FromUtf16(const FileBytes& bytes) {
  TRY_ASSIGN(const auto all, bytes.all(kMaxBytes));
  const bool little = all.front() == '\xFF';
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(all[i]), b = static_cast<unsigned char>(all[i + 1]);
    return static_cast<std::uint32_t>(little ? a | b << 8U : b | a << 8U);
  };
  std::string text;
  for (std::size_t i = 2; i + 1 < all.size(); i += 2) {
    const std::uint32_t c = unit(i);
    const bool high = c >= 0xD800 && c < 0xDC00, low = c >= 0xDC00 && c < 0xE000;
    if (!high && !low) {
      appendUtf8(text, c);
    } else if (high && i + 3 < all.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000) {
      appendUtf8(text, 0x10000 + ((c - 0xD800) << 10U) + (unit(i + 2) - 0xDC00));
      i += 2;
    } else {
      text += '?';
    }
  }
  return text;
}

}  // namespace standpoint
