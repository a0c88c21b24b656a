// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/files/utf8.h"

#include <array>

namespace standpoint {

namespace {

bool isCharacter(std::uint32_t code) { return code <= 0x10FFFF && (code < 0xD800 || code >= 0xE000); }

}  // namespace

std::optional<Utf8Character> utf8At(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[at + i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return Utf8Character{lead, 1};
  const unsigned more = lead >= 0xF0 && lead < 0xF5   ? 3
                        : lead >= 0xE0 && lead < 0xF0 ? 2
                        : lead >= 0xC2 && lead < 0xE0 ? 1
                                                      : 0;
  if (more == 0 || at + more >= text.size()) return std::nullopt;
  std::uint32_t code = lead & (0x3FU >> more);
  for (unsigned i = 1; i <= more; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return std::nullopt;
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 4> kLeast{0, 0x80, 0x800, 0x10000};
  if (code < kLeast[more] || !isCharacter(code)) return std::nullopt;
  return Utf8Character{code, std::size_t{more} + 1};
}

void appendUtf8(std::string& text, std::uint32_t code) {
  if (!isCharacter(code)) code = kReplacementCharacter;
  if (code < 0x80) {
    text += static_cast<char>(code);
    return;
  }
  const unsigned more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // bytes after the first
  const unsigned lead = more == 1 ? 0xC0 : more == 2 ? 0xE0 : 0xF0;
  text += static_cast<char>(lead | code >> 6U * more);
  for (unsigned i = more; i-- > 0;) text += static_cast<char>(0x80U | (code >> 6U * i & 0x3FU));
}

}  // namespace standpoint
