// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/nearest_name.h"
#include "core/scratch_folder.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/events.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/plain_words.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "emulated-ui/rehearsal/sample_solution.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;

constexpr std::size_t kMostFacts = 8;  // of the hundreds that there are, in a message

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> samples() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(samplesFolder(), error))
    if (entry.path().extension() == ".ifc") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// All that can be pressed on it.
std::vector<std::string> widgetsOf(const Device& device) {
  const auto& d = device.type().definition;
  auto names = idsOf(d.keys);
  const auto take = [&](const std::string& id) {
    if (!among(names, id)) names.push_back(id);
  };
  for (const auto& screen : d.screens)
    for (const auto& w : screen.widgets) {
      if (w.setting != "*")
        take(w.id);
      else
        for (const auto& s : device.type().instrument.settings)
          take("setting." + s.key);  // a screen that shows every setting
    }
  for (const auto& dialog : d.dialogs)
    for (const auto& button : dialog.buttons) take(button.id);
  return names;
}

class Checker {
 public:
  explicit Checker(const Exercise& exercise) : e_(exercise) {}

  std::vector<Error> check() {
    checkDevices();
    if (devices_.empty()) return std::move(faults_);
    if (std::filesystem::path(e_.model).has_extension()) {
      if (const auto model = modelOf(e_); !model) faults_.push_back(model.error());
    } else if (const auto known = samples(); !among(known, e_.model)) {
      fault("/model", fmt::format("unknown sample '{}'; {}", e_.model, knownInstead(e_.model, known)));
    }
    checkTexts();
    checkQuestions();
    const auto points = [](double sum, const auto& one) { return sum + one.points; };
    if (std::accumulate(e_.rules.begin(), e_.rules.end(),
                        std::accumulate(e_.steps.begin(), e_.steps.end(), 0.0, points), points) <= 0)
      fault("", "no points to award: give at least one step or rule points");
    checkIds(e_.steps, "steps");
    checkIds(e_.rules, "rules");
    checkIds(e_.questions, "questions");
    for (std::size_t i = 0; i < e_.steps.size(); ++i) {
      const auto place = fmt::format("/steps/{}", i);
      checkCondition(e_.steps[i].done, place + "/done");
      if (!e_.steps[i].widget.empty()) checkWidget(e_.steps[i].widget, place + "/widget");
    }
    for (std::size_t i = 0; i < e_.rules.size(); ++i) {
      const auto place = fmt::format("/rules/{}", i);
      checkCondition(e_.rules[i].holds, place + "/holds");
      if (!e_.rules[i].proof.empty()) (void)checkFact(e_.rules[i].proof, devices_.front(), place + "/proof");
      checkFigures(e_.rules[i].because, place + "/because");
      checkFigures(e_.rules[i].cost, place + "/cost");
      checkShownAt(e_.rules[i].shown_at, place + "/shown_at");
    }
    for (std::size_t i = 0; i < e_.events.size(); ++i) {
      checkCondition(e_.events[i].when, fmt::format("/events/{}/when", i));
      checkTrouble(e_.events[i].trouble, fmt::format("/events/{}/trouble", i));
    }
    for (std::size_t i = 0; i < e_.troubles.size(); ++i) checkTrouble(e_.troubles[i], fmt::format("/troubles/{}", i));
    for (std::size_t i = 0; i < e_.setup.size(); ++i) {
      const auto& verb = e_.setup[i];
      const auto place = fmt::format("/setup/{}", i);
      checkVerb(verb.at("verb").get<std::string>(), verb.at("options"), place);
      checkPrepares(verb.at("verb").get<std::string>(), verb.at("options"), place);
    }
    for (const auto& id : e_.expect.broken)
      if (const auto known = idsOf(e_.rules); !among(known, id))
        fault("/expect/broken", fmt::format("unknown rule '{}'; {}", id, knownInstead(id, known)));
    checkActions(e_.start, "/start");
    checkActions(e_.solution, "/solution");
    for (std::size_t i = 0; i < e_.mistakes.size(); ++i)
      checkActions(e_.mistakes[i].actions, fmt::format("/mistakes/{}/actions", i));
    checkIds(e_.mistakes, "mistakes");
    return std::move(faults_);
  }

 private:
  void fault(const std::string& place, const std::string& message) {
    faults_.push_back({ErrorKind::unusable, message, e_.file + " " + place});
  }

  void checkDevices() {
    for (std::size_t i = 0; i < e_.devices.size(); ++i) {
      const auto place = fmt::format("/devices/{}", i);
      if (e_.devices[i] == "*") {
        for (const auto& device : emulatedDevices()) load(device, place);
        continue;
      }
      if (const auto* device = findDevice(e_.devices[i]))
        load(*device, place);
      else
        fault(place, fmt::format("unknown device '{}'; {}", e_.devices[i],
                                 knownInstead(e_.devices[i], idsOf(emulatedDevices()))));
    }
  }
  void load(const EmulatedDevice& device, const std::string& place) {
    auto type = loadDevice(device, e_.instrument);
    if (type)
      devices_.emplace_back(*type);
    else
      fault(place, describe(type.error()));
  }

