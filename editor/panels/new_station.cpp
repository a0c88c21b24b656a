// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/new_station.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <imgui.h>

#include "editor/model/station_steps.h"
#include "editor/model/walking.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/place_verdict_row.h"
#include "editor/panels/survey_edit.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/widgets/widgets.h"
#include "survey/stations/station_places.h"
#include "survey/stations/storeys.h"

namespace standpoint {

namespace {

constexpr double kSameStorey_m = 1.5;  // from floor to floor, over steps and ramps

struct NewStationState {
  bool shown = false;
  SurveyEdit edit;
};

// In the middle of the storey where a survey begins; metres, the frame of the model's file.
Eigen::Vector3d usualPlace(const Model& model) {
  const auto storeys = storeysFromGround(*model.environment(), model.shift_m().z());
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  if (!storeys.empty() && !storeys.front().box.empty()) {
    place = (storeys.front().box.min + storeys.front().box.max) / 2;
    place.z() = storeys.front().floor_m;
  }
  const Eigen::Vector3d at = place + Eigen::Vector3d(0, 0, kUsualHeight_m) + model.shift_m();
  return (1000 * at.array()).round() / 1000;  // nobody types more than millimetres
}

// On the floor there that is nearest to the height that it has, if it is not farther up or down than this: whoever
// types a place in a wall is told so, and not put on the roof.
void putOnFloor(const Model& model, Eigen::Vector3d& at, double farthest_m) {
  const auto scene = model.picker.scene();
  if (!scene) return;
  const Eigen::Vector3d shift = model.shift_m();
  const double wanted = at.z() - shift.z() - kUsualHeight_m;
  std::optional<double> nearest;
  for (const double floor : floorsAt(*scene, at.x() - shift.x(), at.y() - shift.y(), kUsualHeight_m))
    if (std::abs(floor - wanted) < (nearest ? std::abs(*nearest - wanted) : farthest_m)) nearest = floor;
  if (nearest) at.z() = *nearest + kUsualHeight_m + shift.z();
}

// Whose tripod the new one would stand on; null: nobody's.
const Station* tripodAt(const Job& job, const Eigen::Vector3d& centre) {
  constexpr double kFeet_m = 0.5;
  const auto& stations = job.stations;
  const auto found = std::find_if(stations.begin(), stations.end(), [&](const Station& s) {
    const Eigen::Vector3d away = s.true_pose.translation - centre;
    return away.head<2>().norm() < kFeet_m && std::abs(away.z()) < 2 * kUsualHeight_m;
  });
  return found == stations.end() ? nullptr : &*found;
}

}  // namespace

void drawNewStation(const Model& model, PanelStates& states, Actions& actions) {
  auto& state = states.of<NewStationState>();
  const auto& view = model.view;
  if (view.tool != Tool::placeStation) {
    state.shown = false;
    return;
  }
  auto& edit = state.edit;
  const bool was_refused = edit.refused;
  if (!std::exchange(state.shown, true)) {
    edit = {};
    edit.at = usualPlace(model);
    putOnFloor(model, edit.at, std::numeric_limits<double>::infinity());
  }
  takeRefusal(edit, actions);
  const Eigen::Vector3d shift = model.shift_m();
  if (view.hover && !view.typed_station) {
    // On its way to the fields the pointer crosses walls and roofs.
    const Eigen::Vector3d pointed = view.hover->position + Eigen::Vector3d(0, 0, kUsualHeight_m);
    const auto* found = verdictOfStation(model, pointed, true);
    if (found != nullptr && found->verdict != Verdict::bad) edit.at = pointed + shift;
  }
  const auto name = freeStationName(*model.session.document().job);
  ui::heading(model, trf("New station {}", name).c_str());
  const Eigen::Vector3d before = edit.at;
  if (ui::beginProperties("new-station", 0.36F)) {
    const bool typed = placeRows(edit, "###new-station", model.typing_wanted);
    if (model.typing_wanted) actions.typingBegun();
    if (typed) edit.problem.clear();
    if (typed && edit.at.z() == before.z()) putOnFloor(model, edit.at, kSameStorey_m);
    if (typed || edit.refused != was_refused) actions.holdNewStation({edit.at - shift, edit.refused});
    if (const auto storey = storeyNameAt(model, edit.at.z() - shift.z() - kUsualHeight_m); !storey.empty())
      ui::property("Storey", storey);
    ui::endProperties();
  }
  const auto job = model.session.document().job;  // a copy: the button changes it
  const auto* there = tripodAt(*job, edit.at - shift);
  const std::string taken = there != nullptr ? trf("{} stands there", there->name) : std::string();
  if (!edit.refused && edit.problem.empty() && there == nullptr) {
    drawPlaceVerdict(model, edit.at - shift, true);
  } else if (there != nullptr) {
    ui::verdict(Verdict::bad);
    ui::wrapped(withVerdictWord(Verdict::bad, taken));
  }
  drawProblem(edit);
  const auto* found = verdictOfStation(model, edit.at - shift, true);
  const bool bad = found != nullptr && found->verdict == Verdict::bad;
  const auto why = edit.refused     ? "Correct the number in the red frame first"
                   : !taken.empty() ? taken
                   : bad            ? found->brief
                                    : model.session.whyNot("station");
  if (ui::button(trf(ICON_CHECK "  Add {} here###add-typed", name).c_str(), why, {-FLT_MIN, 0},
                 "Add the station at these coordinates")) {
    actions.holdNewStation({edit.at - shift});
    startEdit(actions, edit, StationOptions{.add = name, .at = edit.at}, trf("Add station {}", name));
    actions.chooseStation(name);
  }
}

}  // namespace standpoint
