// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string>
#include <string_view>

#include "importers/files/utf8.h"
#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {
int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

namespace {

// No text of ours holds a zero byte.
void appendCode(std::string& out, std::uint32_t code) {
  if (code != 0) appendUtf8(out, code);
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
      appendCode(out, 0x10000 + ((high - 0xD800) << 10) + (*code - 0xDC00));
      high = 0;
    } else {
      appendCode(out, *code);
    }
  }
  return s.substr(at, 4) == "\\X0\\" ? at + 4 : at;
}

// An escape that begins at `at` with a backslash; returns where the text goes on.
std::size_t appendEscape(std::string& out, std::string_view s, std::size_t at) {
  const std::string_view rest = s.substr(at);
  if (rest.starts_with("\\\\")) return out += '\\', at + 2;
  if (rest.starts_with("\\S\\") && rest.size() > 3)
    return appendCode(out, (static_cast<unsigned char>(rest[3]) & 0x7FU) + 0x80U),
           at + (rest.substr(3, 2) == "''" ? 5 : 4);
  if (rest.starts_with("\\X2\\")) return appendWide(out, s, at + 4, 4);
  if (rest.starts_with("\\X4\\")) return appendWide(out, s, at + 4, 8);
  if (rest.starts_with("\\X\\"))
    if (const auto code = hexNumber(s, at + 3, 2)) return appendCode(out, *code), at + 5;
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
    } else if (const auto character = utf8At(s, i)) {
      out += s.substr(i, character->bytes);
      i += character->bytes;
    } else {
      appendCode(out, static_cast<unsigned char>(c));
      ++i;
    }
  }
  return out;
}

}  // namespace standpoint::ifc
