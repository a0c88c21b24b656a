// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/import_preview_panel.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/panels/actions.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/job_progress.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

struct ImportChoice {
  const char* value;
  const char* label;
};
constexpr std::array kUnits = {ImportChoice{"", "As in the file"}, ImportChoice{"m", "Metre"},
                               ImportChoice{"cm", "Centimetre"},   ImportChoice{"mm", "Millimetre"},
                               ImportChoice{"in", "Inch"},         ImportChoice{"ft", "Foot"}};
constexpr std::array kUps = {ImportChoice{"", "As in the file"}, ImportChoice{"y", "Y points up"},
                             ImportChoice{"z", "Z points up"}};

template <std::size_t N>
bool choose(const char* id, const std::array<ImportChoice, N>& choices, std::string& value) {
  const auto chosen =
      std::find_if(choices.begin(), choices.end(), [&](const ImportChoice& c) { return value == c.value; });
  bool changed = false;
  if (!ui::beginDropDown(id, tr(chosen == choices.end() ? value.c_str() : chosen->label).c_str())) return false;
  for (const auto& c : choices)
    if (ui::choice(ui::Label(c.label), value == c.value)) value = c.value, changed = true;
  ui::endDropDown();
  return changed;
}

void heading(const Model& model, const char* text) {
  ui::gap(model, 4);
  ui::heading(model, text);
}

// A text that counts when it is left or Enter is pressed: each change reads the file again.
bool textField(const char* id, const char* hint, std::string& text) {
  ImGui::InputTextWithHint(id, tr(hint).c_str(), &text);
  return ImGui::IsItemDeactivatedAfterEdit();
}

void drawPlace(const Model& model, Actions& actions) {
  const auto& preview = model.preview;
  auto chosen = preview.overrides;
  heading(model, "Size and place");
  if (!ui::beginProperties("preview-place", 0.28F)) return;
  const auto& facts = preview.facts();
  ui::property("Size", sizeText(facts.size_m));
  if (preview.firstSize_m()) ui::property("Before", sizeText(*preview.firstSize_m()));
  ui::propertyLabel("Unit");
  bool changed = choose("###preview-unit", kUnits, chosen.unit);
  ui::propertyLabel("Up");
  changed |= choose("###preview-up", kUps, chosen.up);
  const auto& georeference = *model.shownDocument().georeference;
  ui::propertyLabel("Shift");
  changed |= textField("###preview-shift", "auto, none or E,N,H", chosen.shift);
  ui::tooltip(
      trf("Subtracted from all coordinates on import and restored on export. Currently {:.0f}, {:.0f}, {:.0f} m",
          georeference.shift_m.x(), georeference.shift_m.y(), georeference.shift_m.z()));
  if (preview.hasIfc()) {
    ui::propertyLabel("Types");
    changed |= ui::checkbox(ui::Label("Import as products###preview-types"), &chosen.types);
    ui::tooltip("Types that no product uses are imported with their shapes as products at the origin");
  }
  ui::propertyLabel("CRS");
  changed |= textField("###preview-crs", georeference.crs.empty() ? "not specified; EPSG:n" : georeference.crs.c_str(),
                       chosen.crs);
  if (!facts.bounds_file_m.empty()) {
    const auto& b = facts.bounds_file_m;
    ui::property("From", figures("{:.2f}  {:.2f}  {:.2f} m", b.min.x(), b.min.y(), b.min.z()));
    ui::property("To", figures("{:.2f}  {:.2f}  {:.2f} m", b.max.x(), b.max.y(), b.max.z()));
  }
  ui::endProperties();
  if (!facts.doubt.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kWarning);
    ui::wrapped(std::string(ICON_WARNING "  ") + facts.doubt);
    ImGui::PopStyleColor();
  }
  if (!preview.error().message.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
    ui::wrapped(std::string(ICON_WARNING "  ") + shownSentence(preview.error().message));
    ImGui::PopStyleColor();
  }
  actions.setOverrides(chosen, changed);
}

