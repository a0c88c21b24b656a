// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "editor/model/material_edit.h"

namespace standpoint {

class Actions;
struct Model;

struct MaterialCardState {
  std::optional<MaterialEdit> edit;  // the card shows its fields
  double incidence_deg = 0;          // of the card's readings
};

// In the card's place, while a material is edited.
void drawMaterialForm(const Model& model, MaterialCardState& state, Actions& actions);

}  // namespace standpoint
