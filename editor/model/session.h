// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <any>
#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/model/log.h"
#include "editor/recovery/left_work.h"
#include "project/answer_fields.h"
#include "project/history.h"
#include "project/storage/project_lock.h"
#include "project/task.h"
#include "project/verb.h"

namespace standpoint {

struct FinishedTask {
  std::string title, verb;
  bool ok = false;
  bool cancelled = false;
  std::string text;  // what was done, or what went wrong
  std::string time;
  double seconds = 0;
  std::any answer;             // as answerAs reads it
  std::uint64_t revision = 0;  // of the document that it ran on, or made
  Document left;               // that document
};

struct ShownError {
  std::string title;  // "Import could not be done"
  Error error;
};

// What a verb that changes nothing has found, to be read.
struct ShownAnswer {
  std::string title, text;
  nlohmann::json figures;
};

// A verb that runs in the background on a snapshot.
class VerbTask : public Task<Outcome> {
 public:
  VerbTask(std::string title, const Verb& verb, nlohmann::json options, Work work, std::function<void()> wake)
      : Task(std::move(title), std::move(work), std::move(wake)), verb_(verb), options_(std::move(options)) {}
  const Verb& verb() const { return verb_; }
  const nlohmann::json& options() const { return options_; }
  bool shows_answer = false;

 private:
  // The work has copies of its own: it may outlive these for as long as the base joins.
  const Verb& verb_;
  nlohmann::json options_;
};

// "" where it has one, else what to do first.
std::string whyNoModel(const Document& document);

// One open project: its history, what runs on it, and what was said about it. Knows neither ImGui nor a window.
// Everything that changes the document is a verb that runs as a task on a snapshot; poll() brings its result in.
class Session {
 public:
  Session(std::vector<Verb> table, std::function<void()> wake);
  ~Session();

  const Document& document() const { return history_.current(); }
  const History& history() const { return history_; }
  std::span<const Verb> verbs() const { return verbs_; }
  const Verb* verb(std::string_view name) const { return findVerb(verbs_, name); }

  // Whoever has a say in what happens to the document besides: "" or the reason why the verb, "undo" or "redo" may not
  // be now.
  std::function<std::string(std::string_view verb)> forbids;
  // Told of every verb that was done, with its options, after its result came in.
  std::function<void(const Verb& verb, const nlohmann::json& options)> done;

  // What works for the document outside of its tasks, such as the scan of an emulated instrument; empty: nothing does.
  std::function<std::vector<LeftJob>()> runs_elsewhere;
  // How the document is looked at, which a crash should not take along; empty: nobody looks.
  std::function<nlohmann::json()> shown_as;

  // "" when a verb may start now, else the reason to show.
  std::string whyNot(std::string_view verb) const;
  std::string whyNotUndo() const;
  std::string whyNotRedo() const;
  std::string whyNotSave() const;
  std::string whyNotAdopt() const;

  // Starts the verb that these are options of; false when whyNot() says why not. `title` is what the list of tasks
  // shows.
  bool start(const VerbOptions& options, std::string title = {});
  // The same with work of its own, once the options have been checked.
  using Work = std::function<Result<Outcome>(const Document&, Progress&)>;
  bool start(const VerbOptions& options, std::string title, Work work);
  // By name, as a form has filled them in.
  bool start(std::string_view verb, nlohmann::json options, std::string title = {});
  // The same; what it answers without changing the document is kept in answers().
  bool startAndShow(std::string_view verb, nlohmann::json options, std::string title = {});
  // Refused where another program has changed the project since it was opened or saved here.
  bool save(const std::filesystem::path& folder);
  bool open(const std::filesystem::path& folder);
  // A copy of what is unsaved; what it shares with the last one in that folder is not written again.
  bool saveRecovery(const std::filesystem::path& folder);
  bool keepsRecovery() const;                                    // right now
  std::uint64_t keptRevision() const { return kept_.revision; }  // of the newest copy that is whole; 0: none
  // Why the newest copy could not be written; "" when there is nothing to say.
  const std::string& keepingProblem() const { return keeping_problem_; }
  // Opens its copy as unsaved work of the project it is a copy of; without a copy, that project. It is removed when a
  // newer copy or the project is written.
  bool recover(const LeftWork& left);
  void clear();  // a new, empty project
  void undo();
  void redo();
  std::string whyNotGoTo(std::size_t step) const;
  void goTo(std::size_t step);  // of history()
  // A step that changes how the document is shown, and nothing of it (History::pushShown).
  void note(std::any shown, std::string description);

