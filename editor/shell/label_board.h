// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
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
  // Around `p`, and what a click on it does is its maker's.
  void button(LabelOf of, ImVec2 p, std::string text);
  // Of what is drawn over the labels: they keep away from it.
  void keepFree(ImVec2 low, ImVec2 high);
  // `layout` is that of the frame before. The button at `pointer`, if there is one.
  std::optional<LabelOf> draw(ImDrawList& list, LabelLayout& layout, std::optional<ImVec2> pointer) const;

 private:
  void add(LabelOf of, ImVec2 p, std::vector<std::string> texts, ImU32 tone, bool chosen, bool centred);

  ImVec2 origin_, size_;
  float scale_;
  std::vector<WantedLabel> wanted_;
  std::vector<ImU32> tones_;
  std::set<LabelOf> buttons_;
  std::vector<Eigen::AlignedBox2d> kept_free_;
};

}  // namespace standpoint
