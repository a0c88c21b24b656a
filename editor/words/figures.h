// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace standpoint {

// Figures in texts that come from below the editor, or were not written to be drawn (else: figures(), trf).

// A number that was written with a point, as the language writes it: "1,6" for "1.6". Another text stays.
std::string asFigure(std::string number);

// The English text with its counts of things in groups of digits, as they are drawn elsewhere: "23 842 triangles",
// "11 920 of 23 842 triangles". Ids, years and codes stay.
std::string countsIn(std::string text);

// The text with each number that a unit follows ("0.35 m", "2.5 to 3 m", "≥ 97.5 %"), or that is a field behind a tab,
// as the language writes it. Names, versions and places ("IFC4.3", "Room 1.01", "1.5,2,0") stay.
std::string figuresIn(std::string text);

bool isFigure(std::string_view text);  // "-1.6": digits with a point between them
// Whether the number that ends there has a unit, be it behind others.
bool hasUnit(std::string_view text, std::size_t end);

}  // namespace standpoint
