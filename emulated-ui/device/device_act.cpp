// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/device/settings.h"

namespace standpoint {

namespace {

constexpr std::size_t kLongestEntry = 60;

bool pressable(WidgetKind kind) {
  switch (kind) {
    case WidgetKind::button:
    case WidgetKind::key:
    case WidgetKind::choice:
    case WidgetKind::toggle:
    case WidgetKind::text:
    case WidgetKind::number:
    case WidgetKind::list:
    case WidgetKind::area:
    case WidgetKind::preview:
    case WidgetKind::plan: return true;
    default: return false;
  }
}

Result<void> checkEntry(const std::string& text, const std::string& id) {
  if (text.size() > kLongestEntry)
    return failure(ErrorKind::usage, fmt::format("maximum length is {} bytes", kLongestEntry), id);
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20)
      return failure(ErrorKind::usage, "control characters are not allowed", id);
  return {};
}

// A list has the row that was pressed.
Result<void> checkRow(const Widget& widget, const std::string& value) {
  if (widget.kind != WidgetKind::list) return {};
  const auto known = std::any_of(widget.options.begin(), widget.options.end(),
                                 [&](const WidgetOption& o) { return o.value == value && o.enabled; });
  if (!known) return failure(ErrorKind::usage, fmt::format("the list has no row '{}'", value), widget.id);
  return {};
}

}  // namespace

const WidgetRow* Device::rowOf(const std::string& id) const {
  const auto in = [&](const std::vector<WidgetRow>& rows) -> const WidgetRow* {
    for (const auto& row : rows)
      if (row.id == id && row.when.holds(facts())) return &row;
    return nullptr;
  };
  if (on() && state_.dialog.empty())
    if (const auto* screen = findScreen(type_->definition, state_.screen))
      if (const auto* row = in(screen->widgets)) return row;
  return in(type_->definition.keys);
}

Result<void> Device::act(const std::string& id, const std::string& value, Gesture by) {
  const bool slept = asleep();
  wake();
  state_.moved_along.clear();
  if (slept) {
    note("woken");
    return {};
  }
  const Screen now = screen();
  if (now.has_dialog) {
    const auto& rows = findDialog(type_->definition, state_.dialog)->buttons;
    for (const auto& button : rows) {
      if (button.id != id) continue;
      note("answered", state_.dialog + "/" + id);
      state_.dialog.clear();
      if (!button.event.empty() && !fire(button.event))
        return failure(ErrorKind::usage, fmt::format("{}: {}", word(id), word("not_now")), id);
      return {};
    }
  }
  const Widget* shown = findWidget(now, id);
  const WidgetRow* row = rowOf(id);
  if ((shown == nullptr || row == nullptr) && !on())
    return failure(ErrorKind::usage, fmt::format("the device is off: cannot press '{}'", id), id);
  const bool taken = row != nullptr && (row->kind != WidgetKind::plan || by != Gesture::tap || !row->empty());
  if (shown == nullptr || !taken || !pressable(shown->kind))
    return failure(ErrorKind::usage,
                   fmt::format("screen '{}' has no control '{}'", now.has_dialog ? now.dialog.id : now.id, id), id);
  if (!shown->enabled) {
    note("refused", id);
    return failure(ErrorKind::usage, shown->why_not.empty() ? "disabled" : shown->why_not, id);
  }
  if (by == Gesture::tap) return press(*row, *shown, value);
  const auto effect = row->gestures.find(by);
  const char* name = nameOf(by);
  if (effect == row->gestures.end())
    return failure(ErrorKind::usage, fmt::format("'{}' does not take the gesture '{}'", id, name), id);
  if (auto ok = checkRow(*shown, value); !ok) return ok;
  note("pressed", fmt::format("{}/{}={} ({})", state_.screen, id, value, name));
  return carryOut(effect->second, value, *shown);
}

