// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/definition.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/nearest_name.h"

namespace standpoint {

namespace {

const std::vector<std::string> kKinds(std::begin(kWidgetKindNames), std::end(kWidgetKindNames));

WidgetKind kindOf(JsonFields& fields) {
  const auto word = fields.wordOf("kind", kKinds);
  const auto found = std::find(kKinds.begin(), kKinds.end(), word);
  return found == kKinds.end() ? WidgetKind::readout : static_cast<WidgetKind>(found - kKinds.begin());
}

void readEffect(JsonFields& f, WidgetEffect& effect) {
  effect.does = f.textOr("does", "");
  effect.event = f.textOr("event", "");
  effect.go = f.textOr("go", "");
}

// "gestures": {"hold": {"event": "power_held", "words": "held_power"}}
void readGestures(JsonFields& f, WidgetRow& w) {
  f.object("gestures", [&](JsonFields& gestures) {
    for (int i = 1; i < static_cast<int>(std::size(kGestureNames)); ++i)
      gestures.object(kGestureNames[i], [&](JsonFields& one) {
        GestureEffect effect;
        readEffect(one, effect);
        effect.words = one.text("words");
        if (effect.empty()) one.wrong("", "a gesture must have does, event or go");
        if (w.kind != WidgetKind::plan && static_cast<Gesture>(i) != Gesture::hold)
          one.wrong("", "only a plan takes this gesture; another widget can be held");
        w.gestures[static_cast<Gesture>(i)] = std::move(effect);
      });
  });
}

WidgetRow widgetRow(JsonFields& f) {
  WidgetRow w;
  w.id = f.text("id");
  w.kind = kindOf(f);
  w.setting = f.textOr("setting", "");
  w.possible_only = f.flagOr("possible_only", false);
  w.value = f.textOr("value", "");
  w.list = f.textOr("list", "");
  w.shows = f.textOr("shows", "");
  readEffect(f, w);
  readGestures(f, w);
  w.when = conditionAt(f, "when");
  w.enabled = conditionAt(f, "enabled");
  w.warns = conditionAt(f, "warns");
  w.why_not = f.textOr("why_not", "");
  w.words = f.textOr("words", w.id);
  w.minimum = f.numberOr("minimum", w.minimum, -1e9, 1e9);
  w.maximum = f.numberOr("maximum", w.maximum, w.minimum, 1e9);
  w.source = f.text("source");
  const int bound =
      static_cast<int>(!w.setting.empty()) + static_cast<int>(!w.value.empty()) + static_cast<int>(!w.list.empty());
  if (bound > 1) f.wrong("id", "a widget must have exactly one of setting, value and list");
  if (w.kind == WidgetKind::list && w.list.empty()) f.wrong("list", "specify what the list contains");
  return w;
}

void readBody(JsonFields& root, BodyRow& body) {
  const auto* raw = root.required("body");
  if (raw == nullptr) return;
  JsonFields f(root.fault(), *raw, root.pointer("body"));
  body.battery_s = f.number("battery_s", 60, 1e6);
  body.battery_warning = f.numberOr("battery_warning", 0.1, 0, 1);
  body.battery_critical = f.numberOr("battery_critical", 0.03, 0, 1);
  body.card_inside = f.flagOr("card_inside", false);
  body.card_bytes = f.number("card_bytes", 1e6, 1e15);
  body.bytes_per_point = f.number("bytes_per_point", 1, 200);
  body.coldest_c = f.number("coldest_c", -60, 60);
  body.hottest_c = f.number("hottest_c", body.coldest_c, 90);
  body.warm_up_s = f.number("warm_up_s", 0, 7200);
  body.tilt_full_deg = f.number("tilt_full_deg", 0, 90);
  body.tilt_limit_deg = f.number("tilt_limit_deg", body.tilt_full_deg, 90);
  f.object("sleeps", [&](JsonFields& sleeps) {
    body.sleeps_by = sleeps.text("value");
    sleeps.object("minutes", [&](JsonFields& minutes) {
      for (const auto& choice : minutes.keys()) body.sleeps_after_min[choice] = minutes.number(choice, 0, 1440);
    });
  });
  f.skip("sources");
  f.close();
}

// "walk": {"reminders_min": [45, 60], "rest_s": 10}
void readWalk(JsonFields& f, WalkRow& walk) {
  walk.rest_s = f.numberOr("rest_s", 0, 0, 3600);
  if (const auto* times = f.raw("reminders_min"); times != nullptr) {
    if (!times->is_array()) return f.wrong("reminders_min", "must be a list of minutes, such as [45, 60]");
    for (std::size_t i = 0; i < times->size(); ++i)
      walk.reminders_min.push_back(
          numberAt(f.fault(), (*times)[i], fmt::format("{}/{}", f.pointer("reminders_min"), i), 0.1, 1440));
  }
  f.skip("sources");
}

PhaseRow phaseRow(JsonFields& f) {
  PhaseRow p;
  p.id = f.text("id");
  p.screen = f.textOr("screen", "");
  if (const auto* lasts = f.raw("lasts"); lasts != nullptr && lasts->is_number())
    p.lasts_s = f.number("lasts", 0, 86400);
  else
    p.lasts_fact = f.textOr("lasts", "");
  p.lamp = f.textOr("lamp", "off");
  p.on = f.flagOr("on", true);
  p.laser = f.flagOr("laser", false);
  p.waits = f.flagOr("waits", false);
  p.source = f.text("source");
  return p;
}

ValueRow valueRow(JsonFields& f) {
  ValueRow v;
  v.id = f.text("id");
  v.kind = kindOf(f);
  v.choices = f.texts("choices");
  v.unit = f.textOr("unit", "");
  v.source = f.text("source");
  v.kept = f.flagOr("kept", true);
  if (v.kind == WidgetKind::toggle) v.choices = {"on", "off"};
  if (v.kind == WidgetKind::number) {
    v.minimum = f.number("minimum", -1e9, 1e9);
    v.maximum = f.number("maximum", v.minimum, 1e9);
    v.default_value = fmt::format("{}", f.number("standard", v.minimum, v.maximum));
    return v;
  }
  v.default_value = f.textOr("standard", "");
  if (v.kind != WidgetKind::text && std::find(v.choices.begin(), v.choices.end(), v.default_value) == v.choices.end()) {
    f.wrong("standard", fmt::format("'{}' is not one of the choices", v.default_value));
  }
  if (v.kind != WidgetKind::choice && v.kind != WidgetKind::toggle && v.kind != WidgetKind::text)
    f.wrong("kind", "a value must be a choice, toggle, text or number");
  return v;
}

SensorRow sensorRow(JsonFields& f) {
  SensorRow s;
  s.id = f.wordOf("id", {"compass", "altimeter", "gps"});
  s.value = f.textOr("value", "");
  s.sigma = f.number("sigma", 1e-3, 1000);
  s.source = f.text("source");
  return s;
}

SoundRow soundRow(JsonFields& f) {
  SoundRow s;
  s.id = f.text("id");
  s.on = f.texts("on");
  s.source = f.text("source");
  if (s.on.empty()) f.wrong("on", "name at least one event, such as \"pressed\" or \"phase.booting\"");
  const std::string shape = "tones must be a list of [hertz, milliseconds], such as [[880, 120], [0, 60], [880, 120]]";
  const auto* tones = f.required("tones");
  if (tones == nullptr) return s;
  if (!tones->is_array() || tones->empty()) {
    f.wrong("tones", shape);
    return s;
  }
  double all_ms = 0;
  for (std::size_t i = 0; i < tones->size(); ++i) {
    const auto& tone = (*tones)[i];
    const auto place = fmt::format("{}/{}", f.pointer("tones"), i);
    if (!tone.is_array() || tone.size() != 2) {
      f.fault().say(place, shape);
      return s;
    }
    s.tones.push_back({numberAt(f.fault(), tone[0], place + "/0", 0, 12000),
                       numberAt(f.fault(), tone[1], place + "/1", 1, kLongestSound_ms)});
    all_ms += s.tones.back().milliseconds;
  }
  if (all_ms > kLongestSound_ms) f.wrong("tones", fmt::format("longer than {:.0f} ms in all", kLongestSound_ms));
  return s;
}

SkinRow skinRow(JsonFields& f) {
  SkinRow s;
  const std::pair<const char*, std::uint32_t*> colours[] = {{"body", &s.body},
                                                            {"body_edge", &s.body_edge},
                                                            {"display", &s.display},
                                                            {"title_bar", &s.title_bar},
                                                            {"title_text", &s.title_text},
                                                            {"tile", &s.tile},
                                                            {"tile_hover", &s.tile_hover},
                                                            {"tile_text", &s.tile_text},
                                                            {"accent", &s.accent},
                                                            {"accent_text", &s.accent_text},
                                                            {"key", &s.key},
                                                            {"text", &s.text},
                                                            {"dim", &s.dim},
                                                            {"line", &s.line},
                                                            {"key_text", &s.key_text},
                                                            {"warning", &s.warning},
                                                            {"off", &s.off}};
  for (const auto& [key, colour] : colours) *colour = f.colourOr(key, *colour);
  s.rounding = f.numberOr("rounding", s.rounding, 0, 2);
  return s;
}

// --- what all devices share, by the names of this one ---

// The names of phases that the file has; what it does not have is a fault.
class PhaseNames {
 public:
  explicit PhaseNames(const std::vector<PhaseRow>& phases) {
    for (const auto& phase : phases) names_.push_back(phase.id);
  }

