// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "editor/clouds/cropped_cloud.h"
#include "editor/shell/editor.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/proof_places.h"
#include "emulated-ui/rehearsal/sample_solution.h"
#include "project/task.h"

namespace standpoint {

// Shows in the view what proves that a rule was broken: the student's points, and those of the sample solution at the
// same place. The solution is carried out once for each exercise, in the background, and kept until the program ends.
class MistakeView {
 public:
  // Of a rule with a place (MarkedRule::shown).
  void show(const Rehearsal& rehearsal, const MarkedRule& rule, Editor& editor);
  // Once a frame: what has come goes into the view.
  void follow(Editor& editor);
  // Back to where the camera was. A solution that is on its way goes on, for the next time.
  void end(Editor& editor);
  const std::string& shown() const { return rule_; }  // id; empty: none
  // The solution is on its way, which can take a minute; null when it is not.
  Progress* solving() { return solving_ ? &solving_->progress() : nullptr; }
  void cancelSolving(Editor& editor);

 private:
  struct Side {  // one half of the view
    Cloud cloud;
    PlaceFigure figure;
  };
  using Solution = std::shared_ptr<const CarriedOutSolution>;
  std::unique_ptr<Task<Side>> read(const ProofPlace& place, const Rehearsal& rehearsal, Editor& editor);
  void showSolution(const Solution& solution, Editor& editor);
  void takeSolution(Editor& editor);
  void takeSides(Editor& editor);
  void put(Editor& editor);
  std::string captionOf(const std::string& whose, const Side& side) const;

  std::string rule_, key_;
  ProofPlace place_;
  const Rehearsal* rehearsal_ = nullptr;
  std::string language_;
  CropShape crop_;
  std::map<std::string, Solution> solved_;  // by exercise
  std::unique_ptr<Task<Solution>> solving_;
  std::unique_ptr<Task<Side>> reading_yours_, reading_good_;
  std::unique_ptr<Side> yours_, good_;
};

}  // namespace standpoint
