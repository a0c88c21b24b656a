// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/material_drag.h"

#include <imgui.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr const char* kDragged = "material";  // a payload's text is the material's id

}  // namespace

void dragMaterial(const PhysicalMaterial& material) {
  if (!ImGui::BeginDragDropSource()) return;
  ImGui::SetDragDropPayload(kDragged, material.id.c_str(), material.id.size() + 1);
  ImGui::TextUnformatted(tr(material.label).c_str());
  ImGui::EndDragDropSource();
}

std::optional<std::string> droppedMaterial() {
  if (!ImGui::BeginDragDropTarget()) return std::nullopt;
  const auto* payload = ImGui::AcceptDragDropPayload(kDragged);
  ImGui::EndDragDropTarget();
  if (payload == nullptr) return std::nullopt;
  return static_cast<const char*>(payload->Data);
}

}  // namespace standpoint
