// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

#include "core/physical_material.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

struct Editor;

// Materials are given to surfaces by dragging them there from a list, or by the brush; a menu asks how far that goes.
void acceptMaterial(Editor& editor, ImVec2 origin);     // after the scene's item
void paintMaterial(Editor& editor, const RayHit& hit);  // with the chosen one
void takeMaterial(Editor& editor, const RayHit& hit);   // the eyedropper: chooses what is there
void drawMaterialMenu(Editor& editor);

}  // namespace standpoint
