// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/report_words.h"

#include <atomic>
#include <utility>

namespace standpoint {

namespace {

std::atomic<std::shared_ptr<const ReportWords>> printing;

}  // namespace

void printReportsIn(std::shared_ptr<const ReportWords> words) { printing = std::move(words); }

std::string reportLanguage() {
  const auto words = printing.load();
  return words ? words->language() : "en";
}

std::string printed(std::string_view english) {
  const auto words = printing.load();
  return words ? words->in(english) : std::string(english);
}

// A translation whose places do not fit must not lose the report.
std::string printedFormatted(fmt::string_view english, fmt::format_args arguments) {
  try {
    return fmt::vformat(printed({english.data(), english.size()}), arguments);
  } catch (const fmt::format_error&) {
    return fmt::vformat(english, arguments);
  }
}

}  // namespace standpoint
