// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/moving.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <numbers>
#include <string>

#include "editor/model/stairs.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/live_overlay.h"
#include "editor/shell/overlay.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/verdict_sign.h"

namespace standpoint {

namespace {

constexpr float kMostTicks = 5;       // of a wheel in one frame: what a touchpad sends that was not answered in time
constexpr double kTurn_px = 14;       // of a drag, that a tick to the side turns as much as
constexpr double kPan_px = 28;        // of a drag
constexpr double kTurnWalking = 0.1;  // rad for each tick
constexpr int kTightRingCorners = 32;
constexpr double kHint_s = 8;  // of a scan, for which its keys are said

double axis(int less, int more) { return (keyboard::held(more) ? 1.0 : 0.0) - (keyboard::held(less) ? 1.0 : 0.0); }

// The panel beside the view has the same device.
void lookAtScreen(Editor& editor) {
  lookAtInstrument(editor);
  editor.workspace = Workspace::instrument;
}

bool moves(const Editor& editor) { return editor.view.tool == Tool::walk || editor.view.tool == Tool::fly; }

// The figures of a place in the file's frame, without "-0.00".
std::string placeText(const Editor& editor, const Eigen::Vector3d& local) {
  const auto toCentimetre = [](double x) { return std::round(100 * x) / 100 + 0.0; };
  const Eigen::Vector3d p = (local + editor.shift_m()).unaryExpr(toCentimetre);
  return figures("{:.2f}  {:.2f}  {:.2f} m", p.x(), p.y(), p.z());
}

std::string walkLine(const Editor& editor) {
  const auto& walk = editor.walk;
  if (editor.recording.live.active()) return walk.note();  // the scan's own line has what counts then
  std::string line = placeText(editor, walk.feet());
  if (const auto name = walkPlaceName(editor); !name.empty()) line += "   " + name;
  line += trf("   eye {:.2f} m   {:.1f} m/s", walk.eyeHeight_m(), walk.speed_mps(false));
  if (const auto& record = editor.recording.record; record.active())
    line += "   " + trf("recording {}, {:.1f} m", durationText(record.seconds()), record.length_m());
  if (const auto note = walk.note(); !note.empty()) line += "   " + note;
  return line;
}

}  // namespace

void clickWalking(Editor& editor) {
  if (const auto label = editor.pointed_label; label && label->kind == LabelKind::stair)
    return takeStair(editor, static_cast<std::uint32_t>(label->index));
  if (!instrumentInReach(editor)) return;
  constexpr double kRadius_m = 0.25;  // around the beam's origin: the whole of any instrument
  const ImVec2 p = ImGui::GetIO().MousePos, low = ImGui::GetItemRectMin();
  const auto ray = rayThrough(editor.view.camera, {p.x - low.x, p.y - low.y}, editor.view.size);
  const auto scene = editor.viewState().working;
  if (!scene) return;
  const Eigen::Vector3d to = scene->stands.centre_m - ray.origin;
  const double along = to.dot(ray.direction);
  if (along > 0 && (to - along * ray.direction).norm() < kRadius_m) lookAtScreen(editor);
}

namespace {

void invokeOrSay(Editor& editor, const char* id) {
  if (const auto why = whyNot(*findAction(id), editor); !why.empty()) return editor.say(tr(why));
  invoke(editor, id);
}

// What hands do: with the instrument, and with a sphere; and going out of its sight.
void handleHands(Editor& editor) {
  if (editor.fieldwork.at_screen) {
    if (keyboard::pressed('F')) lookUp(editor);
    return;
  }
  if (!editor.walk.active()) return;
  if (keyboard::pressed('F') && instrumentInReach(editor)) return lookAtScreen(editor);
  if (keyboard::pressed('G') && editor.held.carried) return putDownInstrument(editor);
  if (keyboard::pressed('G') && !editor.held.instrument.empty()) {
    if (const auto why = whyNotPickUp(editor); !why.empty()) return editor.say(tr(why));
    return pickUpInstrument(editor);
  }
  if (keyboard::pressed('Q')) return invokeOrSay(editor, "take-stair");
  if (keyboard::pressed('H')) return invokeOrSay(editor, "step-out-of-sight");
  if (keyboard::pressed('R')) return invokeOrSay(editor, "return-to-instrument");
  if (keyboard::pressed('B') && !putUpSphere(editor)) editor.say(tr("No surface within 3 m to put a sphere on"));
}

}  // namespace

void handleMoving(Editor& editor) {
  const auto& io = ImGui::GetIO();
  const bool keys_are_ours = !io.WantTextInput && !editor.device_has_keys && !io.KeyCtrl && !io.KeyAlt &&
                             !ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId);
  if (editor.view.tool == Tool::fly) {
    FlyKeys keys;
    if (keys_are_ours) keys = {{axis('A', 'D'), axis('S', 'W'), axis('Q', 'E')}, io.KeyShift};
    editor.fly.go(keys, io.DeltaTime, editor.view.camera);
  }
  if (keys_are_ours) handleHands(editor);
  if (!editor.walk.active()) return;
  WalkKeys keys;
  if (keys_are_ours) keys = {{axis('A', 'D'), axis('S', 'W')}, io.KeyShift, keyboard::held('C')};
  if (keys_are_ours && keyboard::pressed('E')) editor.walk.toggleDoor(editor.view.camera);
  editor.walk.go(keys, io.DeltaTime, editor.view.camera);
}

