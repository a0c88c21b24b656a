// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/costs.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/device/replaced.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/language/plural.h"

namespace standpoint {

namespace {

// The text with what stands in its braces filled in: `part` says what for.
template <class Part>
std::string filled(const std::string& text, const Part& part) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto open = text.find('{', i);
    const auto end = open == std::string::npos ? open : text.find('}', open);
    if (end == std::string::npos) return out + text.substr(i);
    out += text.substr(i, open - i) + part(text.substr(open + 1, end - open - 1));
    i = end + 1;
  }
  return out;
}

// In a sentence a number has the decimal sign of its language, and a noun the form that goes with its count.
std::string inSentence(const Device& device, const std::string& between_braces) {
  const auto part = countedPart(between_braces);
  const std::string name(part.fact);
  const auto& language = device.state().language;
  if (!part.forms.empty()) return std::string(formFor(part, language, device.number(name)));
  const auto found = device.fact(name);
  return found && found->number ? numberInSentence(device.shown(name), language) : device.shown(name);
}

const InstrumentSetting* settingOf(const Instrument& instrument, const std::string& key) {
  const auto found =
      std::find_if(instrument.settings.begin(), instrument.settings.end(), [&](const auto& s) { return s.key == key; });
  return found == instrument.settings.end() ? nullptr : &*found;
}

std::string choiceWord(const Device& device, const std::string& key, const std::string& fallback) {
  const auto& d = device.type();
  return d.words->has(d.definition.id, key, "en") ? device.word(key) : fallback;
}

std::string choiceLabel(const Device& device, const InstrumentSetting& setting, const std::string& value) {
  for (const auto& choice : setting.choices)
    if (choice.value == value) {
      // A plain On or Off is the same word on every device.
      const bool plain = device.type().words->text(device.type().definition.id, value, "en") == choice.label;
      return choiceWord(device, setting.key + "=" + value, plain ? device.word(value) : choice.label);
    }
  return value;
}

// As the widget that sets it is called.
std::string settingLabel(const Device& device, const InstrumentSetting& setting) {
  for (const auto& screen : device.type().definition.screens)
    for (const auto& row : screen.widgets)
      if (row.setting == setting.key) return choiceWord(device, row.words, setting.label);
  return setting.label;
}

void addSettingOptions(const Device& device, const InstrumentSetting& setting, bool possible_only, Widget& w) {
  const std::string now = device.setting(setting.key);
  for (const auto& choice : setting.choices) {
    WidgetOption option{choice.value, choiceLabel(device, setting, choice.value), true, {}};
    const auto adapted = adaptedSettings(device.type().instrument, device.state().settings, setting.key, choice.value);
    if (!adapted && possible_only) continue;
    if (!adapted) {
      option.enabled = false;
      option.why_not = adapted.error().message;
    }
    if (choice.value == now) w.value = option.label;
    w.options.push_back(std::move(option));
  }
}

void addValueOptions(const Device& device, const ValueRow& value, Widget& w) {
  for (const auto& choice : value.choices) {
    const std::string words = value.kind == WidgetKind::toggle ? choice : value.id + "=" + choice;
    w.options.push_back({choice, choiceWord(device, words, choice), true, {}});
    if (choice == device.value(value.id) && w.kind == WidgetKind::choice) w.value = w.options.back().label;
  }
  if (w.kind != WidgetKind::choice) w.value = device.value(value.id);
  w.minimum = value.minimum;
  w.maximum = value.maximum;
  w.unit = value.unit;
}

std::vector<WidgetOption> listRows(const Device& device, const std::string& name) {
  for (const auto* lists : {&device.type().program.lists, &sharedLists()})
    for (const auto& list : *lists)
      if (name == list.name) return list.rows(device);
  return {};
}

// What is typed on a device that shows feet.
void turnIntoFeet(Widget& w) {
  if (w.kind != WidgetKind::number || (w.unit != "m" && w.unit != "°C")) return;
  const bool length = w.unit == "m";
  const auto turned = [&](double x) { return length ? x / kMetresPerFoot : x * 1.8 + 32; };
  if (const auto number = numberIn(w.value)) w.value = fmt::format("{:.5g}", turned(*number));
  w.minimum = turned(w.minimum);
  w.maximum = turned(w.maximum);
  w.unit = length ? "ft" : "°F";
}

void addArea(const Device& device, Widget& w) {
  for (const char* key : {"horizontal_from", "horizontal_to", "vertical_from", "vertical_to"})
    w.options.push_back({device.setting(key), key, true, {}});
}

// An event that shows a screen in the same phase leads there.
bool shows(const DeviceProgram& program, const EventId& event) {
  return std::any_of(program.transitions.begin(), program.transitions.end(),
                     [&](const Transition& t) { return t.event == event && t.to.name.empty() && !t.show.empty(); });
}

Leads leadsOf(const WidgetRow& row, const DeviceProgram& program, const DeviceState& state) {
  if (row.go.empty()) return !row.event.empty() && shows(program, row.event) ? Leads::onwards : Leads::nowhere;
  const auto& from = state.came_from;
  if (row.go != "back" && std::find(from.begin(), from.end(), row.go) == from.end()) return Leads::onwards;
  return row.does.empty() ? Leads::back
                          : Leads::nowhere;  // "Create" does something, though it then shows what one came from
}

}  // namespace

std::string Device::word(const std::string& key) const {
  return filled(type_->words->text(type_->definition.id, key, state_.language), [this](const std::string& name) {
    return name == "detail" ? state_.dialog_detail : inSentence(*this, name);
  });
}

