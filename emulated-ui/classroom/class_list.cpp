// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/class_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_file.h"

namespace standpoint {

namespace {

constexpr std::uintmax_t kLargestList = 4U << 20U;
constexpr std::size_t kMostStudents = 5000, kLongestId = 64;
constexpr const char* kIdLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-@";

struct Row {
  int line = 0;
  std::vector<std::string> cells;
};

// The line in which the text stops being UTF-8; nothing where it is.
std::optional<int> lineNotUtf8(const std::string& text) {
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.find('\0') != std::string::npos) return number;  // UTF-16, which spreadsheets call Unicode
    try {
      (void)nlohmann::json(line).dump();
    } catch (const nlohmann::json::exception&) {
      return number;
    }
  }
  return std::nullopt;
}

char separatorOf(const std::string& text) {
  const auto header = text.substr(0, text.find('\n'));
  const auto count = [&](char c) { return std::count(header.begin(), header.end(), c); };
  char best = ',';
  for (const char c : {';', '\t'})
    if (count(c) > count(best)) best = c;
  return best;
}

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t\r");
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

// RFC 4180. Blank lines are left out.
Result<std::vector<Row>> rowsOf(const std::string& text, const std::string& file) {
  const char separator = separatorOf(text);
  std::vector<Row> rows;
  Row row{1, {}};
  std::string cell;
  bool quoted = false;
  int line = 1, quoted_from = 0;
  const auto endCell = [&] { row.cells.push_back(trimmed(std::exchange(cell, {}))); };
  const auto endRow = [&] {
    endCell();
    if (std::any_of(row.cells.begin(), row.cells.end(), [](const auto& one) { return !one.empty(); }))
      rows.push_back(row);
    row = {line, {}};
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    line += c == '\n' ? 1 : 0;
    if (quoted) {
      if (c != '"')
        cell += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        cell += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true, quoted_from = line;
    } else if (c == separator) {
      endCell();
    } else if (c == '\n') {
      endRow();
    } else {
      cell += c;
    }
  }
  if (quoted)
    return failure(ErrorKind::unusable, "the quotation mark has no end", fmt::format("{} line {}", file, quoted_from));
  if (!cell.empty() || !row.cells.empty()) endRow();
  return rows;
}

struct ColumnRow {
  const char* name;
  std::string Student::*member;
};
constexpr std::array kColumns = {ColumnRow{"id", &Student::id}, ColumnRow{"name", &Student::name},
                                 ColumnRow{"username", &Student::username}, ColumnRow{"email", &Student::email}};

class Reader {
 public:
  Reader(std::string file, Report& report) : file_(std::move(file)), report_(report) {}

  Result<std::vector<Student>> read(const std::vector<Row>& rows) {
    if (rows.empty())
      return failure(ErrorKind::unusable, "is empty; its first row must name the columns: id, name", file_);
    TRY(readHeader(rows.front()));
    for (std::size_t i = 1; i < rows.size(); ++i) TRY(readRow(rows[i]));
    if (students_.empty()) return failure(ErrorKind::unusable, "has no student below the row with the columns", file_);
    if (students_.size() > kMostStudents)
      return failure(ErrorKind::unusable, fmt::format("more than {} students", kMostStudents), file_);
    return std::move(students_);
  }

 private:
  std::string at(const Row& row) const { return fmt::format("{} line {}", file_, row.line); }

  Result<void> readHeader(const Row& header) {
    for (const auto& title : header.cells) {
      auto name = title;
      std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
      const auto* column =
          std::find_if(kColumns.begin(), kColumns.end(), [&](const auto& c) { return name == c.name; });
      members_.push_back(column == kColumns.end() ? nullptr : column->member);
      if (column == kColumns.end()) {
        report_.note(at(header), fmt::format("column '{}' is not used", title));
      } else if (std::count(members_.begin(), members_.end(), column->member) > 1) {
        return failure(ErrorKind::unusable, fmt::format("column '{}' is there twice", title), at(header));
      }
    }
    if (std::find(members_.begin(), members_.end(), &Student::id) == members_.end())
      return failure(ErrorKind::unusable,
                     fmt::format("there is no column 'id'; the columns are {}. Name the one that identifies a student "
                                 "'id'; name, username and email are optional",
                                 fmt::join(header.cells, ", ")),
                     at(header));
    return {};
  }

  Result<void> readRow(const Row& row) {
    if (row.cells.size() > members_.size())
      return failure(ErrorKind::unusable,
                     fmt::format("{} cells, but {} columns; put a cell with a separator in quotation marks",
                                 row.cells.size(), members_.size()),
                     at(row));
    Student s;
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      if (members_[i] != nullptr) s.*members_[i] = row.cells[i];
    if (s.username.empty()) s.username = s.id;
    TRY(checkWord(s.id, "id", row));
    TRY(checkWord(s.username, "username", row));
    TRY(checkOnce(ids_, s.id, "id", row));
    TRY(checkOnce(usernames_, s.username, "username", row));
    students_.push_back(std::move(s));
    return {};
  }

  // It becomes a file's name, a name in Moodle, and a cell of tables.
  Result<void> checkWord(const std::string& word, const char* column, const Row& row) const {
    if (word.empty()) return failure(ErrorKind::unusable, fmt::format("'{}' is empty", column), at(row));
    if (word.size() > kLongestId || word.find_first_not_of(kIdLetters) != std::string::npos || word.front() == '.' ||
        word.front() == '-' || word.front() == '@')
      return failure(ErrorKind::unusable,
                     fmt::format("{} '{}' can contain only letters A to Z, digits and . _ - @, at most {}, and begins "
                                 "with a letter or digit",
                                 column, word, kLongestId),
                     at(row));
    return {};
  }

  Result<void> checkOnce(std::map<std::string, int>& seen, const std::string& word, const char* column,
                         const Row& row) const {
    const auto [before, first] = seen.try_emplace(word, row.line);
    if (first) return {};
    return failure(ErrorKind::unusable,
                   fmt::format("{} '{}' is also in line {}: each student once", column, word, before->second), at(row));
  }

  std::string file_;
  Report& report_;
  std::vector<std::string Student::*> members_;  // of each column; null: it is not used
  std::vector<Student> students_;
  std::map<std::string, int> ids_, usernames_;  // with their lines
};

}  // namespace

const Student* ClassList::find(const std::string& id) const {
  const auto found = std::find_if(students.begin(), students.end(), [&](const Student& s) { return s.id == id; });
  return found == students.end() ? nullptr : &*found;
}

Result<ClassList> readClassList(const std::filesystem::path& file, Report& report) {
  TRY_ASSIGN(auto text, readWholeFile(file, kLargestList));
  const auto name = file.filename().string();
  if (const auto line = lineNotUtf8(text))
    return failure(ErrorKind::unusable, "is not UTF-8; save it as \"CSV UTF-8\" and try again",
                   fmt::format("{} line {}", name, *line));
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  std::erase(text, '\r');
  TRY_ASSIGN(const auto rows, rowsOf(text, name));
  TRY_ASSIGN(auto students, Reader(name, report).read(rows));
  return ClassList{file.stem().string(), std::move(students)};
}

}  // namespace standpoint
