// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string>
#include <string_view>

#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {
int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

namespace {

void appendUtf8(std::string& out, std::uint32_t code) {
  if (code == 0) return;  // no text of ours holds a zero byte
  if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) code = 0xFFFD;
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    out += static_cast<char>(0xE0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    out += static_cast<char>(0xF0 | (code >> 18));
    out += static_cast<char>(0x80 | ((code >> 12) & 0x3F));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
}

// `digits` hexadecimal digits at `at`, or nothing.
std::optional<std::uint32_t> hexNumber(std::string_view s, std::size_t at, std::size_t digits) {
  if (at + digits > s.size()) return {};
  std::uint32_t code = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    const int d = hexDigit(s[at + i]);
    if (d < 0) return {};
    code = code * 16 + static_cast<std::uint32_t>(d);
  }
  return code;
}

// \X2\ and \X4\ runs up to \X0\; returns where the text goes on.
std::size_t appendWide(std::string& out, std::string_view s, std::size_t at, std::size_t digits) {
  std::uint32_t high = 0;
  while (const auto code = hexNumber(s, at, digits)) {
    at += digits;
    if (digits == 4 && *code >= 0xD800 && *code < 0xDC00) {
      high = *code;
    } else if (digits == 4 && high && *code >= 0xDC00 && *code < 0xE000) {
      appendUtf8(out, 0x10000 + ((high - 0xD800) << 10) + (*code - 0xDC00));
      high = 0;
    } else {
      appendUtf8(out, *code);
    }
  }
  return s.substr(at, 4) == "\\X0\\" ? at + 4 : at;
}

// Length of the UTF-8 sequence that begins here, 0 when it is none.
std::size_t utf8Length(std::string_view s, std::size_t at) {
  const auto lead = static_cast<unsigned char>(s[at]);
  const std::size_t length = lead >= 0xF0 && lead < 0xF5   ? 4
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                                                           : 0;
  if (length == 0 || at + length > s.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(s[at + i]) & 0xC0) != 0x80) return 0;
  return length;
}

// An escape that begins at `at` with a backslash; returns where the text goes on.
std::size_t appendEscape(std::string& out, std::string_view s, std::size_t at) {
  const std::string_view rest = s.substr(at);
  if (rest.starts_with("\\\\")) return out += '\\', at + 2;
  if (rest.starts_with("\\S\\") && rest.size() > 3)
    return appendUtf8(out, (static_cast<unsigned char>(rest[3]) & 0x7FU) + 0x80U),
           at + (rest.substr(3, 2) == "''" ? 5 : 4);
  if (rest.starts_with("\\X2\\")) return appendWide(out, s, at + 4, 4);
  if (rest.starts_with("\\X4\\")) return appendWide(out, s, at + 4, 8);
  if (rest.starts_with("\\X\\"))
    if (const auto code = hexNumber(s, at + 3, 2)) return appendUtf8(out, *code), at + 5;
  if (rest.size() > 3 && rest[1] == 'P' && rest[3] == '\\') return at + 4;  // code page of \S\: Latin-1 is all we know
  out += '\\';
  return at + 1;
}

}  // namespace

std::string decodeText(std::string_view s) {
  std::string out;
  out.reserve(s.size());
  for (std::size_t i = 0; i < s.size();) {
    const char c = s[i];
    if (c == '\'') {
      out += c;
      i += s.substr(i, 2) == "''" ? 2 : 1;
    } else if (c == '\\') {
      i = appendEscape(out, s, i);
    } else if (static_cast<unsigned char>(c) < 0x80) {
      if (c != '\n' && c != '\r' && c != '\0') out += c;  // a string may be broken over lines; the break is not text
      ++i;
    } else if (const std::size_t length = utf8Length(s, i)) {
      out += s.substr(i, length);
      i += length;
    } else {
      appendUtf8(out, static_cast<unsigned char>(c));
      ++i;
    }
  }
  return out;
}

}  // namespace standpoint::ifc
