// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "pointclouds/e57/e57_xml.h"
#include "pointclouds/files/number_text.h"

namespace standpoint::e57 {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Length of the well-formed UTF-8 sequence at the front (Unicode table 3-7), 0 when there is none.
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  const unsigned a = byte(0), b = byte(1);
  if (a < 0x80) return 1;
  if (a >= 0xC2 && a <= 0xDF) return continues(1) ? 2 : 0;
  if (a >= 0xE0 && a <= 0xEF) {
    if (!continues(1) || !continues(2) || (a == 0xE0 && b < 0xA0) || (a == 0xED && b > 0x9F)) return 0;
    return a == 0xEF && b == 0xBF && byte(2) >= 0xBE ? 0 : 3;  // U+FFFE and U+FFFF are no XML characters
  }
  if (a >= 0xF0 && a <= 0xF4)
    return continues(1) && continues(2) && continues(3) && !(a == 0xF0 && b < 0x90) && !(a == 0xF4 && b > 0x8F) ? 4 : 0;
  return 0;
}

std::string characterData(std::string_view value) {
  std::string text = "<![CDATA[";
  while (!value.empty()) {
    const std::size_t n = sequenceLength(value);
    const auto first = static_cast<unsigned char>(value.front());
    const bool control = n == 1 && first < 0x20 && first != '\t' && first != '\n';
    if (value.starts_with("]]>")) {
      text += "]]]]><![CDATA[>";
      value.remove_prefix(3);
    } else if (n == 0 || control) {
      text += kReplacement;
      value.remove_prefix(1);
    } else {
      text += value.substr(0, n);
      value.remove_prefix(n);
    }
  }
  return text + "]]>";
}

}  // namespace

void XmlWriter::open(std::string_view name, std::string_view attributes) {
  text_.append("<").append(name).append(" ").append(attributes).append(">\n");
}

void XmlWriter::close(std::string_view name) { text_.append("</").append(name).append(">\n"); }

void XmlWriter::leaf(std::string_view name, std::string_view attributes) {
  text_.append("<").append(name).append(" ").append(attributes).append("/>\n");
}

void XmlWriter::string(std::string_view name, std::string_view value) {
  text_.append("<").append(name).append(" type=\"String\">").append(characterData(value));
  text_.append("</").append(name).append(">\n");
}

void XmlWriter::integer(std::string_view name, std::int64_t value) {
  text_.append("<").append(name).append(" type=\"Integer\">");
  appendNumber(text_, value);
  text_.append("</").append(name).append(">\n");
}

void XmlWriter::real(std::string_view name, double value) {
  text_.append("<").append(name).append(" type=\"Float\">");
  appendNumber(text_, std::isfinite(value) ? value + 0.0 : 0.0);  // -0 + 0 = 0
  text_.append("</").append(name).append(">\n");
}

}  // namespace standpoint::e57
