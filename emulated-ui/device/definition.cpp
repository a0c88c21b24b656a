// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/definition.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "core/json_file.h"
#include "emulated-ui/device/json_fields.h"
#include "emulated-ui/device/numbers.h"

namespace standpoint {

namespace {

const std::vector<std::string> kKinds(std::begin(kWidgetKindNames), std::end(kWidgetKindNames));

WidgetKind kindOf(JsonFields& fields) {
  const auto word = fields.wordOf("kind", kKinds);
  const auto found = std::find(kKinds.begin(), kKinds.end(), word);
  return found == kKinds.end() ? WidgetKind::readout : static_cast<WidgetKind>(found - kKinds.begin());
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
  w.does = f.textOr("does", "");
  w.event = f.textOr("event", "");
  w.go = f.textOr("go", "");
  w.when = f.condition("when");
  w.enabled = f.condition("enabled");
  w.warns = f.condition("warns");
  w.why_not = f.textOr("why_not", "");
  w.words = f.textOr("words", w.id);
  w.source = f.text("source");
  const int bound =
      static_cast<int>(!w.setting.empty()) + static_cast<int>(!w.value.empty()) + static_cast<int>(!w.list.empty());
  if (bound > 1) f.wrong("id", "a widget must have exactly one of setting, value and list");
  if (w.kind == WidgetKind::list && w.list.empty()) f.wrong("list", "specify what the list contains");
  return w;
}

void readBody(JsonFields& root, BodyRow& body) {
  const auto* raw = root.raw("body");
  if (raw == nullptr) return root.wrong("body", "missing");
  JsonFields f(root.fault(), *raw, root.pointer() + "/body");
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
  body.display_aspect = f.numberOr("display_aspect", 0.62, 0, 4);
  body.tablet = f.flagOr("tablet", false);
  body.sleeps_after = f.textOr("sleeps_after", "");
  body.skin = f.text("skin");
  f.skip("sources");
  f.close();
}

PhaseRow phaseRow(JsonFields& f) {
  PhaseRow p;
  p.id = f.text("id");
  p.screen = f.textOr("screen", "");
  const auto* lasts = f.raw("lasts");
  if (lasts != nullptr && lasts->is_number())
    p.lasts = fmt::format("{}", f.number("lasts", 0, 86400));
  else
    p.lasts = f.textOr("lasts", "");
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
  v.default_value = f.textOr("standard", "");
  v.unit = f.textOr("unit", "");
  v.source = f.text("source");
  v.kept = f.flagOr("kept", true);
  if (v.kind == WidgetKind::toggle) v.choices = {"on", "off"};
  if (v.kind == WidgetKind::number) {
    v.minimum = f.number("minimum", -1e9, 1e9);
    v.maximum = f.number("maximum", v.minimum, 1e9);
    const auto default_value = numberIn(v.default_value);
    if (!default_value || *default_value < v.minimum || *default_value > v.maximum)
      f.wrong("standard", fmt::format("must be a number from {} to {}, in quotes", v.minimum, v.maximum));
  } else if (v.kind != WidgetKind::text &&
             std::find(v.choices.begin(), v.choices.end(), v.default_value) == v.choices.end()) {
    f.wrong("standard", fmt::format("'{}' is not one of the choices", v.default_value));
  }
  if (v.kind != WidgetKind::choice && v.kind != WidgetKind::toggle && v.kind != WidgetKind::text &&
      v.kind != WidgetKind::number)
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
  JsonFault fault(file.filename().string());
  JsonFields root(fault, json, "");
  DeviceDefinition d;
  d.id = root.text("id");
  d.title = root.text("title");
  d.instruments = root.texts("instruments");
  d.about = root.text("about");
  readBody(root, d.body);
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
  root.close();
  if (d.phases.empty()) fault.say("/phases", "a device must have at least one phase");
  if (d.instruments.empty()) fault.say("/instruments", "a device must drive at least one scanner");
  refuseTwins(fault, d.phases, "/phases");
  refuseTwins(fault, d.values, "/values");
  refuseTwins(fault, d.screens, "/screens");
  refuseTwins(fault, d.dialogs, "/dialogs");
  refuseTwins(fault, d.keys, "/keys");
  refuseTwins(fault, d.sensors, "/sensors");
  if (fault.error()) return failure(*fault.error());
  return d;
}

const ScreenRow* findScreen(const DeviceDefinition& d, const std::string& id) { return rowOf(d.screens, id); }
const PhaseRow* findPhase(const DeviceDefinition& d, const std::string& id) { return rowOf(d.phases, id); }
const ValueRow* findValue(const DeviceDefinition& d, const std::string& id) { return rowOf(d.values, id); }
const DialogRow* findDialog(const DeviceDefinition& d, const std::string& id) { return rowOf(d.dialogs, id); }

}  // namespace standpoint
