// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/dxf/dxf_text.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <iconv.h>
#include <memory>
#include <type_traits>

#include "importers/files/utf8.h"

namespace standpoint {

namespace {

struct CloseConversion {
  void operator()(iconv_t conversion) const { iconv_close(conversion); }
};
using Conversion = std::unique_ptr<std::remove_pointer_t<iconv_t>, CloseConversion>;

Conversion conversionFrom(const std::string& encoding) {
  iconv_t conversion = iconv_open("UTF-8", encoding.c_str());
  return Conversion(conversion == reinterpret_cast<iconv_t>(-1) ? nullptr : conversion);  // NOLINT
}

// The bytes that are none become '?' where `repair` is set, else the text is empty.
std::string converted(iconv_t conversion, std::string_view text, bool repair) {
  std::string in(text), out(4 * text.size() + 8, '\0');
  char* from = in.data();
  char* to = out.data();
  std::size_t left = in.size(), room = out.size();
  while (left > 0 && iconv(conversion, &from, &left, &to, &room) == static_cast<std::size_t>(-1)) {
    if (!repair || errno == E2BIG) return {};
    ++from, --left;
    *to++ = '?', --room;
  }
  out.resize(out.size() - room);
  return out;
}

// "ansi_1251" → "CP1251", "dos850" → "CP850", "iso8859-1" → "ISO8859-1".
std::string encodingOf(const std::string& code_page) {
  const auto digits = code_page.find_first_of("0123456789");
  if (digits == std::string::npos) return "CP1252";
  if (code_page.starts_with("iso") || code_page.starts_with("ISO")) return "ISO" + code_page.substr(digits);
  return "CP" + code_page.substr(digits);
}

// \U+00E4, the way of files before 2007 to have any character.
std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    std::uint32_t c = 0;
    const char* digits = text.data() + i + 3;
    const bool escape = text.compare(i, 3, "\\U+") == 0 && i + 7 <= text.size() &&
                        std::from_chars(digits, digits + 4, c, 16).ptr == digits + 4 && c >= 0x20 &&
                        (c < 0xD800 || c >= 0xE000);
    if (escape)
      appendUtf8(out, c), i += 7;
    else
      out += text[i++];
  }
  return out;
}

}  // namespace

std::string utf8OfDxf(std::string_view text, const std::string& code_page) {
  const bool ascii = std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
  if (ascii) return unescaped(std::string(text));
  if (const auto check = conversionFrom("UTF-8")) {
    const std::string same = converted(check.get(), text, false);
    if (!same.empty()) return unescaped(same);
  }
  auto page = conversionFrom(encodingOf(code_page));
  if (!page) page = conversionFrom("ASCII");
  return page ? unescaped(converted(page.get(), text, true)) : std::string();
}

}  // namespace standpoint
