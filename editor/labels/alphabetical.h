// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace standpoint {

// Bytes that compare as people sort the names (UTF-8): "Room 2" before "Room 10", "ä" beside "a", capitals beside small
// letters. The root collation of Unicode (UTS #10, CLDR), numbers by value. Names that it holds for equal keep an
// order by their own bytes.
std::string alphabeticalKey(std::string_view name);

// The text (UTF-8) as a search compares it: without the difference of capitals and small letters, in any script, and
// without marks above and below letters, "kuche" for "Küche".
std::string forSearch(std::string_view text);

}  // namespace standpoint
