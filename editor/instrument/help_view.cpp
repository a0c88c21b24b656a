// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <set>

#include "editor/instrument/desk.h"
#include "editor/widgets/widgets.h"
#include "emulated-ui/device/costs.h"

namespace standpoint {

namespace {

bool holds(const std::string& text, const std::string& wanted) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), wanted.begin(), wanted.end(), same) != text.end();
}

void entry(const Device& device, const WidgetRow& row) {
  ui::wrapped(device.word(row.words));
  ui::dimWrapped(widgetHelp(device, row));
  ImGui::Spacing();
}

}  // namespace

// The widget that was asked about, or all whose name or help holds what is searched.
void drawHelp(InstrumentDesk& desk, Editor& editor) {
  const Device& device = *desk.shown();
  if (ui::button(desk.view.asking ? "Select a control to explain###asking" : "Explain a control###asking"))
    desk.view.asking = !desk.view.asking;
  (void)ui::searchField("##help", "Search controls", desk.search);
  ui::gap(editor);
  if (!desk.search.empty()) {
    std::set<std::string> seen;
    for (const auto& screen : device.type().definition.screens)
      for (const auto& row : screen.widgets)
        if ((holds(device.word(row.words), desk.search) || holds(device.word(row.words + "?"), desk.search)) &&
            seen.insert(screen.id + row.id).second)
          entry(device, row);
    if (seen.empty()) ui::dimWrapped("No matching controls on this device");
    return;
  }
  if (desk.view.explained.empty())
    return ui::dimWrapped("Choose Explain, then select a control on the device. The scan is not affected.");
  const auto& id = desk.view.explained;
  const auto screen = device.screen();
  if (const auto* widget = findWidget(screen, id)) ui::wrapped(widget->label);
  const auto help = device.help(id);
  ui::wrapped(help.empty() ? "Answers the question on the screen." : help);
}

}  // namespace standpoint
