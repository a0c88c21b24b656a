// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/task.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace standpoint {

// Linux keeps niceness for each thread, and a thread begins with that of its starter. Ten more are a tenth.
void computeInBackground() {
  constexpr int kNicer = 10;
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));
  setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kNicer);
}

}  // namespace standpoint
