// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>

#include <imgui.h>

#include "editor/shell/editor.h"
#include "survey/quality/quality_limits.h"

namespace standpoint {

// Draws what stands in the scene over its picture.
class ViewPen {
 public:
  ViewPen(const Editor& editor, ImVec2 origin) : editor_(editor), origin_(origin) {}
  std::optional<ImVec2> at(const Eigen::Vector3d& p) const;
  void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, ImU32 tone, float width_pt) const;
  // With a dark rim, which shows on light and dark alike.
  void rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, ImU32 tone, float width_pt) const;
  // Whatever can be seen straight from `middle`.
  void fan(const Eigen::Vector3d& middle, std::span<const Eigen::Vector3d> rim, ImU32 tone) const;
  void ring(std::span<const Eigen::Vector3d> rim, ImU32 tone, float width_pt) const;
  // What the corners span.
  void body(std::span<const Eigen::Vector3d> corners, ImU32 fill, ImU32 rim) const;
  // On a dark plate beside a pixel, and within the view.
  void plate(ImVec2 beside, const char* sign, ImU32 sign_tone, const std::string& text) const;
  void verdict(ImVec2 beside, Verdict verdict, const std::string& text) const;  // the same with its word before

 private:
  const Editor& editor_;
  ImVec2 origin_;
};

}  // namespace standpoint
