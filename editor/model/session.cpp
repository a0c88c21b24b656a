// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/session.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "project/model/import_verb.h"
#include "project/storage/project_files.h"

namespace standpoint {

namespace {

using nlohmann::json;
constexpr std::size_t kRememberedTasks = 200;

std::filesystem::path folderOf(const json& options) { return options.at("folder").get<std::string>(); }

Result<Outcome> runSave(const Document& document, const json& options, Progress& progress) {
  TRY(saveProject(document, folderOf(options), progress));
  Outcome outcome;
  outcome.document = document;
  outcome.description = fmt::format("Saved {}", folderOf(options).string());
  return outcome;
}

Result<Outcome> runOpen(const Document&, const json& options, Progress& progress) {
  TRY_ASSIGN(auto document, loadProject(folderOf(options), progress));
  Outcome outcome;
  outcome.document = std::move(document);
  outcome.description = fmt::format("Opened {}", folderOf(options).string());
  return outcome;
}

// Saving, opening and keeping a recovery copy run as tasks like every verb; only the editor has a use for them.
std::vector<Verb> fileVerbs() {
  const std::vector<Parameter> folder = {
      {.name = "folder", .kind = ParameterKind::path, .help = "Project folder", .positional = true, .required = true}};
  auto with_owner = folder;
  with_owner.push_back({.name = "name", .kind = ParameterKind::text, .help = "Project name"});
  with_owner.push_back({.name = "saved-in", .kind = ParameterKind::text, .help = "Folder of the original project"});
  return {{"save-project", "Save the project", VerbScope::reads, folder, runSave},
          {"save-recovery", "Save recovery copy", VerbScope::reads, folder, runSave},
          {"open-project", "Open a project", VerbScope::creates, folder, runOpen},
          {"open-recovery", "Open a recovery copy", VerbScope::creates, with_owner, runOpen}};
}

bool writesDocument(const Verb& verb) { return verb.scope == VerbScope::creates || verb.scope == VerbScope::changes; }

// While one of these runs, the document stays as it is.
bool holdsDocument(const Verb& verb) { return writesDocument(verb) || std::string_view(verb.name) == "save-project"; }

}  // namespace

Session::Session(std::vector<Verb> table, std::function<void()> wake)
    : verbs_(std::move(table)), wake_(std::move(wake)) {
  for (auto& verb : fileVerbs()) verbs_.push_back(std::move(verb));
}

Session::~Session() { cancelAll(); }

std::string Session::name() const {
  if (!folder_.empty()) return folder_.filename().string();
  return document().name.empty() ? "New project" : document().name;
}

std::string Session::whyNot(std::string_view name) const {
  const Verb* wanted = verb(name);
  if (wanted == nullptr) return fmt::format("'{}' is not available in this build", name);
  const bool needs_model = wanted->scope == VerbScope::changes || wanted->scope == VerbScope::reads;
  if (needs_model && !document().imported) return "Import a model first (Ctrl+I)";
  if (auto why = whyForbidden(name); !why.empty()) return why;
  return holdsDocument(*wanted) ? whyHeld() : std::string();
}

std::string Session::whyForbidden(std::string_view name) const { return forbids ? forbids(name) : std::string(); }

std::string Session::whyHeld() const {
  for (const auto& task : running_)
    if (holdsDocument(task->verb())) return fmt::format("Wait for '{}' to finish, or cancel it", task->title());
  return {};
}

std::string Session::whyNotUndo() const {
  if (!history_.canUndo()) return "Nothing to undo";
  const auto why = whyForbidden("undo");
  return why.empty() ? whyHeld() : why;
}

std::string Session::whyNotRedo() const {
  if (!history_.canRedo()) return "Nothing to redo";
  const auto why = whyForbidden("redo");
  return why.empty() ? whyHeld() : why;
}

std::string Session::whyNotAdopt() const { return whyHeld(); }

std::string Session::whyNotSave() const { return whyNot("save-project"); }

void Session::launch(const Verb& wanted, json options, std::string title, Task<Outcome>::Work work) {
  running_.push_back(std::make_unique<VerbTask>(std::move(title), wanted, std::move(options), std::move(work), wake_));
}

bool Session::start(std::string_view name, json options, std::string title) {
  if (!whyNot(name).empty()) return false;
  const Verb& wanted = *verb(name);
  auto work = [&wanted, snapshot = document(), options](Progress& progress) {
    return runVerb(wanted, snapshot, options, progress);
  };
  launch(wanted, std::move(options), title.empty() ? wanted.summary : std::move(title), std::move(work));
  return true;
}

bool Session::start(std::string_view name, json options, std::string title, Work work) {
  if (!whyNot(name).empty()) return false;
  const Verb& wanted = *verb(name);
  auto checked = [&wanted, snapshot = document(), options,
                  work = std::move(work)](Progress& progress) -> Result<Outcome> {
    TRY_ASSIGN(auto filled, checkOptions(wanted, options));
    return work(snapshot, filled, progress);
  };
  launch(wanted, std::move(options), std::move(title), std::move(checked));
  return true;
}

bool Session::save(const std::filesystem::path& folder) {
  return start("save-project", {{"folder", folder.string()}}, "Save " + folder.filename().string());
}

bool Session::open(const std::filesystem::path& folder) {
  return start("open-project", {{"folder", folder.string()}}, "Open " + folder.filename().string());
}

bool Session::saveRecovery(const std::filesystem::path& folder) {
  return start("save-recovery", {{"folder", folder.string()}});
}

bool Session::recover(const RecoveryCopy& copy) {
  return start("open-recovery", {{"folder", copy.project.string()}, {"name", copy.name}, {"saved-in", copy.saved_in}},
               "Recover " + copy.name);
}

void Session::clear() {
  history_ = History();
  folder_.clear();
  project_since_ = ++revision_;
}

void Session::undo() {
  if (!whyNotUndo().empty()) return;
  say(LogLevel::note, "", "Undone: " + history_.undoDescription());
  history_.undo();
  ++revision_;
}

void Session::redo() {
  if (!whyNotRedo().empty()) return;
  say(LogLevel::note, "", "Redone: " + history_.redoDescription());
  history_.redo();
  ++revision_;
}

bool Session::poll() {
  bool any = false;
  for (std::size_t i = 0; i < running_.size();) {
    if (!running_[i]->done()) {
      ++i;
      continue;
    }
    const auto task = std::move(running_[i]);
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
    takeResult(*task);
    any = true;
  }
  return any;
}

void Session::wait() {
  while (!running_.empty())
    if (!poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Session::cancelAll() {
  for (auto& task : running_) task->progress().cancel();
}

bool Session::adopt(Outcome outcome) {
  if (!whyNotAdopt().empty()) return false;
  for (const auto& issue : outcome.report.issues) say(levelOf(issue.severity), issue.source, issue.message);
  say(LogLevel::done, "", outcome.description);
  history_.push(std::move(outcome.document), outcome.description);
  ++revision_;
  return true;
}

bool Session::adoptImport(Outcome outcome) {
  if (!adopt(std::move(outcome))) return false;
  project_since_ = revision_;
  folder_.clear();
  return true;
}

bool Session::startAdding(Outcome outcome, std::string title) {
  if (!whyNot("add").empty()) return false;
  auto rest = [snapshot = document(), read = std::move(outcome)](Progress& progress) {
    return addImported(snapshot, read, progress);
  };
  launch(*verb("add"), json::object(), std::move(title), std::move(rest));
  return true;
}

void Session::takeResult(VerbTask& task) {
  auto result = task.take();
  if (result)
    succeed(task, std::move(*result));
  else
    fail(task, result.error());
  if (finished_.size() > kRememberedTasks) finished_.pop_back();
}

void Session::succeed(VerbTask& task, Outcome outcome) {
  const std::string_view verb_name = task.verb().name;
  if (verb_name == "save-recovery") return;
  const bool begins_project = task.verb().scope == VerbScope::creates && !task.options().value("update", false);
  const std::string text = outcome.description.empty() ? task.title() : outcome.description;
  finished_.push_front(
      {task.title(), task.verb().name, true, false, text, timeOfDay(), task.seconds(), std::move(outcome.typed)});
  for (const auto& issue : outcome.report.issues) say(levelOf(issue.severity), issue.source, issue.message);
  say(LogLevel::done, "", text);
  if (verb_name == "save-project") {
    folder_ = folderOf(task.options());
    history_.markSaved();
  } else if (verb_name == "open-project") {
    history_ = History(std::move(outcome.document), text);
    folder_ = folderOf(task.options());
    ++revision_;
  } else if (verb_name == "open-recovery") {
    history_ = History();  // an empty saved value below it: what was recovered counts as unsaved
    outcome.document.name = task.options().at("name").get<std::string>();  // it was loaded as the copy's folder
    history_.push(std::move(outcome.document), text);
    folder_ = task.options().at("saved-in").get<std::string>();
    removeRecovery(folderOf(task.options()).parent_path());
    ++revision_;
  } else if (writesDocument(task.verb())) {
    if (begins_project) folder_.clear();
    history_.push(std::move(outcome.document), text);
    ++revision_;
  }
  if (begins_project) project_since_ = revision_;
  finished_.front().revision = revision_;
  if (done) done(task.verb(), task.options());
}

void Session::fail(const VerbTask& task, const Error& error) {
  const bool cancelled = error.kind == ErrorKind::cancelled;
  finished_.push_front({task.title(),
                        task.verb().name,
                        false,
                        cancelled,
                        cancelled ? "Cancelled" : describe(error),
                        timeOfDay(),
                        task.seconds(),
                        {}});
  if (cancelled) {
    say(LogLevel::note, "", task.title() + " cancelled");
    return;
  }
  say(LogLevel::error, error.source, error.message);
  errors_.push_back({task.title(), error});
}

const FinishedTask* Session::lastOf(std::string_view name) const {
  const auto found = std::find_if(finished_.begin(), finished_.end(), [&](const FinishedTask& t) {
    return t.ok && t.verb == name && t.revision >= project_since_;
  });
  return found == finished_.end() ? nullptr : &*found;
}

void Session::say(LogLevel level, std::string source, std::string message) {
  log_.push_back({level, timeOfDay(), std::move(source), std::move(message)});
}

}  // namespace standpoint
