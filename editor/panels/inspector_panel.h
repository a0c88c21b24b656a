// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

// What others ask the Inspector for, until it is drawn.
struct InspectorWish {
  bool materials = false;  // that of what is selected is to be chosen: its list opens
};

}  // namespace standpoint
