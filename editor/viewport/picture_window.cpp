// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/picture_window.h"

#include <algorithm>

#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace standpoint {

vtkStandardNewMacro(PictureWindow);

// Debian's GLEW speaks GLX only: without an X display glewInit() says "no GLX display" (4) though every entry point was
// loaded, so both answers are good.
void PictureWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  if (Initialized) return;
  constexpr GLenum kNoGlxDisplay = 4;
  const GLenum answer = glewInit();
  GlewInitValid = answer == GLEW_OK || answer == kNoGlxDisplay;
  Initialized = GlewInitValid;
}

bool PictureWindow::hasPixels(int width, int height) const {
  const auto has = [&](vtkOpenGLFramebufferObject* buffer) {
    const int* size = buffer->GetLastSize();
    return buffer->GetFBOIndex() != 0 && size[0] == width && size[1] == height;
  };
  return std::any_of(kept_.begin(), kept_.end(), [&](const Buffers& b) { return has(b.drawn) && has(b.shown); });
}

void PictureWindow::use(const Buffers& buffers) {
  const auto put = [](vtkOpenGLFramebufferObject*& in, vtkOpenGLFramebufferObject* now) {
    now->Register(nullptr);
    in->UnRegister(nullptr);
    in = now;
  };
  put(RenderFramebuffer, buffers.drawn);
  put(DisplayFramebuffer, buffers.shown);
}

void PictureWindow::setPixels(int width, int height) {
  SetSize(width, height);
  if (!kept_.empty() && kept_.back().width == width && kept_.back().height == height) return;
  auto found = std::find_if(kept_.begin(), kept_.end(),
                            [&](const Buffers& b) { return b.width == width && b.height == height; });
  if (found == kept_.end() && kept_.size() < kMostSizes) {
    Buffers& made = *kept_.emplace(kept_.end());
    made.drawn = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    made.shown = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    made.drawn->SetContext(this);
    made.shown->SetContext(this);
    found = std::prev(kept_.end());
  }
  if (found == kept_.end()) found = kept_.begin();  // the one that was used longest ago: VTK gives it this size
  found->width = width, found->height = height;
  std::rotate(found, std::next(found), kept_.end());
  use(kept_.back());
}

void PictureWindow::makeReady(int width, int height) {
  const int before[2] = {Size[0], Size[1]};
  auto* state = GetState();
  state->Reset();
  state->Push();
  setPixels(width, height);
  if (const int* size = DisplayFramebuffer->GetLastSize();
      DisplayFramebuffer->GetFBOIndex() == 0 || size[0] != width || size[1] != height) {
    makeShown();
  } else {
    Start();
    state->PopFramebufferBindings();
  }
  setPixels(before[0], before[1]);
  state->Pop();
}

void PictureWindow::Start() {
  if (!Initialized) Initialize();
  MakeCurrent();
  if (DisplayFramebuffer->GetFBOIndex() == 0) makeShown();
  vtkGenericOpenGLRenderWindow::Start();
}

void PictureWindow::makeShown() {
  GetState()->Initialize(this);
  GetState()->PushFramebufferBindings();
  constexpr bool kAsTextures = true, kDepth = false;
  DisplayFramebuffer->PopulateFramebuffer(Size[0], Size[1], kAsTextures, 1, VTK_UNSIGNED_CHAR, kDepth, 0, 0);
  GetState()->PopFramebufferBindings();
}

void PictureWindow::ReleaseGraphicsResources(vtkWindow* window) {
  for (const Buffers& buffers : kept_) {
    buffers.drawn->ReleaseGraphicsResources(window);
    buffers.shown->ReleaseGraphicsResources(window);
  }
  vtkGenericOpenGLRenderWindow::ReleaseGraphicsResources(window);
}

}  // namespace standpoint