  // Takes the results of what has finished; true when there were any. Call once a frame.
  bool poll();
  void wait();  // until nothing runs
  void cancelAll();
  // Takes in what ran elsewhere on the current document (an emulated instrument's scan); false when whyNotAdopt() says
  // why not.
  bool adopt(Outcome outcome);
  // Takes in a model that was read for a preview: a new project. False when whyNot("import") says why not.
  bool adoptImport(Outcome outcome);
  // Starts what is left of the verb add when the model has been read for a preview. False when whyNot("add") says why
  // not.
  bool startAdding(Outcome outcome, std::string title);

  const std::vector<std::unique_ptr<VerbTask>>& running() const { return running_; }
  const std::deque<FinishedTask>& finished() const { return finished_; }  // newest first
  // That went well, and on this project.
  const FinishedTask* lastOf(std::string_view verb) const;
  // Whether the model, its materials or the survey have changed since; a measurement or a bookmark is nothing to it.
  bool isOutOfDate(const FinishedTask& task) const;
  // Its answer; null where there is none of that type.
  template <class A>
  const A* lastAnswer(std::string_view verb) const {
    const auto* last = lastOf(verb);
    return last == nullptr ? nullptr : answerAs<A>(last->answer);
  }
  const std::vector<LogEntry>& log() const { return log_; }
  void clearLog() { log_.clear(); }
  void say(const Report& report);
  void say(LogLevel level, std::string source, std::string message);
  std::deque<ShownAnswer>& answers() { return answers_; }  // not yet read by the user, oldest first
  std::deque<ShownError>& errors() { return errors_; }     // not yet read by the user, oldest first

  // Whether another program has changed the open project; looks at most once a second.
  bool changedOnDisk();
  void keepOverDisk();  // the next save replaces what the other program wrote
  // Who else has the open project open in an editor: "standpoint editor (process 123 of …)"; "" nobody, or it has been
  // settled.
  const std::string& openElsewhere() const { return open_elsewhere_; }
  void stayBeside() { open_elsewhere_.clear(); }                   // both work on it; who saves second is asked
  void workOnCopy();                                               // a new, unsaved project with what is open
  const std::filesystem::path& folder() const { return folder_; }  // empty until saved or opened
  // folder(), or while there is none a place that is this project's own: scanning needs no saving.
  std::filesystem::path ownFolder() const;
  std::string name() const;
  bool modified() const { return history_.modified(); }
  std::string lastChange() const { return history_.description(history_.position()); }
  // Rises with every change of the document, for what is derived from it.
  std::uint64_t revision() const { return revision_; }
  std::uint64_t steps() const { return revision_ + noted_; }  // rises with every step, back ones too

 private:
  std::string whyHeld() const;  // by a task; "" when it is free
  std::string whyForbidden(std::string_view name) const;
  void launch(const Verb& verb, nlohmann::json options, std::string title, Task<Outcome>::Work work);
  void takeResult(VerbTask& task);
  void succeed(VerbTask& task, Outcome outcome);
  void fail(const VerbTask& task, const Error& error);
  void succeedKeeping();
  void forgetRecovered();
  void stayIn(const std::filesystem::path& folder, std::string on_disk);
  void leaveFolder();
  void countStep(const Document& before);

  std::vector<Verb> verbs_;
  std::function<void()> wake_;
  History history_;
  std::filesystem::path folder_;
  std::string begun_ = dateAndTime();  // the project
  std::optional<OpenMark> open_mark_;  // of folder_
  std::string open_elsewhere_;
  std::string on_disk_;  // what the project on disk was when it was last read or written here
  bool changed_on_disk_ = false;
  std::chrono::steady_clock::time_point looked_;
  std::vector<std::unique_ptr<VerbTask>> running_;
  std::deque<FinishedTask> finished_;
  std::vector<LogEntry> log_;
  std::deque<ShownError> errors_;
  std::deque<ShownAnswer> answers_;
  std::uint64_t revision_ = 0, noted_ = 0;
  struct Kept {
    std::filesystem::path folder;
    Document document;
    std::uint64_t revision = 0;
  };
  Kept kept_, keeping_;  // the recovery copy that is whole, and the one that is being written
  std::string keeping_problem_;
  std::filesystem::path recovered_from_;  // a copy that is still needed
  std::uint64_t project_since_ = 0;       // its first revision
};

}  // namespace standpoint
