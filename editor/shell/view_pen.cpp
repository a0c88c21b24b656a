// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/view_pen.h"

#include <algorithm>
#include <vector>

#include "editor/widgets/theme.h"
#include "editor/widgets/verdict_sign.h"

namespace standpoint {

namespace {

// Counter-clockwise around the points.
std::vector<ImVec2> hullOf(std::vector<ImVec2> points) {
  std::sort(points.begin(), points.end(), [](ImVec2 a, ImVec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto turns = [](ImVec2 o, ImVec2 a, ImVec2 b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x) > 0;
  };
  std::vector<ImVec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const ImVec2 p : points) {
      while (hull.size() >= begin + 2 && !turns(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace

std::optional<ImVec2> ViewPen::at(const Eigen::Vector3d& p) const {
  const auto pixel = project(editor_.view.camera, p, editor_.view.size);
  if (!pixel) return std::nullopt;
  return ImVec2(origin_.x + static_cast<float>(pixel->x()), origin_.y + static_cast<float>(pixel->y()));
}

void ViewPen::line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, ImU32 tone, float width_pt) const {
  const auto from = at(a), to = at(b);
  if (from && to) ImGui::GetWindowDrawList()->AddLine(*from, *to, tone, editor_.px(width_pt));
}

void ViewPen::rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, ImU32 tone, float width_pt) const {
  const ImU32 alpha = 170 * (tone >> IM_COL32_A_SHIFT) / 255;
  line(a, b, IM_COL32(16, 18, 22, alpha), width_pt + 2);
  line(a, b, tone, width_pt);
}

void ViewPen::fan(const Eigen::Vector3d& middle, std::span<const Eigen::Vector3d> rim, ImU32 tone) const {
  auto& list = *ImGui::GetWindowDrawList();
  const auto centre = at(middle);
  const auto flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // no seams between the parts
  for (std::size_t i = 0; centre && i < rim.size(); ++i) {
    const auto a = at(rim[i]), b = at(rim[(i + 1) % rim.size()]);
    if (a && b) list.AddTriangleFilled(*centre, *a, *b, tone);
  }
  list.Flags = flags;
}

void ViewPen::ring(std::span<const Eigen::Vector3d> rim, ImU32 tone, float width_pt) const {
  for (std::size_t i = 0; i < rim.size(); ++i) line(rim[i], rim[(i + 1) % rim.size()], tone, width_pt);
}

void ViewPen::body(std::span<const Eigen::Vector3d> corners, ImU32 fill, ImU32 rim) const {
  std::vector<ImVec2> points;
  for (const auto& corner : corners)
    if (const auto p = at(corner)) points.push_back(*p);
  if (points.size() != corners.size()) return;
  const auto hull = hullOf(std::move(points));
  auto& list = *ImGui::GetWindowDrawList();
  list.AddConvexPolyFilled(hull.data(), static_cast<int>(hull.size()), fill);
  list.AddPolyline(hull.data(), static_cast<int>(hull.size()), rim, ImDrawFlags_Closed, editor_.px(1.5F));
}

void ViewPen::plate(ImVec2 beside, const char* sign, ImU32 sign_tone, const std::string& text) const {
  const float most = editor_.px(380), pad = editor_.px(6), gap = editor_.px(6);
  const ImVec2 icon = ImGui::CalcTextSize(sign), words = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
  const ImVec2 size(icon.x + gap + words.x + 2.5F * pad, std::max(icon.y, words.y) + pad);
  const float right = origin_.x + static_cast<float>(editor_.view.size.x()) - size.x - editor_.px(4),
              bottom = origin_.y + static_cast<float>(editor_.view.size.y()) - size.y - editor_.px(4);
  const ImVec2 low(std::clamp(beside.x, origin_.x, std::max(origin_.x, right)),
                   std::clamp(beside.y, origin_.y, std::max(origin_.y, bottom)));
  auto& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(20, 23, 28, 235), editor_.px(4));
  list.AddRectFilled(low, {low.x + editor_.px(3), low.y + size.y}, sign_tone, editor_.px(4),
                     ImDrawFlags_RoundCornersLeft);
  list.AddText({low.x + 1.5F * pad, low.y + pad / 2}, sign_tone, sign);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + 1.5F * pad + icon.x + gap, low.y + pad / 2},
               IM_COL32(236, 239, 244, 255), text.c_str(), nullptr, most);
}

void ViewPen::verdict(ImVec2 beside, Verdict verdict, const std::string& text) const {
  plate(beside, verdictSign(verdict), verdictTone(verdict), withVerdictWord(verdict, text));
}

}  // namespace standpoint