void handleWheel(Editor& editor, ImVec2 origin) {
  const auto& io = ImGui::GetIO();
  const double up = std::clamp(io.MouseWheel, -kMostTicks, kMostTicks),
               aside = std::clamp(io.MouseWheelH, -kMostTicks, kMostTicks);
  if (up == 0 && aside == 0) return;
  auto& view = editor.view;
  auto& camera = view.camera;
  if (moves(editor)) {
    if (view.tool == Tool::walk) editor.walk.changeSpeed(up);
    if (view.tool == Tool::fly) editor.fly.changeSpeed(up);
    const Eigen::Vector3d eye = camera.eye();
    camera.azimuth_rad = std::remainder(camera.azimuth_rad + kTurnWalking * aside, 2 * std::numbers::pi);
    camera.target = eye + camera.forward() * camera.distance_m;
    return;
  }
  const Eigen::Vector2d pixel(io.MousePos.x - origin.x, io.MousePos.y - origin.y);
  const auto ray = rayThrough(camera, pixel, view.size);
  const Eigen::Vector3d on_target_plane =
      ray.origin +
      ray.direction * ((camera.target - ray.origin).dot(camera.forward()) / ray.direction.dot(camera.forward()));
  const Eigen::Vector3d anchor = view.hover ? view.hover->position : on_target_plane;
  if (io.KeyShift) {
    const double depth = std::max(0.1, (anchor - camera.eye()).dot(camera.forward()));
    return pan(camera, kPan_px * Eigen::Vector2d(aside, up), view.size, depth);
  }
  if (io.KeyCtrl) return zoom(camera, up, camera.target);
  if (up != 0) zoom(camera, up, anchor);
  if (aside != 0) orbit(camera, {kTurn_px * aside, 0}, anchor);
}

bool movesByKey(const Editor& editor, int key) {
  const bool letter = key > 0 && key < 128;
  if (editor.fieldwork.at_screen && key == 'F') return true;
  if (editor.view.tool == Tool::walk && letter && std::strchr("FGBHRQ", key) != nullptr) return true;
  return moves(editor) && letter && std::strchr("WASDCEQ", key) != nullptr;
}

void movingChips(Editor& editor) {
  if (!editor.walk.active()) return;
  const auto field = [&](const char* id, double& value, const NumberFormat& format, const char* tip) {
    beside(editor, editor.px(104));
    ImGui::SetNextItemWidth(editor.px(104));
    return ui::numberField(id, value, format, tip);
  };
  constexpr NumberKind kEyes = {.unit = "m eyes", .least = Walk::kLowestEyes_m, .most = Walk::kHighestEyes_m};
  constexpr NumberKind kAngle = {.unit = "° view", .least = Walk::kNarrowestView_deg, .most = Walk::kWidestView_deg};
  double eyes = editor.walk.uprightEyes_m(), angle = editor.walk.viewAngle_deg();
  if (field("###eye-height", eyes, {.kind = kEyes, .decimals = 2, .drag = 0.01}, "Eye height, standing upright"))
    editor.walk.setUprightEyes(eyes);
  if (field("###view-angle", angle, {.kind = kAngle, .decimals = 0, .drag = 0.5}, "Vertical angle of view"))
    editor.walk.setViewAngle(angle, editor.view.camera);
  walkingChips(editor);
  if (editor.held.instrument.empty()) return;
  float width = ImGui::GetStyle().ItemSpacing.x;
  for (const char* id : {"step-out-of-sight", "return-to-instrument"})
    width += chipWidth(editor, findAction(id)->icon, 0);
  beside(editor, width);
  drawPlate(editor, ImGui::GetCursorScreenPos(), {width, ImGui::GetFrameHeight()});
  actionToolButton(editor, "step-out-of-sight");
  actionToolButton(editor, "return-to-instrument");
  ImGui::NewLine();
}