  std::optional<FactDomain> domain(const std::string& name, const Device& device) const {
    auto own = rehearsalDomain(e_, name);
    return own ? own : device.domain(name);
  }

  bool checkFact(const std::string& name, const Device& device, const std::string& place) {
    if (name.starts_with("count.")) {
      const auto wrong = wrongCounter(name, device);
      if (wrong) fault(place, *wrong);
      return !wrong;
    }
    if (domain(name, device)) return true;
    const auto& id = device.type().definition.id;
    fault(place, fmt::format("{}: unknown fact '{}'; {} (full list: standpoint rehearse --names --device {})", id, name,
                             knownInstead(name, factNames(e_, device), kMostFacts), id));
    return false;
  }

  // Its targets are those that stand there from the start.
  void checkShownAt(const std::string& name, const std::string& place) {
    if (name.empty()) return;
    std::vector<std::string> known = {kNowhere};
    for (const auto& [part, is] : e_.parts) known.push_back(part);
    for (const auto& [at, is] : e_.places) known.push_back(at);
    for (const auto& verb : e_.setup)
      if (const auto& options = verb.at("options");
          verb.at("verb") == "target" && options.contains("add") && options["add"].is_string())
        known.push_back(options["add"].get<std::string>());
    if (!among(known, name))
      fault(place, fmt::format("unknown part, place or target '{}'; {}", name, knownInstead(name, known)));
  }

  void checkFigures(const Spoken& said, const std::string& place) {
    for (const auto& [language, text] : said.texts) {
      if (const auto ok = standpoint::checkFigures(text); !ok) return fault(place, ok.error().message);
      for (const auto& name : factsInText(text))
        if (!checkFact(name, devices_.front(), place)) return;
    }
  }

  // It must be possible on each device of the exercise.
  void checkCondition(const Condition& condition, const std::string& place) {
    for (const auto& device : devices_) {
      for (const auto& name : condition.facts())
        if (!checkFact(name, device, place)) return;
      if (auto ok = condition.check([&](const std::string& name) { return domain(name, device); }); !ok)
        return fault(place, fmt::format("{}: {}", device.type().definition.id, ok.error().message));
    }
  }

  void checkWidget(const std::string& id, const std::string& place) {
    for (const auto& device : devices_)
      if (const auto known = widgetsOf(device); !among(known, id))
        return fault(place, fmt::format("{} has no control '{}'; {}", device.type().definition.id, id,
                                        knownInstead(id, known, 2 * kMostFacts)));
  }

  void checkVerb(const std::string& name, const nlohmann::json& options, const std::string& place) {
    // A station that stands badly is there all the same: what stands at it is no second fault.
    const auto names = [&](const char* key) {
      return name == "station" && options.contains(key) && options[key].is_string();
    };
    if (names("add")) stations_.push_back(options["add"].get<std::string>());
    if (names("remove")) std::erase(stations_, options["remove"].get<std::string>());
    auto complete = options;
    if (name == "scan") complete["output"] = "static";  // the rehearsal says where
    if (name == "clean") complete["in"] = "scans.e57", complete["output"] = "cleaned.e57";
    if (auto ok = checkOptions(*findVerb(verbs(), name), complete); !ok) fault(place + "/options", ok.error().message);
  }

  // What neither adds nor treats anything prepares nothing.
  void checkPrepares(const std::string& verb, const nlohmann::json& options, const std::string& place) {
    const auto lacks = [&](const char* key, const char* example) {
      if (options.is_object() && !options.contains(key))
        fault(place + "/options", fmt::format("'{}' is required by '{}'; example: {}", key, verb, example));
    };
    if (verb == "station") lacks("add", R"({"add": "S1", "on": [4.3, 1.6, 0]})");
    if (verb == "target") lacks("add", R"({"add": "T1", "type": "sphere-145", "on": [1.2, 1, 0], "height": 1.2})");
    if (verb == "mover")
      lacks("add", R"({"add": "Rotor", "kind": "turning", "product": ["Hub"], "axis-at": [0, 0, 120], "turn": 30})");
    if (verb == "treat") lacks("as", R"({"products": ["class:IfcDoor"], "as": "excluded"})");
  }

