// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/session.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "editor/desktop/user_folders.h"
#include "editor/model/settings.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/fields.h"
#include "project/model/import_verb.h"
#include "project/storage/project_files.h"
#include "project/storage/project_json.h"
#include "project/storage/project_lock.h"

namespace standpoint {

namespace {

using nlohmann::json;
constexpr std::size_t kRememberedTasks = 200;

// Saving, opening and keeping a recovery copy run as tasks like every verb; only the editor has a use for them.
struct SaveOptions {
  std::filesystem::path folder;
  std::string seen;  // the project on disk when it was last read or written here (stateOnDisk); empty: replaced unseen
};
struct SaveRecoveryOptions {
  std::filesystem::path folder;
};
struct OpenOptions {
  std::filesystem::path folder;
};
struct OpenRecoveryOptions {
  std::filesystem::path folder;
  std::string name, saved_in;  // of the project that it is a copy of
};
struct ProjectAnswer {
  std::filesystem::path folder;  // that was read or written
  std::string name, saved_in;    // of a recovery copy
  std::string on_disk;           // stateOnDisk, of the folder
};
const AnswerFields<ProjectAnswer>& answerFields(const ProjectAnswer*) {
  using A = ProjectAnswer;
  static const AnswerFields<A> fields = {{"folder", &A::folder}, {"name", &A::name}, {"saved_in", &A::saved_in}};
  return fields;
}

template <class O>
Field<O> folderField() {
  return {"folder", &O::folder, "Project folder", {.positional = true, .required = true}};
}
template <class O>
const Fields<O>& folderFields() {
  static const Fields<O> fields = {folderField<O>()};
  return fields;
}
const Fields<SaveOptions>& saveFields() {
  using O = SaveOptions;
  static const Fields<O> fields = {folderField<O>(), {"seen", &O::seen, "State on disk that may be replaced"}};
  return fields;
}
const Fields<OpenRecoveryOptions>& openRecoveryFields() {
  using O = OpenRecoveryOptions;
  static const Fields<O> fields = {folderField<O>(),
                                   {"name", &O::name, "Project name"},
                                   {"saved-in", &O::saved_in, "Folder of the original project"}};
  return fields;
}

// Of a project, for those who read it: where it is, they know.
std::string nameOf(const std::filesystem::path& folder) {
  const auto plain = folder.lexically_normal();
  return (plain.has_filename() ? plain : plain.parent_path()).filename().string();
}

// Equal for equal projects; empty where there is none.
std::string stateOnDisk(const std::filesystem::path& folder) {
  const auto text = projectText(folder);
  return text ? fmt::format("{:016x}", contentHash(*text)) : std::string();
}

Result<Answered<ProjectAnswer>> saved(const Document& document, const std::filesystem::path& folder,
                                      Progress& progress) {
  TRY(saveProject(document, folder, progress));
  return Answered<ProjectAnswer>{document, {folder, {}, {}, stateOnDisk(folder)}, {}, "Saved " + nameOf(folder)};
}

Result<Answered<ProjectAnswer>> runSave(const Document& document, const SaveOptions& options, Progress& progress) {
  TRY_ASSIGN(const auto lock, ProjectLock::acquire(options.folder, "editor", progress));
  const auto now = stateOnDisk(options.folder);
  if (!options.seen.empty() && !now.empty() && now != options.seen)
    return failure(ErrorKind::file_system,
                   "another program has changed the project since it was opened; reload it, or save to another folder",
                   options.folder.string());
  return saved(document, options.folder, progress);
}

Result<Answered<ProjectAnswer>> runSaveRecovery(const Document& document, const SaveRecoveryOptions& options,
                                                Progress& progress) {
  return saved(document, options.folder, progress);
}

Result<Answered<ProjectAnswer>> opened(ProjectAnswer answer, Progress& progress) {
  answer.on_disk = stateOnDisk(answer.folder);
  Report dropped;
  TRY_ASSIGN(auto document, loadProject(answer.folder, progress, &dropped));
  auto description = answer.name.empty() ? "Opened " + nameOf(answer.folder) : "Recovered " + answer.name;
  return Answered<ProjectAnswer>{std::move(document), std::move(answer), std::move(dropped), std::move(description)};
}
Result<Answered<ProjectAnswer>> runOpen(const Document&, const OpenOptions& options, Progress& progress) {
  return opened({options.folder, {}, {}, {}}, progress);
}
Result<Answered<ProjectAnswer>> runOpenRecovery(const Document&, const OpenRecoveryOptions& options,
                                                Progress& progress) {
  return opened({options.folder, options.name, options.saved_in, {}}, progress);
}

std::vector<Verb> fileVerbs() {
  using S = VerbScope;
  std::vector<Verb> verbs = {
      verbOf("save-project", "Save the project", S::reads, saveFields(), runSave),
      verbOf("save-recovery", "Save recovery copy", S::reads, folderFields<SaveRecoveryOptions>(), runSaveRecovery),
      verbOf("open-project", "Open a project", S::creates, folderFields<OpenOptions>(), runOpen),
      verbOf("open-recovery", "Open a recovery copy", S::creates, openRecoveryFields(), runOpenRecovery)};
  for (auto& verb : verbs) verb.without_model = true;
  return verbs;
}

bool writesDocument(const Verb& verb) { return verb.scope == VerbScope::creates || verb.scope == VerbScope::changes; }

// While one of these runs, the document stays as it is.
bool holdsDocument(const Verb& verb) { return writesDocument(verb) || std::string_view(verb.name) == "save-project"; }

Task<Outcome>::Work workOf(const Verb& verb, const Document& snapshot, const json& options) {
  return [&verb, snapshot, options](Progress& progress) { return runVerb(verb, snapshot, options, progress); };
}

// An answer that nobody reads can be large, and takes as long to go as many pictures: it goes on the worker.
Task<Outcome>::Work withoutAnswer(Task<Outcome>::Work work) {
  return [work = std::move(work)](Progress& progress) {
    auto outcome = work(progress);
    if (outcome) outcome->answer = nullptr;
    return outcome;
  };
}

}  // namespace

std::string whyNoModel(const Document& document) {
  if (document.hasModel()) return {};
  return document.imported ? "This project has point clouds only; add a model first (Ctrl+I)"
                           : "Import a model first (Ctrl+I)";
}

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
  if (wanted == nullptr) return trf("'{}' is not available in this build", name);
  const bool takes_document = wanted->scope == VerbScope::changes || wanted->scope == VerbScope::reads;
  if (takes_document && !(wanted->without_model && document().imported))
    if (auto why = whyNoModel(document()); !why.empty()) return why;
  if (auto why = whyForbidden(name); !why.empty()) return why;
  return holdsDocument(*wanted) ? whyHeld() : std::string();
}

