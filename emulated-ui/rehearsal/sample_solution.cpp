// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/sample_solution.h"

#include <fmt/format.h>

namespace standpoint {

Result<CarriedOutSolution> carryOutSolution(const Exercise& exercise, const std::string& device, Progress& progress) {
  constexpr double kPrepared = 0.2;  // of the whole, once it is prepared
  const auto& actions = exercise.solution;
  if (actions.empty()) return failure(ErrorKind::unusable, "there is no solution", exercise.file + " /solution");
  TRY_ASSIGN(auto folder, ScratchFolder::make());
  progress.stage("Preparing the environment", 0, kPrepared);
  Progress own;  // the import has stages of its own; here the actions are what counts
  own.onChange([&] {
    if (progress.cancelled()) own.cancel();
  });
  TRY_ASSIGN(auto rehearsal, Rehearsal::start(exercise, device, folder.path(), {}, own));
  CarriedOutSolution carried{std::move(folder), std::move(rehearsal), {}};
  const auto done_at = [&](std::size_t count) {
    return kPrepared + (1 - kPrepared) * static_cast<double>(count) / static_cast<double>(actions.size());
  };
  for (std::size_t i = 0; i < actions.size(); ++i) {
    TRY(progress.check());
    progress.stage("Carrying out the sample solution", done_at(i), done_at(i + 1));
    if (const auto done = carried.rehearsal->act(actions[i], progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      if (carried.refused.empty()) carried.refused = fmt::format("/solution/{} {}", i, describe(done.error()));
    }
  }
  return carried;
}

}  // namespace standpoint
