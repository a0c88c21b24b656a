// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

const char* programVersion();  // "0.9.0"

}  // namespace standpoint
