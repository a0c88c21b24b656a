// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace standpoint {

// A text as a cell of a table (RFC 4180), in quotation marks. Of a text that begins like a formula a spreadsheet would
// make one: the apostrophe says that it is text.
inline std::string csvText(const std::string& text) {
  std::string out = "\"";
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos) out += '\'';
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace standpoint
