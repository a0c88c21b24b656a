// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/outliner_panel.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "project/survey/underlays.h"

namespace standpoint {

namespace {

const char* iconOf(const Model& model, const Outliner::Node& node) {
  if (node.kind == OutlinerRow::Kind::group) return ICON_FOLDER;
  const auto& e = *model.environment();
  const bool product = node.kind == OutlinerRow::Kind::product;
  const auto& ifc_class = product ? e.products[node.index].ifc_class : e.spatial[node.index].ifc_class;
  if (ifc_class == "IfcSpace") return ICON_HOME;
  if (product) return ICON_CUBE;
  if (ifc_class == "IfcSite") return ICON_SITE;
  if (ifc_class == "IfcBuilding") return ICON_BUILDING;
  if (ifc_class == "IfcBuildingStorey") return ICON_STOREY;
  return ICON_GLOBE;
}

void choose(const Model& model, OutlinerState& state, Actions& actions, const std::vector<OutlinerRow>& rows,
            int index) {
  const auto& row = rows[static_cast<std::size_t>(index)];
  // A room without what stands in it: that has rows of its own.
  const auto below = row.kind == OutlinerRow::Kind::product ? std::vector{model.outliner.tree.node(row.node).index}
                                                            : model.outliner.tree.productsBelow(row.node);
  const auto& io = ImGui::GetIO();
  if (io.KeyShift && state.anchor < rows.size()) {
    std::vector<std::uint32_t> chosen;
    const auto [low, high] = std::minmax({static_cast<int>(state.anchor), index});
    for (int i = low; i <= high; ++i) {
      const auto more = model.outliner.tree.productsBelow(rows[static_cast<std::size_t>(i)].node);
      chosen.insert(chosen.end(), more.begin(), more.end());
    }
    actions.select(std::move(chosen));
    return;
  }
  state.anchor = static_cast<std::uint32_t>(index);
  if (io.KeyCtrl && below.size() == 1)
    actions.toggle(below.front());
  else if (io.KeyCtrl) {
    auto chosen = model.selection.products();
    chosen.insert(chosen.end(), below.begin(), below.end());
    actions.select(std::move(chosen));
  } else {
    actions.select(below);
  }
}

void drawEye(const Model& model, Actions& actions, const std::vector<std::uint32_t>& below, float x) {
  const bool any_shown =
      std::any_of(below.begin(), below.end(), [&](std::uint32_t p) { return !model.visibility.hidden(p); });
  ImGui::SameLine(x);
  ImGui::PushStyleColor(ImGuiCol_Text, any_shown ? tone::kIcon : tone::kWarning);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(model.px(3), 0));
  if (ui::iconButton(any_shown ? ICON_EYE "###eye" : ICON_EYE_OFF "###eye", any_shown ? "Hide" : "Show"))
    actions.show(below, !any_shown);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

bool isRoom(const Model& model, const Outliner::Node& node) {
  if (node.kind != OutlinerRow::Kind::product) return false;
  const auto& product = model.environment()->products[node.index];
  return product.ifc_class == "IfcSpace" && !product.excluded;
}

bool isStorey(const Model& model, const Outliner::Node& node) {
  const auto& storeys = model.storeys();
  return node.kind == OutlinerRow::Kind::spatial &&
         std::any_of(storeys.begin(), storeys.end(),
                     [&](const StoreyLevel& s) { return s.node == static_cast<std::int32_t>(node.index); });
}

// Into a room, or onto a storey.
void goTo(const Model& model, Actions& actions, const Outliner::Node& node) {
  if (isRoom(model, node))
    actions.goToRoom(node.index);
  else
    actions.goToStorey(static_cast<std::int32_t>(node.index));
}

// For all that is chosen; a row that is not becomes so.
void productMenu(const Model& model, OutlinerState& state, Actions& actions, const std::vector<OutlinerRow>& rows,
                 int index, bool chosen) {
  if (!ImGui::BeginPopupContextItem("###row-menu")) return;
  if (ImGui::IsWindowAppearing() && !chosen) choose(model, state, actions, rows, index);
  const auto& node = model.outliner.tree.node(rows[static_cast<std::size_t>(index)].node);
  if (isRoom(model, node) || isStorey(model, node)) {
    if (ui::menuItem(ICON_WALK, tr("Go there") + "###row-go-there", nullptr, {})) goTo(model, actions, node);
    ImGui::Separator();
  }
  for (const char* id : {"frame", "hide", "isolate", "show-all"}) actions.menuItem(id);
  ImGui::Separator();
  for (const char* id : {"assign-material", "exclude", "keep", "by-rules"}) actions.menuItem(id);
  ImGui::EndPopup();
}

void drawRow(const Model& model, OutlinerState& state, Actions& actions, const std::vector<OutlinerRow>& rows,
             int index) {
  const OutlinerRow row = rows[static_cast<std::size_t>(index)];
  const auto& node = model.outliner.tree.node(row.node);
  const bool product = row.kind == OutlinerRow::Kind::product;
  const bool chosen = product && model.selection.contains(node.index);
  const float left = ImGui::GetCursorPosX(), right = left + ImGui::GetContentRegionAvail().x;
  const float indent = model.px(13) * static_cast<float>(row.depth);
  ImGui::PushID(static_cast<int>(row.node));
  if (ImGui::Selectable("###row", chosen, ImGuiSelectableFlags_AllowItemOverlap | ImGuiSelectableFlags_AllowDoubleClick,
                        {0, model.px(19)})) {
    const bool on_arrow = ImGui::GetIO().MousePos.x < ImGui::GetWindowPos().x + left + indent + model.px(16);
    const bool twice = ImGui::IsMouseDoubleClicked(0), room = isRoom(model, node);
    if (row.expandable && (on_arrow || (twice && !room)))
      actions.expand(row.node, !row.expanded);
    else
      choose(model, state, actions, rows, index);
    if (room && twice && !on_arrow)
      goTo(model, actions, node);
    else if (product && twice)
      actions.showSelection();
  }
  const bool hovered = ImGui::IsItemHovered();
  productMenu(model, state, actions, rows, index, chosen);
  ImGui::SameLine(left + indent);
  if (row.expandable) ui::dimText(row.expanded ? ICON_ARROW_DOWN : ICON_CHEVRON_RIGHT);
  ImGui::SameLine(left + indent + model.px(17));
  const bool hidden = product && model.visibility.hidden(node.index);
  const bool excluded = product && model.environment()->products[node.index].excluded;
  ImGui::PushStyleColor(ImGuiCol_Text, product ? tone::kPartIcon : tone::kGroupIcon);
  ImGui::TextUnformatted(excluded ? ICON_BAN : iconOf(model, node));
  ImGui::PopStyleColor();
  ImGui::SameLine(left + indent + model.px(39));
  const std::string count = product ? std::string() : std::to_string(node.products);
  const float count_width = count.empty() ? 0 : ImGui::CalcTextSize(count.c_str()).x + model.px(8);
  const float eye = model.px(24);
  ImGui::BeginDisabled(hidden || excluded);
  const bool named = node.kind != OutlinerRow::Kind::group;
  ui::fitted(named ? node.label : tr(node.label), right - ImGui::GetCursorPosX() - count_width - eye);
  ImGui::EndDisabled();
  if (!count.empty()) {
    ImGui::SameLine(right - eye - count_width);
    ui::dimText(count);
  }
  const bool some_hidden = hidden || (!product && model.visibility.anyHidden());
  if (hovered || some_hidden) {
    const auto below = model.outliner.tree.productsBelow(row.node);
    const bool show_eye =
        hovered || std::any_of(below.begin(), below.end(), [&](std::uint32_t p) { return model.visibility.hidden(p); });
    if (show_eye) drawEye(model, actions, below, right - eye);
  }
  ImGui::PopID();
}

void drawUnderlayEye(const Model& model, Actions& actions, const Underlay& underlay, float x) {
  ImGui::SameLine(x);
  ImGui::PushStyleColor(ImGuiCol_Text, underlay.visible ? tone::kIcon : tone::kWarning);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(model.px(3), 0));
  if (ui::iconButton(underlay.visible ? ICON_EYE "###eye" : ICON_EYE_OFF "###eye", underlay.visible ? "Hide" : "Show",
                     model.session.whyNot("underlay")))
    underlay.visible ? actions.start(UnderlayOptions{.hide = underlay.name}, trf("Hide {}", underlay.name))
                     : actions.start(UnderlayOptions{.show = underlay.name}, trf("Show {}", underlay.name));
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

void frameUnderlay(const Model& model, Actions& actions, const Underlay& underlay) {
  const Bounds b = underlayBounds(underlay, *model.session.document().georeference);
  if (!b.empty()) actions.bringIntoView(b);
}

void underlayMenu(const Model& model, Actions& actions, const Underlay& underlay) {
  if (!ImGui::BeginPopupContextItem("###underlay-menu")) return;
  if (ImGui::MenuItem(ui::Label(ICON_EXPAND "  Frame###underlay-frame"))) frameUnderlay(model, actions, underlay);
  const auto why = model.session.whyNot("underlay");
  if (ImGui::MenuItem(ui::Label(ICON_MOVE "  Move…###underlay-move"), nullptr, false, why.empty()))
    actions.openForm(UnderlayOptions{.move = underlay.name, .at = underlay.file_from_cloud.translation});
  if (ImGui::MenuItem(ui::Label(ICON_TRASH "  Remove (keeps the file)###underlay-remove"), nullptr, false, why.empty()))
    actions.start(UnderlayOptions{.remove = underlay.name}, trf("Remove underlay {}", underlay.name));
  ImGui::EndPopup();
}

// Clouds under the model; a double click frames one.
void drawUnderlays(const Model& model, Actions& actions) {
  const auto underlays = model.session.document().underlays;  // a copy: a click may change them
  for (std::size_t i = 0; i < underlays.size(); ++i) {
    const Underlay& u = *underlays[i];
    ImGui::PushID(static_cast<int>(i));
    const float left = ImGui::GetCursorPosX(), right = left + ImGui::GetContentRegionAvail().x, eye = model.px(24);
    const bool pressed = ImGui::Selectable(
        "###underlay", model.survey.underlay == static_cast<int>(i),
        ImGuiSelectableFlags_AllowItemOverlap | ImGuiSelectableFlags_AllowDoubleClick, {0, model.px(19)});
    if (pressed) actions.choose(SurveyChoice{.underlay = static_cast<int>(i)});
    if (pressed && ImGui::IsMouseDoubleClicked(0)) frameUnderlay(model, actions, u);
    ImGui::SetItemAllowOverlap();
    underlayMenu(model, actions, u);
    ui::tooltip(trf("{}\n{} points\nDouble-click to frame", u.file, groupedDigits(u.points)));
    ImGui::SameLine(left + model.px(17));
    ImGui::TextColored(colour(tone::kPartIcon), "%s", ICON_UNDERLAY);
    ImGui::SameLine(left + model.px(39));
    const std::string points = groupedDigits(u.points);
    const float width = ImGui::CalcTextSize(points.c_str()).x + model.px(8);
    ImGui::BeginDisabled(!u.visible);
    ui::fitted(u.name, right - ImGui::GetCursorPosX() - width - eye);
    ImGui::EndDisabled();
    ImGui::SameLine(right - eye - width);
    ui::dimText(points);
    drawUnderlayEye(model, actions, u, right - eye);
    ImGui::PopID();
  }
  if (!underlays.empty()) ImGui::Separator();
}

void scrollTo(const Model& model, Actions& actions, const std::vector<OutlinerRow>& rows, float row_height) {
  if (!model.outliner.scroll_to) return;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].kind == OutlinerRow::Kind::product &&
        model.outliner.tree.node(rows[i].node).index == *model.outliner.scroll_to) {
      const float y = static_cast<float>(i) * row_height, height = ImGui::GetWindowHeight();
      if (y < ImGui::GetScrollY() || y + row_height > ImGui::GetScrollY() + height)
        ImGui::SetScrollY(std::max(0.0F, y - height * 0.4F));
    }
  actions.scrolled();
}

void draw(const Model& model, OutlinerState& state, Actions& actions) {
  const auto& environment = model.environment();
  if (!environment) {
    ui::emptyState(model, ICON_LIST, "Nothing to list", "Import a model to see the building structure.");
    return;
  }
  if (state.made != model.outliner.made) state = {.made = model.outliner.made};
  ui::searchField("outliner-filter", "Name, class, id, material", state.filter);
  if (state.filter.empty()) drawUnderlays(model, actions);
  const auto rows = model.outliner.tree.rows(*environment, state.filter);
  if (rows.empty() && !model.session.document().hasModel()) {
    ui::emptyState(model, ICON_CUBE, "No model", "This project has point clouds only. Import a model to add it.");
    return;
  }
  if (rows.empty()) {
    ui::emptyState(model, ICON_SEARCH, "No matches",
                   "No product matches all words in name, class, ID, storey or materials.");
    return;
  }
  ImGui::BeginChild("rows");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(model.px(4), model.px(1)));
  const float row_height = model.px(19) + model.px(1);
  scrollTo(model, actions, rows, row_height);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()), row_height);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) drawRow(model, state, actions, rows, i);
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

}  // namespace

void drawOutlinerPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<OutlinerState>(), actions);
}

}  // namespace standpoint