  void checkHand(const RehearsalAction& action, const std::string& place) {
    if (const auto known = idsOf(handRows()); !among(known, action.name))
      return fault(place + "/hand",
                   fmt::format("unknown hand action '{}'; {}", action.name, knownInstead(action.name, known)));
    if (action.name == "stand_at" && !among(stations_, action.value))
      fault(place + "/value",
            fmt::format("unknown station '{}'; {}", action.value,
                        stations_.empty() ? "add one in /setup first" : knownInstead(action.value, stations_)));
  }

  // A choice must be one that the device offers.
  void checkPress(const RehearsalAction& action, const std::string& place) {
    if (devices_.size() != 1) return;
    checkWidget(action.name, place + "/press");
    const auto& device = devices_.front();
    if (action.by != Gesture::tap) return checkGesture(device.type().definition, action, place + "/by");
    if (action.value.empty()) return;
    std::vector<std::string> known;
    for (const auto& screen : device.type().definition.screens)
      for (const auto& w : screen.widgets) {
        if (w.id != action.name || (w.kind != WidgetKind::choice && w.kind != WidgetKind::toggle)) continue;
        const auto values = device.domain(w.setting.empty() ? "value." + w.value : "setting." + w.setting);
        if (!values || values->words.empty()) return;  // typed, or of a list that grows
        known.insert(known.end(), values->words.begin(), values->words.end());
      }
    if (!known.empty() && !among(known, action.value) && !isLabel(device, action.value))
      fault(place + "/value", fmt::format("'{}' is not a valid choice for '{}'; {}", action.value, action.name,
                                          knownInstead(action.value, known)));
  }
  void checkGesture(const DeviceDefinition& definition, const RehearsalAction& action, const std::string& place) {
    const auto takes = [&](const WidgetRow& w) { return w.id == action.name && w.gestures.contains(action.by); };
    const auto among_rows = [&](const std::vector<WidgetRow>& rows) {
      return std::any_of(rows.begin(), rows.end(), takes);
    };
    const bool taken =
        among_rows(definition.keys) || std::any_of(definition.screens.begin(), definition.screens.end(),
                                                   [&](const ScreenRow& screen) { return among_rows(screen.widgets); });
    if (!taken) fault(place, fmt::format("'{}' does not take the gesture '{}'", action.name, nameOf(action.by)));
  }
  // A choice may be pressed by its label, too.
  static bool isLabel(const Device& device, const std::string& value) {
    for (const auto& setting : device.type().instrument.settings)
      for (const auto& choice : setting.choices)
        if (choice.label == value || device.word(setting.key + "=" + choice.value) == value) return true;
    for (const auto& own : device.type().definition.values)
      for (const auto& choice : own.choices)
        if (device.word(own.id + "=" + choice) == value) return true;
    return false;
  }

  template <class Rows>
  void checkIds(const Rows& rows, const char* list) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!seen.insert(rows[i].id).second)
        fault(fmt::format("/{}/{}", list, i), fmt::format("duplicate '{}'", rows[i].id));
  }

  void checkAnswer(const RehearsalAction& action, const std::string& place) {
    const auto* question = findQuestion(e_.questions, action.name);
    if (question == nullptr)
      return fault(place + "/answer", fmt::format("unknown question '{}'; {}", action.name,
                                                  knownInstead(action.name, idsOf(e_.questions))));
    if (const auto wrong = wrongAnswer(*question, action.value)) fault(place + "/value", *wrong);
  }

  void checkTrouble(const std::string& id, const std::string& place) {
    if (const auto known = idsOf(troubleRows()); !among(known, id))
      fault(place, fmt::format("unknown trouble '{}'; {}", id, knownInstead(id, known)));
  }

  void checkActions(const std::vector<RehearsalAction>& actions, const std::string& place) {
    for (std::size_t i = 0; i < actions.size(); ++i) {
      const auto& a = actions[i];
      const auto at = fmt::format("{}/{}", place, i);
      if (a.kind == Kind::press) checkPress(a, at);
      if (a.kind == Kind::answer) checkAnswer(a, at);
      if (a.kind == Kind::hand) checkHand(a, at);
      if (a.kind == Kind::verb) checkVerb(a.name, a.options, at);
      if (a.kind == Kind::hint && !among(idsOf(e_.steps), a.name))
        fault(at + "/hint", fmt::format("unknown step '{}'; {}", a.name, knownInstead(a.name, idsOf(e_.steps))));
    }
  }

  void checkSpoken(const Spoken& text, const std::string& place) {
    if (text.texts.empty()) return;
    for (const auto& [language, other] : e_.title.texts)
      if (!text.texts.contains(language)) fault(place, fmt::format("missing text in '{}'", language));
  }

  void checkQuestions() {
    for (std::size_t i = 0; i < e_.questions.size(); ++i) {
      const auto& choices = e_.questions[i].choices;
      if (choices.empty() != e_.questions[i].number.has_value())
        fault(fmt::format("/questions/{}/choices", i), "a question requires choices, or else a number");
      for (std::size_t k = 0; k < choices.size(); ++k)
        if (std::count(choices.begin(), choices.begin() + static_cast<std::ptrdiff_t>(k), choices[k]) > 0)
          fault(fmt::format("/questions/{}/choices/{}/value", i, k), fmt::format("duplicate '{}'", choices[k]));
      const auto asks = [fact = "answer." + e_.questions[i].id](const Condition& c) { return among(c.facts(), fact); };
      if (std::none_of(e_.steps.begin(), e_.steps.end(), [&](const ExerciseStep& s) { return asks(s.done); }) &&
          std::none_of(e_.rules.begin(), e_.rules.end(), [&](const ExerciseRule& r) { return asks(r.holds); }))
        fault(fmt::format("/questions/{}", i),
              fmt::format("nothing asks for its answer: let a step or a rule use answer.{}", e_.questions[i].id));
    }
  }

  void checkTexts() {
    auto exercise = e_;
    eachText(exercise, [this](const Spoken& text, const std::string& place) { checkSpoken(text, place); });
  }

  const Exercise& e_;
  std::vector<Device> devices_;
  std::vector<std::string> stations_;  // that are put up so far
  std::vector<Error> faults_;
};

