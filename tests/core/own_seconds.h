// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STANDPOINT_WATCHED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define STANDPOINT_WATCHED 1
#endif
#endif

namespace standpoint::test {

// Processor time of this process, for bounds that hostile input must not break: other processes do not count, and
// under a sanitizer a tenth of it does.
inline double ownSeconds() {
#ifdef STANDPOINT_WATCHED
  constexpr double kShare = 0.1;
#else
  constexpr double kShare = 1;
#endif
  return kShare * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace standpoint::test
