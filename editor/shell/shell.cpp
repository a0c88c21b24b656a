// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "editor/panels/import_preview_panel.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/escape.h"
#include "editor/shell/graphics_choice.h"
#include "editor/shell/import_preview.h"
#include "editor/shell/panel_actions.h"
#include "editor/shell/scene_picture.h"
#include "editor/shell/start_page.h"
#include "editor/shell/status_bar.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

struct WorkspaceTab {
  Workspace workspace;
  const char* action;
  const char* title;
};
constexpr std::array kWorkspaceTabs = {
    WorkspaceTab{Workspace::environment, "workspace-environment", "Environment"},
    WorkspaceTab{Workspace::optimise, "workspace-optimise", "Optimise"},
    WorkspaceTab{Workspace::materials, "workspace-materials", "Materials"},
    WorkspaceTab{Workspace::georeference, "workspace-georeference", "Georeference"},
    WorkspaceTab{Workspace::survey, "workspace-survey", "Survey"},
    WorkspaceTab{Workspace::instrument, "workspace-instrument", "Instrument"},
    WorkspaceTab{Workspace::inspect, "workspace-inspect", "Inspect"},
};

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoNavFocus;

struct Box {
  float x = 0, y = 0, w = 0, h = 0;
};

void beginFixed(const char* id, const Box& box, ImVec2 padding, ImU32 background, ImGuiWindowFlags more = 0) {
  ImGui::SetNextWindowPos({box.x, box.y});
  ImGui::SetNextWindowSize({std::max(box.w, 1.0F), std::max(box.h, 1.0F)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
  ImGui::Begin(id, nullptr, kFixed | more);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(4);
}

void items(Editor& editor, std::initializer_list<const char*> ids) {
  for (const char* id : ids) {
    if (*id == 0)
      ImGui::Separator();
    else
      actionMenuItem(editor, id);
  }
}

void recentMenu(Editor& editor) {
  if (!ui::beginMenu(ICON_HISTORY, "Open recent###recent", !editor.settings.recent.empty())) return;
  const auto recent = editor.settings.recent;
  for (const auto& path : recent) {
    const auto shown = std::filesystem::path(path).filename().string();
    if (ImGui::MenuItem((shown + "###" + path).c_str(), nullptr, false, editor.session.whyNot("open-project").empty()))
      openPath(editor, path);
    ui::tooltip(path);
  }
  ImGui::EndMenu();
}

// What has its own place among the menus, where it is asked for with more help than a form gives.
bool isElsewhere(std::string_view verb) {
  return verb == "import" || verb == "export" || verb == "convert" || verb == "scan" || verb.ends_with("-project") ||
         verb.ends_with("-recovery");
}

// The verbs in the order of the work; what is in no group stands below them.
struct VerbGroup {
  const char* title;
  std::initializer_list<std::string_view> verbs;
};
const VerbGroup kVerbGroups[] = {
    {"Model###group-model", {"add", "optimize", "treat", "collide", "georeference", "bookmark"}},
    {"Materials###group-materials", {"materials", "verify"}},
    {"Survey###group-survey", {"station", "target", "trajectory", "mover", "plan", "coverage", "underlay"}},
    {"Scans###group-scans", {"register", "assess", "measure", "waveform"}},
    {"Points and datasets###group-points", {"clean", "compare", "dataset", "score"}},
    {"Files and jobs###group-files", {"info", "locate", "instruments", "run"}},
};

void verbItem(Editor& editor, const Verb& verb) {
  const auto why = editor.session.whyNot(verb.name);
  if (ui::menuItem("", fmt::format("{}…###run-{}", tr(verbTitle(verb.name)), verb.name), nullptr, why))
    openVerbForm(editor, verb.name);
  if (why.empty()) ui::tooltip(tr(verb.summary));
}

void runMenu(Editor& editor) {
  items(editor, {"add-station", "add-station-at", "add-row", "add-trajectory", "add-target", "scan", ""});
  for (const auto& group : kVerbGroups) {
    if (!ui::beginMenu("", group.title)) continue;
    for (const auto name : group.verbs)
      if (const auto* verb = editor.session.verb(name)) verbItem(editor, *verb);
    ImGui::EndMenu();
  }
  const auto grouped = [](std::string_view verb) {
    return std::any_of(std::begin(kVerbGroups), std::end(kVerbGroups), [&](const VerbGroup& group) {
      return std::find(group.verbs.begin(), group.verbs.end(), verb) != group.verbs.end();
    });
  };
  for (const auto& verb : editor.session.verbs())
    if (!isElsewhere(verb.name) && !grouped(verb.name)) verbItem(editor, verb);
}

void submenu(Editor& editor, const char* icon, const char* title, std::initializer_list<const char*> ids) {
  if (!ui::beginMenu(icon, title)) return;
  items(editor, ids);
  ImGui::EndMenu();
}

void graphicsMenu(Editor& editor) {
  if (!ui::beginMenu("", "Graphics###menu-graphics")) return;
  const auto before = editor.settings.graphics;
  drawGraphicsChoices(editor, 380);
  if (editor.settings.graphics != before) ImGui::CloseCurrentPopup();  // and the menu that it is in
  ImGui::EndMenu();
}

// With submenus, so that all of it has room in a window of 800 pixels.
void viewMenu(Editor& editor) {
  items(editor, {"frame", "view-corner"});
  submenu(editor, "", "Look from###menu-look",
          {"frame-all", "view-front", "view-back", "view-right", "view-left", "view-top", "view-before"});
  items(editor, {"view-plan", "view-parallel", "", "hide", "isolate", "show-all", "", "edges", "grid", "walkable",
                 "shapes", "holes", "labels"});
  submenu(editor, "", "Points###menu-points", {"points-larger", "points-smaller", "shaded-points"});
  submenu(editor, "", "More labels###menu-labels", {"room-names", "labels-through-walls"});
  items(editor, {"", "walk", "teleport", "go-to", "look-from-station"});
  submenu(editor, "", "More moves###menu-moves",
          {"take-stair", "view-before", "", "fly", "door", "record-walk", "scan-walk", "step-out-of-sight",
           "return-to-instrument", "add-bookmark"});
  ImGui::Separator();
  submenu(editor, ICON_PAINT, "Colour by###menu-colour",
          {"colour-model", "colour-material", "colour-reflectance", "colour-confidence", "colour-intensity",
           "colour-noise", "colour-fate", "colour-coverage", "colour-spacing", "colour-incidence"});
  submenu(editor, "", "Workspace###menu-workspace",
          {"workspace-environment", "workspace-optimise", "workspace-materials", "workspace-georeference",
           "workspace-survey", "workspace-instrument", "workspace-inspect"});
  ImGui::Separator();
  graphicsMenu(editor);
  items(editor, {editor.settings.theme == Theme::light ? "theme-dark" : "theme-light", "sounds"});
  submenu(editor, "", "Language###menu-language", {"language-system", "language-en", "language-de", "language-uk"});
  submenu(editor, "", "Interface size###menu-size", {"interface-larger", "interface-smaller", "interface-usual"});
}

void drawMenuBar(Editor& editor) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  const bool open = ImGui::BeginMainMenuBar();
  ImGui::PopStyleVar();
  if (!open) return;
  if (ImGui::BeginMenu(ui::Label("File"))) {
    items(editor, {"new", "open", "sample"});
    recentMenu(editor);
    items(editor, {"import", "update", "", "save", "save-as", "recover", "export", "export-points"});
    submenu(editor, "", "Pictures and films###menu-shots", {"picture", "panorama", "turntable", "walk-through"});
    items(editor, {"", "preferences", "quit"});
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(ui::Label("Edit"))) {
    items(editor, {"undo", "redo", "", "select-all", "select-none", "", "rename", "duplicate-station", "remove", "",
                   "assign-material", "take-material", "paint-material"});
    submenu(
        editor, "", "Measure###menu-measure",
        {"measure", "measure-height", "measure-angle", "measure-area", "measure-plane", "pick-wall", "measurements"});
    submenu(editor, "", "Colour points###menu-points",
            {"points-by-natural", "points-by-rgb", "points-by-intensity", "points-by-range", "points-by-height",
             "points-by-incidence", "points-by-product", "points-by-material", "points-by-return-number",
             "points-by-flags", "points-by-residual", "points-by-deviation", "points-by-time", "points-by-station",
             "points-larger", "points-smaller"});
    items(editor, {"show-panorama", "compare-clouds"});
    submenu(editor, "", "Clip###menu-clip",
            {"clip-box", "clip-none", "section-wall", "section-x", "section-y", "section-z", "clip-look", "clip-turn",
             "clip-handles"});
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(ui::Label("View"))) {
    viewMenu(editor);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(ui::Label("Run"))) {
    runMenu(editor);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(ui::Label("Help"))) {
    items(editor, {"first-steps", "shortcuts", "palette", "", "about"});
    ImGui::EndMenu();
  }
  const auto& session = editor.session;
  const bool unnamed = session.folder().empty() && session.document().name.empty();
  const std::string title = (unnamed ? tr("New project") : session.name()) + (session.modified() ? "  •" : "");
  const float width = ImGui::CalcTextSize(title.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowWidth() - width - editor.px(22));
  ImGui::TextDisabled("%s", title.c_str());
  ImGui::EndMainMenuBar();
}

void toolGap(const Editor& editor) {
  ImGui::SameLine(0, editor.px(8));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float h = ImGui::GetFrameHeight();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y + h * 0.2F}, {at.x, at.y + h * 0.8F}, tone::kLine, editor.px(1));
  ImGui::Dummy({editor.px(1), h});
  ImGui::SameLine(0, editor.px(8));
}