// "*" stands for all.
std::vector<std::string> devicesOf(const Exercise& exercise) {
  std::vector<std::string> ids;
  for (const auto& id : exercise.devices)
    for (const auto& device : emulatedDevices())
      if ((id == "*" || id == device.id) && !among(ids, device.id)) ids.emplace_back(device.id);
  return ids;
}

}  // namespace

std::vector<Error> checkExercise(const Exercise& exercise) { return Checker(exercise).check(); }

namespace {

std::string quoted(const std::vector<std::string>& ids) {
  return ids.empty() ? "none" : fmt::format("'{}'", fmt::join(ids, "', '"));
}

// What the outcome is, where it is another than the author expects; with the actions that were refused on the way.
std::string unexpected(const ExpectedOutcome& expect, const Marks& marks, const std::string& refused) {
  std::string text;
  const auto say = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (marks.passed != expect.passed) say(marks.passed ? "it is passed" : whyNotPassed(marks));
  if (expect.score && std::abs(*expect.score - marks.score) > 5e-4)
    say(fmt::format("score {:.4g}, expected {:.4g}", marks.score, *expect.score));
  std::vector<std::string> open;
  for (const auto& step : marks.steps)
    if (!step.done) open.push_back(step.id);
  if (!text.empty() && !open.empty()) say("steps not done: " + quoted(open));
  std::vector<std::string> broken;
  for (const auto& rule : marks.rules)
    if (!rule.held) broken.push_back(rule.id);
  std::sort(broken.begin(), broken.end());
  auto wanted = expect.broken;
  std::sort(wanted.begin(), wanted.end());
  if (!wanted.empty() && broken != wanted)
    say(fmt::format("rules not held: {}, expected: {}", quoted(broken), quoted(wanted)));
  return text.empty() || refused.empty() ? text : text + "; refused: " + refused;
}

}  // namespace

Result<void> checkSolution(const Exercise& exercise, Report& report, Progress& progress) {
  if (exercise.solution.empty()) {
    report.warn(exercise.file + " /solution", "there is no solution to carry out");
    return {};
  }
  for (const auto& device : exercise.devices) {
    TRY_ASSIGN(const auto carried, carryOutSolution(exercise, device, progress));
    TRY_ASSIGN(const auto marks, marksOf(*carried.rehearsal, {}, "en", progress));
    const auto text = unexpected(exercise.expect, marks, carried.refused);
    const auto on_which = exercise.devices.size() > 1 ? fmt::format(" ({})", device) : "";
    if (!text.empty())
      return failure(ErrorKind::unusable, "the solution does not do what is expected of it: " + text,
                     exercise.file + " /solution" + on_which);
  }
  return {};
}

Result<void> checkStart(const Exercise& exercise, Report& report, Progress& progress) {
  for (const auto& device : devicesOf(exercise)) {
    TRY_ASSIGN(const auto folder, ScratchFolder::make());
    TRY_ASSIGN(const auto rehearsal, Rehearsal::start(exercise, device, folder.path(), {}, progress));
    for (std::size_t i = 0; i < exercise.steps.size(); ++i)
      if (exercise.steps[i].done.holds([&](const std::string& name) { return rehearsal->fact(name); }))
        report.warn(
            fmt::format("{} /steps/{}/done", exercise.file, i),
            fmt::format(
                "{}: '{}' is already true at the start: the step completes at once unless an earlier step changes it",
                device, exercise.steps[i].done.text()));
  }
  return {};
}

}  // namespace standpoint
