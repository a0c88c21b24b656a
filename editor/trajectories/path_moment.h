// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

// The moment of a trajectory at which its instrument is drawn; all others are drawn where they begin.
struct PathMoment {
  std::string trajectory;  // its name
  double after_s = 0;      // since it begins
  bool plays = false;      // it goes on by itself, as fast as it is walked
  bool follows = true;     // the view goes along while it plays
};

}  // namespace standpoint
