// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "editor/model/picker.h"
#include "editor/model/view_state.h"
#include "project/survey/survey_verbs.h"
#include "survey/trajectories/path_coverage.h"

namespace standpoint {

struct Model;

// The holes of the coverage that was computed last, be it of the plan, of the scans or of trajectories.
struct ShownHoles {
  enum class Of { plan, scans, trajectories };
  const std::vector<PlanPatch>* patches = nullptr;  // null: none was computed, or the project has changed since
  Of of = Of::plan;
};
ShownHoles shownHoles(const Model& model);

const char* wordsOf(Blindness blind);  // why a surface is blind along trajectories; English

// What of a hole is in a picture. Local frame.
struct HoleInSight {
  const PlanPatch* patch = nullptr;
  std::vector<std::array<Eigen::Vector3d, 4>> fill;  // rectangles
  std::vector<std::array<Eigen::Vector3d, 2>> hatching, rim;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // the shown place that is the nearest to its middle
};

// Of each hole the squares that nothing hides, largest first. In a plan all that do not face down and are between the
// floor of the storey that is cut and the cut, also below a table. Kept as long as nothing changes.
class HolesInSight {
 public:
  const std::vector<HoleInSight>& of(const Model& model, const std::vector<PlanPatch>& patches, const ViewState& view);

 private:
  const std::vector<PlanPatch>* patches_ = nullptr;
  ViewState view_;
  bool could_pick_ = false;
  std::vector<HoleInSight> holes_;
};

}  // namespace standpoint
