// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

struct KeptOptions {
  double tolerance_m = 0.001;              // how far a point may have been moved, by rounding
  std::optional<Eigen::Vector3d> shift_m;  // truth = cleaned + shift; nothing: found, where it is whole metres
};

struct KeptPoints {
  std::vector<std::uint8_t> kept;  // by number in the truth: 1 where it is still there
  std::uint64_t cleaned = 0;       // points of the other file
  std::uint64_t doubled = 0;       // of these more than the truth has there
  std::uint64_t unknown = 0;       // of these where the truth has none
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> first_unknown;  // file frame of the truth
};

// Which points of a cloud another file still has, that somebody made of it with any program: in any order, of any
// format, rounded, and moved by the whole metres that programs take off large coordinates. Points are matched by place,
// one to one: of all pairs within the tolerance always the nearest first, so that a point that is twice in both is kept
// twice, and once where it is once in the other. A shift that nobody states is looked for in steps of 1000, 100, 10 and
// 1 m between the two clouds' boxes, by some hundred points; an error where fewer than half of them have a partner.
//
// Reads both files once for each 8 million points of the two together, and the truth twice more. Memory: one byte for
// each point of the truth and 0.5 GB; points within one cube of a metre are looked at together however many they are.
Result<KeptPoints> keptPoints(const std::filesystem::path& truth, const std::filesystem::path& cleaned,
                              const KeptOptions& options, Progress& progress);

// Of a cloud that was thinned as well: marks as kept (2) what was not, but lies within `spacing_m` of a point that was,
// and is of the same kind: flawed or not (cleaning.h). What then is 0 was removed there altogether. Answers how many it
// marked; memory as above.
Result<std::uint64_t> keepThinned(const std::filesystem::path& truth, double spacing_m, KeptPoints& points,
                                  Progress& progress);

}  // namespace standpoint
