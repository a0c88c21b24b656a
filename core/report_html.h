// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <string>

#include "core/html_text.h"
#include "core/report_words.h"

namespace standpoint {

// Pieces of a printed report, their English words in its language.

inline constexpr const char* kReportStyle = R"(@page{size:A4;margin:15mm}
body{font:10pt sans-serif;color:#111;background:#fff;max-width:180mm;margin:2em auto}
h1{font-size:16pt;margin-bottom:.2em}h2{font-size:12pt;margin:1.4em 0 .4em}
table{border-collapse:collapse;width:100%}
td,th{border-bottom:1px solid #ccc;padding:3px 6px;text-align:left;vertical-align:top}
th{background:#f0f0f0}td.n,th.n{text-align:right;white-space:nowrap}td.s{white-space:nowrap;font-weight:bold}
p.verdict{font-size:13pt}small{color:#555}svg{width:100%;max-height:110mm;border:1px solid #ccc}
tr,svg{page-break-inside:avoid}@media print{body{margin:0}}
)";

// A page to print up to its title, which is a part of HTML already. `style` is what it has beside kReportStyle.
inline std::string reportBeginning(const std::string& title, const std::string& style = {}) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{0}\"><head><meta charset=\"utf-8\"><title>{1}</title>\n"
      "<style>{2}{3}</style></head><body>\n<h1>{1}</h1>\n",
      reportLanguage(), title, kReportStyle, style);
}

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
