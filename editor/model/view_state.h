// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/result.h"
#include "editor/bodies/standing.h"
#include "editor/bodies/under_way.h"
#include "editor/camera/camera.h"
#include "editor/clouds/cloud.h"
#include "editor/clouds/underlay_view.h"
#include "editor/inspect/clip_box.h"
#include "editor/model/deviation_view.h"
#include "editor/model/graphics.h"
#include "editor/model/visibility.h"
#include "optimizer/optimizer.h"
#include "project/document.h"

struct ImDrawData;

namespace standpoint {

constexpr int kMostPointSize_px = 8;
constexpr double kReflectanceWavelength_nm = 1550;  // what most of the emulated scanners emit

enum class ColourMode {
  model,
  material,
  reflectance,
  confidence,
  deviation,
  // Of what a station gets (expected_view.h); the model below it is grey.
  expected_intensity,
  expected_noise,
  expected_fate,
  // Of what all stations see (coverage_view.h), likewise.
  coverage,
  coverage_spacing,
  coverage_incidence,
};
constexpr bool isExpected(ColourMode mode) { return mode >= ColourMode::expected_intensity; }

// Rows from the top; an alpha of 0 lets what is below be seen.
struct PixelPicture {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> rgba;
};

// Where the interface has drawn the display of the desk's device: within a window of this name, left, top, width and
// height on the screen.
struct DrawnDisplay {
  std::string window;
  std::array<float, 4> at{};
};

// All that a picture of the scene depends on, as a value: equal states give the same picture, so whoever draws compares
// and redraws only when something differs. Parts of the document are compared by pointer.
struct ViewState {
  std::shared_ptr<const Environment> environment;
  std::shared_ptr<const MaterialChoice> materials;
  std::shared_ptr<const CollideResult> collision;
  std::shared_ptr<const DeviationField> deviation;  // of `environment`; null until it is there
  std::shared_ptr<const HiddenProducts> hidden;
  std::shared_ptr<const Environment> doors;  // instead of those of the model, as they stand open; null: as modelled
  std::shared_ptr<const std::vector<std::uint32_t>> selected;
  std::optional<double> cut_height_m;
  std::optional<ClipBox> clip;
  ColourMode colour = ColourMode::model;
  double wavelength_nm = kReflectanceWavelength_nm;  // at which reflectance is shown
  bool edges = true;
  bool grid = true;
  bool walkable = false;
  bool shapes = false;                            // collision shapes instead of the model
  bool shaded_points = false;                     // clouds are shaded by depth (eye-dome lighting)
  int point_size_px = 2;                          // of the square that a point covers
  std::shared_ptr<const Cloud> cloud;             // a scan instead of the model; null: none
  std::shared_ptr<const CloudPaint> cloud_paint;  // null: its own colours
  std::vector<ShownUnderlay> underlays;
  bool quick_points = false;  // they come while the camera moves: while it does, half as fine and in half the time
  std::shared_ptr<const InstrumentsInScene> instruments;  // on their tripods; null: none
  std::shared_ptr<const InstrumentsUnderWay> under_way;   // carried along trajectories; null: none
  std::optional<WorkingInstrument> working;               // that of the desk, besides those
  std::shared_ptr<const PixelPicture> display;            // what its display shows; null: it is dark
  Camera camera;
  bool still_light = false;  // the sun stays where it is when the camera turns: pictures that are put together
  GraphicsLook graphics;
  bool operator==(const ViewState&) const = default;
};

// Whether what stands there, that far above its floor, is in the picture: not beside the clip box, nor on a floor that
// is cut away. Of what stands on a storey that is cut open, all is.
bool keeps(const ViewState& state, const Eigen::Vector3d& place, double above_floor_m);
constexpr double kMarkAboveFloor_m = 1.5;  // of a mark whose floor is not known
// Drawn where it stands open, not where the model has it.
bool isDrawnApart(const ViewState& state, std::uint32_t product);
bool isTerrain(const Product& product);  // the ground around what is built

// Where the picture of a scene comes from. The panels know only this; editor/viewport has the one that draws.
class SceneView {
 public:
  virtual ~SceneView() = default;
  // A texture that holds the picture of `state`, for Dear ImGui's AddImage with v from 1 to 0; 0 when there is none.
  // `fine` asks for smooth edges: it costs a multiple, so it is for a view that stands still.
  virtual std::uint64_t texture(const ViewState& state, int width_px, int height_px, bool fine) = 0;
  // A texture of these pixels, with v from 0 to 1; taken over once for each picture.
  virtual std::uint64_t texture(const std::shared_ptr<const PixelPicture>& picture) = 0;
  // Makes a part of what the first pictures of a model will need, as long as a picture takes; `state` has no model yet.
  // False: there is no more of it.
  virtual bool prepare(const ViewState& /*state*/, int /*width_px*/, int /*height_px*/) { return false; }
  // The finest picture of `state`, as pixels. An error where there is nothing that draws, or no memory for it.
  virtual Result<PixelPicture> pixels(const ViewState& state, int width_px, int height_px);
  // Puts what Dear ImGui has laid out for its size over such a picture.
  virtual void drawOver(PixelPicture& /*picture*/, ImDrawData& /*drawing*/) {}
  // The picture gets better when it is asked for again, though nothing has changed.
  virtual bool refining() const { return false; }
  virtual std::string trouble() const { return {}; }  // why not all of it can be drawn; "" mostly
  virtual GraphicsMeans means() { return {}; }
  // Pictures drawn so far in which nothing but the camera was another one.
  virtual std::uint64_t movedPictures() const { return 0; }
  // In which nothing but a working instrument was, and the points that it measures.
  virtual std::uint64_t workedPictures() const { return 0; }
  // How long such a picture takes at the level of `state`; drawn for that.
  virtual double cost_s(const ViewState& /*state*/, int /*width_px*/, int /*height_px*/) { return 0; }
};

// The colour that stands for a physical material: about what it looks like by its reflectance in the visible, with a
// tint of its own to tell it from others that look the same. nullptr = nothing assigned.
Colour materialColour(const PhysicalMaterial* material);
// From dark brown, a guess, over orange to pale green, with a step at kWeakConfidence: lighter is surer, so that it is
// read without telling red from green. Below 0: nothing is assigned.
Colour confidenceColour(double confidence);

}  // namespace standpoint
