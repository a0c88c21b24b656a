// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

constexpr ImU32 kDark = IM_COL32(16, 19, 22, 255), kEmpty = IM_COL32(150, 156, 164, 255);
constexpr ImU32 kFloor = IM_COL32(46, 74, 92, 255), kWall = IM_COL32(205, 214, 222, 255);
// Of a map of quality: floor and ceiling seen, the ceiling alone, the floor alone [S31].
constexpr ImU32 kBoth = IM_COL32(52, 112, 196, 255), kCeilingAlone = IM_COL32(160, 214, 134, 255);
constexpr ImU32 kFloorAlone = IM_COL32(30, 104, 62, 255);
constexpr ImU32 kWay = IM_COL32(70, 200, 120, 255), kHurried = IM_COL32(238, 84, 70, 255);
constexpr ImU32 kHere = IM_COL32(255, 255, 255, 255), kMark = IM_COL32(255, 190, 70, 255);
constexpr double kLeast_m = 8;  // that the map shows, when nothing is seen yet

struct SeenFrame {
  double x_m = 0, y_m = 0, scale = 1;
  ImVec2 middle;

  ImVec2 at(double x, double y) const {
    return {middle.x + static_cast<float>((x - x_m) * scale), middle.y - static_cast<float>((y - y_m) * scale)};
  }
};

// The processed walk that is on view, where none is recorded, or was.
const WalkResult* processedOn(const Device& device) {
  const auto* setup = device.shownSetup();
  return device.state().walk.way.empty() && setup != nullptr && setup->walk ? &*setup->walk : nullptr;
}

const WalkedWay& wayOf(const Device& device) {
  const auto* processed = processedOn(device);
  return processed == nullptr ? device.state().walk.way : processed->way;
}

const SeenMap* seenOf(const Device& device) {
  const auto* processed = processedOn(device);
  return processed == nullptr ? device.state().walk.seen.get() : processed->seen.get();
}

SeenFrame frameOf(const Device& device, const WalkedWay& way, ImVec2 at, ImVec2 size, float margin, bool ceilings) {
  const std::uint8_t unframed = ceilings ? 0 : SeenMap::kCeiling;
  const auto& walk = device.state().walk;
  double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
  const auto add = [&](double x, double y) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  };
  if (walk.at && processedOn(device) == nullptr) add(walk.at->front(), walk.at->back());
  for (const auto& place : way) add(place[0], place[1]);
  if (const auto* seen = seenOf(device))
    for (int row = 0; row < seen->rows; ++row)
      for (int column = 0; column < seen->columns; ++column)
        if ((seen->cells[static_cast<std::size_t>(row) * seen->columns + column] & ~unframed) != 0)
          add(seen->x_m + column * seen->cell_m, seen->y_m + row * seen->cell_m);
  SeenFrame frame;
  if (low_x > high_x) return frame;
  frame.x_m = (low_x + high_x) / 2, frame.y_m = (low_y + high_y) / 2;
  frame.scale = std::min((size.x - 2 * margin) / std::max(kLeast_m, high_x - low_x),
                         (size.y - 2 * margin) / std::max(kLeast_m, high_y - low_y));
  frame.middle = {at.x + size.x / 2, at.y + size.y / 2};
  return frame;
}

void cells(ImDrawList* list, const SeenMap& seen, const SeenFrame& frame, std::uint8_t what, ImU32 colour) {
  for (int row = 0; row < seen.rows; ++row) {
    const auto* line = seen.cells.data() + static_cast<std::size_t>(row) * seen.columns;
    for (int column = 0; column < seen.columns;) {
      if ((line[column] & what) != what) {
        ++column;
        continue;
      }
      int end = column;  // cells side by side are one box
      while (end < seen.columns && (line[end] & what) == what) ++end;
      const ImVec2 low = frame.at(seen.x_m + column * seen.cell_m, seen.y_m + row * seen.cell_m);
      const ImVec2 high = frame.at(seen.x_m + end * seen.cell_m, seen.y_m + (row + 1) * seen.cell_m);
      list->AddRectFilled({low.x, high.y}, {std::max(high.x, low.x + 1), std::max(low.y, high.y + 1)}, colour);
      column = end;
    }
  }
}

