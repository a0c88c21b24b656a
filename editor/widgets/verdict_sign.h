// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

#include "survey/quality/quality_limits.h"

namespace standpoint {

// Told apart by people who do not tell red from green, too; each has a sign besides. The tone is for dark plates.
ImU32 verdictTone(Verdict verdict);
ImU32 verdictInk(Verdict verdict);  // the same hue on a panel, as deep as its ground needs
const char* verdictSign(Verdict verdict);

}  // namespace standpoint
