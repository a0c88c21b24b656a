// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/escaped_text.h"

#include <algorithm>
#include <charconv>

namespace standpoint {

void appendEscaped(std::string& text, std::string_view value) {
  constexpr char kHex[] = "0123456789abcdef";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\t')
      text += "\\t";
    else if (c == '\n')
      text += "\\n";
    else if (c == '\\')
      text += "\\\\";
    else if (byte < 0x20)
      text.append("\\x").append(1, kHex[byte >> 4]).append(1, kHex[byte & 15]);
    else
      text += c;
  }
}

std::string unescaped(std::string_view text) {
  std::string value;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      value += text[i];
      continue;
    }
    const char kind = text[++i];
    unsigned byte = 0;
    if (kind == 't')
      value += '\t';
    else if (kind == 'n')
      value += '\n';
    else if (kind == 'x' && i + 2 < text.size() &&
             std::from_chars(text.data() + i + 1, text.data() + i + 3, byte, 16).ptr == text.data() + i + 3) {
      value += static_cast<char>(byte);
      i += 2;
    } else
      value += kind;
  }
  return value;
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0, to; from <= text.size(); from = to + 1) {
    to = std::min(text.find(at, from), text.size());
    parts.push_back(text.substr(from, to - from));
  }
  return parts;
}

}  // namespace standpoint
