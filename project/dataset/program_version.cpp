// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/program_version.h"

namespace standpoint {

const char* programVersion() { return STANDPOINT_VERSION; }

}  // namespace standpoint
