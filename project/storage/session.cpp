// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/session.h"

#include <chrono>

#include "project/answers.h"
#include "project/storage/project_files.h"

namespace standpoint {

namespace {

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

Result<Outcome> runOnProject(const Verb& verb, const json& options, Progress& progress) {
  TRY_ASSIGN(auto folder, projectFolder(verb, options));
  json own = options;
  own.erase("project");
  // A wrong option is said before minutes are spent on reading.
  TRY(checkOptions(verb, own));
  std::error_code ignored;
  const bool update = options.value("update", false);
  if (update && options.value("replace", false))
    return failure(ErrorKind::usage, "--update and --replace cannot be combined", "--update");
  const bool creates = verb.scope == VerbScope::creates && !update;
  if (creates && std::filesystem::exists(folder, ignored) && !std::filesystem::is_empty(folder, ignored) &&
      !options.value("replace", false))
    return failure(ErrorKind::usage, "the folder is not empty; choose another folder, or use --replace",
                   folder.string());
  Document document;
  if (!creates) {
    TRY_ASSIGN(auto loaded, loadProject(folder, progress));
    document = std::move(loaded);
  }
  auto outcome = runVerb(verb, document, own, progress);
  if (!outcome) return outcome;
  if (creates) outcome->document.name = std::filesystem::absolute(folder).filename().string();
  if (verb.scope != VerbScope::reads && outcome->document != document)
    TRY(saveProject(outcome->document, folder, progress));
  return outcome;
}

}  // namespace

Result<Outcome> runOnDisk(const Verb& verb, const json& options, Progress& progress) {
  const auto started = std::chrono::steady_clock::now();
  auto outcome =
      verb.scope == VerbScope::files ? runVerb(verb, {}, options, progress) : runOnProject(verb, options, progress);
  if (!outcome) return outcome;
  outcome->answer["issues"] = toJson(outcome->report);
  outcome->answer["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return outcome;
}

}  // namespace standpoint
