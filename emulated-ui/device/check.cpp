// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/check.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include <fmt/format.h>

namespace standpoint {

namespace {

// What every device has to know, whatever it answers.
const std::set<std::string> kOwnDialogs = {"refused", "failed"};

using Graph = std::map<std::string, std::set<std::string>>;

std::set<std::string> reached(const Graph& graph, const std::set<std::string>& from) {
  std::set<std::string> seen = from;
  std::vector<std::string> open(from.begin(), from.end());
  while (!open.empty()) {
    const auto at = open.back();
    open.pop_back();
    if (const auto next = graph.find(at); next != graph.end())
      for (const auto& to : next->second)
        if (seen.insert(to).second) open.push_back(to);
  }
  return seen;
}

Graph turned(const Graph& graph) {
  Graph other;
  for (const auto& [from, tos] : graph)
    for (const auto& to : tos) other[to].insert(from);
  return other;
}

std::string listed(const Phases& phases) {
  std::string text;
  for (const auto& phase : phases) text += (text.empty() ? "" : " ") + phase.name;
  return text;
}

// "Low (12 mm @ 10 m)" has a word to translate; "1/4", "3x" and "6 mm @ 10 m" have none.
bool hasWord(const std::string& text) {
  int letters = 0;
  for (const char c : text) {
    letters = std::isalpha(static_cast<unsigned char>(c)) != 0 ? letters + 1 : 0;
    if (letters >= 4) return true;
  }
  return false;
}

class Checker {
 public:
  explicit Checker(const DeviceType& type)
      : type_(type),
        device_(std::make_shared<const DeviceType>(type)),
        lookup_([this](const std::string& name) { return device_.domain(name); }) {}

  std::vector<Error> structure() {
    collectEvents();
    for (const auto& screen : d().screens) checkScreen(screen);
    for (const auto& key : d().keys) checkWidget(key, "/keys/" + key.id);
    checkBody();
    checkTransitions();
    checkPhases();
    checkDialogs();
    checkSounds();
    checkReach();
    return std::move(faults_);
  }
  std::vector<Error> words() {
    checkWords();
    return std::move(faults_);
  }

 private:
  const DeviceDefinition& d() const { return type_.definition; }
  // With the place in the device's file, or the transition, which may be one of the code.
  void fault(const std::string& place, const std::string& message) {
    faults_.push_back({ErrorKind::unusable, message, d().id + (place.front() == '/' ? "/device.json " : " ") + place});
  }

  void collectEvents() {
    for (const auto& t : type_.program.transitions) known_.insert(t.event.name);
    sent_ = eventsSent(d());
  }

  void checkCondition(const Condition& condition, const std::string& place) {
    if (auto ok = condition.check(lookup_); !ok) fault(place, ok.error().message);
  }

