// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/shown_holes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <tbb/parallel_for.h>

#include "editor/model/model.h"
#include "project/survey/assess_verb.h"
#include "project/survey/coverage_verb.h"
#include "survey/stations/storeys.h"

namespace standpoint {

namespace {

constexpr double kBefore_m = 0.03;  // of its surface: so far one looks for what hides it
constexpr double kBelowFloor_m = 0.05;
constexpr double kJustAbove_m = 0.002;
constexpr double kBuilt_m = 0.3;  // of air over a surface at most, where that is within a floor and not under furniture
constexpr double kDownwards = -0.3;  // z of the normal of what a plan has no place for: undersides of tables and slabs

// The floor of the storey that a plan shows; nothing where there is no plan.
std::optional<double> planFloor(const Model& model, const ViewState& view) {
  if (!view.cut_height_m || !looksStraightDown(view.camera)) return std::nullopt;
  std::optional<double> floor;
  for (const auto& storey : model.storeys())
    if (storey.elevation_m <= *view.cut_height_m)
      floor = std::max(floor.value_or(storey.elevation_m), storey.elevation_m);
  return floor;
}

class Sight {
 public:
  Sight(const Model& model, const ViewState& view) : model_(model), view_(view), floor_(planFloor(model, view)) {}
  bool shows(const HoleShape& shape, const Eigen::Vector3d& middle) const {
    if (view_.cut_height_m && middle.z() > *view_.cut_height_m) return false;
    if (floor_ && shape.normal.z() < kDownwards) return false;
    if (floor_ && middle.z() > *floor_ - kBelowFloor_m) {
      const Eigen::Vector3d over = middle + Eigen::Vector3d(0, 0, kJustAbove_m);
      return shape.normal.z() < -kDownwards || model_.picker.sees(over, over + Eigen::Vector3d(0, 0, kBuilt_m), view_);
    }
    const Eigen::Vector3d before =
        middle + (shape.normal.dot(view_.camera.forward()) > 0 ? -kBefore_m : kBefore_m) * shape.normal;
    return model_.picker.isInSight(before, view_);
  }

 private:
  const Model& model_;
  const ViewState& view_;
  std::optional<double> floor_;
};

// From each square on that none comes before, as far as they follow one another by that step; calls with first and
// last.
template <class Do>
void eachRun(const std::set<HoleSquare>& squares, const HoleSquare& step, const Do& act) {
  for (const auto& first : squares) {
    if (squares.contains({first[0] - step[0], first[1] - step[1]})) continue;
    HoleSquare last = first;
    for (HoleSquare next = first; squares.contains(next); next = {next[0] + step[0], next[1] + step[1]}) last = next;
    act(first, last);
  }
}

// Columns of squares as rectangles, and their diagonals as lines through all of the hole.
HoleInSight inSight(const PlanPatch& patch, const std::set<HoleSquare>& shown, const Eigen::Vector3d& shift_m) {
  HoleInSight hole;
  if (shown.empty()) return hole;
  const auto& shape = patch.shape;
  hole.patch = &patch;
  eachRun(shown, {0, 1}, [&](const HoleSquare& a, const HoleSquare& b) {
    const int top = b[1] + 1;
    hole.fill.push_back(
        {shape.corner(a), shape.corner({a[0] + 1, a[1]}), shape.corner({a[0] + 1, top}), shape.corner({a[0], top})});
  });
  eachRun(shown, {1, 1}, [&](const HoleSquare& a, const HoleSquare& b) {
    hole.hatching.push_back({shape.corner(a), shape.corner({b[0] + 1, b[1] + 1})});
  });
  for (const auto& [a, b] : rimOf(shown)) hole.rim.push_back({shape.corner(a), shape.corner(b)});
  const Eigen::Vector3d at = patch.at - shift_m;
  const auto nearest = std::min_element(shown.begin(), shown.end(), [&](const auto& a, const auto& b) {
    return (shape.middle(a) - at).squaredNorm() < (shape.middle(b) - at).squaredNorm();
  });
  hole.middle = shape.middle(*nearest);
  return hole;
}

}  // namespace

ShownHoles shownHoles(const Model& model) {
  const auto& session = model.session;
  const auto *plan = session.lastOf("plan"), *assess = session.lastOf("assess"), *walked = session.lastOf("coverage");
  for (const auto& task : session.finished()) {
    if ((&task != plan && &task != assess && &task != walked) || session.isOutOfDate(task)) continue;
    if (const auto* answer = answerAs<PlanAnswer>(task.answer)) return {&answer->patches, ShownHoles::Of::plan};
    if (const auto* answer = answerAs<AssessAnswer>(task.answer)) return {&answer->patches, ShownHoles::Of::scans};
    if (const auto* answer = answerAs<CoverageAnswer>(task.answer))
      return {&answer->blind, ShownHoles::Of::trajectories};
  }
  return {};
}

const char* wordsOf(Blindness blind) {
  switch (blind) {
    case Blindness::covered: return "Covered";
    case Blindness::passed_by: return "Hidden by a mover";
    case Blindness::sparse: return "Too few points";
    case Blindness::grazing: return "Grazing incidence only";
    case Blindness::out_of_view: return "Outside the field of view";
    case Blindness::out_of_range: return "Out of range";
    case Blindness::occluded: return "Occluded along this path";
    case Blindness::unreachable: return "Not visible from any walkable place";
  }
  return "";
}

const std::vector<HoleInSight>& HolesInSight::of(const Model& model, const std::vector<PlanPatch>& patches,
                                                 const ViewState& view) {
  const bool can_pick = model.picker.ready();
  if (&patches == patches_ && can_pick == could_pick_ && view == view_) return holes_;
  patches_ = &patches, view_ = view, could_pick_ = can_pick;
  const Sight sight(model, view);
  std::vector<HoleInSight> all(patches.size());
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t k) {  // each into its own slot
    const auto& shape = patches[k].shape;
    std::set<HoleSquare> shown;
    for (const auto& s : shape.squares)
      if (sight.shows(shape, shape.middle(s))) shown.insert(s);
    all[k] = inSight(patches[k], shown, model.shift_m());
  });
  holes_.clear();
  for (auto& hole : all)
    if (hole.patch != nullptr) holes_.push_back(std::move(hole));
  return holes_;
}

}  // namespace standpoint