float scanButtonWidth(const Editor& editor) {
  const float text = ImGui::CalcTextSize(tr(ICON_PLAY "  Scan…").c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
  return std::max(editor.px(96), text);
}

// Of two buttons in sight one opens the panel, and one scans.
std::string whyNotOpenScan(const Editor& editor) {
  const bool open =
      editor.workspace == Workspace::survey && editor.front_tab[static_cast<std::size_t>(Area::right)] == "scan";
  return open ? "The Scan panel is open: its button starts the scan" : editor.session.whyNot("scan");
}

// Beside ten tools, the button Scan and the palette's, with room for one more between them.
bool roomForTitles(const Editor& editor, float width) {
  const float padding = 2 * ImGui::GetStyle().FramePadding.x;
  float needed = 12 * (ImGui::GetFrameHeight() + editor.px(10)) + editor.px(3 * 17 + 16) + scanButtonWidth(editor);
  for (const auto& tab : kWorkspaceTabs)
    needed += ImGui::CalcTextSize(tr(tab.title).c_str()).x + editor.px(24) + padding;
  return needed <= width;
}

// How far the work of a workspace is done, at the corner of its button: a tick or an exclamation mark, so that colour
// is not all.
void markStep(const Editor& editor, const GuideStep& step) {
  ui::tooltipAbove(step.status.empty() ? tr(step.title) : fmt::format("{}: {}", tr(step.title), tr(step.status)));
  const bool attention = step.state == GuideStep::State::attention;
  if (!editor.environment() || (!attention && step.state != GuideStep::State::done)) return;
  const float size = ImGui::GetFontSize() * 0.62F;
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), size,
                                      {ImGui::GetItemRectMax().x - size, ImGui::GetItemRectMin().y - editor.px(1)},
                                      attention ? tone::kWarning : tone::kGood, attention ? ICON_WARNING : ICON_CHECK);
}

