// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/nearest_name.h"
#include "core/number_text.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/hand_over.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/field_proofs.h"
#include "emulated-ui/rehearsal/office_cleaning.h"
#include "emulated-ui/rehearsal/part_proofs.h"
#include "emulated-ui/rehearsal/part_surface.h"
#include "emulated-ui/rehearsal/plain_words.h"
#include "emulated-ui/sighting.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Kind = RehearsalAction::Kind;

constexpr double kStep_s = 1;              // of virtual time
constexpr double kLongestFinish_s = 7200;  // of the device's clock, for one "finish"

Result<Document> done(const Document& document, const std::string& verb, const json& options, Progress& progress) {
  TRY_ASSIGN(auto outcome, runVerb(*findVerb(verbs(), verb), document, options, progress));
  return std::move(outcome.document);
}

std::vector<std::string> stationNames(const Document& document) {
  std::vector<std::string> names;
  if (document.job)
    for (const auto& station : document.job->stations) names.push_back(station.name);
  return names;
}

// What a verb or device refuses of a file is the file's fault, not that of whoever starts it.
ErrorKind preparing(const Error& error) { return error.kind == ErrorKind::usage ? ErrorKind::unusable : error.kind; }

// Scans with the truth of each point are several times as large: only where something is asked of it.
bool asksThePoints(const Exercise& e) {
  const auto asks = [](const std::string& text) {
    return text.find("data.") != std::string::npos || text.find("cleaning.") != std::string::npos;
  };
  return std::any_of(e.rules.begin(), e.rules.end(),
                     [&](const ExerciseRule& r) {
                       return asks(r.holds.text()) || asks(r.proof) || asks(r.because.in("en")) ||
                              asks(r.cost.in("en"));
                     }) ||
         std::any_of(e.steps.begin(), e.steps.end(), [&](const ExerciseStep& s) { return asks(s.done.text()); });
}

bool isOfAScan(const std::string& fact) { return fact.starts_with("data.") || fact.starts_with("newest."); }

// Those that its proof and its texts show and its condition does not ask.
std::vector<std::string> shownFacts(const ExerciseRule& rule) {
  std::vector<std::string> names;
  const auto asked = rule.holds.facts();
  const auto take = [&](const std::string& name) {
    const auto is = [&](const std::vector<std::string>& in) {
      return std::find(in.begin(), in.end(), name) != in.end();
    };
    if (!name.empty() && !is(asked) && !is(names)) names.push_back(name);
  };
  take(rule.proof);
  for (const auto* said : {&rule.because, &rule.cost})
    for (const auto& [language, text] : said->texts)
      for (const auto& name : factsInText(text)) take(name);
  return names;
}

}  // namespace

Result<std::unique_ptr<Rehearsal>> Rehearsal::start(Exercise exercise, const std::string& device,
                                                    const fs::path& folder, std::function<void()> wake,
                                                    Progress& progress) {
  std::unique_ptr<Rehearsal> rehearsal(new Rehearsal(std::move(exercise), folder));
  TRY(rehearsal->prepare(device, std::move(wake), progress));
  return rehearsal;
}

Result<void> Rehearsal::prepare(const std::string& wanted, std::function<void()> wake, Progress& progress) {
  const auto& e = exercise_;
  if (const auto faults = checkExercise(e); !faults.empty()) return failure(faults.front());
  const std::string id = wanted.empty() ? e.devices.front() : wanted;
  if (!isFor(e, id))
    return failure(ErrorKind::usage, fmt::format("the exercise is for {}, not '{}'", fmt::join(e.devices, ", "), id),
                   e.id);
  const auto* device = findDevice(id == "*" ? emulatedDevices().front().id : id);
  if (device == nullptr) return failure(ErrorKind::usage, fmt::format("unknown device '{}'", id), e.id);
  TRY_ASSIGN(auto type, loadDevice(*device, e.instrument));
  if (auto ok = prepareModel(progress); !ok) return ok;
  if (auto ok = checkParts(); !ok) return ok;
  host_ = std::make_unique<DeviceHost>(type, document_, std::move(wake));
  host_->time_factor = 1;
  host_->truth = asksThePoints(e);
  steps_.resize(e.steps.size());
  rules_.resize(e.rules.size());
  for (const auto& rule : e.rules) shown_facts_.push_back(shownFacts(rule));
  event_happened_.resize(e.events.size());
  for (std::size_t i = 0; i < e.start.size(); ++i) {
    const auto logged = this->device().state().log.size();
    auto ok = apply(e.start[i], progress);
    const auto& log = this->device().state().log;
    for (std::size_t k = logged; ok && k < log.size(); ++k)
      if (log[k].what == "failed") ok = failure(ErrorKind::unusable, log[k].detail);
    if (!ok)
      return failure(preparing(ok.error()), "cannot prepare the exercise: " + ok.error().message,
                     fmt::format("{} /start/{}", e.file, i));
  }
  auto& around = this->device().change().around;
  if (e.battery) around.battery = *e.battery;
  if (e.card_free_gb) around.card_used_bytes = std::max(0.0, around.card_bytes - *e.card_free_gb * 1e9);
  for (const auto& trouble : e.troubles)
    if (auto ok = this->device().trouble(trouble); !ok) return ok;
  started_s_ = this->device().state().clock_s;
  log_seen_ = this->device().state().log.size();
  watching_ = true;  // what the start did is nobody's work
  watch();
  for (std::size_t i = 0; i < steps_.size(); ++i)
    if (steps_[i].done)
      return failure(ErrorKind::unusable,
                     fmt::format("step '{}' is already done at the start: '{}' is true; change the condition or /start",
                                 e.steps[i].id, e.steps[i].done.text()),
                     fmt::format("{} /steps/{}/done", e.file, i));
  return {};
}

