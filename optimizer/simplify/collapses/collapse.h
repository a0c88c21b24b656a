// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// One step of a simplification: vertex `removed` joins `kept`, which moves to `position`. Where both are the same
// vertex, it only moves, or, if triangles vanish, this is the last step, with which all that is left goes.
struct Collapse {
  std::uint32_t kept = 0, removed = 0;
  std::uint32_t triangles = 0;  // that vanish with it, of one copy of the shape
  bool flat = false;            // it moves the surface by no more than rounding does
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  bool endsAll() const { return kept == removed && triangles > 0; }
};

struct CollapseOptions {
  double max_deviation_m = 0;  // a step that moves the surface further is not made
  bool lossless = false;       // only steps that keep surface, borders, creases and the borders between surfaces
  bool memoryless = false;     // steps are judged by the surface as it is, not by that of the beginning
  std::size_t floor = 0;       // no steps below so many triangles
};

// A full simplification by quadric error, cheapest step first, of which any prefix is a valid simplification. A shape
// without a limit ends with no triangle at all: small parts that cannot become simpler vanish at the price of their
// size. O(n log n), as no vertex may gather more than some hundred triangles. A shape of more than 100 000 triangles is
// cut into cells that are simplified side by side; how depends on the shape only, so that any number of threads gives
// the same log. Stops when cancelled.
std::vector<Collapse> recordCollapses(const Shape& shape, const CollapseOptions& options, const Progress& progress);

// Down to `triangles`, or one or two less, by Lindstrom and Turk's cost and placement (1998: volume kept, squared
// volume between old and new least), which look at the surface as it is. As the last steps of a simplification, a third
// less mean error on smooth surfaces. Borders, creases and seams are held as before; cells as before. `stays` says of
// each vertex whether it stays where it is; shapes that are cut into cells ignore it.
std::vector<Collapse> refined(const Shape& shape, std::size_t triangles, const Progress& progress,
                              const std::vector<bool>* stays = nullptr);

// Plays a log: the shape after its first steps, which may only become more. Vertices that did not move keep their exact
// position. Keeps references to both. Going on costs what is left, so that looking at many stages of a long log is
// cheap.
class LogPlayer {
 public:
  LogPlayer(const Shape& shape, const std::vector<Collapse>& log);
  const Shape& at(std::size_t steps);
  // For each triangle of the shape what it became in what at() gave last, or one that is near that; the largest number
  // if there is none.
  std::vector<std::uint32_t> image() const;
  // The wedges of what at() gave last, as Shape's: corners whose paint is one after what vanished between them have the
  // same.
  std::vector<Triangle> wedges() const;
  Shape take() { return std::move(form_); }

 private:
  const Shape& shape_;
  const std::vector<Collapse>& log_;
  Shape form_;
  std::size_t done_ = 0;
  std::vector<std::uint32_t> joined_, origin_;
};

// Without the positions that no triangle uses; `names` gets what the others were called before.
Shape withoutUnused(const Shape& shape, std::vector<std::uint32_t>& names);

// All of it at once.
Shape replay(const Shape& shape, const std::vector<Collapse>& log, std::size_t steps,
             std::vector<std::uint32_t>* image = nullptr);

}  // namespace standpoint
