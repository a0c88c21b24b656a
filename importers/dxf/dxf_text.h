// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace standpoint {

// Names of a file as UTF-8: what is UTF-8 stays, else they are in the code page of $DWGCODEPAGE ("ANSI_1252"), and
// \U+00E4 is a character. A byte that is none in that page becomes '?'.
std::string utf8OfDxf(std::string_view text, const std::string& code_page);

}  // namespace standpoint
