// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace standpoint {

constexpr std::uint32_t kReplacementCharacter = 0xFFFD;

struct Utf8Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};
// The character whose first byte is at `at`; nothing where the bytes are none: cut off, longer than they have to be, a
// surrogate, above U+10FFFF.
std::optional<Utf8Character> utf8At(std::string_view text, std::size_t at);

// What is no character becomes U+FFFD.
void appendUtf8(std::string& text, std::uint32_t code);

}  // namespace standpoint
