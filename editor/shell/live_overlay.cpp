// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/live_overlay.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "core/number_text.h"
#include "core/units.h"
#include "editor/colours/colour_scale.h"
#include "editor/model/scan_form.h"
#include "editor/model/walk_recording_steps.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/overlay.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr float kBannerRims_pt = 32;

std::string paceText(const WalkPace& pace) {
  return figures("{:.1f} m/s   {:.0f}°/s", pace.speed_mps(), pace.turn_radps() / kRadPerDeg);
}

// As much of it as one line has room for.
std::string scanningText(const Editor& editor, float room) {
  const auto& recording = editor.recording;
  const LiveFigures& scan = recording.live.figures();
  if (!scan.problem.empty()) return trf("No live points: {}. The walk is recorded.", scan.problem);
  const std::string gap = "   ";
  const std::string walked =
      durationText(recording.record.seconds()) + gap + figures("{:.1f} m", recording.record.length_m());
  const std::string points = trf("{} points", groupedDigits(scan.points));
  const std::string rate =
      trf("{} per second", groupedDigits(1000 * static_cast<std::uint64_t>(scan.points_per_s / 1000 + 0.5)));
  const std::string thinned = scan.one_pulse_in > 1 ? gap + trf("1 pulse in {}", scan.one_pulse_in) : "";
  const std::string pace = gap + paceText(recording.pace), begin = tr("Live preview") + gap + walked + gap + points;
  for (const auto& text : {begin + gap + rate + thinned + pace, begin + thinned + pace})
    if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  return walked + gap + points + pace;
}

std::string readoutText(const Editor& editor, float room) {
  const auto& recording = editor.recording;
  if (recording.scan_wanted) return tr("Preparing the scan …");
  if (recording.live.active()) return scanningText(editor, room);
  if (recording.record.active()) return paceText(recording.pace);
  if (recording.live.empty()) return {};
  return trf("Live preview, {} points: no noise and no trajectory error in it",
             groupedDigits(recording.live.figures().points));
}

// As devices say it: what to do, and by how much.
std::string warningText(const Editor& editor) {
  const auto& recording = editor.recording;
  const WalkPace& pace = recording.pace;
  if (!recording.record.active()) return {};
  std::string text;
  if (pace.tooFast())
    text = trf("Slow down: {:.1f} m/s, at most {:.3g} m/s", pace.speed_mps(), pace.limits().speed_mps);
  if (!pace.turnsTooFast()) return text;
  if (!text.empty()) text += "   ";
  return text + trf("Turn more slowly: {:.0f}°/s, at most {:.0f}°/s", pace.turn_radps() / kRadPerDeg,
                    pace.limits().turn_radps / kRadPerDeg);
}

void instrumentChip(Editor& editor) {
  const Instrument* const chosen = carriedOnFoot(editor);
  const std::string label =
      chosen == nullptr ? tr("Choose a scanner…") : fmt::format("{} {}", chosen->maker, chosen->model);
  const float width = chipWidth(editor, label, 120);
  beside(editor, width);
  drawChipGround(editor, width);
  ImGui::SetNextItemWidth(width);
  ImGui::BeginDisabled(scansWalk(editor));
  if (ui::beginDropDown("###live-instrument", label.c_str(),
                        ImGuiComboFlags_NoArrowButton | ImGuiComboFlags_HeightLarge)) {
    for (const auto& i : editor.catalogue().instruments)
      if (i.moving && carrierOnFoot(i.moving->mount) != nullptr &&
          ui::choice(fmt::format("{} {}###live-{}", i.maker, i.model, i.id).c_str(), chosen == &i))
        chooseInstrument(editor.carried_scan.choice, i);
    ui::endDropDown();
  } else {
    ui::tooltip("Scanner to carry");
  }
  ImGui::EndDisabled();
}

// As wide while it is on: no other chip comes under the pointer.
void wordedButton(Editor& editor, const char* id, const char* word) {
  const Action& action = *findAction(id);
  const std::string begin = fmt::format("{}  {}", action.icon, tr(word)),
                    end = fmt::format("{}  {}", ICON_STOP, tr("Stop"));
  const float width = std::max(chipWidth(editor, begin, 0), chipWidth(editor, end, 0));
  const std::string tip = tr(action.title) + "  (" + shortcutText(action.shortcut) + ")";
  beside(editor, width);
  if (ui::button(fmt::format("{}###tool_{}", action.on(editor) ? end : begin, id).c_str(), whyNot(action, editor),
                 {width, 0}, tip.c_str()))
    action.run(editor);
}

const char* liveColourName(LiveColour colour) {
  return colour == LiveColour::height ? "Height above the feet" : "Range";
}

