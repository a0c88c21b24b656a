// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/progress.h"

namespace standpoint {

// For work with stages of its own from 0 to 1 that is only a part of the current stage of a whole, [from, to] of it:
// the whole goes on by as much and never back, and takes its cancel along. The whole must outlive it.
class ProgressPart final : public Progress {
 public:
  ProgressPart(Progress& whole, double from, double to) {
    onChange([this, &whole, from, to] {
      whole.advance(from + (to - from) * fraction());
      if (whole.cancelled()) cancel();
    });
    if (whole.cancelled()) cancel();
  }
};

}  // namespace standpoint
