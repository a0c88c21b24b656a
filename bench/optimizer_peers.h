// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"

namespace standpoint::bench {

// What a simplifier made, and the seconds that it took from an indexed, welded mesh; the conversion into the peer's own
// mesh is not counted.
struct Simplified {
  Mesh mesh;
  double seconds = 0;
  double cpu_seconds = 0;  // of all threads: what counts where others use the machine, too
};

Simplified lindstromTurk(const Mesh& mesh,
                         std::size_t target);  // CGAL's Surface_mesh_simplification, its default cost and placement
Simplified meshoptimizer(const Mesh& mesh, std::size_t target);  // meshopt_simplify without a limit on the error

// Since it was made.
class Stopwatch {
 public:
  Stopwatch();
  Simplified stop(Mesh mesh) const;

 private:
  double wall_, cpu_;
};

struct ErrorPercent {  // of the diagonal of the mesh before
  double mean = 0;     // of the two directions' means
  double max = 0;
};

// 100 000 points by area each way, each to the nearest point of the other surface, found by CGAL's AABB tree.
ErrorPercent errorBetween(const Mesh& before, const Mesh& after);

}  // namespace standpoint::bench