void drawClasses(const Model& model, float height) {
  const auto& facts = model.preview.facts();
  heading(model,
          trf("{} products, {} triangles", groupedDigits(facts.products), groupedDigits(facts.triangles)).c_str());
  ui::copyTable("preview-classes", [&] {
    TableRows table = {{tr("Class"), tr("Products"), tr("Triangles")}};
    for (const auto& row : facts.classes)
      table.push_back({row.ifc_class, std::to_string(row.products), std::to_string(row.triangles)});
    return table;
  });
  if (facts.triangles_of_spaces > 0) {
    const auto others =
        trf("and {} of spaces and annotations, invisible to scanners", groupedDigits(facts.triangles_of_spaces));
    ui::dimWrapped(others);
    height -= ImGui::GetTextLineHeightWithSpacing();
  }
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX;
  if (!ImGui::BeginTable("preview-classes", 3, flags, {0, height})) return;
  ImGui::TableSetupColumn("class", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("products", ImGuiTableColumnFlags_WidthFixed, model.px(64));
  ImGui::TableSetupColumn("triangles", ImGuiTableColumnFlags_WidthFixed, model.px(84));
  for (const auto& row : facts.classes) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ui::fitted(tr(readableClass(row.ifc_class)), ImGui::GetContentRegionAvail().x);
    ImGui::TableNextColumn();
    ui::textRightAligned(groupedDigits(row.products));
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ui::textRightAligned(groupedDigits(row.triangles));
    ImGui::PopStyleColor();
  }
  ImGui::EndTable();
}

void drawIssue(const Model& model, Actions& actions, const LogEntry& issue, int i) {
  const auto product = productOf(*model.shown(), issue.source);
  ImGui::PushID(i);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImU32 shade = issue.level == LogLevel::loss      ? tone::kBad
                      : issue.level == LogLevel::warning ? tone::kWarning
                                                         : tone::kDim;
  ImGui::TextColored(colour(shade), "%s", issue.level == LogLevel::note ? ICON_INFO : ICON_WARNING);
  ImGui::TableNextColumn();
  const ImVec2 at = ImGui::GetCursorPos();
  const std::string text = (issue.source.empty() ? "" : issue.source + "  ") + shownSentence(issue.message);
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
  if (product && ImGui::Selectable("###issue", model.preview_selection.contains(*product),
                                   ImGuiSelectableFlags_AllowItemOverlap, {0, height})) {
    actions.selectInPreview(*product);
    actions.showSelection();
  }
  ImGui::SetCursorPos(at);
  if (product) ImGui::PushStyleColor(ImGuiCol_Text, tone::kLink);
  ui::wrapped(text);
  if (product) ImGui::PopStyleColor();
  ImGui::PopID();
}

void drawIssues(const Model& model, ImportPreviewState& state, Actions& actions) {
  const auto& facts = model.preview.facts();
  auto& filter = state.filter;
  heading(model, "Issues");
  ui::filterButton(model, "preview", ICON_BAN, "losses", facts.losses, tone::kBad, filter.losses);
  ui::filterButton(model, "preview", ICON_WARNING, "warnings", facts.warnings, tone::kWarning, filter.warnings);
  ui::filterButton(model, "preview", ICON_INFO, "notes", facts.notes, tone::kDim, filter.notes);
  const auto& entries = model.preview.issues();
  if (std::any_of(entries.begin(), entries.end(), [](const LogEntry& e) { return e.follows; }))
    ui::listEach("preview", filter.each);
  ImGui::NewLine();
  if (entries.empty()) {
    ImGui::TextColored(colour(tone::kGood), "%s  %s", ICON_CHECK, tr("No issues").c_str());
    return;
  }
  std::vector<int> shown;
  for (int i = 0; i < static_cast<int>(entries.size()); ++i)
    if (passes(entries[static_cast<std::size_t>(i)], filter)) shown.push_back(i);
  const float height = std::max(3 * ImGui::GetTextLineHeightWithSpacing(), ImGui::GetContentRegionAvail().y);
  if (!ImGui::BeginTable("preview-issues", 2,
                         ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX, {0, height}))
    return;
  ImGui::TableSetupColumn("level", ImGuiTableColumnFlags_WidthFixed, model.px(18));
  ImGui::TableSetupColumn("text", ImGuiTableColumnFlags_WidthStretch);
  constexpr std::size_t kMost = 1000;  // rows of different heights are all laid out in each frame
  for (std::size_t i = 0; i < std::min(shown.size(), kMost); ++i)
    drawIssue(model, actions, entries[static_cast<std::size_t>(shown[i])], shown[i]);
  if (shown.size() > kMost) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(1);
    ui::dimWrapped(
        trf("and {} more, which the log has once the model is imported", groupedDigits(shown.size() - kMost)));
  }
  ImGui::EndTable();
}

