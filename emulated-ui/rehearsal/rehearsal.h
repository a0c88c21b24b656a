// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/progress.h"
#include "emulated-ui/host.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "emulated-ui/rehearsal/field_proofs.h"
#include "emulated-ui/rehearsal/proofs.h"

namespace standpoint {

// A rehearsal that runs: an exercise, its environment, the device in the student's hands, and what was done so far.
class Rehearsal {
 public:
  // `folder` receives the scans and copies; `device` empty: the exercise's first. An exercise that checkExercise
  // refuses, that cannot be prepared, or of which a step is done before the student comes, is refused with file and
  // JSON pointer.
  static Result<std::unique_ptr<Rehearsal>> start(Exercise exercise, const std::string& device,
                                                  const std::filesystem::path& folder, std::function<void()> wake,
                                                  Progress& progress);

  const Exercise& exercise() const { return exercise_; }
  Device& device() { return host_->device(); }
  const Device& device() const { return host_->device(); }
  DeviceHost& host() { return *host_; }
  const Document& document() const { return document_; }
  const std::filesystem::path& folder() const { return folder_; }

  // What the student does; it is kept for the replay. What cannot be done now is an error of kind usage.
  Result<void> act(const RehearsalAction& action, Progress& progress);
  // A verb of the survey that ran elsewhere, on the job of document(): `job` is what became of it. It is kept for the
  // replay.
  void did(const RehearsalAction& verb, std::shared_ptr<const Job> job);
  // The clock of the device goes on by `seconds`: in a window, once per frame. Simulations run beside it.
  void pass(double seconds);
  // The same in virtual time: each simulation is waited for before the clock goes on, so that the same actions give the
  // same.
  Result<void> passVirtually(double seconds, Progress& progress);
  // Until the device and what runs behind it rest.
  Result<void> finish(Progress& progress);

  // Of the device, of the exercise ("time", "count.scan_stored", "answer.usable", "hints") and of the data
  // ("data.noise").
  std::optional<Fact> fact(const std::string& name) const;

  struct StepState {
    bool done = false;
    double at_s = 0;
    bool hinted = false;
  };
  struct RuleState {
    bool held = false;        // as far as it could be told
    bool asked = false;       // false: its event never came
    double broken_at_s = -1;  // for the first time
    std::string found;        // what the facts of its condition were then
    // As it was judged: the facts of its condition; then those of its proof and texts, of the scan that ran when it was
    // broken once that is stored. What was not there is left out.
    std::map<std::string, Fact> facts;
    bool awaits_scan = false;  // for the latter
    std::string scan;          // file of the one that shows it: that ran then, else the newest of then; empty: none
  };
  const std::vector<StepState>& steps() const { return steps_; }
  // The step that is to be done now; null after the last.
  const ExerciseStep* nextStep() const;
  const std::vector<RehearsalAction>& actions() const { return actions_; }
  // Beside each of them: when it was done, of the computer's clock since the start, and what device and marks were
  // right after it, in one line that is the same on each computer: "home||ready|S1|tilt 20 mdeg|…".
  struct Trace {
    std::int64_t wall_ms = 0;
    std::string state;
  };
  const std::vector<Trace>& traces() const { return traces_; }
  // Keeps the device's time since the last action as a wait: before an end that is no action.
  void keepWait();
  // What the device was asked for and could not do, with the reason: a scan that failed.
  struct Failure {
    double at_s = 0;
    std::string reason;
  };
  const std::vector<Failure>& failures() const { return failures_; }
  // The end: asks the rules of the end; gives the states of all.
  std::vector<RuleState> judge() const;
  bool overTime() const;
  double seconds() const { return device().state().clock_s - started_s_; }

 private:
  Rehearsal(Exercise exercise, std::filesystem::path folder)
      : exercise_(std::move(exercise)), folder_(std::move(folder)) {}
  Result<void> prepare(const std::string& device, std::function<void()> wake, Progress& progress);
  Result<void> apply(const RehearsalAction& action, Progress& progress);
  Result<void> goAlong(const WalkedWay& way);
  Result<void> runFieldVerb(const RehearsalAction& action, Progress& progress);
  Result<void> cleanOffice(const RehearsalAction& action, Progress& progress);
  Result<void> prepareModel(Progress& progress);
  Result<void> checkParts() const;
  void knowControl();
  void watch();
  void update(double seconds);
  void keep(const RehearsalAction& action);
  std::string state() const;
  void count(const DeviceEvent& event);
  void noteTargets();
  void breakRule(std::size_t index);
  void find(std::size_t index);  // what the facts of the rule's condition are now
  void noteNewest(RuleState& state) const;
  void noteScanOf(RuleState& state, std::size_t index, const DeviceEvent& event);
  enum class FactsOf { all, scan, others };  // of the newest scan, or not
  void takeShown(RuleState& state, std::size_t index, FactsOf which) const;
  void takeFacts(RuleState& state, const std::vector<std::string>& names) const;
  FactLookup lookup() const;

  Exercise exercise_;
  std::filesystem::path folder_;
  Document document_;
  std::unique_ptr<DeviceHost> host_;
  std::vector<StepState> steps_;
  std::vector<RuleState> rules_;
  std::vector<std::vector<std::string>> shown_facts_;  // by rule: of its proof and texts, beside those of its condition
  std::vector<bool> event_happened_;
  std::vector<RehearsalAction> actions_;
  std::vector<Trace> traces_;
  double waited_s_ = 0;  // of the device's clock, in no action so far
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::vector<Failure> failures_;
  std::map<std::string, std::string> answers_;
  WalkedWay walk_;
  std::map<std::string, double> counts_;
  std::map<std::string, Eigen::Vector3d> target_places_;  // during the newest scan that had them
  bool watching_ = false;                                 // not before the student comes
  std::size_t log_seen_ = 0;
  double started_s_ = 0;
  int hints_ = 0;
  mutable Proofs proofs_;
};

// What a rehearsal's own facts can be, for the checker; the device's stand apart.
std::optional<FactDomain> rehearsalDomain(const Exercise& exercise, const std::string& name);
// "tilt = 0.3, data.noise = –": the facts of the condition, in its order.
std::string foundText(const Condition& condition, const std::map<std::string, Fact>& facts);
// Facts that conditions of the exercise may ask on the device, but for counters and those with figures in their names.
std::vector<std::string> factNames(const Exercise& exercise, const Device& device);

}  // namespace standpoint
