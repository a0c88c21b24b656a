// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;

class Checker {
 public:
  explicit Checker(const Exercise& exercise) : e_(exercise) {}

  std::vector<Error> check() {
    checkDevices();
    if (devices_.empty()) return std::move(faults_);
    if (std::error_code error; std::filesystem::path(e_.model).has_parent_path() || !std::filesystem::is_regular_file(samplesFolder() / (e_.model + ".ifc"), error))
      fault("/model", fmt::format("there is no sample '{}'", e_.model));
    checkTexts();
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
      if (!e_.rules[i].proof.empty() && !domain(e_.rules[i].proof, devices_.front())) fault(place + "/proof", fmt::format("there is no fact '{}'", e_.rules[i].proof));
    }
    for (std::size_t i = 0; i < e_.events.size(); ++i) {
      checkCondition(e_.events[i].when, fmt::format("/events/{}/when", i));
      checkTrouble(e_.events[i].trouble, fmt::format("/events/{}/trouble", i));
    }
    for (std::size_t i = 0; i < e_.troubles.size(); ++i) checkTrouble(e_.troubles[i], fmt::format("/troubles/{}", i));
    checkActions(e_.start, "/start");
    checkActions(e_.solution, "/solution");
    return std::move(faults_);
  }

 private:
  void fault(const std::string& place, const std::string& message) { faults_.push_back({ErrorKind::unusable, message, e_.id + " " + place}); }

  void checkDevices() {
    for (std::size_t i = 0; i < e_.devices.size(); ++i) {
      const auto place = fmt::format("/devices/{}", i);
      if (e_.devices[i] == "*") {
        for (const auto& device : emulatedDevices()) load(device, place);
        continue;
      }
      if (const auto* device = findDevice(e_.devices[i])) load(*device, place);
      else fault(place, fmt::format("there is no device '{}'", e_.devices[i]));
    }
  }
  void load(const EmulatedDevice& device, const std::string& place) {
    auto type = loadDevice(device, e_.instrument);
    if (type) devices_.emplace_back(*type);
    else fault(place, describe(type.error()));
  }

  std::optional<FactDomain> domain(const std::string& name, const Device& device) const {
    auto own = rehearsalDomain(e_, name);
    return own ? own : device.domain(name);
  }

  // It must be possible on each device of the exercise.
  void checkCondition(const Condition& condition, const std::string& place) {
    for (const auto& device : devices_)
      if (auto ok = condition.check([&](const std::string& name) { return domain(name, device); }); !ok)
        return fault(place, fmt::format("{}: {}", device.type().definition.id, ok.error().message));
  }

  // A screen that shows every setting has a widget for each: "setting.resolution".
  static bool isSetting(const std::string& id, const Device& device) { return id.starts_with("setting.") && device.domain(id).has_value(); }

  void checkWidget(const std::string& id, const std::string& place) {
    for (const auto& device : devices_) {
      const auto& d = device.type().definition;
      bool found = std::any_of(d.keys.begin(), d.keys.end(), [&](const WidgetRow& w) { return w.id == id; });
      for (const auto& screen : d.screens)
        found = found || std::any_of(screen.widgets.begin(), screen.widgets.end(), [&](const WidgetRow& w) { return w.id == id || (w.setting == "*" && isSetting(id, device)); });
      for (const auto& dialog : d.dialogs)
        found = found || std::any_of(dialog.buttons.begin(), dialog.buttons.end(), [&](const DialogButton& b) { return b.id == id; });
      if (!found) return fault(place, fmt::format("{} has no widget '{}'", d.id, id));
    }
  }

  template <class Rows>
  void checkIds(const Rows& rows, const char* list) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!seen.insert(rows[i].id).second) fault(fmt::format("/{}/{}", list, i), fmt::format("'{}' is there before", rows[i].id));
  }

  void checkAnswer(const RehearsalAction& action, const std::string& place) {
    const auto question = std::find_if(e_.questions.begin(), e_.questions.end(), [&](const ExerciseQuestion& q) { return q.id == action.name; });
    if (question == e_.questions.end()) return fault(place, fmt::format("there is no question '{}'", action.name));
    if (std::find(question->choices.begin(), question->choices.end(), action.value) == question->choices.end())
      fault(place, fmt::format("'{}' is not one of {}", action.value, fmt::join(question->choices, ", ")));
  }

  void checkTrouble(const std::string& id, const std::string& place) {
    const auto& rows = troubleRows();
    if (std::none_of(rows.begin(), rows.end(), [&](const TroubleRow& row) { return id == row.id; })) fault(place, fmt::format("there is no trouble '{}'", id));
  }

  void checkActions(const std::vector<RehearsalAction>& actions, const std::string& place) {
    for (std::size_t i = 0; i < actions.size(); ++i) {
      const auto& a = actions[i];
      const auto at = fmt::format("{}/{}", place, i);
      if (a.kind == Kind::press && devices_.size() == 1) checkWidget(a.name, at);
      if (a.kind == Kind::answer) checkAnswer(a, at);
      const auto& hands = handRows();
      if (a.kind == Kind::hand && std::none_of(hands.begin(), hands.end(), [&](const HandRow& row) { return a.name == row.id; }))
        fault(at, fmt::format("hands know no '{}'", a.name));
    }
  }

  void checkSpoken(const Spoken& text, const std::string& place) {
    if (text.texts.empty()) return;
    for (const auto& [language, other] : e_.title.texts)
      if (!text.texts.contains(language)) fault(place, fmt::format("it has no text in '{}'", language));
  }

  void checkTexts() {
    checkSpoken(e_.goal, "/goal");
    for (std::size_t i = 0; i < e_.steps.size(); ++i) {
      checkSpoken(e_.steps[i].text, fmt::format("/steps/{}/text", i));
      checkSpoken(e_.steps[i].hint, fmt::format("/steps/{}/hint", i));
    }
    for (std::size_t i = 0; i < e_.rules.size(); ++i) {
      checkSpoken(e_.rules[i].text, fmt::format("/rules/{}/text", i));
      checkSpoken(e_.rules[i].because, fmt::format("/rules/{}/because", i));
    }
    for (std::size_t i = 0; i < e_.questions.size(); ++i) {
      checkSpoken(e_.questions[i].text, fmt::format("/questions/{}/text", i));
      for (std::size_t k = 0; k < e_.questions[i].choice_texts.size(); ++k)
        checkSpoken(e_.questions[i].choice_texts[k], fmt::format("/questions/{}/choices/{}/text", i, k));
    }
  }

  const Exercise& e_;
  std::vector<Device> devices_;
  std::vector<Error> faults_;
};

}  // namespace

std::vector<Error> checkExercise(const Exercise& exercise) { return Checker(exercise).check(); }

}  // namespace standpoint
