// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "editor/labels/label_layout.h"

namespace standpoint {

// Collects what shall be written over the view, all of it, and writes it so that nothing covers anything.
class LabelBoard {
 public:
  LabelBoard(ImVec2 origin, ImVec2 size, float scale) : origin_(origin), size_(size), scale_(scale) {}

  // `texts` from the fullest to the shortest, lines apart by '\n'. Beside `p`, over it first of all; or around it.
  void over(LabelOf of, ImVec2 p, std::vector<std::string> texts, ImU32 tone, bool chosen = false) {
    add(of, p, std::move(texts), tone, chosen, false);
  }
  void around(LabelOf of, ImVec2 p, std::vector<std::string> texts, ImU32 tone) {
    add(of, p, std::move(texts), tone, false, true);
  }
  // Of what is drawn over the labels: they keep away from it.
  void keepFree(ImVec2 low, ImVec2 high);
  // `layout` is that of the frame before.
  void draw(ImDrawList& list, LabelLayout& layout) const;

 private:
  void add(LabelOf of, ImVec2 p, std::vector<std::string> texts, ImU32 tone, bool chosen, bool centred);

  ImVec2 origin_, size_;
  float scale_;
  std::vector<WantedLabel> wanted_;
  std::vector<ImU32> tones_;
  std::vector<Eigen::AlignedBox2d> kept_free_;
};

}  // namespace standpoint
