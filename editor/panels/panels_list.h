// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;

void drawCollisionPanel(Editor& editor);
void drawFindingsPanel(Editor& editor);
void drawGeoreferencePanel(Editor& editor);
void drawInspectorPanel(Editor& editor);
void drawInstrumentPanel(Editor& editor);
void drawLogPanel(Editor& editor);
void drawMaterialCardPanel(Editor& editor);
void drawMaterialForm(Editor& editor);  // in the card's place, while a material is edited
void drawMaterialsPanel(Editor& editor);
void drawOptimisePanel(Editor& editor);
void drawOutlinerPanel(Editor& editor);
void drawPlanPanel(Editor& editor);
void drawScanPanel(Editor& editor);
void drawSurveyPanel(Editor& editor);
void drawTargetsPanel(Editor& editor);
void drawTasksPanel(Editor& editor);
void drawVerifyPanel(Editor& editor);

}  // namespace standpoint
