// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "project/fields.h"

namespace standpoint {

// Points the project at files that lie elsewhere now: scans and underlays. Without `to` it lists them.
struct LocateOptions {
  std::optional<std::filesystem::path> file;  // as the project has it, or its name alone; nothing: all that are missing
  std::optional<std::filesystem::path> to;    // where it is now, or a folder in which files of the same names are
};
const Fields<LocateOptions>& locateFields();

struct ProjectFile {
  std::filesystem::path file;  // as the project has it
  bool there = false;
  std::vector<std::string> used_by;  // "scan of S1", "underlay hall"
};
const AnswerFields<ProjectFile>& answerFields(const ProjectFile*);
struct LocatedFile {
  std::filesystem::path from, to;
};
const AnswerFields<LocatedFile>& answerFields(const LocatedFile*);
struct LocateAnswer {
  std::vector<LocatedFile> located;
  std::vector<ProjectFile> files;  // that the project then uses
};
const AnswerFields<LocateAnswer>& answerFields(const LocateAnswer*);

// Each file that the job's scans and the underlays are in, once.
std::vector<ProjectFile> filesOf(const Document& document);

// A file is taken where it holds what the project knows of the old one: the points of each of its scans, or the number
// and the bounds of the underlay's. Of several, those in `to` that do not fit are warned of; one that was asked for is
// an error.
Result<Answered<LocateAnswer>> runLocate(const Document& document, const LocateOptions& options, Progress& progress);

}  // namespace standpoint
