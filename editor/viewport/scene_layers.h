// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <vtkRenderer.h>

#include "editor/viewport/ground_shadow.h"
#include "editor/viewport/layer.h"
#include "editor/viewport/merged_scene.h"
#include "editor/viewport/texture.h"

namespace standpoint {

// All that is drawn of a scene, and what of it must be made anew when another state is shown.
class SceneLayers {
 public:
  explicit SceneLayers(vtkRenderer* renderer);
  // From `last`, which was shown before; null: nothing was.
  void update(const ViewState& state, const ViewState* last);
  // On the terrain of the model; an empty one takes it away.
  void cast(const ViewState& state, const GroundShadow& shadow);
  void setPixels(int factor);  // of the picture that is drawn, for each of the picture that is seen
  const Bounds& bounds() const { return bounds_; }  // of the environment
  const Bounds& reach() const { return reach_; }    // of all that is shown

 private:
  struct UnderlayLayer {
    Layer layer;
    std::shared_ptr<const Cloud> cloud;
    std::size_t step = 0;
  };
  void setUpSurface(Layer& layer, double offset);
  void setUpLines(Layer& layer, std::array<double, 3> colour, double opacity, double width);
  void setUpPoints(Layer& layer);
  void updateSurfaces(const ViewState& state, bool same_triangles);
  void updateEdges(const ViewState& state);
  void updateSelection(const ViewState& state);
  void updateDoors(const ViewState& state);
  void updateCollision(const ViewState& state);
  void updateCloud(const ViewState& state);
  void updateUnderlays(const ViewState& state);
  void updateGrid(const ViewState& state);
  void updateCut(const ViewState& state);
  Bounds reachOf(const ViewState& state) const;

  vtkRenderer* renderer_;
  Layer opaque_, shadow_, transparent_, graded_, graded_transparent_, shapes_, selected_, walkable_, edges_, outline_,
      grid_, cloud_, doors_, door_glass_, door_edges_;
  std::vector<std::unique_ptr<Layer>> painted_;  // one for each image in sight
  std::vector<std::uint32_t>
      runs_;  // of what opaque_ and transparent_ show; empty: their colours cannot be changed alone
  TextureCache textures_;
  EdgeCache edge_cache_, door_edge_cache_;
  std::vector<std::unique_ptr<UnderlayLayer>> underlays_;
  Bounds bounds_, reach_;
};

}  // namespace standpoint
