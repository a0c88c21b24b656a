// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

// The text with `by` wherever `what` was: a word's places, such as {limit}, filled.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); !what.empty() && at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

}  // namespace standpoint
