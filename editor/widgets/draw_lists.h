// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include <imgui.h>

namespace standpoint {

// Some lists of what Dear ImGui has laid out, to be drawn by themselves.
class DrawListsOf {
 public:
  // The vector is to live as long.
  DrawListsOf(const ImDrawData& laid_out, std::vector<ImDrawList*>& lists) : part_(laid_out) {
    part_.CmdListsCount = static_cast<int>(lists.size());
#if IMGUI_VERSION_NUM >= 18980  // a vector since then, a pointer before
    part_.CmdLists.resize(part_.CmdListsCount);
    std::copy(lists.begin(), lists.end(), part_.CmdLists.begin());
#else
    part_.CmdLists = lists.data();
#endif
  }
  ImDrawData& data() { return part_; }

 private:
  ImDrawData part_;
};

}  // namespace standpoint
