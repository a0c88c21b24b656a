// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace standpoint {

// Sentences that the rooms below the editor compose in English, with {} for what differs: what a verb has done ("Added
// station S1"), why a place is refused ("18 cm from wall"), what is wrong with a number. Each is a text of the
// catalogues.
std::span<const std::string_view> sentences();

// Such a sentence in the language that is spoken; what differs stays as it is. Others stay English: errors, findings
// and reports of verbs.
std::string trSentence(std::string_view english);

}  // namespace standpoint
