// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace standpoint {

// Of RFC 4648 with its padding: how a page of HTML holds a picture.
inline std::string base64Of(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t b = (i + 1 < bytes.size() ? bytes[i + 1] : 0U), c = (i + 2 < bytes.size() ? bytes[i + 2] : 0U);
    const std::uint32_t three = static_cast<std::uint32_t>(bytes[i]) << 16U | b << 8U | c;
    out += kDigits[three >> 18U];
    out += kDigits[three >> 12U & 63U];
    out += i + 1 < bytes.size() ? kDigits[three >> 6U & 63U] : '=';
    out += i + 2 < bytes.size() ? kDigits[three & 63U] : '=';
  }
  return out;
}

}  // namespace standpoint
