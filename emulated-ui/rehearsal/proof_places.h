// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/result.h"
#include "core/survey.h"
#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

// What of the points shows that a rule was broken.
enum class ProofKind {
  spacing,  // how dense they lie on a surface
  scatter,  // how thick they make a surface
  offset,   // how far off its true place they put a surface
  hole,     // that there are few or none
  stray,    // that there are some which belong to no surface: people, ghosts, drops
  target,   // how well a target is covered
  around,   // nothing of its own: what stands there
};

// Where it shows. Local frame, metres.
struct ProofPlace {
  ProofKind kind = ProofKind::around;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal;  // of the surface, unit, towards the instrument; nothing: no single surface
  double radius_m = 0.5;
  Eigen::Vector3d seen_from_m = Eigen::Vector3d::Zero();  // the instrument's centre
  std::string what;                                       // product or target; may be empty
  std::string station;                                    // of the instrument
  std::uint8_t flags = 0;                                 // of the points that are meant by `stray`
  double offset_m = 0;                                    // of `offset`, along the normal
  double target_radius_m = 0;                             // of `target`
  std::vector<std::string> scans;                         // files that show it; none: nothing was scanned
  bool one_scan = false;                                  // it is a matter of that scan, not of all together
};

// Finds the places of a rehearsal's broken rules, from the facts that prove them and from its points; each file is read
// once. The rehearsal must outlive it.
class ProofPlaces {
 public:
  explicit ProofPlaces(const Rehearsal& rehearsal);
  ~ProofPlaces();
  // Nothing where no place proves it: an order of steps, an answer, a setting that leaves no trace in the points, or a
  // scan that is gone.
  std::optional<ProofPlace> of(const ExerciseRule& rule, const Rehearsal::RuleState& state);

 private:
  class Finder;
  std::unique_ptr<Finder> finder_;
};

// "West wall, 4.2 m from S1", in a language.
std::string placeText(const ProofPlace& place, const Rehearsal& rehearsal, const std::string& language);

// A scan as it is to be looked at: by its true place, or where the work of whoever made it puts it.
struct PlacedScan {
  std::string file, station;
  Pose local_from_scanner;
  std::optional<std::uint64_t> on_target;  // points by which the device fitted the place's target, if it found it
};
// Those that show the place: `offset` is shown as delivered, everything else where it truly is.
Result<std::vector<PlacedScan>> scansOf(const ProofPlace& place, const Rehearsal& rehearsal);
// The same place in another rehearsal of the exercise, such as one of its solution: its scans from the same station,
// all where it has none from there. A target is where that rehearsal has it.
ProofPlace samePlace(const ProofPlace& place, const Rehearsal& other);

// What the points are there.
struct PlaceFigure {
  std::uint64_t points = 0;
  std::optional<double> value_mm;  // of `spacing`, `scatter` and `offset`; nothing: too few points for it
};
Result<PlaceFigure> figureAt(const ProofPlace& place, const std::vector<PlacedScan>& scans, Progress& progress);
// "Point spacing: 12.4 mm", "Points: 0", in a language.
std::string figureText(const ProofPlace& place, const PlaceFigure& figure, const Rehearsal& rehearsal,
                       const std::string& language);

}  // namespace standpoint
