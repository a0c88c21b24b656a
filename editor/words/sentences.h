// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace standpoint {

// Sentences that the rooms below the editor compose in English, with {} for what differs: what a verb has done ("Added
// station S1"), why a place is refused ("18 cm from wall"), what is wrong with an option. They are the texts of the
// catalogues with the context "sentence", and stand nowhere else.
const std::vector<std::string>& sentences();

// Such a sentence in the language that is spoken; what stands in a place is translated where it is a text or a sentence
// itself, and a figure where it has a unit. Others stay English, with their figures as the language writes them.
std::string trSentence(std::string_view english);

// The same as the interface shows it: as a sentence it begins with a capital, unless its first word is a name, an
// option or a unit. Names stay as they were typed.
std::string shownSentence(std::string_view english);

// describe(error), with its message so.
std::string trError(const Error& error);

// Printed reports are in the language that is spoken, from now on.
void printReportsAsSpoken();

}  // namespace standpoint