void drawWorkspaceTabs(Editor& editor, bool titles) {
  const auto& steps = editor.guide.of(editor);
  for (const auto& tab : kWorkspaceTabs) {
    const bool chosen = editor.workspace == tab.workspace;
    ImGui::PushStyleColor(ImGuiCol_Button, chosen ? ImVec4(0.25F, 0.56F, 0.97F, 0.26F) : ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, chosen ? tone::kChosen : tone::kCalm);
    const std::string label = fmt::format("{}{}{}###{}", findAction(tab.action)->icon, titles ? "  " : "",
                                          titles ? tr(tab.title) : "", tab.action);
    if (ImGui::Button(label.c_str())) editor.workspace = tab.workspace;
    ImGui::PopStyleColor(2);
    markStep(editor, steps[static_cast<std::size_t>(tab.workspace)]);
    ImGui::SameLine(0, editor.px(2));
  }
}

void drawToolbar(Editor& editor, const Box& box) {
  beginFixed("###toolbar", box, {editor.px(8), editor.px(6)}, tone::kPanel);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(editor.px(2), 0));
  for (const char* id : {"open", "import", "save"}) actionToolButton(editor, id);
  toolGap(editor);
  for (const char* id : {"undo", "redo"}) actionToolButton(editor, id);
  toolGap(editor);
  drawWorkspaceTabs(editor, roomForTitles(editor, box.w));
  toolGap(editor);
  for (const char* id : {"walk", "teleport", "add-station", "add-target", "measure"}) actionToolButton(editor, id);
  const float scan = scanButtonWidth(editor), right = scan + editor.px(36);
  ImGui::SameLine(box.w - right - editor.px(8));
  if (ui::primaryButton(ICON_PLAY "  Scan…###tool_scan", whyNotOpenScan(editor), {scan, 0})) invoke(editor, "scan");
  ImGui::SameLine(0, editor.px(4));
  actionToolButton(editor, "palette");
  ImGui::PopStyleVar();
  ImGui::End();
}

