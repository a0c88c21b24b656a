// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <vtkRenderer.h>

#include "editor/viewport/layer.h"
#include "editor/viewport/merged_scene.h"
#include "editor/viewport/texture.h"

namespace standpoint {

// Runs of instances with about `triangles` triangles each, in their order, first those of the first faceRank(); a
// larger mesh is a run of its own.
std::vector<InstanceRange> rangesOf(const Environment& environment, std::uint64_t triangles);

// The surfaces and edges of the model, merged piece by piece: a large model is there after some pictures, none of which
// takes long, and what is hidden or painted anew concerns the pieces that it is in. A piece shows what it was until it
// is made anew.
class ModelPieces {
 public:
  ModelPieces(vtkRenderer* renderer, EdgeCache& edges) : renderer_(renderer), edge_cache_(edges) {}

  // Makes at most what one picture has time for. True when the pieces are others than before: their actors must then be
  // added to the renderer, in the order in which they are blended.
  bool update(const ViewState& state);
  bool building() const { return building_; }  // another update with the same state makes more
  void addSurfaces() const;
  void addTransparent() const;
  void addEdges() const;
  void setLineWidth(float pixels);
  void spareEdges(bool spared);
  void forEachLayer(const std::function<void(Layer&)>& act);

 private:
  struct Look {  // what the triangles and colours of a piece depend on
    std::shared_ptr<const HiddenProducts> hidden;
    std::shared_ptr<const MaterialChoice> materials;
    std::shared_ptr<const DeviationField> deviation;
    ColourMode colour = ColourMode::model;
    double wavelength_nm = 0;
    bool doors_apart = false;  // a walk goes through the same doors from end to end
    bool operator==(const Look&) const = default;
  };
  struct Piece {
    InstanceRange range;
    std::uint64_t triangles = 0;
    Layer opaque, transparent, graded, graded_transparent, edges;
    std::vector<std::unique_ptr<Layer>> painted;  // one for each image in sight
    std::vector<std::uint32_t> runs;              // as MergedColours; empty: the colours cannot be changed alone
    std::optional<Look> look;                     // that it shows; none: it has not been made yet
    bool has_edges = false;
  };

  static Look lookOf(const ViewState& state);
  void plan(const ViewState& state);
  static bool shows(const Piece& piece, const ViewState& state, const Look& look);
  static bool repaint(Piece& piece, const ViewState& state);
  void make(Piece& piece, const ViewState& state);
  void showEdges(Piece& piece, const ViewState& state);
  static void setVisible(Piece& piece, bool model, bool edges);

  vtkRenderer* renderer_;
  EdgeCache& edge_cache_;
  TextureCache textures_;
  std::shared_ptr<const Environment> environment_;  // whose pieces these are
  std::vector<std::unique_ptr<Piece>> pieces_;
  float line_width_ = 1;
  bool building_ = false;
};

}  // namespace standpoint
