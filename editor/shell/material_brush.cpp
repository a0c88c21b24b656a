// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/material_brush.h"

#include <algorithm>

#include <fmt/format.h>

#include "editor/model/editor.h"
#include "editor/model/material_scope.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

constexpr const char* kDragged = "material";  // a payload's text is the material's id
constexpr const char* kMenu = "###material-menu";

void ask(Editor& editor, const RayHit& hit, std::string material) {
  editor.panels.materials.painted = {hit, std::move(material)};
  ImGui::OpenPopup(kMenu);
}

}  // namespace

const PhysicalMaterial* knownMaterial(Editor& editor, const std::string& id) {
  const auto& all = offeredMaterials(editor.panels.catalogue, editor.session.document().materials);
  const auto found = std::find_if(all.begin(), all.end(), [&](const PhysicalMaterial& m) { return m.id == id; });
  return found == all.end() ? nullptr : &*found;
}

void dragMaterial(const PhysicalMaterial& material) {
  if (!ImGui::BeginDragDropSource()) return;
  ImGui::SetDragDropPayload(kDragged, material.id.c_str(), material.id.size() + 1);
  ImGui::TextUnformatted(material.label.c_str());
  ImGui::EndDragDropSource();
}

void acceptMaterial(Editor& editor, ImVec2 origin) {
  if (!ImGui::BeginDragDropTarget()) return;
  if (const auto* payload = ImGui::AcceptDragDropPayload(kDragged)) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    const auto ray = rayThrough(editor.view.camera, {p.x - origin.x, p.y - origin.y}, editor.view.size);
    if (const auto hit = editor.picker.pick(ray, editor.viewState()))
      ask(editor, *hit, static_cast<const char*>(payload->Data));
  }
  ImGui::EndDragDropTarget();
}

void paintMaterial(Editor& editor, const RayHit& hit) {
  if (!editor.panels.materials.chosen.empty()) ask(editor, hit, editor.panels.materials.chosen);
}

void takeMaterial(Editor& editor, const RayHit& hit) {
  const auto& choice = editor.session.document().materials;
  const auto* material = choice ? materialAt(*editor.environment(), choice->result.assignment, hit) : nullptr;
  editor.panels.materials.chosen_unassigned = material == nullptr;
  editor.panels.materials.chosen = material == nullptr ? std::string() : material->id;
  editor.wanted_tab[1] = "material";
}

void drawMaterialMenu(Editor& editor) {
  if (!ImGui::BeginPopup(kMenu)) return;
  const auto& [hit, id] = editor.panels.materials.painted;
  const auto* material = knownMaterial(editor, id);
  const auto why = editor.session.whyNot("materials");
  if (material == nullptr || !editor.environment() || hit.product >= editor.environment()->products.size()) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return;
  }
  ui::dimText(fmt::format("{} on", material->label));
  for (const auto& scope :
       materialScopes(*editor.environment(), hit, editor.session.document().georeference->shift_m)) {
    const auto label = scope.products > 1
                           ? fmt::format("{}   {} products###{}", scope.title, scope.products, scope.selector)
                           : fmt::format("{}###{}", scope.title, scope.selector);
    if (ImGui::MenuItem(label.c_str(), nullptr, false, why.empty()))
      editor.session.start("materials", {{"assign", {scope.selector + "=" + material->id}}},
                           fmt::format("Assign {} to {}", material->label, scope.title));
  }
  ui::tooltip(why);
  ImGui::EndPopup();
}

}  // namespace standpoint
