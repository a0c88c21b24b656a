// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/widget_list.h"

#include <map>

#include <fmt/format.h>

#include "emulated-ui/menus.h"

namespace standpoint {

namespace {

std::string effectOf(const WidgetRow& w) {
  std::string text;
  const auto add = [&](const char* what, const std::string& name) {
    if (!name.empty()) text += (text.empty() ? "" : ", ") + fmt::format("{} `{}`", what, name);
  };
  add("setting", w.setting);
  add("value", w.value);
  add("rows", w.list);
  add("does", w.does);
  add("event", w.event);
  add("opens", w.go);
  if (text.empty()) add("shows", w.shows);
  return text.empty() ? "–" : text;
}

bool acts(WidgetKind kind) {
  return kind != WidgetKind::status && kind != WidgetKind::readout && kind != WidgetKind::note &&
         kind != WidgetKind::progress && kind != WidgetKind::lamp && kind != WidgetKind::level &&
         kind != WidgetKind::plan;
}

}  // namespace

Result<std::string> widgetList() {
  std::string rows, summary;
  std::size_t all = 0, all_act = 0;
  for (const auto& device : emulatedDevices()) {
    const auto type = loadDevice(device);
    if (!type) return failure(type.error());
    const Device d(*type);
    std::map<std::string, std::pair<const WidgetRow*, std::string>> once;  // id: row, screens
    std::vector<std::string> order;
    const auto take = [&](const WidgetRow& w, const std::string& screen) {
      auto [at, fresh] = once.try_emplace(w.id, &w, screen);
      if (fresh)
        order.push_back(w.id);
      else
        at->second.second += ", " + screen;
    };
    for (const auto& key : (*type)->definition.keys) take(key, "body");
    for (const auto& screen : (*type)->definition.screens)
      for (const auto& w : screen.widgets) take(w, screen.id);
    std::size_t acting = 0;
    for (const auto& id : order) {
      const auto& [w, screens] = once[id];
      const bool act = acts(w->kind);
      acting += act ? 1 : 0;
      rows += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", device.id, id, d.word(w->words),
                          kWidgetKindNames[static_cast<int>(w->kind)], effectOf(*w), screens, w->source,
                          act ? fmt::format("`Widgets.PressedOnEveryScreen` ({})", device.id)
                              : fmt::format("`Widgets.ShowSomething` ({})", device.id));
    }
    summary += fmt::format("- {}: {} widgets, {} of them to press\n", device.title, order.size(), acting);
    all += order.size();
    all_act += acting;
  }
  return fmt::format(
      "# Widgets of the emulated devices\n\nWritten by `list-widgets`; `WidgetList.DocsListThemAll` holds it against "
      "the tables. {} distinct widgets, {} of them to press.\n\n{}\n"
      "Marks of the source: S… = read in that source, D = derived, G1 and G2 = general knowledge (weak: correct the "
      "label in emulated-ui/words), P = a choice of this emulator.\n\n"
      "| device | widget | label | kind | what it does | screens | source | test "
      "|\n|---|---|---|---|---|---|---|---|\n{}",
      all, all_act, summary, rows);
}

}  // namespace standpoint