Result<void> Rehearsal::prepareModel(Progress& progress) {
  TRY_ASSIGN(const auto model, modelOf(exercise_));
  progress.stage("Preparing the environment", 0, 0.3);
  auto document = done({}, "import", {{"files", json::array({model.string()})}}, progress);
  if (!document) return failure(document.error());
  document_ = *std::move(document);
  for (std::size_t i = 0; i < exercise_.setup.size(); ++i) {
    const auto verb = exercise_.setup[i].at("verb").get<std::string>();
    auto options = exercise_.setup[i].at("options");
    if (verb == "scan") options["output"] = (folder_ / "static").string();
    document = done(document_, verb, options, progress);
    if (!document)
      return failure(preparing(document.error()), "cannot prepare the environment: " + document.error().message,
                     fmt::format("{} /setup/{}/options", exercise_.file, i));
    document_ = *std::move(document);
  }
  knowControl();
  return {};
}

// What a part means must be in the model.
Result<void> Rehearsal::checkParts() const {
  if (exercise_.parts.empty()) return {};
  const auto& environment = *document_.environment();
  const auto bounds = productBounds(environment);
  for (const auto& [name, part] : exercise_.parts) {
    const PartSurface surface(part, environment, document_.georeference->shift_m);
    const auto place = fmt::format("{} /parts/{}", exercise_.file, name);
    if (!surface.hasProducts()) {
      std::vector<std::string> known;
      for (const auto& product : environment.products)
        known.push_back(part.floor.empty() ? product.name : product.storey);
      std::sort(known.begin(), known.end());
      known.erase(std::unique(known.begin(), known.end()), known.end());
      const auto& wanted = part.floor.empty() ? part.product : part.floor;
      return failure(ErrorKind::unusable,
                     fmt::format("the model has no {} '{}'; {}", part.floor.empty() ? "product" : "floor", wanted,
                                 knownInstead(wanted, known)),
                     place + (part.floor.empty() ? "/product" : "/floor"));
    }
    if (!surface.meets(bounds))
      return failure(ErrorKind::unusable, "nothing of the model is in the box; check its corners (metres, file frame)",
                     place + "/box");
  }
  return {};
}

// The known places that are copied to the instrument; heights are theirs, not of the targets above them.
void Rehearsal::knowControl() {
  if (exercise_.control.empty()) return;
  Job job = document_.job ? *document_.job : Job();
  const Eigen::Vector3d shift = document_.georeference->shift_m;
  for (const auto& [name, at] : exercise_.control)
    job.control_points.push_back({name, Eigen::Vector3d(at[0], at[1], at[2]) - shift, 0});
  document_.job = std::make_shared<const Job>(std::move(job));
}

Result<void> Rehearsal::runFieldVerb(const RehearsalAction& action, Progress& progress) {
  if (host_->busy()) return failure(ErrorKind::usage, "wait until the instrument has finished", action.name);
  TRY_ASSIGN(auto document, done(document_, action.name, action.options, progress));
  document_ = std::move(document);
  counts_["field." + action.name] += 1;
  return {};
}

Result<void> Rehearsal::cleanOffice(const RehearsalAction& action, Progress& progress) {
  if (host_->busy()) return failure(ErrorKind::usage, "wait until the instrument has finished", action.name);
  const auto office = officeBeside(folder_ / "scans");
  TRY(cleanCopies(officeCopies(device(), office), action.options.at("filters"), office, progress));
  counts_["field." + action.name] += 1;
  return {};
}

