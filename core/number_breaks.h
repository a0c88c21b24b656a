// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace standpoint {

// Whether the word is what follows a number as its unit: "m", "m²", "°", "%", "GB", also with a mark behind it. Units
// are those of English, German and Ukrainian texts.
bool isUnit(std::string_view word);

// For texts that are broken into lines. Where the number with its unit begins that a break before the byte `at` would
// part: "0.08", "10 m", "3.5 gon"; `at` where it parts none.
std::size_t beginOfNumber(std::string_view text, std::size_t at);

}  // namespace standpoint
