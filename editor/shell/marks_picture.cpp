// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/marks_picture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/shell/editor.h"
#include "editor/shell/inspect_tools.h"
#include "editor/shell/label_board.h"
#include "editor/shell/overlay.h"
#include "editor/widgets/draw_lists.h"

namespace standpoint {

namespace {

constexpr float kPlain_px = 1080;  // up to this height a point is a pixel

// While it is there, the current window draws into `list` instead of itself, and the view looks from elsewhere.
class ViewElsewhere {
 public:
  ViewElsewhere(Editor& editor, ImDrawList& list, const Camera& camera, const Eigen::Vector2d& size)
      : view_(editor.view),
        window_(*ImGui::GetCurrentWindowRead()),
        camera_(std::exchange(view_.camera, camera)),
        size_(std::exchange(view_.size, size)),
        list_(std::exchange(window_.DrawList, &list)),
        written_(window_.WriteAccessed) {}
  ~ViewElsewhere() {
    view_.camera = camera_;
    view_.size = size_;
    window_.DrawList = list_;
    window_.WriteAccessed = written_;  // Dear ImGui hides the window of no name as long as nobody has drawn into it
  }
  ViewElsewhere(const ViewElsewhere&) = delete;
  ViewElsewhere& operator=(const ViewElsewhere&) = delete;

 private:
  ViewportState& view_;
  ImGuiWindow& window_;
  Camera camera_;
  Eigen::Vector2d size_;
  ImDrawList* list_;
  bool written_;
};

}  // namespace

void drawMarksOver(Editor& editor, const Camera& camera, PixelPicture& picture) {
  const auto wide = static_cast<float>(picture.width), high = static_cast<float>(picture.height);
  const float pixels = std::max(1.0F, high / kPlain_px) / editor.scale;  // of each of the interface
  const ImVec2 size(wide / pixels, high / pixels), origin(0, 0);
  ImDrawList list(ImGui::GetDrawListSharedData());
  list._ResetForNewFrame();
  list.PushTextureID(ImGui::GetIO().Fonts->TexID);
  list.PushClipRect(origin, size);
  {
    const ViewElsewhere elsewhere(editor, list, camera, {size.x, size.y});
    LabelBoard labels(origin, size, editor.scale);
    LabelLayout layout;
    drawMarkers(editor, origin, labels);
    drawInspectMarks(editor, origin, labels);
    labels.draw(list, layout, std::nullopt);
    const auto banners = std::exchange(editor.banners_size, {0, 0});  // a picture has none
    drawColourLegend(editor, origin, size);
    editor.banners_size = banners;
  }
  std::vector<ImDrawList*> lists = {&list};
  ImDrawData drawing;
  drawing.Valid = true;
  drawing.TotalVtxCount = list.VtxBuffer.Size;
  drawing.TotalIdxCount = list.IdxBuffer.Size;
  drawing.DisplaySize = {(wide + 0.01F) / pixels, (high + 0.01F) / pixels};  // they are cut to whole pixels
  drawing.FramebufferScale = {pixels, pixels};
  editor.scene->drawOver(picture, DrawListsOf(drawing, lists).data());
}

}  // namespace standpoint