void drawReading(const Model& model) {
  auto* task = model.preview.task();
  const auto text = ui::jobText(task->progress(), task->seconds());
  ui::gap(model, 6);
  ui::dimText(text.empty() ? tr("Reading") : text);
  ui::gap(model, 2);
  ui::jobBar(model, task->progress(), ImGui::GetContentRegionAvail().x);
}

void drawFailure(const Model& model) {
  const Error& error = model.preview.error();
  ui::gap(model, 6);
  ImGui::TextColored(colour(tone::kBad), "%s  %s", ICON_WARNING, tr("Cannot read the file").c_str());
  ui::gap(model, 2);
  ui::wrapped(shownSentence(error.message));
  if (!error.source.empty()) ui::dimWrapped(trf("in {}", error.source));
}

std::string whyNotAccept(const Model& model, const char* verb) {
  if (model.preview.stage() == ImportPreview::Stage::failed) return "Nothing to import";
  if (model.preview.stage() != ImportPreview::Stage::ready || model.preview.reading()) return "Reading file …";
  return model.session.whyNot(verb);
}

void drawPreviewButtons(const Model& model, Actions& actions) {
  const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
  const bool can_add = model.session.document().imported != nullptr;
  const float text = ImGui::CalcTextSize(tr(ICON_IMPORT "  Import").c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float each = can_add ? std::max((room - 2 * gap) / 4, text) : (room - gap) / 2;
  if (ui::primaryButton(ICON_IMPORT "  Import###preview-import", whyNotAccept(model, "import"), {each, model.px(28)}))
    actions.acceptPreview();
  ImGui::SameLine();
  if (can_add) {
    if (ui::button("Add to the environment###preview-add", whyNotAccept(model, "add"),
                   {room - 2 * gap - 2 * each, model.px(28)}, "Keeps the current model, stations and scans"))
      actions.addPreview();
    ImGui::SameLine();
  }
  if (ui::button("Cancel###preview-cancel", {}, {each, model.px(28)})) actions.closePreview();
}

std::string fileLine(const ImportPreview& preview) {
  std::uintmax_t bytes = 0;
  std::error_code ignored;
  for (const auto& file : preview.files())
    if (const auto size = std::filesystem::file_size(file, ignored); !ignored) bytes += size;
  std::string extension = preview.files().front().extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  const std::string size = bytes > 0 ? readableSize(bytes) : std::string();  // none: the file has gone meanwhile
  return (extension.empty() ? std::string() : extension.substr(1) + "   ") + size;
}

}  // namespace

void drawImportPreview(const Model& model, ImportPreviewState& state, Actions& actions) {
  const auto& preview = model.preview;
  if (state.closed != preview.closed()) state = {.closed = preview.closed()};
  if (model.fonts.bold != nullptr) ImGui::PushFont(model.fonts.bold);
  ui::fitted(preview.fileNames(), ImGui::GetContentRegionAvail().x);
  if (model.fonts.bold != nullptr) ImGui::PopFont();
  ui::tooltip(preview.files().front().string());
  ui::dimText(fileLine(preview));
  const float footer = model.px(28) + ImGui::GetStyle().ItemSpacing.y + model.px(6);
  ImGui::BeginChild("preview-body", {0, ImGui::GetContentRegionAvail().y - footer});
  if (preview.reading()) drawReading(model);
  if (preview.stage() == ImportPreview::Stage::failed && !preview.reading()) drawFailure(model);
  if (preview.outcome() != nullptr) {
    ImGui::BeginDisabled(preview.reading());
    drawPlace(model, actions);
    ImGui::EndDisabled();
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const float free = ImGui::GetContentRegionAvail().y - 4 * row - model.px(24);
    // The classes have what the issues leave, and at least half of the room that the two lists have.
    const auto& issues = preview.issues();
    const auto listed =
        std::count_if(issues.begin(), issues.end(), [&](const LogEntry& issue) { return passes(issue, state.filter); });
    const float most = issues.empty() ? free : std::max(free / 2, free - row * (static_cast<float>(listed) + 1));
    const float classes = std::clamp(row * (static_cast<float>(preview.facts().classes.size()) + 0.5F), row,
                                     std::max(row, most - 2 * row));
    drawClasses(model, classes);
    drawIssues(model, state, actions);
  }
  ImGui::EndChild();
  ui::gap(model, 2);
  drawPreviewButtons(model, actions);
}

}  // namespace standpoint