// What tabs show, by the room there is: all of it, no icons, these side by side as closely as need be, or the title of
// the chosen one alone.
enum class TabLabels { whole, titles, chosen_title };
struct TabLook {
  TabLabels labels = TabLabels::whole;
  float padding = 0;  // px, at either side of a tab's words
};

TabLook tabLook(const Editor& editor, Area area) {
  constexpr float kClosest_pt = 3;
  const float usual = ImGui::GetStyle().FramePadding.x, room = ImGui::GetContentRegionAvail().x;
  float words = 0, count = 0;
  for (const auto& panel : panels())
    if (panel.area[static_cast<std::size_t>(editor.workspace)] == area) {
      words += ImGui::CalcTextSize(tr(panel.title).c_str()).x + ImGui::GetStyle().ItemInnerSpacing.x + 1;
      ++count;
    }
  if (words + count * (2 * usual + editor.px(26)) <= room) return {TabLabels::whole, usual};
  const float padding = std::floor((room - words) / (2 * std::max(count, 1.0F)));
  return padding < editor.px(kClosest_pt) ? TabLook{TabLabels::chosen_title, usual}
                                          : TabLook{TabLabels::titles, std::min(padding, usual)};
}

std::string tabLabel(const Panel& panel, TabLabels labels) {
  const std::string id = std::string("###") + panel.id, title = tr(panel.title);
  const bool chosen = ImGui::GetCurrentContext()->CurrentTabBar->SelectedTabId == ImGui::GetID(id.c_str());
  if (labels == TabLabels::whole) return std::string(panel.icon) + "  " + title + id;
  return (labels != TabLabels::chosen_title || chosen ? title : panel.icon) + id;
}

