// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "editor/camera/camera.h"

namespace standpoint {

struct Model;

// First steps in the sample house: what to do is said, and that it was done is seen.
class Tour {
 public:
  struct Step {
    const char* title;
    const char* text;
    bool (*done)(const Tour&, const Model&);
  };
  static std::span<const Step> steps();

  void begin() { active_ = true, step_ = 0, fresh_ = true; }
  void end() { active_ = false; }
  void skip() { ++step_, fresh_ = true; }
  void follow(const Model& model);  // once a frame

  bool active() const { return active_; }
  std::size_t step() const { return step_; }        // steps().size(): all are done
  const Camera& camera() const { return camera_; }  // as the step began
  std::size_t stations() const { return stations_; }
  bool walked() const { return walked_; }

 private:
  bool active_ = false, fresh_ = false, walked_ = false;
  std::size_t step_ = 0, stations_ = 0;
  Camera camera_;
};

}  // namespace standpoint