std::string Session::whyForbidden(std::string_view name) const { return forbids ? forbids(name) : std::string(); }

std::string Session::whyHeld() const {
  for (const auto& task : running_)
    if (holdsDocument(task->verb())) return trf("Wait for '{}' to finish, or cancel it", task->title());
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
  title = tr(title);
  running_.push_back(std::make_unique<VerbTask>(std::move(title), wanted, std::move(options), std::move(work), wake_));
}

bool Session::start(std::string_view name, json options, std::string title) {
  if (!whyNot(name).empty()) return false;
  const Verb& wanted = *verb(name);
  auto work = withoutAnswer(workOf(wanted, document(), options));
  launch(wanted, std::move(options), title.empty() ? wanted.summary : std::move(title), std::move(work));
  return true;
}

bool Session::startAndShow(std::string_view name, json options, std::string title) {
  if (!whyNot(name).empty()) return false;
  const Verb& wanted = *verb(name);
  auto work = workOf(wanted, document(), options);
  launch(wanted, std::move(options), title.empty() ? wanted.summary : std::move(title), std::move(work));
  running_.back()->shows_answer = true;
  return true;
}

bool Session::start(const VerbOptions& options, std::string title) {
  const Verb* wanted = findVerb(verbs_, options.type());
  return wanted != nullptr && start(wanted->name, wanted->job_options(options.held()), std::move(title));
}

bool Session::start(const VerbOptions& options, std::string title, Work work) {
  const Verb* wanted = findVerb(verbs_, options.type());
  if (wanted == nullptr || !whyNot(wanted->name).empty()) return false;
  auto job = wanted->job_options(options.held());
  auto checked = [wanted, snapshot = document(), job, work = std::move(work)](Progress& progress) -> Result<Outcome> {
    TRY(checkOptions(*wanted, job));
    return work(snapshot, progress);
  };
  launch(*wanted, std::move(job), std::move(title), withoutAnswer(std::move(checked)));
  return true;
}