  PhaseId one(JsonFields& f, const char* key) const {
    auto name = f.textOr(key, "");
    if (!name.empty()) check(f, key, name);
    return {std::move(name)};
  }
  Phases several(JsonFields& f, const char* key) const {
    Phases phases;
    for (auto& name : f.texts(key)) {
      if (name != kAnyPhase.name) check(f, key, name);
      phases.push_back({std::move(name)});
    }
    return phases;
  }

 private:
  void check(JsonFields& f, const char* key, const std::string& name) const {
    if (std::find(names_.begin(), names_.end(), name) == names_.end())
      f.wrong(key, fmt::format("unknown phase '{}'; {}", name, knownInstead(name, names_)));
  }

  std::vector<std::string> names_;
};

DeviceEffect effectOf(JsonFields& f, const char* key) {
  std::vector<std::string> names = {""};
  for (const auto& row : namedEffects()) names.emplace_back(row.name);
  const auto name = f.has(key) ? f.wordOf(key, names) : std::string();
  for (const auto& row : namedEffects())
    if (name == row.name) return row.effect;
  return nullptr;
}

Transition transitionRow(JsonFields& f, const PhaseNames& phases) {
  Transition t{.event = f.text("event")};
  t.from = phases.several(f, "from");
  t.guard = conditionAt(f, "guard").text();
  t.to = phases.one(f, "to");
  t.show = f.textOr("show", "");
  t.ask = f.textOr("ask", "");
  t.effect = effectOf(f, "effect");
  t.source = f.text("source");
  if (t.from.empty()) f.wrong("from", "must have at least one phase, or \"*\" for any with power");
  return t;
}

// A part that a file does not name stays as it is; null: the device has nothing of that kind.
void readRoles(JsonFields& f, const PhaseNames& names, DeviceRoles& r) {
  const auto phases = [&](const char* key, Phases& into) {
    if (f.has(key)) into = names.several(f, key);
  };
  const auto phase = [&](const char* key, PhaseId& into) {
    if (f.has(key)) into = names.one(f, key);
  };
  const auto text = [&](const char* key, std::optional<std::string>& into) {
    if (f.isNull(key))
      into.reset();
    else if (f.has(key))
      into = f.text(key);
  };
  if (f.isNull("off"))
    r.off.reset();
  else if (f.has("off"))
    r.off = names.one(f, "off");
  if (f.has("kept")) r.kept = names.one(f, "kept");
  phase("ready", r.ready);
  phase("first", r.first);
  phases("rest", r.rest);
  phases("idle", r.idle);
  phases("working", r.working);
  phases("measuring", r.measuring);
  phases("laser", r.laser);
  phases("camera", r.camera);
  phases("holding", r.holding);
  std::optional<std::string> home = r.home;
  text("home", home);
  r.home = home.value_or("");
  text("scans", r.scans);
  text("targets", r.targets);
  text("tools", r.tools);
  r.start = f.textOr("start", r.start);
  r.start_anyway = f.textOr("start_anyway", r.start_anyway);
  f.list("first_questions", [&](JsonFields& t) { r.first_questions.push_back(transitionRow(t, names)); });
  f.list("last_questions", [&](JsonFields& t) { r.last_questions.push_back(transitionRow(t, names)); });
  if (f.has("tilted")) r.tilted = conditionAt(f, "tilted").text();
  if (f.has("near")) r.near = conditionAt(f, "near").text();
  text("card_needed", r.card_needed);
  r.links = f.flagOr("links", r.links);
  f.object("marks", [&](JsonFields& marks) {
    for (const auto& source : marks.keys()) r.marks.push_back({source, marks.texts(source)});
  });
}

template <class Row>
void refuseTwins(JsonFault& fault, const std::vector<Row>& rows, const std::string& pointer) {
  std::set<std::string> ids;
  for (const auto& row : rows)
    if (!ids.insert(row.id).second) fault.say(pointer, fmt::format("duplicate '{}'", row.id));
}

template <class Row>
const Row* rowOf(const std::vector<Row>& rows, const std::string& id) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.id == id; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

Result<DeviceDefinition> readDefinition(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(nameWithFolder(file));
  JsonFields root(fault, json, "");
  DeviceDefinition d;
  d.id = root.text("id");
  d.title = root.text("title");
  d.instruments = root.texts("instruments");
  d.about = root.text("about");
  readBody(root, d.body);
  root.object("walk", [&](JsonFields& f) { readWalk(f, d.walk); });
  root.list("phases", [&](JsonFields& f) { d.phases.push_back(phaseRow(f)); });
  root.list("values", [&](JsonFields& f) { d.values.push_back(valueRow(f)); });
  root.list("sensors", [&](JsonFields& f) { d.sensors.push_back(sensorRow(f)); });
  root.list("keys", [&](JsonFields& f) { d.keys.push_back(widgetRow(f)); });
  root.list("screens", [&](JsonFields& f) {
    ScreenRow s;
    s.id = f.text("id");
    s.entry = f.flagOr("entry", false);
    f.list("widgets", [&](JsonFields& w) { s.widgets.push_back(widgetRow(w)); });
    refuseTwins(fault, s.widgets, f.pointer() + "/widgets");
    d.screens.push_back(std::move(s));
  });
  root.list("dialogs", [&](JsonFields& f) {
    DialogRow dialog{f.text("id"), {}};
    f.list("buttons", [&](JsonFields& b) { dialog.buttons.push_back({b.text("id"), b.textOr("event", "")}); });
    if (dialog.buttons.empty()) dialog.buttons.push_back({"ok", ""});
    d.dialogs.push_back(std::move(dialog));
  });
  root.object("skin", [&](JsonFields& f) { d.skin = skinRow(f); });
  root.object("sounds", [&](JsonFields& f) {
    d.sounds.when = conditionAt(f, "when");
    f.list("rows", [&](JsonFields& row) { d.sounds.rows.push_back(soundRow(row)); });
    refuseTwins(fault, d.sounds.rows, f.pointer("rows"));
  });
  root.object("scan", [&](JsonFields& f) {
    d.scan.name = f.textOr("name", d.scan.name);
    d.scan.project_base = f.flagOr("project_base", false);
    d.scan.levelled = conditionAt(f, "levelled");
    const auto facts = d.scan.levelled.facts();
    if (std::find(facts.begin(), facts.end(), "levelled") != facts.end())
      f.wrong("levelled", "'levelled' is what this condition says: it cannot ask for itself");
  });
  const PhaseNames phases(d.phases);
  root.list("transitions", [&](JsonFields& f) { d.transitions.push_back(transitionRow(f, phases)); });
  root.object("roles", [&](JsonFields& f) { readRoles(f, phases, d.roles.emplace()); });
  root.close();
  if (d.phases.empty()) fault.say("/phases", "a device must have at least one phase");
  if (d.instruments.empty()) fault.say("/instruments", "a device must drive at least one scanner");
  refuseTwins(fault, d.phases, "/phases");
  refuseTwins(fault, d.values, "/values");
  refuseTwins(fault, d.screens, "/screens");
  refuseTwins(fault, d.dialogs, "/dialogs");
  refuseTwins(fault, d.keys, "/keys");
  refuseTwins(fault, d.sensors, "/sensors");
  TRY(fault.result());
  return d;
}

std::set<std::string> eventsSent(const DeviceDefinition& d) {
  std::set<std::string> sent;
  const auto take = [&](const WidgetRow& w) {
    sent.insert(w.event);
    for (const auto& [gesture, effect] : w.gestures) sent.insert(effect.event);
  };
  for (const auto& screen : d.screens)
    for (const auto& w : screen.widgets) take(w);
  for (const auto& key : d.keys) take(key);
  for (const auto& dialog : d.dialogs)
    for (const auto& button : dialog.buttons) sent.insert(button.event);
  sent.erase("");
  return sent;
}

const ScreenRow* findScreen(const DeviceDefinition& d, const std::string& id) { return rowOf(d.screens, id); }
const PhaseRow* findPhase(const DeviceDefinition& d, const std::string& id) { return rowOf(d.phases, id); }
const ValueRow* findValue(const DeviceDefinition& d, const std::string& id) { return rowOf(d.values, id); }
const DialogRow* findDialog(const DeviceDefinition& d, const std::string& id) { return rowOf(d.dialogs, id); }

}  // namespace standpoint