Result<void> Device::bind(const WidgetRow& row, const Widget& widget, const std::string& given) {
  std::string value = given;
  if (widget.kind == WidgetKind::toggle && value.empty()) value = widget.value == "on" ? "off" : "on";
  if (widget.kind == WidgetKind::choice || widget.kind == WidgetKind::toggle) {
    const auto option = std::find_if(widget.options.begin(), widget.options.end(),
                                     [&](const WidgetOption& o) { return o.value == value || o.label == value; });
    if (option == widget.options.end()) {
      std::vector<std::string> known;
      for (const auto& o : widget.options) known.push_back(o.value);
      return failure(ErrorKind::usage, fmt::format("'{}' is not one of {}", value, fmt::join(known, ", ")), row.id);
    }
    if (!option->enabled) return failure(ErrorKind::usage, option->why_not, row.id);
    value = option->value;
  } else if (widget.kind == WidgetKind::number) {
    const auto number = numberIn(value);
    if (!number || *number < widget.minimum || *number > widget.maximum)
      return failure(ErrorKind::usage, fmt::format("must be a number from {} to {}", widget.minimum, widget.maximum),
                     row.id);
    if (widget.unit == "ft") value = fmt::format("{:.6g}", *number * kMetresPerFoot);
    if (widget.unit == "°F") value = fmt::format("{:.6g}", (*number - 32) / 1.8);
  } else if (widget.kind == WidgetKind::text) {
    if (auto ok = checkEntry(value, row.id); !ok) return ok;
  }
  if (!row.setting.empty()) {
    const auto adapted = adaptedSettings(type_->instrument, state_.settings, row.setting, value);
    if (!adapted) return failure(ErrorKind::usage, adapted.error().message, row.id);
    note("setting", row.setting + "=" + value);
    state_.moved_along = movedAlong(*adapted, row.setting);
    return setSettings(*adapted);
  }
  if (!row.value.empty()) {
    note("value", row.value + "=" + value);
    state_.values[row.value] = value;
    if (row.value == "language") state_.language = value;
  } else if (widget.kind == WidgetKind::text || widget.kind == WidgetKind::number) {
    state_.entries[row.id] = value;
  }
  return {};
}

namespace {

// "from_h,to_h,from_v,to_v" into the four settings of a scan area.
Result<SettingValues> areaSettings(const SettingValues& now, const std::string& value) {
  constexpr const char* kKeys[] = {"horizontal_from", "horizontal_to", "vertical_from", "vertical_to"};
  SettingValues wanted = now;
  std::size_t at = 0;
  for (const char* key : kKeys) {
    const auto end = value.find(',', at);
    const auto number = numberIn(value.substr(at, end == std::string::npos ? std::string::npos : end - at));
    if (!number) return failure(ErrorKind::usage, "must be four angles in degrees: from_h,to_h,from_v,to_v");
    wanted = withSetting(wanted, key, fmt::format("{:g}", *number));
    at = end == std::string::npos ? value.size() : end + 1;
  }
  return wanted;
}

}  // namespace

Result<void> Device::press(const WidgetRow& row, const Widget& widget, const std::string& value) {
  note("pressed", state_.screen + "/" + row.id + (value.empty() ? "" : "=" + value));
  if (widget.kind == WidgetKind::area) {
    TRY_ASSIGN(const auto wanted, areaSettings(state_.settings, value));
    if (auto ok = setSettings(wanted); !ok) return failure(ErrorKind::usage, ok.error().message, row.id);
    note("setting", "area=" + value);
    return {};
  }
  if (auto ok = widget.kind == WidgetKind::list ? checkRow(widget, value) : bind(row, widget, value); !ok) return ok;
  return carryOut(row, value, widget);
}

Result<void> Device::carryOut(const WidgetEffect& effect, const std::string& value, const Widget& widget) {
  if (!effect.does.empty()) {
    const auto named = [&](const DeviceAction& a) { return effect.does == a.name; };
    const auto& own = type_->program.actions;
    auto action = std::find_if(own.begin(), own.end(), named);
    if (action == own.end()) action = std::find_if(sharedActions().begin(), sharedActions().end(), named);
    if (auto done = action->act(*this, value); !done) {
      note("refused", widget.id);
      ask("refused", done.error().message);
      return {};
    }
  }
  if (!effect.event.empty() && !fire(effect.event))
    return failure(ErrorKind::usage, fmt::format("{}: {}", widget.label, word("not_now")), widget.id);
  if (!effect.go.empty() && state_.dialog.empty()) show(effect.go);
  return {};
}

Result<void> Device::hand(const std::string& id, const std::string& value) {
  for (const auto& row : handRows()) {
    if (row.id != id) continue;
    auto done = row.act(*this, value);
    if (done) note("hand", value.empty() ? id : id + "=" + value);
    return done;
  }
  return failure(ErrorKind::usage, fmt::format("unknown hand action '{}'", id), id);
}

Result<void> Device::trouble(const std::string& id) {
  for (const auto& row : troubleRows()) {
    if (row.id != id) continue;
    note("trouble", id);
    row.happens(*this);
    return {};
  }
  return failure(ErrorKind::usage, fmt::format("unknown trouble '{}'", id), id);
}

}  // namespace standpoint