namespace {

std::string hints(std::initializer_list<const char*> parts) {
  std::string joined;
  for (const char* part : parts)
    if (*part != 0) joined += (joined.empty() ? "" : "   ") + tr(part);
  return joined;
}

// What is at hand first, then how one goes on.
std::string walkingHint(const Editor& editor) {
  constexpr const char* kGo = "W A S D to walk, drag to look, Shift to run, C to crouch";
  constexpr const char* kElsewhere = "T to teleport to the pointer, Ctrl+G to go to a room or upstairs";
  constexpr const char* kLeave = "Esc to leave";
  const auto& walk = editor.walk;
  if (walk.goesByItself()) return hints({"W A S D to stop here", "Alt+Left for the previous view", kLeave});
  const char* back = canUndoJump(editor) ? "Alt+Left for the previous view" : "";
  const bool door = walk.doorInReach(editor.view.camera);
  const auto stairs = stairsAhead(editor, editor.viewState());
  const char* stair = stairs.empty()      ? ""
                      : stairs.front().up ? "Q, or a click on its label, to walk up the stair"
                                          : "Q, or a click on its label, to walk down the stair";
  return hints({door ? "E to open or close the door" : "", stair, back, kGo,
                door ? "T to teleport to the pointer" : kElsewhere, kLeave});
}

}  // namespace

std::optional<std::string> movingHint(const Editor& editor) {
  if (editor.view.tool == Tool::fly)
    return tr("W A S D to fly, E up, Q down, Shift faster, U to walk, drag to look around   Esc to leave");
  if (editor.fieldwork.at_screen) return tr("F to look up   Esc to leave");
  if (editor.view.tool != Tool::walk) return std::nullopt;
  // Who scans looks at what is scanned; the button over the view ends it, too.
  if (const auto& recording = editor.recording; recording.live.active())
    return recording.record.seconds() < kHint_s ? tr("W A S D to walk, drag to look   Ctrl+Shift+L to end the scan")
                                                : std::string();
  if (editor.held.carried)
    return tr("G to put the instrument down here   W A S D to walk, Shift to run   Esc to leave");
  if (instrumentInReach(editor))
    return tr(
        "F to look at the instrument's screen, G to carry it, H to step out of its sight, B to put up a sphere   "
        "W A S D to walk   Esc to leave");
  if (!editor.held.instrument.empty() && !editor.walk.doorInReach(editor.view.camera))
    return tr(
        "R to return to the instrument, H to step out of its sight   W A S D to walk, T to teleport to the pointer, "
        "B to put up a sphere   Esc to leave");
  return walkingHint(editor);
}

std::string movingLine(const Editor& editor) {
  if (editor.walk.active()) return walkLine(editor);
  if (editor.view.tool != Tool::fly) return {};
  return placeText(editor, editor.view.camera.eye()) + figures("   {:.1f} m/s", editor.fly.speed_mps(false));
}

void drawTightPlaces(const Editor& editor, ImVec2 origin) {
  const auto& collision = editor.session.document().collision;
  if (!collision) return;
  const ViewPen pen(editor, origin);
  const ImU32 tone = verdictTone(Verdict::bad);
  for (const auto& room : collision->rooms) {
    const auto& low = room.tight_place;
    const bool flown_to = low && editor.view.flown_to && (*editor.view.flown_to - low->position).norm() < 0.01;
    if (!low || !(editor.view.walkable || flown_to)) continue;
    const Eigen::Vector3d top = low->position + Eigen::Vector3d(0, 0, low->headroom_m);
    for (const auto& middle : {low->position, top}) {
      std::array<Eigen::Vector3d, kTightRingCorners> rim;
      for (std::size_t i = 0; i < rim.size(); ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kTightRingCorners;
        rim[i] = middle + editor.walker.radius_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      }
      pen.ring(rim, tone, 2.5F);
    }
    pen.rod(low->position, top, tone, 2.5F);
    if (const auto at = pen.at(top))
      pen.plate({at->x + editor.px(10), at->y}, verdictSign(Verdict::bad), tone,
                tightPlaceName(*low, editor.walker) + ", " + whoPasses(*low));
  }
}

}  // namespace standpoint
