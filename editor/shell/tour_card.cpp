// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/tour_card.h"

#include <algorithm>

#include <fmt/format.h>

#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/overlay.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

void drawStep(Editor& editor, const Tour::Step& step, std::size_t number) {
  ui::dimText(trf("First steps  {} of {}", number + 1, Tour::steps().size()));
  ui::heading(editor, step.title);
  ui::wrapped(step.text);
  ui::gap(editor, 4);
  if (ui::button("Skip###tour-skip")) editor.tour.skip();
  ImGui::SameLine();
  if (ui::button("Leave###tour-leave")) editor.tour.end();
}

void drawEnd(Editor& editor) {
  ui::heading(editor, "That is the whole workflow");
  ui::wrapped(
      "Import your own building next. The Guide panel next to the Outliner shows what to do; F1 lists the keyboard "
      "shortcuts.");
  ui::gap(editor, 4);
  if (ui::primaryButton(ICON_IMPORT "  Import model…###tour-import", editor.session.whyNot("import"))) {
    editor.tour.end();
    invoke(editor, "import");
  }
  ImGui::SameLine();
  if (ui::button("Close###tour-leave")) editor.tour.end();
}

}  // namespace

void beginTour(Editor& editor) {
  openSample(editor, "house.ifc");
  editor.tour.begin();
}

void drawTour(Editor& editor, ImVec2 origin, ImVec2 size) {
  editor.tour.follow(editor);
  if (!editor.tour.active() || !editor.environment()) return;
  const float width = std::min(editor.px(300), size.x - editor.px(20)), height = editor.px(152);
  ImGui::SetCursorScreenPos({origin.x + editor.px(10), controlsCorner(editor, origin).y + editor.px(10)});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, tone::kOverlay);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(editor.px(12), editor.px(8)));
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, editor.px(6));
  ImGui::BeginChild("tour", {width, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
  const auto step = editor.tour.step();
  if (step < Tour::steps().size())
    drawStep(editor, Tour::steps()[step], step);
  else
    drawEnd(editor);
  ImGui::EndChild();
}

}  // namespace standpoint