void drawPanelTabs(Editor& editor, Area area, const char* id) {
  // A panel of this area may ask for another one of it, which is for the next frame.
  const auto wanted = std::exchange(editor.wanted_tab[static_cast<std::size_t>(area)], {});
  const auto workspace = static_cast<std::size_t>(editor.workspace);
  const auto [labels, across] = tabLook(editor, area);
  ImGui::PushID(static_cast<int>(workspace));
  // A tab takes the padding of its own moment for its width, and that of its bar for its letters.
  const ImVec2 padding(across, ImGui::GetStyle().FramePadding.y);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
  const bool bar = ImGui::BeginTabBar(id, ImGuiTabBarFlags_FittingPolicyResizeDown);
  ImGui::PopStyleVar();
  if (bar) {
    for (const auto& panel : panels()) {
      if (panel.area[workspace] != area) continue;
      const auto flags = wanted == panel.id ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
      ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
      const bool open = ImGui::BeginTabItem(tabLabel(panel, labels).c_str(), nullptr, flags);
      ImGui::PopStyleVar();
      if (labels == TabLabels::chosen_title) ui::tooltip(panel.title);
      if (!open) continue;
      editor.front_tab[static_cast<std::size_t>(area)] = panel.id;
      ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(editor.px(10), editor.px(6)));
      ImGui::BeginChild(panel.id, {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
      ImGui::PopStyleVar();
      PanelActions actions(editor);
      panel.draw(editor, editor.panels, actions);
      ImGui::EndChild();
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::PopID();
}

bool anyPanel(const Editor& editor, Area area) {
  return std::any_of(panels().begin(), panels().end(),
                     [&](const Panel& p) { return p.area[static_cast<std::size_t>(editor.workspace)] == area; });
}

void splitter(Editor& editor, const char* id, const Box& box, ImGuiAxis axis, float sign, float size,
              std::optional<float>& dragged, float smallest, float largest) {
  ImGui::SetCursorScreenPos({box.x, box.y});
  ImGui::InvisibleButton(id, {std::max(box.w, 1.0F), std::max(box.h, 1.0F)});
  const bool active = ImGui::IsItemActive();
  if (const float moved = ImGui::GetIO().MouseDelta[axis]; active && moved != 0)
    dragged = std::clamp(size + sign * moved / editor.scale, smallest, largest);
  if (!active && !ImGui::IsItemHovered()) return;
  ImGui::SetMouseCursor(axis == ImGuiAxis_X ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  ImGui::GetWindowDrawList()->AddRectFilled({box.x, box.y}, {box.x + box.w, box.y + box.h}, tone::kAccent);
}

struct Layout {
  Box left, right, bottom, middle, all;
};

// What the areas get: the viewport keeps two fifths of the width, three tenths where the device is what is looked at.
// Where that leaves too little, the left one keeps its width for longest, so that the view begins where it does
// elsewhere.
Layout layOut(const Editor& editor, const Box& all) {
  const AreaSizes sizes = editor.settings.sizesIn(editor.workspace);
  Layout l;
  l.all = all;
  const float gap = editor.px(3);
  float left = anyPanel(editor, Area::left) ? editor.px(sizes.left) : 0;
  float right = anyPanel(editor, Area::right) ? editor.px(sizes.right) : 0;
  if (const float most = all.w * (editor.workspace == Workspace::instrument ? 0.7F : 0.6F); left + right > most) {
    right = std::min(right, std::max(most - left, most / 2));
    left = std::min(left, most - right);
  }
  const float bottom = anyPanel(editor, Area::bottom) ? std::min(editor.px(sizes.bottom), all.h * 0.6F) : 0;
  l.left = {all.x, all.y, left, all.h};
  l.right = {all.x + all.w - right, all.y, right, all.h};
  const float x = all.x + left + (left > 0 ? gap : 0);
  const float w = all.w - left - right - (left > 0 ? gap : 0) - (right > 0 ? gap : 0);
  l.middle = {x, all.y, w, all.h - bottom - (bottom > 0 ? gap : 0)};
  l.bottom = {x, all.y + all.h - bottom, w, bottom};
  return l;
}

void drawSplitters(Editor& editor, const Layout& l) {
  const AreaSizes sizes = editor.settings.sizesIn(editor.workspace);
  auto& dragged = editor.settings.draggedIn(editor.workspace);
  const float gap = editor.px(3);
  // Never as one that wants the focus: under a dialog that would put it over the areas that have just appeared.
  beginFixed("###splitters", l.all, {0, 0}, tone::kBehind, ImGuiWindowFlags_NoFocusOnAppearing);
  if (l.left.w > 0)
    splitter(editor, "###split-left", {l.left.x + l.left.w, l.all.y, gap, l.all.h}, ImGuiAxis_X, 1, sizes.left,
             dragged.left, 160, 900);
  if (l.right.w > 0)
    splitter(editor, "###split-right", {l.right.x - gap, l.all.y, gap, l.all.h}, ImGuiAxis_X, -1, sizes.right,
             dragged.right, 200, 1200);
  if (l.bottom.h > 0)
    splitter(editor, "###split-bottom", {l.middle.x, l.bottom.y - gap, l.middle.w, gap}, ImGuiAxis_Y, -1, sizes.bottom,
             dragged.bottom, 80, 700);
  ImGui::End();
}

void drawArea(Editor& editor, const char* id, const Box& box, Area area) {
  if (box.w <= 0 || box.h <= 0) return;
  beginFixed(id, box, {0, editor.px(3)}, tone::kTabs);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, tone::kPanel);
  drawPanelTabs(editor, area, id);
  ImGui::PopStyleColor();
  ImGui::End();
}

// While a model is previewed, there is it and the question, and nothing else.
void drawPreviewLayout(Editor& editor, const Box& all) {
  const float panel = std::min(editor.px(400), all.w * 0.5F), gap = editor.px(3);
  beginFixed("###preview", {all.x + all.w - panel, all.y, panel, all.h}, {editor.px(14), editor.px(12)}, tone::kPanel);
  PanelActions actions(editor);
  drawImportPreview(editor, editor.panels.of<ImportPreviewState>(), actions);
  ImGui::End();
  beginFixed("###viewport", {all.x, all.y, all.w - panel - gap, all.h}, {0, 0}, tone::kPanel);
  drawViewport(editor);
  ImGui::End();
}

void drawPreviewShell(Editor& editor) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float head = ImGui::GetFrameHeight() + editor.px(12);
  beginFixed("###preview-head", {0, 0, display.x, head}, {editor.px(14), editor.px(6)}, tone::kPanel);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(tr(ICON_IMPORT "  Import preview").c_str());
  ImGui::SameLine(0, editor.px(16));
  ui::dimText("Enter: import   Esc: cancel   F: frame");
  ImGui::End();
  drawPreviewLayout(editor, {0, head, display.x, display.y - head});
  drawFileDialog(editor);  // where to save what is open, before it gives way
  drawMessages(editor);
}

// Once for each choice; whoever asks for another panel meanwhile has it.
void bringInspectorForward(Editor& editor) {
  const Area area = areaOf("inspector", editor.workspace);
  if (!std::exchange(editor.inspect_wanted, false) || area == Area::none) return;
  auto& wanted = editor.wanted_tab[static_cast<std::size_t>(area)];
  if (wanted.empty()) wanted = "inspector";
}

void drawWorkspace(Editor& editor, const Box& all) {
  bringInspectorForward(editor);
  const Layout l = layOut(editor, all);
  drawArea(editor, "###left", l.left, Area::left);
  drawArea(editor, "###right", l.right, Area::right);
  drawArea(editor, "###bottom", l.bottom, Area::bottom);
  beginFixed("###viewport", l.middle, {0, 0}, tone::kPanel);
  drawViewport(editor);
  ImGui::End();
  drawSplitters(editor, l);  // last: windows that keep their place lie behind those made before them
}

// While a model is read, what its first picture needs besides is made, a part in each frame.
void prepareViewport(Editor& editor, const Box& all) {
  if (editor.scene == nullptr || (!editor.jobRuns() && editor.session.running().empty())) return;
  const Layout l = layOut(editor, all);
  const auto [width, height] = screenPixels({l.middle.w, l.middle.h});
  editor.scene->prepare(editor.viewState(), width, height);
}

}  // namespace

void openPanel(Editor& editor, Workspace workspace, std::string_view panel) {
  editor.workspace = workspace;
  if (const Area area = areaOf(panel, workspace); area != Area::none)
    editor.wanted_tab[static_cast<std::size_t>(area)] = panel;
}

void takeStep(Editor& editor, const GuideStep& step) {
  openPanel(editor, step.workspace, step.tab);
  if (*step.command != 0) invoke(editor, step.command);
}

void drawShell(Editor& editor) {
  editor.update();
  editor.followClip(editor.view.clip.face < 0 && !ImGui::IsAnyItemActive());
  closeTopmost(editor);  // which may close the preview, and then there is nothing of it to draw
  if (editor.preview.isOpen()) runPreviewKeys(editor);
  if (editor.preview.isOpen()) {
    drawPreviewShell(editor);
    return;
  }
  runShortcuts(editor);
  editor.device_has_keys = editor.device_drawn = false;  // until it is drawn
  drawMenuBar(editor);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float menu = ImGui::GetFrameHeight(), tools = ImGui::GetFrameHeight() + editor.px(12),
              status = ImGui::GetFrameHeight() + editor.px(4);
  drawToolbar(editor, {0, menu, display.x, tools});
  const Box all = {0, menu + tools, display.x, display.y - menu - tools - status};
  if (wantsStartPage(editor)) {
    beginFixed("###start", all, {0, 0}, tone::kTabs);
    drawStartPage(editor, {all.w, all.h});
    ImGui::End();
    prepareViewport(editor, all);
  } else {
    drawWorkspace(editor, all);
  }
  beginFixed("###status", {0, display.y - status, display.x, status}, {editor.px(10), editor.px(2)}, tone::kBar);
  drawStatusBar(editor);
  ImGui::End();
  drawFileDialog(editor);
  drawVerbDialog(editor);
  drawShotDialog(editor);
  drawPalette(editor);
  drawMessages(editor);
}

void drawFrame(Editor& editor) {
  const auto draw = [&] {
    ImGui::NewFrame();
    drawShell(editor);
    ImGui::Render();
  };
  draw();
  if (std::exchange(editor.laid_out, editor.workspace) == editor.workspace) return;
  ImGui::GetIO().DeltaTime = 1e-4F;
  draw();
}

}  // namespace standpoint