// What the colours mean, in the row of the chip that chooses them: nothing else of the view can lie over it.
void scaleChip(const Editor& editor) {
  constexpr int kSteps = 32;
  const std::string most = trf("{:.0f} m or more", liveScale_m(editor.recording.live.colour()));
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  const float bar = editor.px(110), bar_height = editor.px(8), gap = editor.px(5), frame = ImGui::GetFrameHeight();
  const float zero = ImGui::CalcTextSize("0").x,
              width = 2 * pad.x + zero + bar + 2 * gap + ImGui::CalcTextSize(most.c_str()).x;
  beside(editor, width);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  auto& list = *ImGui::GetWindowDrawList();
  drawChipGround(editor, width);
  list.AddText({at.x + pad.x, at.y + pad.y}, tone::kDim, "0");
  const float from = at.x + pad.x + zero + gap, y = at.y + (frame - bar_height) / 2;
  for (int i = 0; i < kSteps; ++i)
    list.AddRectFilled({from + bar * static_cast<float>(i) / kSteps, y},
                       {from + bar * static_cast<float>(i + 1) / kSteps, y + bar_height},
                       packed(viridis((i + 0.5) / kSteps)));
  list.AddText({from + bar + gap, at.y + pad.y}, tone::kDim, most.c_str());
  ImGui::Dummy({width, frame});
}

}  // namespace

void drawWalkedRibbon(const Editor& editor, const ViewState& state, ImVec2 origin) {
  constexpr double kHalf_m = 0.12, kAbove_m = 0.03;
  constexpr std::size_t kMostPlaces = 400;
  if (!editor.recording.record.active()) return;
  const auto& places = editor.recording.pace.places();
  const ViewPen pen(editor, origin);
  auto& list = *ImGui::GetWindowDrawList();
  const auto flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // no seams between the parts
  const std::size_t first = places.size() > kMostPlaces ? places.size() - kMostPlaces : 0;
  for (std::size_t i = first + 1; i < places.size(); ++i) {
    const Vector3d up(0, 0, kAbove_m), from = places[i - 1].feet + up, to = places[i].feet + up, leg = to - from;
    Vector3d side(-leg.y(), leg.x(), 0);
    if (side.norm() < 1e-6 || !editor.picker.isInSight(to, state)) continue;
    side *= kHalf_m / side.norm();
    const auto a = pen.at(from + side), b = pen.at(to + side), c = pen.at(to - side), d = pen.at(from - side);
    const ImU32 tone = (places[i].hurried ? ImU32(tone::kBad) : ImU32(tone::kAccent)) & ~IM_COL32_A_MASK;
    if (a && b && c && d) list.AddQuadFilled(*a, *b, *c, *d, tone | (170U << IM_COL32_A_SHIFT));
  }
  list.Flags = flags;
}

std::vector<Banner> liveReadouts(const Editor& editor, float width) {
  const auto warning = warningText(editor);
  return {{readoutText(editor, width - editor.px(kBannerRims_pt))},
          {warning.empty() ? warning : ICON_WARNING "  " + warning, banner::kTooFast}};
}

void walkingChips(Editor& editor) {
  wordedButton(editor, "record-walk", "Record");
  wordedButton(editor, "scan-walk", "Scan live");
  instrumentChip(editor);
}

void livePointChips(Editor& editor) {
  auto& live = editor.recording.live;
  if (live.empty()) return;
  if (!editor.walk.active()) nextRow();
  const std::string colours = ICON_PAINT "  " + tr(liveColourName(live.colour()));
  ImGui::SetNextItemWidth(chipWidth(editor, colours, 120));
  if (ui::beginDropDown("###live-colour", colours.c_str(), ImGuiComboFlags_NoArrowButton)) {
    for (const auto colour : {LiveColour::height, LiveColour::range})
      if (ui::choice(ui::Label(liveColourName(colour)), live.colour() == colour)) live.colourBy(colour);
    ui::endDropDown();
  } else {
    ui::tooltip("By what live points are coloured");
  }
  scaleChip(editor);
  if (live.active()) return;
  const auto& name = editor.recording.scanned;
  if (!name.empty()) {
    const std::string label = std::string(ICON_PLAY "  ") + trf("Scan along {}", name);
    beside(editor, chipWidth(editor, label, 0));
    const auto& scan = *findAction("scan-walked");
    if (ui::button((label + "###scan-walked").c_str(), whyNot(scan, editor), {0, 0},
                   "The real scan of this walk, with noise and trajectory error"))
      scan.run(editor);
  }
  beside(editor, chipWidth(editor, ICON_CLOSE, 0));
  const auto& drop = *findAction("drop-live-points");
  drawPlate(editor, ImGui::GetCursorScreenPos(), {chipWidth(editor, ICON_CLOSE, 0), ImGui::GetFrameHeight()});
  if (ui::iconButton(ICON_CLOSE "###drop-live-points", drop.title, whyNot(drop, editor))) drop.run(editor);
}

}  // namespace standpoint