Result<void> Rehearsal::apply(const RehearsalAction& action, Progress& progress) {
  switch (action.kind) {
    case Kind::press: return device().act(action.name, action.value, action.by);
    case Kind::hand:
      if (action.name == "stand_at" && stationOf(document_, action.value) == nullptr)
        return failure(
            ErrorKind::usage,
            fmt::format("unknown station '{}'; {}", action.value, knownInstead(action.value, stationNames(document_))),
            action.name);
      return host_->hand(action.name, action.value);
    case Kind::wait: return passVirtually(action.seconds, progress);
    case Kind::finish: return finish(progress);
    case Kind::verb: return isOfficeVerb(action.name) ? cleanOffice(action, progress) : runFieldVerb(action, progress);
    case Kind::answer: {
      const auto* question = findQuestion(exercise_.questions, action.name);
      if (question == nullptr)
        return failure(ErrorKind::usage, fmt::format("unknown question '{}'", action.name), exercise_.id);
      if (const auto wrong = wrongAnswer(*question, action.value))
        return failure(ErrorKind::usage, *wrong, action.name);
      answers_[action.name] = action.value;
      return {};
    }
    case Kind::walk:
      walk_.clear();
      for (const auto& place : action.options)
        walk_.push_back({place[0].get<double>(), place[1].get<double>(), place[2].get<double>()});
      counts_["field.walk"] += 1;
      return device().type().instrument.moving ? goAlong(walk_) : Result<void>();
    case Kind::hint: {
      for (std::size_t i = 0; i < exercise_.steps.size(); ++i)
        if (exercise_.steps[i].id == action.name) {
          hints_ += steps_[i].hinted ? 0 : 1;
          steps_[i].hinted = true;
          return {};
        }
      return failure(ErrorKind::usage, fmt::format("unknown step '{}'", action.name), exercise_.id);
    }
  }
  return {};
}

// With a scanner in the hand the planned way is gone at once, each leg as fast as its times have it; to where it begins
// at the usual pace.
Result<void> Rehearsal::goAlong(const WalkedWay& way) {
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double length = i == 0 ? 0 : std::hypot(way[i][0] - way[i - 1][0], way[i][1] - way[i - 1][1]);
    const auto pace = i == 0 ? std::string() : fmt::format(",{:.3f}", length / (way[i][2] - way[i - 1][2]));
    if (i > 0 && length < 1e-6) continue;
    const auto value = fmt::format("{},{}{}", exactText(way[i][0]), exactText(way[i][1]), pace);
    TRY(host_->hand("walk_to", value));
  }
  return {};
}

Result<void> Rehearsal::act(const RehearsalAction& action, Progress& progress) {
  keepWait();
  auto ok = apply(action, progress);
  watch();
  if (ok) keep(action);
  return ok;
}

void Rehearsal::keep(const RehearsalAction& action) {
  const auto since = std::chrono::steady_clock::now() - began_;
  actions_.push_back(action);
  traces_.push_back({std::chrono::duration_cast<std::chrono::milliseconds>(since).count(), state()});
}

// In whole milliseconds, so that it reads well; the rest belongs to the next one.
void Rehearsal::keepWait() {
  const double wait_s = std::floor(waited_s_ * 1000) / 1000;
  if (wait_s <= 0) return;
  waited_s_ -= wait_s;
  keep({Kind::wait, "", "", wait_s, {}});
}

// Whole numbers and words only.
std::string Rehearsal::state() const {
  const auto screen = device().screen();
  const auto& state = device().state();
  auto text = fmt::format("{}|{}|{}|{}|{} mdeg|", screen.id, state.dialog, state.phase, state.around.station,
                          std::lround(1000 * device().number("tilt")));
  for (const auto& project : state.projects)
    for (const auto& setup : project.setups) text += fmt::format("{}={} ", setup.name, setup.points);
  text += '|';
  for (const auto& step : steps_) text += step.done ? '1' : '0';
  text += '|';
  for (const auto& rule : rules_) text += rule.broken_at_s >= 0 ? '0' : '1';
  return text;
}

void Rehearsal::did(const RehearsalAction& verb, std::shared_ptr<const Job> job) {
  keepWait();
  document_.job = std::move(job);
  counts_["field." + verb.name] += 1;
  watch();
  keep(verb);
}

void Rehearsal::pass(double seconds) {
  const double before = device().state().clock_s;
  update(seconds);
  waited_s_ += device().state().clock_s - before;
}

void Rehearsal::update(double seconds) {
  if (auto stored = host_->update(document_, folder_ / "scans", seconds)) document_ = std::move(stored->document);
  watch();
}

