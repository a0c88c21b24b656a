// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace standpoint {

// For texts that are broken into lines. Where the number with its unit begins that a break before the byte `at` would
// part: "0.08", "10 m", "3.5 gon"; `at` where it parts none. Units are those of English, German and Ukrainian texts.
std::size_t beginOfNumber(std::string_view text, std::size_t at);

}  // namespace standpoint
