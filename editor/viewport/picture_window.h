// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkSmartPointer.h>

class vtkOpenGLFramebufferObject;

namespace standpoint {

// VTK's window in a context of OpenGL that is somebody else's, for pictures that are taken from its textures.
//
// Pictures of a few sizes alternate: while the view moves, at rest, made fine. To make framebuffers takes a processor
// that draws longer than many a picture does (0.1 s for 4 million pixels), so each of the last four sizes keeps its
// own: 12 bytes a pixel, as what is shown needs no depths.
class PictureWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static PictureWindow* New();
  vtkTypeMacro(PictureWindow, vtkGenericOpenGLRenderWindow);
  // From the next picture on.
  void setPixels(int width, int height);
  bool hasPixels(int width, int height) const;
  // Once there has been a picture: makes half of them for a size that comes later.
  void makeReady(int width, int height);

  void OpenGLInitContext() override;
  void Start() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

 private:
  struct Buffers {
    int width = 0, height = 0;
    vtkSmartPointer<vtkOpenGLFramebufferObject> drawn, shown;
  };
  static constexpr std::size_t kMostSizes = 4;
  void use(const Buffers& buffers);
  void makeShown();

  std::vector<Buffers> kept_;  // the one that was used last comes last
};

}  // namespace standpoint