Result<void> Rehearsal::passVirtually(double seconds, Progress& progress) {
  while (seconds > 0) {
    update(0);  // what was ordered meanwhile begins
    while (host_->task() != nullptr) {
      if (auto going = progress.check(); !going) {
        host_->task()->progress().cancel();
        return going;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      update(0);
    }
    const double step = std::min(seconds, kStep_s);
    update(step);
    seconds -= step;
  }
  return {};
}

Result<void> Rehearsal::finish(Progress& progress) {
  update(0);
  for (double waited = 0; host_->busy() && waited < kLongestFinish_s && device().state().dialog.empty();
       waited += kStep_s)
    if (auto ok = passVirtually(kStep_s, progress); !ok) return ok;
  return {};
}

FactLookup Rehearsal::lookup() const {
  return [this](const std::string& name) { return fact(name); };
}

std::optional<Fact> Rehearsal::fact(const std::string& name) const {
  if (name == "time") return numberFact(seconds());
  if (name == "hints") return numberFact(hints_);
  if (name.starts_with("count.")) {
    const auto found = counts_.find(name.substr(6));
    return numberFact(found == counts_.end() ? 0 : found->second);
  }
  if (name.starts_with("answer.")) {
    const auto found = answers_.find(name.substr(7));
    if (found == answers_.end()) return wordFact("");
    const auto* question = findQuestion(exercise_.questions, found->first);
    return Fact{found->second, question->number ? numberIn(found->second) : std::nullopt};
  }
  if (auto planned = walkProof(name, exercise_, walk_, device())) return planned;
  if (auto shown = proofs_.fact(name, exercise_, device(), document_, folder_)) return shown;
  return device().fact(name);
}

const ExerciseStep* Rehearsal::nextStep() const {
  for (std::size_t i = 0; i < steps_.size(); ++i)
    if (!steps_[i].done) return &exercise_.steps[i];
  return nullptr;
}

std::string foundText(const Condition& condition, const std::map<std::string, Fact>& facts) {
  std::string text;
  for (const auto& name : condition.facts()) {
    const auto value = facts.find(name);
    text += (text.empty() ? "" : ", ") + name + " = " +
            (value == facts.end()   ? "–"
             : value->second.number ? fmt::format("{:.6g}", *value->second.number)
                                    : value->second.text);
  }
  return text;
}

void Rehearsal::takeFacts(RuleState& state, const std::vector<std::string>& names) const {
  for (const auto& name : names)
    if (auto value = fact(name)) state.facts.insert_or_assign(name, *std::move(value));
}

void Rehearsal::find(std::size_t index) {
  RuleState& state = rules_[index];
  const auto& condition = exercise_.rules[index].holds;
  state.facts.clear();
  takeFacts(state, condition.facts());
  state.found = foundText(condition, state.facts);
}

void Rehearsal::breakRule(std::size_t index) {
  RuleState& state = rules_[index];
  if (state.broken_at_s >= 0) return;
  state.broken_at_s = seconds();
  find(index);
  state.awaits_scan = device().state().running.has_value();
  if (!state.awaits_scan) noteNewest(state);
  takeShown(state, index, state.awaits_scan ? FactsOf::others : FactsOf::all);
}

void Rehearsal::takeShown(RuleState& state, std::size_t index, FactsOf which) const {
  std::vector<std::string> names;
  for (const auto& name : shown_facts_[index])
    if (which == FactsOf::all || isOfAScan(name) == (which == FactsOf::scan)) names.push_back(name);
  takeFacts(state, names);
}

void Rehearsal::noteNewest(RuleState& state) const {
  if (const auto* newest = device().newestSetup()) state.scan = newest->file;
}

// What a mistake does shows in the scan that ran when it was made, not in a better one that comes later.
void Rehearsal::noteScanOf(RuleState& state, std::size_t index, const DeviceEvent& event) {
  if (!state.awaits_scan) return;
  if (event.what == "scan_stored") {
    takeShown(state, index, FactsOf::scan);
    noteNewest(state);
  }
  state.awaits_scan = event.what != "scan_stored" && event.what != "scan_dropped" && event.what != "failed";
}

// A target that is not where it was during an earlier scan was moved.
void Rehearsal::noteTargets() {
  if (!document_.job) return;
  for (const auto& target : document_.job->targets) {
    const auto [seen, first] = target_places_.try_emplace(target.name, target.centre);
    if (first || (seen->second - target.centre).norm() < 1e-4) continue;
    counts_["targets_moved"] += 1;
    seen->second = target.centre;
  }
}

// With its detail, too: of "settings/resolution=6mm" what was pressed counts, and which value.
void Rehearsal::count(const DeviceEvent& event) {
  counts_[event.what] += 1;
  counts_[event.what + "." + event.detail] += 1;
  if (const auto value = event.detail.find('='); value != std::string::npos)
    counts_[event.what + "." + event.detail.substr(0, value)] += 1;
}

// After every action and every step of the clock.
void Rehearsal::watch() {
  if (!watching_) return;
  const auto look = lookup();
  const auto& log = device().state().log;
  for (; log_seen_ < log.size(); ++log_seen_) {
    const auto& event = log[log_seen_];
    count(event);
    if (event.what == "scan_started") noteTargets();
    if (event.what == "failed") failures_.push_back({seconds(), event.detail});
    for (std::size_t i = 0; i < rules_.size(); ++i) {
      const auto& rule = exercise_.rules[i];
      noteScanOf(rules_[i], i, event);
      if (rule.when != "each" || rule.event != event.what) continue;
      rules_[i].asked = true;
      if (!rule.holds.holds(look))
        breakRule(i);
      else if (rules_[i].broken_at_s < 0)
        find(i);  // as it was when it was asked last
    }
  }
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const auto& rule = exercise_.rules[i];
    if (rule.when == "always" && !rule.holds.holds(look)) breakRule(i);
    if (rule.when == "once" && !rules_[i].held && rule.holds.holds(look)) {
      rules_[i].held = true;
      find(i);
    }
  }
  for (std::size_t i = 0; i < exercise_.events.size(); ++i)
    if (!event_happened_[i] && exercise_.events[i].when.holds(look)) {
      event_happened_[i] = true;
      (void)device().trouble(exercise_.events[i].trouble);
    }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (!steps_[i].done && exercise_.steps[i].done.holds(look)) {
      steps_[i].done = true;
      steps_[i].at_s = seconds();
    }
    if (!steps_[i].done && exercise_.in_order) break;
  }
}

