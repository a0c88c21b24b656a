// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/drawn_over.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "editor/viewport/full_screen.h"

namespace standpoint {

void putOver(PixelPicture& picture, ImDrawData& drawing) {
  PixelPicture over;
  {
    const PlainDrawing plain;
    DrawnTexture target(GL_RGBA8);
    if (!target.bind(picture.width, picture.height)) return;
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(&drawing);
    over = drawnPixels(picture.width, picture.height);
  }
  // On black, each colour has been weighted with what it covers.
  for (std::size_t i = 0; i < picture.rgba.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const int left = picture.rgba[i][c] * (255 - over.rgba[i][3]) / 255;
      picture.rgba[i][c] = static_cast<std::uint8_t>(std::min(255, over.rgba[i][c] + left));
    }
}

}  // namespace standpoint
