// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/material_brush.h"

#include <fmt/format.h>

#include "editor/model/material_scope.h"
#include "editor/shell/editor.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/material_drag.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

constexpr const char* kMenu = "###material-menu";

void ask(Editor& editor, const RayHit& hit, std::string material) {
  editor.painted = {hit, std::move(material)};
  ImGui::OpenPopup(kMenu);
}

}  // namespace

void acceptMaterial(Editor& editor, ImVec2 origin) {
  const auto material = droppedMaterial();
  if (!material) return;
  const ImVec2 p = ImGui::GetIO().MousePos;
  const auto ray = rayThrough(editor.view.camera, {p.x - origin.x, p.y - origin.y}, editor.view.size);
  if (const auto hit = editor.picker.pick(ray, editor.viewState())) ask(editor, *hit, *material);
}

void paintMaterial(Editor& editor, const RayHit& hit) {
  if (!editor.material.id.empty()) ask(editor, hit, editor.material.id);
}

void takeMaterial(Editor& editor, const RayHit& hit) {
  const auto& choice = editor.session.document().materials;
  const auto* material = choice ? materialAt(*editor.environment(), choice->result.assignment, hit) : nullptr;
  editor.material.unassigned = material == nullptr;
  editor.material.id = material == nullptr ? std::string() : material->id;
  editor.wanted_tab[1] = "material";
}

void drawMaterialMenu(Editor& editor) {
  if (!ImGui::BeginPopup(kMenu)) return;
  const auto& [hit, id] = editor.painted;
  const auto* material = editor.offeredMaterial(id);
  const auto why = editor.session.whyNot("materials");
  if (material == nullptr || !editor.environment() || hit.product >= editor.environment()->products.size()) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return;
  }
  ui::dimText(trf("{} on", tr(material->label)));
  for (const auto& scope :
       materialScopes(*editor.environment(), hit, editor.session.document().georeference->shift_m)) {
    const auto label = scope.products > 1
                           ? trf("{}   {} products###{}", scope.title, groupedDigits(scope.products), scope.selector)
                           : fmt::format("{}###{}", scope.title, scope.selector);
    if (ImGui::MenuItem(label.c_str(), nullptr, false, why.empty()))
      editor.materials_asked |= editor.session.start(MaterialsOptions{{.assign = {{scope.selector, material->id}}}},
                                                     trf("Assign {} to {}", tr(material->label), scope.title));
  }
  ui::tooltip(why);
  ImGui::EndPopup();
}

}  // namespace standpoint
