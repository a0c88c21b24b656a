// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "editor/viewport/full_screen.h"

namespace standpoint {

// How depths of a picture are places in front of the camera.
struct Lens {
  bool parallel = false;
  double near_m = 0.1, far_m = 1000;
  double half_width = 1, half_height = 1;  // of what is seen: metres if parallel, else at a distance of 1
};

// A drawn scene: `factor` times as many pixels each way as the picture of it.
struct DrawnScene {
  GLuint colours = 0, depths = 0;
  int width = 0, height = 0;  // of the picture
  int factor = 1;
};

// What is done to the picture of a scene once it is drawn.
class Finish {
 public:
  Finish();
  // Why these do not work here; empty where they do.
  const std::string& noSmoothing() const { return smoother_.problem(); }
  const std::string& noShading() const { return no_shading_; }

  // Softens the steps of edges by their contrast (in the manner of FXAA). 0 where the picture cannot be drawn.
  GLuint smooth(const DrawnScene& scene);

  // Ambient occlusion from the depths, which are only a part of the surface: corners and what is near other surfaces
  // gets darker. Each call of shade() adds a part of the samples, until there are all of them.
  void begin() { parts_ = 0; }
  GLuint shade(const DrawnScene& scene, const Lens& lens);
  bool shaded() const { return parts_ == kParts; }

 private:
  static constexpr int kParts = 12, kSamplesOfPart = 6;
  bool occlude(const DrawnScene& scene, const Lens& lens);

  FullScreenProgram smoother_{kSmoother}, occluder_{kOccluder}, composer_{kComposer};
  DrawnTexture smoothed_{GL_RGBA8}, occlusion_{GL_R16F}, shaded_{GL_RGBA8};
  int parts_ = 0;
  std::string no_shading_;

  static const char* const kSmoother;
  static const char* const kOccluder;
  static const char* const kComposer;
};

}  // namespace standpoint
