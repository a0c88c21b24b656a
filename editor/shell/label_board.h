// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "editor/labels/label_layout.h"

namespace standpoint {

// Collects what shall be written over the view, and writes it so that nothing covers anything: who was asked for first
// has the right of way.
class LabelBoard {
 public:
  LabelBoard(ImVec2 origin, ImVec2 size, float scale) : origin_(origin), size_(size), scale_(scale) {}

  // `texts` from the fullest to the shortest, lines apart by '\n'. Over `p`, or around it.
  void over(ImVec2 p, std::vector<std::string> texts, ImU32 tone) { add(p, std::move(texts), tone, false); }
  void around(ImVec2 p, std::vector<std::string> texts, ImU32 tone) { add(p, std::move(texts), tone, true); }
  void draw(ImDrawList& list) const;

 private:
  void add(ImVec2 p, std::vector<std::string> texts, ImU32 tone, bool centred);

  ImVec2 origin_, size_;
  float scale_;
  std::vector<WantedLabel> wanted_;
  std::vector<ImU32> tones_;
};

}  // namespace standpoint