bool Session::save(const std::filesystem::path& folder) {
  return start(SaveOptions{folder, folder == folder_ ? on_disk_ : std::string()}, trf("Save {}", nameOf(folder)));
}

bool Session::changedOnDisk() {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (folder_.empty() || on_disk_.empty() || !running_.empty()) return false;
  if (now < looked_ + 1s) return changed_on_disk_;
  looked_ = now;
  const auto state = stateOnDisk(folder_);
  changed_on_disk_ = !state.empty() && state != on_disk_;
  return changed_on_disk_;
}

void Session::keepOverDisk() {
  on_disk_ = stateOnDisk(folder_);
  changed_on_disk_ = false;
  history_.markUnsaved();
}

bool Session::open(const std::filesystem::path& folder) {
  return start(OpenOptions{folder}, trf("Open {}", nameOf(folder)));
}

bool Session::saveRecovery(const std::filesystem::path& folder) {
  const SaveRecoveryOptions options{folder};
  auto work = [folder, before = kept_.folder == folder ? kept_.document : Document()](
                  const Document& document, Progress& progress) -> Result<Outcome> {
    TRY(saveChanges(before, document, folder, progress));
    return Outcome{document};
  };
  keeping_ = {folder, document(), revision_};
  return start(options, "Save recovery copy", std::move(work));
}

bool Session::keepsRecovery() const {
  return std::any_of(running_.begin(), running_.end(),
                     [](const auto& task) { return std::string_view(task->verb().name) == "save-recovery"; });
}

bool Session::recover(const LeftWork& left) {
  const auto& mark = left.mark;
  if (left.project.empty()) return open(mark.saved_in);
  return start(OpenRecoveryOptions{left.project, mark.name, mark.saved_in}, trf("Recover {}", mark.name));
}

void Session::clear() {
  history_ = History();
  leaveFolder();
  project_since_ = ++revision_;
}

void Session::undo() {
  if (!whyNotUndo().empty()) return;
  say(LogLevel::note, "", fmt::format("Undone: {}", history_.undoDescription()));
  const Document before = document();
  history_.undo();
  countStep(before);
}

void Session::redo() {
  if (!whyNotRedo().empty()) return;
  say(LogLevel::note, "", fmt::format("Redone: {}", history_.redoDescription()));
  const Document before = document();
  history_.redo();
  countStep(before);
}

std::string Session::whyNotGoTo(std::size_t step) const {
  if (step == history_.position()) return "This is the current step";
  return step < history_.position() ? whyNotUndo() : whyNotRedo();
}

void Session::goTo(std::size_t step) {
  if (!whyNotGoTo(step).empty()) return;
  say(LogLevel::note, "", fmt::format("Went to step: {}", history_.description(step)));
  const Document before = document();
  history_.goTo(step);
  countStep(before);
}

void Session::note(std::any shown, std::string description) {
  say(LogLevel::done, "", description);
  history_.pushShown(std::move(shown), std::move(description));
  ++noted_;
}

void Session::countStep(const Document& before) { ++(document() == before ? noted_ : revision_); }

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
  say(outcome.report);
  say(LogLevel::done, "", outcome.description);
  history_.push(std::move(outcome.document), outcome.description);
  ++revision_;
  return true;
}

bool Session::adoptImport(Outcome outcome) {
  if (!adopt(std::move(outcome))) return false;
  project_since_ = revision_;
  leaveFolder();
  return true;
}

