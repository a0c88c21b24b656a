// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <string>

#include "core/html_text.h"
#include "core/report_words.h"

namespace standpoint {

// Pieces of a printed report, their English words in its language.

inline std::string reportHeading(const char* title) { return "<h2>" + htmlText(printed(title)) + "</h2>\n"; }

struct ReportColumn {
  ReportColumn(const char* column, bool is_number = false) : title(column), number(is_number) {}
  const char* title;
  bool number;
};
// The beginning of a table: its rows follow, then "</table>".
inline std::string reportTable(std::initializer_list<ReportColumn> columns) {
  std::string text = "<table><tr>";
  for (const auto& column : columns)
    text += (column.number ? "<th class=\"n\">" : "<th>") + htmlText(printed(column.title));
  return text + "</tr>\n";
}

}  // namespace standpoint