  template <class Rows>
  static bool hasName(const Rows& rows, const std::string& name) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return name == row.name; });
  }

  void checkEffect(const WidgetEffect& effect, const std::string& place) {
    if (!effect.does.empty() && !hasName(type_.program.actions, effect.does) && !hasName(sharedActions(), effect.does))
      fault(place + "/does", fmt::format("unknown action '{}'", effect.does));
    if (!effect.event.empty() && !known_.contains(effect.event))
      fault(place + "/event", fmt::format("no phase handles the event '{}'", effect.event));
    if (!effect.go.empty() && effect.go != "back" && findScreen(d(), effect.go) == nullptr)
      fault(place + "/go", fmt::format("unknown screen '{}'", effect.go));
  }

  void checkWidget(const WidgetRow& w, const std::string& place) {
    checkCondition(w.when, place + "/when");
    checkCondition(w.enabled, place + "/enabled");
    checkCondition(w.warns, place + "/warns");
    const auto& settings = type_.instrument.settings;
    if (!w.setting.empty() &&
        std::none_of(settings.begin(), settings.end(), [&](const auto& s) { return s.key == w.setting; }) &&
        d().instruments.size() == 1)
      fault(place + "/setting", fmt::format("unknown scanner setting '{}'", w.setting));
    if (!w.value.empty() && findValue(d(), w.value) == nullptr)
      fault(place + "/value", fmt::format("unknown value '{}'", w.value));
    if (!w.list.empty() && !hasName(type_.program.lists, w.list) && !hasName(sharedLists(), w.list))
      fault(place + "/list", fmt::format("unknown list '{}'", w.list));
    checkEffect(w, place);
    for (const auto& [gesture, effect] : w.gestures) checkEffect(effect, place + "/gestures/" + nameOf(gesture));
    if (w.gestures.contains(Gesture::lay) && type_.program.laid == nullptr)
      fault(place + "/gestures/lay", "this device has no cloud that can be laid by hand");
    if (w.shows.find('{') == std::string::npos && !w.shows.empty() && !device_.domain(w.shows))
      fault(place + "/shows", fmt::format("unknown fact '{}'", w.shows));
    for (auto open = w.shows.find('{'); open != std::string::npos; open = w.shows.find('{', open + 1)) {
      const auto name = w.shows.substr(open + 1, w.shows.find('}', open) - open - 1);
      if (!device_.domain(name)) fault(place + "/shows", fmt::format("unknown fact '{}'", name));
    }
    const bool can_be_grey = !w.enabled.empty() || !w.warns.empty();
    if (can_be_grey && w.why_not.empty()) fault(place + "/why_not", "can be disabled or warn without giving a reason");
    if ((w.kind == WidgetKind::button || w.kind == WidgetKind::key) && w.empty()) fault(place, "has no effect");
  }

  void checkScreen(const ScreenRow& screen) {
    for (const auto& w : screen.widgets) checkWidget(w, "/screens/" + screen.id + "/" + w.id);
  }

  void checkTransitions() {
    for (std::size_t i = 0; i < type_.program.transitions.size(); ++i) {
      const auto& t = type_.program.transitions[i];
      const auto place = fmt::format("transition {} of '{}'", t.event.name, listed(t.from));
      checkCondition(type_.guards[i], place);
      for (const auto& from : t.from)
        if (from != kAnyPhase) checkPhase(from, place);
      if (!t.to.name.empty()) checkPhase(t.to, place);
      if (!t.show.empty() && findScreen(d(), t.show) == nullptr)
        fault(place, fmt::format("unknown screen '{}'", t.show));
      if (!t.ask.empty() && findDialog(d(), t.ask) == nullptr) fault(place, fmt::format("unknown dialog '{}'", t.ask));
      if (!sent_.contains(t.event.name) && !t.event.isOfEngine()) fault(place, "this event is never sent");
    }
  }
  void checkPhase(const PhaseId& phase, const std::string& place) {
    if (findPhase(d(), phase.name) == nullptr) fault(place, fmt::format("unknown phase '{}'", phase.name));
  }

  void checkBody() {
    const auto& body = d().body;
    if (!d().scan.levelled.empty()) checkCondition(d().scan.levelled, "/scan/levelled");
    if (body.sleeps_by.empty()) return;
    const auto* value = findValue(d(), body.sleeps_by);
    if (value == nullptr) return fault("/body/sleeps/value", fmt::format("unknown value '{}'", body.sleeps_by));
    for (const auto& [choice, minutes] : body.sleeps_after_min)
      if (std::find(value->choices.begin(), value->choices.end(), choice) == value->choices.end())
        fault("/body/sleeps/minutes", fmt::format("'{}' is not a choice of '{}'", choice, body.sleeps_by));
  }

  // A number of the file or of the scanner, or a fact in seconds, but not what depends on the phase's own time.
  bool isTime(const std::string& lasts) const {
    const auto domain = device_.domain(lasts);
    if (!domain || !domain->is_number) return false;
    for (const auto* rows : {&type_.program.facts, &sharedFacts()})
      for (const auto& row : *rows)
        if (lasts == row.name) return row.unit == FactUnit::seconds && lasts != "phase.lasts";
    return true;
  }

  void checkPhases() {
    Graph graph;
    for (const auto& t : type_.program.transitions) {
      if (t.to.name.empty()) continue;
      for (const auto& from : t.from)
        for (const auto& phase : d().phases)
          if (from.name == phase.id || (from == kAnyPhase && phase.on)) graph[phase.id].insert(t.to.name);
    }
    const std::string first = d().phases.front().id;
    const auto forth = reached(graph, {first});
    const auto back = reached(turned(graph), {first});
    for (const auto& phase : d().phases) {
      if (!forth.contains(phase.id)) fault("/phases/" + phase.id, "this phase cannot be reached");
      if (!back.contains(phase.id))
        fault("/phases/" + phase.id, fmt::format("'{}' cannot be reached from this phase", first));
      if (!phase.screen.empty() && findScreen(d(), phase.screen) == nullptr)
        fault("/phases/" + phase.id + "/screen", fmt::format("unknown screen '{}'", phase.screen));
      if (!phase.lasts_fact.empty() && !isTime(phase.lasts_fact))
        fault("/phases/" + phase.id + "/lasts", fmt::format("'{}' is not a duration in seconds", phase.lasts_fact));
      const bool ended =
          std::any_of(type_.program.transitions.begin(), type_.program.transitions.end(), [&](const Transition& t) {
            return t.event == EngineEvent::elapsed &&
                   std::find(t.from.begin(), t.from.end(), PhaseId{phase.id}) != t.from.end();
          });
      if (phase.ends() && !ended) fault("/phases/" + phase.id, "has a duration, but no transition when it ends");
    }
  }

  void checkDialogs() {
    for (const auto& id : kOwnDialogs)
      if (findDialog(d(), id) == nullptr) fault("/dialogs", fmt::format("missing dialog '{}'", id));
    std::set<std::string> asked = kOwnDialogs;
    for (const auto& t : type_.program.transitions) asked.insert(t.ask);
    for (const auto& dialog : d().dialogs) {
      if (!asked.contains(dialog.id)) fault("/dialogs/" + dialog.id, "this dialog is never opened");
      for (const auto& b : dialog.buttons)
        if (!b.event.empty() && !known_.contains(b.event))
          fault("/dialogs/" + dialog.id + "/" + b.id, fmt::format("no phase handles the event '{}'", b.event));
    }
  }

  void checkSounds() {
    checkCondition(d().sounds.when, "/sounds/when");
    for (const auto& row : d().sounds.rows)
      for (const auto& event : row.on)
        if (const auto wrong = unheardOf(d(), event); !wrong.empty()) fault("/sounds/rows/" + row.id + "/on", wrong);
  }

  // A screen is left by a widget that goes elsewhere or sends an event, or by the phase that shows it.
  void checkReach() {
    Graph graph;
    std::set<std::string> from;
    std::set<std::string> of_phases;
    for (const auto& phase : d().phases)
      if (!phase.screen.empty()) from.insert(phase.screen), of_phases.insert(phase.screen);
    for (const auto& t : type_.program.transitions)
      if (!t.show.empty()) from.insert(t.show);
    for (const auto& screen : d().screens) {
      bool can_leave = of_phases.contains(screen.id);
      for (const auto& w : screen.widgets) {
        can_leave = can_leave || !w.go.empty() || !w.event.empty();
        if (!w.go.empty() && w.go != "back") graph[screen.id].insert(w.go);
        for (const auto& [gesture, effect] : w.gestures)
          if (!effect.go.empty() && effect.go != "back") graph[screen.id].insert(effect.go);
      }
      if (!can_leave) fault("/screens/" + screen.id, "this screen has no exit");
    }
    const auto seen = reached(graph, from);
    for (const auto& screen : d().screens)
      if (!seen.contains(screen.id)) fault("/screens/" + screen.id, "this screen cannot be reached");
  }

  void needWord(const std::string& key, const std::string& place) {
    for (const auto& language : type_.words->languages())
      if (!type_.words->has(d().id, key, language))
        fault(place, fmt::format("'{}' has no text in '{}'", key, language));
  }

  void checkWidgetWords(const WidgetRow& w, const std::string& place) {
    const bool spelled_out = d().instruments.front() == "*" && !w.setting.empty();
    if (spelled_out) return;
    needWord(w.words, place);
    needWord(w.words + "?", place);
    if (!w.why_not.empty()) needWord(w.why_not, place);
    for (const auto& [gesture, effect] : w.gestures) needWord(effect.words, place + "/gestures/" + nameOf(gesture));
    for (const auto& setting : type_.instrument.settings)
      if (setting.key == w.setting)
        for (const auto& choice : setting.choices)
          if (hasWord(choice.label)) needWord(setting.key + "=" + choice.value, place);
    if (const auto* value = w.value.empty() ? nullptr : findValue(d(), w.value);
        value != nullptr && w.value != "language")
      for (const auto& choice : value->choices)
        if (hasWord(choice)) needWord(value->kind == WidgetKind::toggle ? choice : value->id + "=" + choice, place);
  }

  void checkWords() {
    for (const auto& screen : d().screens) {
      needWord(screen.id, "/screens/" + screen.id);
      for (const auto& w : screen.widgets) checkWidgetWords(w, "/screens/" + screen.id + "/" + w.id);
    }
    for (const auto& w : d().keys) checkWidgetWords(w, "/keys/" + w.id);
    for (const auto& dialog : d().dialogs) {
      needWord("dialog." + dialog.id, "/dialogs/" + dialog.id);
      for (const auto& b : dialog.buttons) needWord(b.id, "/dialogs/" + dialog.id + "/" + b.id);
    }
  }

  const DeviceType& type_;
  Device device_;
  DomainLookup lookup_;
  std::vector<Error> faults_;
  std::set<std::string> known_, sent_;
};

}  // namespace

std::vector<Error> checkStructure(const DeviceType& type) { return Checker(type).structure(); }

std::vector<Error> checkDevice(const DeviceType& type) {
  auto faults = checkStructure(type);
  for (auto& fault : Checker(type).words()) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace standpoint
