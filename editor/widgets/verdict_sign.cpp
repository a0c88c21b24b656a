// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/verdict_sign.h"

#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

ImU32 verdictTone(Verdict verdict) {
  switch (verdict) {
    case Verdict::good: return IM_COL32(0, 170, 125, 255);
    case Verdict::warn: return IM_COL32(240, 214, 66, 255);
    case Verdict::bad: return IM_COL32(224, 100, 20, 255);
    case Verdict::unknown: break;
  }
  return tone::kDim;
}

ImU32 verdictInk(Verdict verdict) {
  switch (verdict) {
    case Verdict::good: return Tone{verdictTone(verdict), IM_COL32(0, 112, 82, 255)};
    case Verdict::warn: return Tone{verdictTone(verdict), IM_COL32(122, 96, 0, 255)};
    case Verdict::bad: return Tone{verdictTone(verdict), IM_COL32(172, 70, 0, 255)};
    case Verdict::unknown: break;
  }
  return tone::kDim;
}

const char* verdictSign(Verdict verdict) {
  switch (verdict) {
    case Verdict::good: return ICON_CHECK;
    case Verdict::warn: return ICON_WARNING;
    case Verdict::bad: return ICON_BAN;
    case Verdict::unknown: break;
  }
  return ICON_CIRCLE;
}

const char* verdictWord(Verdict verdict) {
  switch (verdict) {
    case Verdict::good: return "Good";
    case Verdict::warn: return "Check";
    case Verdict::bad: return "Bad";
    case Verdict::unknown: break;
  }
  return "Unknown";
}

std::string withVerdictWord(Verdict verdict, const std::string& said) {
  const bool speaks_against = verdict == Verdict::warn || verdict == Verdict::bad;
  return speaks_against ? tr(verdictWord(verdict)) + ": " + said : said;
}

void ui::verdict(Verdict verdict) {
  ImGui::TextColored(colour(verdictInk(verdict)), "%s", verdictSign(verdict));
  tooltip(verdictWord(verdict));
  ImGui::SameLine();
}

}  // namespace standpoint
