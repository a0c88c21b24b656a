// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <imgui.h>

#include "survey/quality/quality_limits.h"

namespace standpoint {

// Told apart by people who do not tell red from green, too; each has a sign besides. The tone is for dark plates.
ImU32 verdictTone(Verdict verdict);
ImU32 verdictInk(Verdict verdict);  // the same hue on a panel, as deep as its ground needs
const char* verdictSign(Verdict verdict);
const char* verdictWord(Verdict verdict);  // in English
// The word before what speaks against something: "Check: 29 cm from wall"; what is good says so itself.
std::string withVerdictWord(Verdict verdict, const std::string& said);

namespace ui {

// In the line of what follows, with the word as its tooltip.
void verdict(Verdict verdict);

}  // namespace ui

}  // namespace standpoint
