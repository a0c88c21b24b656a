// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/model/log.h"
#include "editor/model/outliner_rows.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

struct LogState {
  LogFilter filter;
  bool follows = true;  // its end is shown, until somebody scrolls up
  float scroll_px = 0;  // when it was drawn last
  // The widest source of the entries that were shown last, by how many there were and the size of letters.
  std::size_t entries = 0, shown = 0;
  float letters_px = 0, source_px = 0;
};

struct Look {
  const char* icon;
  ImU32 tone;
};

Look lookOf(LogLevel level) {
  switch (level) {
    case LogLevel::note: return {ICON_INFO, tone::kDim};
    case LogLevel::done: return {ICON_CHECK, tone::kGood};
    case LogLevel::warning: return {ICON_WARNING, tone::kWarning};
    case LogLevel::loss: return {ICON_WARNING, tone::kBad};
    case LogLevel::error: return {ICON_BAN, tone::kBad};
  }
  return {ICON_INFO, tone::kDim};
}

void drawHead(const Model& model, LogState& state, Actions& actions) {
  auto& filter = state.filter;
  std::size_t notes = 0, warnings = 0, losses = 0;
  bool any_follows = false;
  for (const auto& e : model.session.log()) {
    any_follows |= e.follows;
    notes += e.level == LogLevel::note || e.level == LogLevel::done ? 1 : 0;
    warnings += e.level == LogLevel::warning ? 1 : 0;
    losses += e.level == LogLevel::loss || e.level == LogLevel::error ? 1 : 0;
  }
  ui::filterButton(model, "log", ICON_BAN, "Losses and errors", losses, tone::kBad, filter.losses);
  ui::filterButton(model, "log", ICON_WARNING, "warnings", warnings, tone::kWarning, filter.warnings);
  ui::filterButton(model, "log", ICON_INFO, "notes", notes, tone::kDim, filter.notes);
  if (any_follows) ui::listEach("log", filter.each);
  const float clear = 2 * ImGui::GetFrameHeight() + model.px(16);
  const float room = ImGui::GetContentRegionMax().x - ImGui::GetCursorPosX() - clear;
  const float search = std::clamp(room, model.px(60), model.px(230));
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetContentRegionMax().x - search - clear));
  ImGui::BeginChild("log-search", {search, ImGui::GetFrameHeight()});
  ui::searchField("log-filter", "Text or source", filter.text);
  ImGui::EndChild();
  ImGui::SameLine();
  if (ui::iconButton(ICON_TRASH "###log-clear", "Clear log")) actions.clearLog();
  ui::copyTable("log", [&] {
    TableRows table = {{tr("Time"), tr("Source"), tr("Message")}};
    for (const auto& e : model.session.log())
      if (passes(e, filter)) table.push_back({e.time, e.source, trSentence(e.message)});
    return table;
  });
}

void rowMenu(const LogEntry& entry) {
  if (!ImGui::BeginPopupContextItem("###log-menu")) return;
  if (ui::menuItem(ICON_COPY, tr("Copy row") + "###copy-log-row", nullptr, {}))
    ImGui::SetClipboardText(rowsText({{entry.time, entry.source, trSentence(entry.message)}}).c_str());
  ImGui::EndPopup();
}

void drawEntry(const Model& model, Actions& actions, const LogEntry& entry, int i) {
  const Look look = lookOf(entry.level);
  ImGui::PushID(i);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::Selectable("###log-row", false, ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
  rowMenu(entry);
  ImGui::SameLine(0, 0);
  ImGui::TextColored(colour(look.tone), "%s", look.icon);
  ImGui::TableNextColumn();
  ui::dimText(entry.time);
  ImGui::TableNextColumn();
  if (!entry.source.empty()) {
    const auto product = model.environment() ? productOf(*model.environment(), entry.source) : std::nullopt;
    if (product) {
      ImGui::PushStyleColor(ImGuiCol_Text, tone::kLink);
      const auto source = ui::fittingMiddle(entry.source, ImGui::GetContentRegionAvail().x);
      if (ImGui::Selectable((source + "###log-source").c_str())) {
        actions.reveal(*product);
        actions.showSelection();
      }
      ImGui::PopStyleColor();
      ui::tooltip(source == entry.source ? tr("Select product") : entry.source + "\n" + tr("Select product"));
    } else {
      ui::fitted(entry.source, ImGui::GetContentRegionAvail().x);
    }
  }
  ImGui::TableNextColumn();
  ui::fitted(withReadableClasses(shownSentence(entry.message)), ImGui::GetContentRegionAvail().x);
  ImGui::PopID();
}

// As wide as the sources need, and at most a third: the rest is the message's.
float sourceWidth(const std::vector<LogEntry>& log, const std::vector<int>& shown, LogState& state) {
  if (state.entries != log.size() || state.shown != shown.size() || state.letters_px != ImGui::GetFontSize()) {
    state.entries = log.size(), state.shown = shown.size(), state.letters_px = ImGui::GetFontSize();
    state.source_px = 1;
    for (const int i : shown)
      state.source_px =
          std::max(state.source_px, ImGui::CalcTextSize(log[static_cast<std::size_t>(i)].source.c_str()).x);
  }
  return std::min(std::ceil(state.source_px), ImGui::GetContentRegionAvail().x / 3);
}

// The place is that of the entries of the frame before: those that are new have not moved it yet.
void followEnd(LogState& state) {
  const float place = ImGui::GetScrollY();
  if (place >= ImGui::GetScrollMaxY() - 1)
    state.follows = true;
  else if (place < state.scroll_px - 0.5F)
    state.follows = false;
  state.scroll_px = place;
  if (state.follows) ImGui::SetScrollHereY(1);
}

void draw(const Model& model, LogState& state, Actions& actions) {
  drawHead(model, state, actions);
  const auto& log = model.session.log();
  std::vector<int> shown;
  for (int i = 0; i < static_cast<int>(log.size()); ++i)
    if (passes(log[static_cast<std::size_t>(i)], state.filter)) shown.push_back(i);
  if (!ImGui::BeginTable("entries", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("level", ImGuiTableColumnFlags_WidthFixed, model.px(18));
  ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, model.px(62));
  ImGui::TableSetupColumn("source", ImGuiTableColumnFlags_WidthFixed, sourceWidth(log, shown, state));
  ImGui::TableSetupColumn("message", ImGuiTableColumnFlags_WidthStretch);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const int entry = shown[static_cast<std::size_t>(i)];
      drawEntry(model, actions, log[static_cast<std::size_t>(entry)], entry);
    }
  clipper.End();
  followEnd(state);
  ImGui::EndTable();
}

}  // namespace

void drawLogPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<LogState>(), actions);
}

}  // namespace standpoint
