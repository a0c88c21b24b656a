// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "editor/model/view_state.h"
#include "editor/viewport/face_rank.h"
#include "editor/viewport/feature_edges.h"

namespace standpoint {

using Rgba = std::array<std::uint8_t, 4>;

// Plain arrays, ready to be handed to the graphics library: one mesh of all placed triangles, whatever they belong to.
// Ten thousand small actors are twenty times slower to draw than one merged mesh.
struct MergedTriangles {
  std::vector<float> positions;       // x, y, z
  std::vector<std::int64_t> corners;  // three per triangle
  std::vector<Rgba> colours;          // one per triangle; where graded, one per position
  bool graded = false;                // the colour runs from corner to corner
};
struct MergedLines {
  std::vector<float> positions;
  std::vector<std::int64_t> ends;  // two per line
};

// What shows an image: at most two for each image of the environment that is in sight, with and without vertex colours.
struct PaintedTriangles {
  MergedTriangles triangles;
  std::vector<float>
      coordinates;     // u, v of each position; (0, 0) is the lower left corner, as graphics libraries have it
  bool unlit = false;  // the light is in the image
};

struct MergedScene {
  MergedTriangles opaque, transparent;
  MergedTriangles graded, graded_transparent;
  std::map<std::pair<std::int32_t, bool>, PaintedTriangles> painted;  // by image, and whether graded
};

bool isShown(const ViewState& state, std::uint32_t product);  // in the scene and not hidden

// Instances of the environment that are merged together: those of [first, end) whose product has that faceRank().
struct InstanceRange {
  std::size_t first = 0, end = static_cast<std::size_t>(-1);  // all there are
  int rank = -1;                                              // any
  bool holds(const Environment& environment, std::size_t instance) const {
    return instance >= first && instance < end &&
           (rank < 0 || faceRank(environment.products[environment.instances[instance].product]) == rank);
  }
};

MergedScene mergeVisible(const ViewState& state, InstanceRange range = {});

// What shows the doors of `state` as they stand open.
ViewState stateOfDoors(const ViewState& state);

// The colours of mergeVisible() without the geometry, for a view that shows the same triangles in another paint.
struct MergedColours {
  std::vector<Rgba> opaque, transparent;
  std::vector<std::uint32_t> runs;  // triangles that go to `opaque`, then to `transparent`, and on in turns: where
                                    // these are equal, every triangle is where it was
  bool operator==(const MergedColours&) const = default;
};
// Nothing where images or vertex colours are shown: their geometry depends on what is painted.
std::optional<MergedColours> mergeColours(const ViewState& state, InstanceRange range = {});

MergedTriangles mergeProducts(const Environment& environment, const std::vector<std::uint32_t>& products, Rgba colour);
MergedTriangles mergeShapes(const CollideResult& collision);
// A walkable surface just above what it lies on. It is made of level cells, which on a slope are steps with the ground
// in between: corners that nearly meet are drawn at the height of the highest.
MergedTriangles mergeWalkable(const Mesh& mesh, Rgba colour);

// Feature edges of meshes, kept as long as the mesh is.
class EdgeCache {
 public:
  // Of the visible products; `only` restricts them (sorted).
  MergedLines edges(const ViewState& state, const std::vector<std::uint32_t>* only, InstanceRange range = {});
  void forgetLost();  // the edges of meshes that are gone

 private:
  const std::vector<EdgeLine>& edgesOf(const std::shared_ptr<const Mesh>& mesh);
  struct Entry {
    std::weak_ptr<const Mesh> mesh;
    std::vector<EdgeLine> lines;
  };
  std::map<const Mesh*, Entry> entries_;
};

}  // namespace standpoint
