// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "editor/model/model.h"

struct ImDrawData;

namespace standpoint {

// The display of a device as pixels, taken from what Dear ImGui has laid out last, so that the instrument in the scene
// shows what its panel shows. Needs the OpenGL context and the renderer of Dear ImGui.
class DisplayPicture {
 public:
  DisplayPicture() = default;
  ~DisplayPicture();
  DisplayPicture(const DisplayPicture&) = delete;
  DisplayPicture& operator=(const DisplayPicture&) = delete;

  // The same picture as before where nothing of it has changed; null where OpenGL cannot draw it.
  std::shared_ptr<const PixelPicture> taken(const ImDrawData& laid_out, const DrawnDisplay& display);
  // Taken so recently that it need not be taken again while other pictures follow at once.
  bool isFresh() const;

 private:
  bool makeTarget(int width, int height);

  std::shared_ptr<const PixelPicture> last_;
  std::chrono::steady_clock::time_point taken_;
  unsigned texture_ = 0, framebuffer_ = 0;
  int width_ = 0, height_ = 0;
};

// For the instrument in the scene, where the panel has just drawn its display; true: it shows something else now.
bool takeDisplay(Model& model, DisplayPicture& picture, const ImDrawData& laid_out);

}  // namespace standpoint
