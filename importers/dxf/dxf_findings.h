// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/report.h"
#include "importers/dxf/dxf_drawing.h"

namespace standpoint {

// What of a drawing is not in the model.
struct DxfFindings {
  DxfTallies lost;     // by sentence
  DxfTallies skipped;  // entities without faces, by kind
  DxfTally hidden;     // on layers that are off or frozen
};

// In the order of the file, with the remedy where there is one.
void tellDxf(const DxfFindings& findings, const DxfDrawing& drawing, Report& report);

}  // namespace standpoint
