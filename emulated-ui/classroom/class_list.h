// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/report.h"
#include "core/result.h"

namespace standpoint {

struct Student {
  std::string id;        // of letters, digits and . _ - @; a pseudonym does
  std::string name;      // may be empty; it never leaves the lecturer's computer
  std::string username;  // of Moodle; the id where the list has none
  std::string email;     // may be empty
};

// In the order of the list. `name` is the file's, without ending.
struct ClassList {
  std::string name;
  std::vector<Student> students;

  const Student* find(const std::string& id) const;
};

// CSV in UTF-8, with a first row that names its columns: id, and if you like name, username, email; others are noted in
// `report` and left alone. Columns are separated by comma, semicolon or tab. A student given twice, a missing column,
// another encoding: an error with its line.
Result<ClassList> readClassList(const std::filesystem::path& file, Report& report);

}  // namespace standpoint