void surfaces(ImDrawList* list, const SeenMap& seen, const SeenFrame& frame, bool quality) {
  cells(list, seen, frame, SeenMap::kFloor, quality ? kFloorAlone : kFloor);
  if (quality) {
    cells(list, seen, frame, SeenMap::kCeiling, kCeilingAlone);
    cells(list, seen, frame, SeenMap::kFloor | SeenMap::kCeiling, kBoth);
  }
  cells(list, seen, frame, SeenMap::kWall, kWall);
}

void way(const Pen& pen, ImDrawList* list, const WalkedWay& way, const SeenFrame& frame, ImU32 colour) {
  const PaceLimits most = paceLimits(pen.device.type().instrument);
  for (std::size_t i = 1; i < way.size(); ++i) {
    const auto &a = way[i - 1], &b = way[i];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length < 1e-6) continue;
    const bool hurried = most.tooFast(length / std::max(1e-6, b[2] - a[2]));
    list->AddLine(frame.at(a[0], a[1]), frame.at(b[0], b[1]), hurried ? kHurried : colour, pen.hair(2.2F));
  }
}

// A wedge that points where they look.
void here(const Pen& pen, ImDrawList* list, ImVec2 p, const std::array<double, 2>& ahead, bool hurried) {
  const float r = 0.9F * pen.unit;
  const float x = static_cast<float>(ahead[0]), y = -static_cast<float>(ahead[1]);
  const ImVec2 tip{p.x + r * x, p.y + r * y},
      left{p.x - 0.7F * r * x + 0.6F * r * y, p.y - 0.7F * r * y - 0.6F * r * x},
      right{p.x - 0.7F * r * x - 0.6F * r * y, p.y - 0.7F * r * y + 0.6F * r * x};
  list->AddTriangleFilled(tip, left, right, hurried ? kHurried : kHere);
  list->AddTriangle(tip, left, right, IM_COL32_BLACK, pen.hair(1.2F));
}

}  // namespace

// Floor and walls that were seen so far, the way, and who carries the scanner.
void drawSeen(Pen& pen, const Widget& w, bool quality) {
  if (pen.height == 0) caption(pen, w.label);
  const ImVec2 at = screenAt(pen);
  const ImVec2 size{pen.width, pen.height > 0 ? pen.height : pen.width * 0.6F};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, kDark);
  if (area(("##" + w.id).c_str(), at, size) && pen.view.asking) pen.pressed(w.id);
  const auto& walk = pen.device.state().walk;
  const auto& walked = wayOf(pen.device);
  const bool stands_there = walked.empty() || &walked == &walk.way;
  if (walked.empty() && !(stands_there && walk.at)) return centred(list, at, size, kEmpty, "–");
  const auto frame = frameOf(pen.device, walked, at, size, 1.2F * pen.unit, quality);
  const ImU32 walked_in = quality ? kHere : kWay;
  list->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  if (const auto* seen = seenOf(pen.device)) surfaces(list, *seen, frame, quality);
  way(pen, list, walked, frame, walked_in);
  if (stands_there && walk.at) {
    if (!walk.way.empty() && walk.recording)
      way(pen, list, {walk.way.back(), {walk.at->front(), walk.at->back(), walk.recorded_s}}, frame, walked_in);
    const auto& control = pen.device.state().control;
    for (const auto& point : control.targets) {
      const ImVec2 p = frame.at(point.place_m.x() + control.shift_m.x(), point.place_m.y() + control.shift_m.y());
      list->AddCircle(p, 0.5F * pen.unit, kMark, 24, pen.hair(2));
    }
    here(pen, list, frame.at(walk.at->front(), walk.at->back()), walk.ahead_of,
         isHurried(walk, paceLimits(pen.device.type().instrument)));
  }
  list->PopClipRect();
}

}  // namespace standpoint
