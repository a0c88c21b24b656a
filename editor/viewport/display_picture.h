// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <memory>

#include "editor/model/model.h"
#include "editor/viewport/full_screen.h"

struct ImDrawData;

namespace standpoint {

// The display of a device as pixels, taken from what Dear ImGui has laid out last, so that the instrument in the scene
// shows what its panel shows. Needs the OpenGL context and the renderer of Dear ImGui.
class DisplayPicture {
 public:
  // The same picture as before where nothing of it has changed; null where OpenGL cannot draw it.
  std::shared_ptr<const PixelPicture> taken(const ImDrawData& laid_out, const DrawnDisplay& display);
  // Taken so recently that it need not be taken again while other pictures follow at once.
  bool isFresh() const;

 private:
  std::shared_ptr<const PixelPicture> last_;
  std::chrono::steady_clock::time_point taken_;
  DrawnTexture target_{GL_RGBA8};
};

// For the instrument in the scene, where the panel has just drawn its display; true: it shows something else now.
bool takeDisplay(Model& model, DisplayPicture& picture, const ImDrawData& laid_out);

}  // namespace standpoint
