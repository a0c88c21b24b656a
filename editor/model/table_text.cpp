// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/table_text.h"

#include <algorithm>
#include <vector>

#include "editor/words/figures.h"

namespace standpoint {

namespace {

using nlohmann::json;

// A tab or a break would begin another field.
std::string fieldOf(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string fieldOf(const json& value) {
  if (value.is_number_float()) return asFigure(value.dump());
  return fieldOf(value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump());
}

bool isTable(const json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const json& row) { return row.is_object(); });
}

std::string rowsOf(const json& rows) {
  std::vector<std::string> columns;
  for (const auto& row : rows)
    for (const auto& [key, value] : row.items())
      if (std::find(columns.begin(), columns.end(), key) == columns.end()) columns.push_back(key);
  std::string text;
  for (const auto& column : columns) text += column + (&column == &columns.back() ? "\n" : "\t");
  for (const auto& row : rows)
    for (const auto& column : columns)
      text += (row.contains(column) ? fieldOf(row[column]) : "") + (&column == &columns.back() ? "\n" : "\t");
  return text;
}

}  // namespace

std::string tableText(const json& figures) {
  std::string singles, tables;
  for (const auto& [key, value] : figures.items())
    if (isTable(value))
      tables += '\n' + key + '\n' + rowsOf(value);
    else
      singles += key + '\t' + fieldOf(value) + '\n';
  return singles + tables;
}

std::string rowsText(const TableRows& rows) {
  std::string text;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) text += fieldOf(row[i]) + (i + 1 == row.size() ? '\n' : '\t');
  return text;
}

}  // namespace standpoint
