// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace standpoint {

// Reports that are printed are in English, unless a door says what they are in: the editor prints them in the language
// of who uses it. The command line and files of figures (.csv, .json) are in English in any case.
struct ReportWords {
  std::function<std::string()> language;                    // ISO 639: "de"
  std::function<std::string(std::string_view english)> in;  // the text in it; English where it has none
};
void printReportsIn(std::shared_ptr<const ReportWords> words);  // null: English again. From any thread.

std::string reportLanguage();  // "en"
std::string printed(std::string_view english);

std::string printedFormatted(fmt::string_view english, fmt::format_args arguments);
// fmt::format of the text in the report's language.
template <class... Arguments>
std::string printedf(fmt::format_string<Arguments...> english, Arguments&&... arguments) {
  return printedFormatted(english, fmt::make_format_args(arguments...));
}

}  // namespace standpoint
