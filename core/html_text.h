// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

// A text as a part of a page of HTML, also within the quotes of an attribute.
inline std::string htmlText(const std::string& text) {
  std::string html;
  for (const char c : text)
    html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return html;
}

}  // namespace standpoint
