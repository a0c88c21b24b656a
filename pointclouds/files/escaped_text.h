// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace standpoint {

// Values as parts of a line, with tabs between them: a tab stands as \t, a line feed as \n, a backslash as \\ and any
// other control character as \xNN.
void appendEscaped(std::string& text, std::string_view value);
std::string unescaped(std::string_view text);

// Never empty: a text without `at` is one part.
std::vector<std::string_view> split(std::string_view text, char at);

}  // namespace standpoint
