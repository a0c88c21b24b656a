// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "editor/camera/camera.h"

namespace standpoint {

// Takes the camera to a place that a command has chosen in a moment instead of at once, so that whoever looks sees
// where it goes. Drags, steps and walks stay as they are. Commands know nothing of it: they set the camera, and a
// moment later it is there.
class CameraFlight {
 public:
  // How long it lasts; 0: commands take effect at once.
  explicit CameraFlight(double seconds = 0) : seconds_(seconds) {}

  // Once a frame, before what is drawn by the camera: takes it a step on, or back to where it was if a command has just
  // moved it far.
  void step(Camera& camera, double seconds);
  // Where a hand, a walk or another model has put it: nothing to fly to.
  void settle(const Camera& camera);
  bool flies() const { return flight_.has_value(); }

 private:
  struct Flight {
    Camera from, to;
    double gone_s = 0;
  };
  double seconds_;
  std::optional<Camera> last_;  // as it was left
  std::optional<Flight> flight_;
};

// From `from` at 0 to `to` at 1: evenly in distance, on the shorter way round; in perspective unless both are parallel
// projections.
Camera between(const Camera& from, const Camera& to, double fraction);

}  // namespace standpoint
