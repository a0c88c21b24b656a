// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/session.h"

#include <chrono>
#include <filesystem>

#include "project/answers.h"
#include "project/storage/project_files.h"
#include "project/storage/project_lock.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Result<std::filesystem::path> projectFolder(const Verb& verb, const json& options) {
  const char* key = verb.scope == VerbScope::creates ? "output" : "project";
  if (!options.contains(key) || !options[key].is_string() || options[key].get<std::string>().empty())
    return failure(
        ErrorKind::usage,
        verb.scope == VerbScope::creates ? "specify the project folder: -o PROJECT" : "specify the project folder",
        verb.name);
  return std::filesystem::path(options[key].get<std::string>());
}

Result<void> checkEmpty(const fs::path& folder, const json& options) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored) || isEmptyProjectFolder(folder) || options.value("replace", false)) return {};
  return failure(ErrorKind::usage, "the folder is not empty; choose another folder, or replace the project in it",
                 folder.string());
}

Result<Outcome> runOnNewProject(const Verb& verb, const fs::path& folder, const json& own, Progress& progress) {
  TRY(checkEmpty(folder, own));
  TRY_ASSIGN(auto outcome, runVerb(verb, {}, own, progress));
  outcome.document.name = fs::absolute(folder).filename().string();
  TRY_ASSIGN(const auto lock, ProjectLock::acquire(folder, verb.name, progress));
  TRY(checkEmpty(folder, own));
  TRY(saveProject(outcome.document, folder, progress));
  return outcome;
}

// What another has written since `before` was read is not lost. `kept` becomes what is in the folder then.
Result<void> saveChange(const Verb& verb, const fs::path& folder, const json& own, const KeptProject& before,
                        Outcome& outcome, KeptProject* kept, Progress& progress) {
  TRY_ASSIGN(const auto lock, ProjectLock::acquire(folder, verb.name, progress));
  TRY_ASSIGN(auto now, projectText(folder));
  Document there = before.document;  // parts that are shared with it are not written again
  bool changed = true;
  if (now != before.text) {
    TRY_ASSIGN(there, loadProject(folder, progress));
    if (verb.carry_over) {
      outcome.document = verb.carry_over(before.document, outcome.document, there);
    } else {
      TRY_ASSIGN(outcome, runVerb(verb, there, own, progress));
    }
    changed = outcome.document != there;
    there = {};
  }
  if (changed) {
    TRY(saveChanges(there, outcome.document, folder, progress));
    TRY_ASSIGN(now, projectText(folder));
  }
  if (kept != nullptr) *kept = {outcome.document, std::move(now)};
  return {};
}

Result<Outcome> runOnProject(const Verb& verb, const json& options, KeptProject* kept, Progress& progress) {
  TRY_ASSIGN(auto folder, projectFolder(verb, options));
  json own = options;
  own.erase("project");
  // A wrong option is said before minutes are spent on reading.
  TRY(checkOptions(verb, own));
  const bool update = options.value("update", false);
  if (update && options.value("replace", false))
    return failure(ErrorKind::usage, "--update and --replace cannot be combined", "--update");
  if (verb.scope == VerbScope::creates && !update) return runOnNewProject(verb, folder, own, progress);
  KeptProject for_once;
  KeptProject& current = kept != nullptr ? *kept : for_once;
  Report dropped;
  TRY(currentDocument(folder, current, progress, &dropped));
  const KeptProject before = current;
  TRY_ASSIGN(auto outcome, runVerb(verb, before.document, own, progress));
  outcome.report.append(dropped);
  if (verb.scope == VerbScope::reads || outcome.document == before.document) return outcome;
  TRY(saveChange(verb, folder, own, before, outcome, kept, progress));
  return outcome;
}

Result<Outcome> run(const Verb& verb, const json& options, KeptProject* kept, Progress& progress) {
  const auto started = std::chrono::steady_clock::now();
  auto outcome = verb.scope == VerbScope::files ? runVerb(verb, {}, options, progress)
                                                : runOnProject(verb, options, kept, progress);
  if (!outcome) return outcome;
  outcome->answer["issues"] = toJson(outcome->report);
  outcome->answer["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return outcome;
}

}  // namespace

Result<Outcome> runOnDisk(const Verb& verb, const json& options, Progress& progress) {
  return run(verb, options, nullptr, progress);
}

Result<Outcome> runOnDisk(const Verb& verb, const json& options, KeptProject& kept, Progress& progress) {
  const bool has_project = verb.scope == VerbScope::changes || verb.scope == VerbScope::reads;
  return run(verb, options, has_project ? &kept : nullptr, progress);
}

Result<Document> currentDocument(const fs::path& folder, KeptProject& kept, Progress& progress, Report* report) {
  const auto text = projectText(folder);
  if (text && *text == kept.text && kept.document.imported) return kept.document;
  TRY_ASSIGN(auto document, loadProject(folder, progress, report));
  kept = {document, text.value_or("")};
  return document;
}

}  // namespace standpoint