std::string Device::movedAlong(const SettingValues& adapted, const std::string& key) const {
  const auto chosen = std::find_if(adapted.begin(), adapted.end(), [&](const auto& s) { return s.first == key; });
  std::string text;
  for (const auto& [name, value] : adapted) {
    const auto *moved = settingOf(type_->instrument, name), *by = settingOf(type_->instrument, key);
    const auto before = setting(name);
    if (name == key || value == before) continue;
    std::string line = type_->words->text(type_->definition.id, "setting_moved", state_.language);
    for (const auto& [place, word] : {std::pair{"{what}", settingLabel(*this, *moved)},
                                      {"{from}", choiceLabel(*this, *moved, before)},
                                      {"{to}", choiceLabel(*this, *moved, value)},
                                      {"{by}", choiceLabel(*this, *by, chosen->second)}})
      line = replaced(std::move(line), place, word);
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

// Nothing when this scanner does not have what the widget sets, or when it is not there now.
std::optional<Widget> Device::widget(const WidgetRow& row) const {
  if (!row.when.holds(facts())) return std::nullopt;
  const auto* setting = row.setting.empty() ? nullptr : settingOf(type_->instrument, row.setting);
  if (!row.setting.empty() && setting == nullptr) return std::nullopt;
  if (row.kind == WidgetKind::area && settingOf(type_->instrument, "horizontal_from") == nullptr) return std::nullopt;
  Widget w;
  w.id = row.id;
  w.kind = row.kind;
  const bool has_word = setting == nullptr || type_->words->has(type_->definition.id, row.words, "en");
  w.label = has_word ? word(row.words) : setting->label;
  if (setting != nullptr) {
    addSettingOptions(*this, *setting, row.possible_only, w);
    w.minimum = setting->minimum;
    w.maximum = setting->maximum;
    w.unit = setting->unit == "deg" ? "°" : setting->unit;
    if (setting->choices.empty()) w.value = this->setting(setting->key);
  } else if (!row.value.empty()) {
    addValueOptions(*this, *findValue(type_->definition, row.value), w);
  } else if (!row.list.empty()) {
    w.options = listRows(*this, row.list);
  } else if (row.kind == WidgetKind::text || row.kind == WidgetKind::number) {
    const auto typed = state_.entries.find(row.id);
    if (typed != state_.entries.end()) w.value = typed->second;
    w.minimum = row.minimum;
    w.maximum = row.maximum;
  } else if (row.kind == WidgetKind::area) {
    addArea(*this, w);
  } else if (row.kind == WidgetKind::level) {
    w.options = {{fmt::format("{:.4f}", state_.around.tilt_x_deg), "x", true, {}},
                 {fmt::format("{:.4f}", state_.around.tilt_y_deg), "y", true, {}}};
    w.maximum = type_->definition.body.tilt_limit_deg;
  }
  if (showsFeet()) turnIntoFeet(w);
  if (!row.shows.empty())
    w.value = row.shows.find('{') == std::string::npos
                  ? shown(row.shows)
                  : filled(row.shows, [this](const std::string& name) { return shown(name); });
  if (row.kind == WidgetKind::progress || row.kind == WidgetKind::number)
    w.number = std::strtod(w.value.c_str(), nullptr);
  if (row.kind == WidgetKind::progress) w.number = fact(row.shows).value_or(numberFact(0)).number.value_or(0);
  if (row.kind == WidgetKind::lamp && row.shows.empty()) w.value = findPhase(type_->definition, state_.phase)->lamp;
  if (row.kind == WidgetKind::preview && shownSetup() != nullptr) w.value = shownSetup()->file;
  w.leads = leadsOf(row, type_->program, state_);
  w.acts = (row.kind != WidgetKind::list && row.kind != WidgetKind::plan) || !row.empty();
  for (const auto& [gesture, effect] : row.gestures) w.gestures.push_back(gesture);
  if (w.takes(Gesture::lay)) w.laid = type_->program.laid(*this);
  w.enabled = row.enabled.holds(facts());
  if ((!w.enabled || (!row.warns.empty() && row.warns.holds(facts()))) && !row.why_not.empty())
    w.why_not = word(row.why_not);
  return w;
}

std::string Device::help(const std::string& widget) const {
  const auto* row = rowOf(widget);
  return row == nullptr ? std::string() : widgetHelp(*this, *row);
}

Screen Device::screen() const {
  Screen s;
  const auto& d = type_->definition;
  for (const auto& row : d.keys)
    if (auto w = widget(row)) s.body.push_back(*std::move(w));
  if (!on() || asleep()) return s;
  if (const auto light = numberIn(value("brightness"))) s.light = *light / 100;
  const auto* screen = findScreen(d, state_.screen);
  if (screen != nullptr) {
    s.id = screen->id;
    s.title = word(screen->id);
    for (const auto& row : screen->widgets)
      if (auto w = widget(row)) s.widgets.push_back(*std::move(w));
  }
  if (const auto* dialog = state_.dialog.empty() ? nullptr : findDialog(d, state_.dialog)) {
    s.has_dialog = true;
    s.dialog = {dialog->id, word("dialog." + dialog->id), {}};
    for (const auto& button : dialog->buttons) {
      Widget w;
      w.id = button.id;
      w.kind = WidgetKind::button;
      w.label = word(button.id);
      s.dialog.buttons.push_back(std::move(w));
    }
  }
  return s;
}

const Widget* findWidget(const Screen& screen, const std::string& id) {
  const auto in = [&](const std::vector<Widget>& widgets) -> const Widget* {
    const auto found = std::find_if(widgets.begin(), widgets.end(), [&](const Widget& w) { return w.id == id; });
    return found == widgets.end() ? nullptr : &*found;
  };
  if (screen.has_dialog)
    if (const auto* found = in(screen.dialog.buttons)) return found;
  if (!screen.has_dialog)
    if (const auto* found = in(screen.widgets)) return found;
  return in(screen.body);
}

}  // namespace standpoint
