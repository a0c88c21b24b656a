// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "core/result.h"
#include "editor/shell/editor.h"

namespace standpoint {

// The editor without a display: the same shell, drawn in an EGL context without a surface and saved as PNG.
class Offscreen {
 public:
  // Makes the context current on this thread and Dear ImGui's one with it. An error says what the machine lacks.
  static Result<std::unique_ptr<Offscreen>> create(int width_px, int height_px, float scale);
  virtual ~Offscreen() = default;
  // Fonts, scale and the scene view of this context.
  virtual void adopt(Editor& editor) = 0;
  virtual SceneView& scene() = 0;
  virtual const Fonts& fonts() const = 0;
  // Draws one frame, as the window does.
  virtual void frame(Editor& editor) = 0;
  // Draws until nothing moves any more, then writes the picture.
  virtual Result<void> picture(Editor& editor, const std::filesystem::path& png) = 0;
  // The same of anything: `draw` makes a frame's windows.
  virtual Result<void> picture(const std::function<void()>& draw, const std::filesystem::path& png) = 0;
};

}  // namespace standpoint