std::vector<Rehearsal::RuleState> Rehearsal::judge() const {
  auto states = rules_;
  const auto look = lookup();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& rule = exercise_.rules[i];
    if (rule.when == "end") {
      states[i].held = rule.holds.holds(look);
      if (!states[i].held) states[i].broken_at_s = seconds();
    } else if (rule.when == "always") {
      states[i].held = states[i].broken_at_s < 0;
    } else if (rule.when == "each") {
      states[i].held = states[i].asked && states[i].broken_at_s < 0;
    }
    states[i].asked = states[i].asked || rule.when != "each";
    if (states[i].asked && states[i].found.empty()) {
      takeFacts(states[i], rule.holds.facts());
      states[i].found = foundText(rule.holds, states[i].facts);
    }
    const bool is_of_the_end = states[i].broken_at_s < 0 || rule.when == "end";
    if (states[i].asked && is_of_the_end) {
      takeShown(states[i], i, FactsOf::all);
      noteNewest(states[i]);
    }
  }
  return states;
}

bool Rehearsal::overTime() const { return exercise_.time_limit_s > 0 && seconds() > exercise_.time_limit_s; }

std::vector<std::string> factNames(const Exercise& exercise, const Device& device) {
  std::vector<std::string> names = {"time", "hints", "phase", "screen", "dialog"};
  for (const auto& q : exercise.questions) names.push_back("answer." + q.id);
  for (const auto& [place, at] : exercise.places) names.push_back("place." + place);
  for (const auto& setting : device.type().instrument.settings) names.push_back("setting." + setting.key);
  for (const auto& value : device.type().definition.values) names.push_back("value." + value.id);
  for (const auto* rows : {&device.type().program.facts, &sharedFacts()})
    for (const auto& row : *rows) names.emplace_back(row.name);
  for (const auto& row : proofRows()) names.emplace_back(row.name);
  return names;
}

std::optional<FactDomain> rehearsalDomain(const Exercise& exercise, const std::string& name) {
  if (name == "time" || name == "hints" || name.starts_with("count.")) return FactDomain{{}, true, 0, 1e9};
  if (name.starts_with("answer.")) {
    const auto* question = findQuestion(exercise.questions, name.substr(7));
    if (question == nullptr) return std::nullopt;
    if (const auto& number = question->number) return FactDomain{{}, true, number->minimum, number->maximum};
    return FactDomain{question->choices};
  }
  if (auto own = namedProofDomain(name, exercise)) return own;
  if (const auto part = partFigure(name, exercise)) return part->domain;
  if (cleaningOfClass(name)) return FactDomain{{}, true, 0, 1};
  for (const auto& row : proofRows())
    if (name == row.name) return row.domain;
  return std::nullopt;
}

}  // namespace standpoint