bool Session::startAdding(Outcome outcome, std::string title) {
  if (!whyNot("add").empty()) return false;
  auto rest = [snapshot = document(), read = std::move(outcome)](Progress& progress) -> Result<Outcome> {
    const auto* answer = answerAs<ImportAnswer>(read.typed);
    TRY_ASSIGN(
        auto added,
        addImported(snapshot, {read.document, answer == nullptr ? ImportAnswer() : *answer, read.report}, progress));
    return outcomeOf(std::move(added));
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
  if (verb_name == "save-recovery") return succeedKeeping();
  const bool begins_project = task.verb().scope == VerbScope::creates && !task.options().value("update", false);
  const std::string text = outcome.description.empty() ? task.title() : outcome.description;
  const bool changes = writesDocument(task.verb()) && !outcome.description.empty();  // a verb that only lists says none
  if (task.shows_answer && !changes) answers_.push_back({text, outcome.text, outcome.answer});
  finished_.push_front(
      {task.title(), task.verb().name, true, false, text, timeOfDay(), task.seconds(), std::move(outcome.typed)});
  say(outcome.report);
  say(LogLevel::done, "", text);
  const auto* project = answerAs<ProjectAnswer>(finished_.front().answer);
  if (verb_name == "save-project") {
    stayIn(project->folder, project->on_disk);
    history_.markSaved();
    forgetRecovered();
  } else if (verb_name == "open-project") {
    history_ = History(std::move(outcome.document), text);
    stayIn(project->folder, project->on_disk);
    ++revision_;
  } else if (verb_name == "open-recovery") {
    outcome.document.name = project->name;  // it was loaded as the copy's folder
    history_ = History(std::move(outcome.document), text);
    history_.markUnsaved();
    stayIn(project->saved_in, stateOnDisk(project->saved_in));
    recovered_from_ = project->folder.parent_path();
    ++revision_;
  } else if (changes) {
    if (begins_project) leaveFolder();
    history_.push(std::move(outcome.document), text);
    ++revision_;
  }
  if (begins_project) project_since_ = revision_;
  finished_.front().revision = revision_;
  finished_.front().left = document();
  if (done) done(task.verb(), task.options());
}

void Session::succeedKeeping() {
  kept_ = std::move(keeping_);
  keeping_problem_.clear();
  forgetRecovered();
}

// What was recovered has been written again.
void Session::forgetRecovered() {
  if (!recovered_from_.empty() && recovered_from_ != kept_.folder.parent_path()) removeRecovery(recovered_from_);
  recovered_from_.clear();
}

std::filesystem::path Session::ownFolder() const {
  if (!folder_.empty()) return folder_;
  std::string own = name() + " " + begun_;
  std::replace(own.begin(), own.end(), '/', '_');
  return unsavedRoot() / own;
}

void Session::workOnCopy() {
  leaveFolder();
  history_.markUnsaved();
}

void Session::stayIn(const std::filesystem::path& folder, std::string on_disk) {
  if (folder != folder_ || folder.empty()) {
    open_mark_.reset();
    open_elsewhere_.clear();
  }
  folder_ = folder;
  if (!open_mark_ && !folder.empty()) {
    if (auto mark = OpenMark::take(folder, open_elsewhere_)) open_mark_.emplace(std::move(*mark));
  }
  on_disk_ = std::move(on_disk);
  changed_on_disk_ = false;
}

void Session::leaveFolder() {
  stayIn({}, {});
  begun_ = dateAndTime();
}

void Session::fail(const VerbTask& task, const Error& error) {
  const bool cancelled = error.kind == ErrorKind::cancelled;
  const bool keeps = std::string_view(task.verb().name) == "save-recovery";
  finished_.push_front({task.title(),
                        task.verb().name,
                        false,
                        cancelled,
                        cancelled ? tr("Cancelled") : trError(error),
                        timeOfDay(),
                        task.seconds(),
                        {}});
  if (cancelled) {
    say(LogLevel::note, "", fmt::format("{} cancelled", task.title()));
    return;
  }
  if (keeps && keeping_problem_ == describe(error)) return;  // said before
  if (keeps) keeping_problem_ = describe(error);
  say(LogLevel::error, error.source, error.message);
  if (!keeps) errors_.push_back({task.title(), error});  // the status bar says it for as long as it is so
}

const FinishedTask* Session::lastOf(std::string_view name) const {
  const auto found = std::find_if(finished_.begin(), finished_.end(), [&](const FinishedTask& t) {
    return t.ok && t.verb == name && t.revision >= project_since_;
  });
  return found == finished_.end() ? nullptr : &*found;
}

bool Session::isOutOfDate(const FinishedTask& task) const {
  const auto& then = task.left;
  const auto& now = document();
  return then.imported != now.imported || then.georeference != now.georeference || then.simplified != now.simplified ||
         then.materials != now.materials || then.job != now.job;
}

void Session::say(const Report& report) {
  for (auto& entry : entriesOf(report)) log_.push_back(std::move(entry));
}

void Session::say(LogLevel level, std::string source, std::string message) {
  log_.push_back({level, timeOfDay(), std::move(source), std::move(message)});
}

}  // namespace standpoint
