// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/vtk_scene_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkEDLShading.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkIdTypeArray.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkTextureObject.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>
#include <vtk_glew.h>

#include "core/units.h"
#include "editor/viewport/merged_scene.h"
#include "editor/viewport/texture.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMostEdges = 1500000;
// A fine picture is drawn twice as large and shrunk, up to this many pixels: VTK makes its framebuffer once with the
// number of samples of that time, so multisampling cannot be switched on for a view that comes to rest.
constexpr int kFineFactor = 2;
constexpr std::int64_t kMostFinePixels = 12000000;

// Debian's GLEW speaks GLX only: without an X display glewInit() says "no GLX display" (4) though every entry point was
// loaded, so both answers are good.
class ForeignContextWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static ForeignContextWindow* New();
  vtkTypeMacro(ForeignContextWindow, vtkGenericOpenGLRenderWindow);
  void OpenGLInitContext() override {
    ContextCreationTime.Modified();
    if (Initialized) return;
    constexpr GLenum kNoGlxDisplay = 4;
    const GLenum answer = glewInit();
    GlewInitValid = answer == GLEW_OK || answer == kNoGlxDisplay;
    Initialized = GlewInitValid;
  }
};
vtkStandardNewMacro(ForeignContextWindow);

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<float>& positions) {
  vtkNew<vtkFloatArray> array;
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(positions.size() / 3));
  if (!positions.empty()) std::memcpy(array->GetPointer(0), positions.data(), positions.size() * sizeof(float));
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(array);
  return points;
}

vtkSmartPointer<vtkCellArray> cellsOf(const std::vector<std::int64_t>& indices, vtkIdType size) {
  vtkNew<vtkTypeInt64Array> array;
  array->SetNumberOfTuples(static_cast<vtkIdType>(indices.size()));
  if (!indices.empty()) std::memcpy(array->GetPointer(0), indices.data(), indices.size() * sizeof(std::int64_t));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(size, array);
  return cells;
}

vtkSmartPointer<vtkUnsignedCharArray> coloursOf(const std::vector<Rgba>& colours) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  if (!colours.empty()) std::memcpy(array->GetPointer(0), colours.data(), colours.size() * sizeof(Rgba));
  return array;
}

// One drawn thing: an actor whose geometry is replaced when it changes.
struct Layer {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;

  void show(const MergedTriangles& triangles) {
    vtkNew<vtkPolyData> data;
    data->SetPoints(pointsOf(triangles.positions));
    data->SetPolys(cellsOf(triangles.corners, 3));
    if (triangles.graded)
      data->GetPointData()->SetScalars(coloursOf(triangles.colours));
    else
      data->GetCellData()->SetScalars(coloursOf(triangles.colours));
    if (triangles.graded)
      mapper->SetScalarModeToUsePointData();
    else
      mapper->SetScalarModeToUseCellData();
    set(data, triangles.colours.empty());
  }
  void show(const PaintedTriangles& painted, vtkTexture* texture) {
    show(painted.triangles);
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    coordinates->SetNumberOfTuples(static_cast<vtkIdType>(painted.coordinates.size() / 2));
    if (!painted.coordinates.empty())
      std::memcpy(coordinates->GetPointer(0), painted.coordinates.data(), painted.coordinates.size() * sizeof(float));
    vtkPolyData::SafeDownCast(mapper->GetInput())->GetPointData()->SetTCoords(coordinates);
    actor->SetTexture(texture);
    actor->GetProperty()->SetLighting(!painted.unlit);
  }
  void show(const MergedLines& lines) {
    vtkNew<vtkPolyData> data;
    data->SetPoints(pointsOf(lines.positions));
    data->SetLines(cellsOf(lines.ends, 2));
    set(data, lines.ends.empty());
  }
  // Every `step`-th point.
  void show(const Cloud& cloud, std::size_t step = 1) {
    std::vector<float> positions;
    std::vector<Rgba> colours;
    for (std::size_t i = 0; i < cloud.colours.size(); i += step) {
      positions.insert(positions.end(),
                       {cloud.positions[3 * i], cloud.positions[3 * i + 1], cloud.positions[3 * i + 2]});
      colours.push_back(cloud.colours[i]);
    }
    std::vector<std::int64_t> indices(colours.size());
    std::iota(indices.begin(), indices.end(), std::int64_t{0});
    vtkNew<vtkPolyData> data;
    data->SetPoints(pointsOf(positions));
    data->SetVerts(cellsOf(indices, 1));
    data->GetPointData()->SetScalars(coloursOf(colours));
    set(data, colours.empty());
  }
  void set(vtkPolyData* data, bool empty) {
    mapper->SetInputData(data);
    actor->SetMapper(mapper);
    actor->SetVisibility(empty ? 0 : 1);
  }
  // The same triangles in other colours: their places stay where the graphics card has them.
  void paint(const std::vector<Rgba>& colours) {
    if (!colours.empty()) mapper->GetInput()->GetCellData()->SetScalars(coloursOf(colours));
  }
  void hide() { actor->SetVisibility(0); }
};

// Squares of 1 m and, where the model is large, of 10 m; they fade towards the rim.
vtkSmartPointer<vtkPolyData> groundGrid(const Bounds& bounds) {
  const double reach =
      std::max(4.0, 0.9 * std::hypot(bounds.max.x() - bounds.min.x(), bounds.max.y() - bounds.min.y()));
  const double step = std::pow(10.0, std::max(0.0, std::floor(std::log10(reach / 8))));
  const Eigen::Vector3d centre = (bounds.min + bounds.max) / 2;
  const double cx = std::round(centre.x() / step) * step, cy = std::round(centre.y() / step) * step,
               z = bounds.min.z() - 0.02;
  const int lines = static_cast<int>(std::ceil(reach / step));
  constexpr int kParts = 40;  // of a line, so that each can have its own strength
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  for (int axis = 0; axis < 2; ++axis)
    for (int i = -lines; i <= lines; ++i)
      for (int part = 0; part <= kParts; ++part) {
        const double across = i * step, along = (2.0 * part / kParts - 1) * lines * step;
        const double x = axis == 0 ? across : along, y = axis == 0 ? along : across;
        const auto id = points->InsertNextPoint(cx + x, cy + y, z);
        const double fade = std::clamp(1 - std::hypot(x, y) / (lines * step), 0.0, 1.0);
        const auto absolute = std::lround(((axis == 0 ? cx : cy) + across) / step);
        const double strength = absolute % 10 == 0 ? 150 : 70;
        const unsigned char rgba[4] = {150, 162, 180, static_cast<unsigned char>(strength * fade)};
        colours->InsertNextTypedTuple(rgba);
        if (part == 0) continue;
        const vtkIdType ends[2] = {id - 1, id};
        cells->InsertNextCell(2, ends);
      }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  data->GetPointData()->SetScalars(colours);
  return data;
}

class VtkSceneView : public SceneView {
 public:
  VtkSceneView() {
    setUpWindow();
    setUpLights();
    setUpLayers();
  }
  ~VtkSceneView() override {
    for (const auto& p : pixels_) glDeleteTextures(1, &p.texture);
    window_->Finalize();
  }
  VtkSceneView(const VtkSceneView&) = delete;
  VtkSceneView& operator=(const VtkSceneView&) = delete;

  std::uint64_t texture(const ViewState& state, int width, int height, bool fine) override {
    const int w = std::max(width, 8), h = std::max(height, 8);
    const bool resized = width_ != w || height_ != h;
    const bool changed = !drawn_ || !(*drawn_ == state);
    // A picture that was made fine stays so until something changes.
    if (changed || resized || (fine && !fine_)) {
      width_ = w;
      height_ = h;
      fine_ = fine;
      const bool larger = fine && std::int64_t{w} * h * kFineFactor * kFineFactor <= kMostFinePixels;
      setPixels(larger ? kFineFactor : 1);
      update(state);
      renderer_->SetPass(fine && state.cloud && state.shaded_points ? static_cast<vtkRenderPass*>(depth_shading_)
                                                                    : steps_);
      window_->Render();
      drawn_ = state;
    }
    auto* buffer = window_->GetDisplayFramebuffer();
    auto* colour = buffer != nullptr ? buffer->GetColorAttachmentAsTextureObject(0) : nullptr;
    if (colour == nullptr) return 0;
    smooth(colour->GetHandle());
    return colour->GetHandle();
  }

  std::uint64_t texture(const std::shared_ptr<const PixelPicture>& picture) override {
    if (picture == nullptr || picture->rgba.empty()) return 0;
    auto shown = std::find_if(pixels_.begin(), pixels_.end(), [&](const auto& p) { return p.of.lock() == picture; });
    if (shown != pixels_.end()) return shown->texture;
    shown = std::find_if(pixels_.begin(), pixels_.end(), [](const auto& p) { return p.of.expired(); });
    if (shown == pixels_.end()) {
      shown = pixels_.emplace(pixels_.end());
      glGenTextures(1, &shown->texture);
    }
    shown->of = picture;
    smooth(shown->texture);
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, shown->texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture->width, picture->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 picture->rgba.data());
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
    return shown->texture;
  }

 private:
  void setPixels(int factor) {
    window_->SetSize(width_ * factor, height_ * factor);
    for (Layer* layer : {&edges_, &grid_}) layer->actor->GetProperty()->SetLineWidth(static_cast<float>(factor));
    outline_.actor->GetProperty()->SetLineWidth(static_cast<float>(2 * factor));
    cloud_.actor->GetProperty()->SetPointSize(static_cast<float>(2 * factor));
    for (const auto& u : underlays_) u->layer.actor->GetProperty()->SetPointSize(static_cast<float>(2 * factor));
  }

  // At half size each pixel is then the mean of four.
  static void smooth(GLuint texture) {
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  }

  void setUpWindow() {
    window_->SetOwnContext(0);
    window_->SetMapped(1);
    window_->SetReadyForRendering(true);
    window_->SetIsDirect(1);
    window_->SetSupportsOpenGL(1);
    window_->SetIsCurrent(true);
    window_->SetFrameBlitModeToNoBlit();  // the picture is taken from the display framebuffer's texture
    window_->SetMultiSamples(0);
    window_->SetSize(8, 8);
    window_->AddRenderer(renderer_);
    renderer_->GradientBackgroundOn();  // also gives the texture an alpha of 1
    renderer_->SetBackground(0.118, 0.129, 0.149);
    renderer_->SetBackground2(0.267, 0.298, 0.345);
    renderer_->SetAutomaticLightCreation(0);
    setUpPasses();
  }

  // Plain blending into the same depth buffer: the renderer's own order-independent pass copies the depth first, which
  // fails for a multisampled framebuffer, and then everything translucent shines through walls.
  void setUpPasses() {
    vtkNew<vtkTranslucentPass> translucent;
    steps_->SetTranslucentPass(translucent);
    depth_shading_->SetDelegatePass(steps_);
    renderer_->SetPass(steps_);
  }

  // A low sun from the camera's left, the sky from above, and a little from below so that no face is black.
  void setUpLights() {
    addLight(VTK_LIGHT_TYPE_CAMERA_LIGHT, {-0.45, 0.35, 1.0}, {1.0, 0.985, 0.95}, 0.58);
    addLight(VTK_LIGHT_TYPE_SCENE_LIGHT, {0.35, -0.3, 1.0}, {0.94, 0.97, 1.0}, 0.40);
    addLight(VTK_LIGHT_TYPE_SCENE_LIGHT, {0.8, 0.5, -0.3}, {0.85, 0.9, 1.0}, 0.14);
  }

  void addLight(int type, std::array<double, 3> position, std::array<double, 3> colour, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightType(type);
    light->SetPosition(position[0], position[1], position[2]);
    light->SetFocalPoint(0, 0, 0);
    light->SetColor(colour.data());
    light->SetIntensity(intensity);
    light->SetPositional(0);
    renderer_->AddLight(light);
  }

  void setUpSurface(Layer& layer, double offset) {
    auto* property = layer.actor->GetProperty();
    property->SetInterpolationToFlat();
    property->SetAmbient(0.34);
    property->SetDiffuse(0.78);
    property->SetSpecular(0);
    layer.mapper->SetColorModeToDirectScalars();
    layer.mapper->SetResolveCoincidentTopologyToPolygonOffset();
    layer.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(offset, offset);
    renderer_->AddActor(layer.actor);
  }

  void setUpLines(Layer& layer, std::array<double, 3> colour, double opacity, double width) {
    auto* property = layer.actor->GetProperty();
    property->SetLighting(false);
    property->SetColor(colour.data());
    property->SetOpacity(opacity);
    property->SetLineWidth(static_cast<float>(width));
    renderer_->AddActor(layer.actor);
  }

  void setUpPoints(Layer& layer) {
    layer.actor->GetProperty()->SetLighting(false);
    layer.mapper->SetScalarModeToUsePointData();
    layer.mapper->SetColorModeToDirectScalars();
    renderer_->AddActor(layer.actor);
  }

  void setUpLayers() {
    setUpLines(grid_, {0.6, 0.6, 0.6}, 1, 1);  // what is translucent is blended in this order
    grid_.actor->ForceTranslucentOn();
    setUpSurface(opaque_, 1);
    setUpSurface(transparent_, 1);
    transparent_.actor->ForceTranslucentOn();
    setUpSurface(graded_, 1);
    setUpSurface(graded_transparent_, 1);
    graded_transparent_.actor->ForceTranslucentOn();
    setUpSurface(shapes_, 1);
    setUpSurface(selected_, -1);
    selected_.actor->ForceTranslucentOn();
    selected_.actor->GetProperty()->SetAmbient(0.5);
    setUpSurface(walkable_, -1);
    walkable_.actor->ForceTranslucentOn();
    walkable_.actor->GetProperty()->SetAmbient(0.8);
    setUpLines(edges_, {0.07, 0.08, 0.10}, 0.55, 1);
    setUpLines(outline_, {0.42, 0.71, 1.0}, 1, 2);
    setUpPoints(cloud_);
    for (Layer* layer : {&opaque_, &transparent_, &graded_, &graded_transparent_, &shapes_, &selected_, &walkable_,
                         &edges_, &outline_, &grid_, &cloud_})
      layer->hide();
  }

  void update(const ViewState& state) {
    const ViewState* last = drawn_ ? &*drawn_ : nullptr;
    const bool environment = last == nullptr || last->environment != state.environment;
    const bool shown =
        environment || last->hidden != state.hidden || last->shapes != state.shapes || last->cloud != state.cloud;
    if (environment) bounds_ = state.environment ? bounds(*state.environment) : Bounds();
    const bool painted = shown || last->materials != state.materials || last->colour != state.colour ||
                         last->wavelength_nm != state.wavelength_nm || last->deviation != state.deviation;
    if (painted) updateSurfaces(state, !shown);
    if (shown || last->edges != state.edges) updateEdges(state);
    if (shown || last->selected != state.selected) updateSelection(state);
    if (last == nullptr || last->collision != state.collision || last->walkable != state.walkable ||
        last->shapes != state.shapes)
      updateCollision(state);
    if (environment || last->grid != state.grid) updateGrid(state);
    if (last == nullptr || last->cloud != state.cloud) updateCloud(state);
    if (last == nullptr || last->underlays != state.underlays || last->cloud != state.cloud) updateUnderlays(state);
    reach_ = reachOf(state);
    updateCut(state);
    updateCamera(state.camera);
  }

  void updateSurfaces(const ViewState& state, bool same_triangles) {
    auto colours = state.environment && !state.shapes && !state.cloud ? mergeColours(state) : std::nullopt;
    const bool repaint = same_triangles && colours && runs_ == colours->runs;
    if (repaint) {
      opaque_.paint(colours->opaque);
      transparent_.paint(colours->transparent);
      return;
    }
    runs_ = colours ? std::move(colours->runs) : std::vector<std::uint32_t>();
    opaque_.hide();
    transparent_.hide();
    graded_.hide();
    graded_transparent_.hide();
    for (const auto& layer : painted_) renderer_->RemoveActor(layer->actor);
    painted_.clear();
    if (!state.environment || state.shapes || state.cloud) return;
    const auto merged = mergeVisible(state);
    opaque_.show(merged.opaque);
    transparent_.show(merged.transparent);
    graded_.show(merged.graded);
    graded_transparent_.show(merged.graded_transparent);
    for (const auto& [key, painted] : merged.painted) {
      painted_.push_back(std::make_unique<Layer>());
      setUpSurface(*painted_.back(), 1);
      painted_.back()->show(painted, textures_.of(state.environment->images[static_cast<std::size_t>(key.first)]));
    }
  }

  void updateEdges(const ViewState& state) {
    edges_.hide();
    if (state.environment && state.edges && !state.shapes && !state.cloud)
      edges_.show(edge_cache_.edges(state, nullptr, kMostEdges));
  }

  void updateSelection(const ViewState& state) {
    selected_.hide();
    outline_.hide();
    if (!state.environment || !state.selected || state.selected->empty()) return;
    selected_.show(mergeProducts(*state.environment, *state.selected, {64, 144, 247, 110}));
    outline_.show(edge_cache_.edges(state, state.selected.get(), kMostEdges));
  }

  void updateCollision(const ViewState& state) {
    shapes_.hide();
    walkable_.hide();
    if (!state.collision) return;
    if (state.shapes) shapes_.show(mergeShapes(*state.collision));
    if (state.walkable) walkable_.show(mergeMesh(state.collision->walkable, {72, 200, 130, 120}, 0.03F));
  }

  void updateCloud(const ViewState& state) {
    cloud_.hide();
    if (state.cloud) cloud_.show(*state.cloud);
  }

  // Above what can be turned smoothly each shows every k-th point of its sample.
  void updateUnderlays(const ViewState& state) {
    std::uint64_t points = 0;
    for (const auto& u : state.underlays) points += u.cloud->colours.size();
    const auto step = static_cast<std::size_t>(points / kMostShownPoints + 1);
    while (underlays_.size() < state.underlays.size()) {
      underlays_.push_back(std::make_unique<UnderlayLayer>());
      setUpPoints(underlays_.back()->layer);
      underlays_.back()->layer.actor->GetProperty()->SetPointSize(cloud_.actor->GetProperty()->GetPointSize());
    }
    for (std::size_t i = 0; i < underlays_.size(); ++i) {
      auto& [layer, cloud, shown_step] = *underlays_[i];
      layer.hide();
      if (state.cloud || i >= state.underlays.size()) continue;
      const auto& wanted = state.underlays[i];
      if (cloud != wanted.cloud || shown_step != step) layer.show(*wanted.cloud, step);
      cloud = wanted.cloud;
      shown_step = step;
      vtkNew<vtkMatrix4x4> matrix;
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
          matrix->SetElement(row, column, wanted.local_from_cloud(row, column));
      layer.actor->SetUserMatrix(matrix);
      layer.actor->SetVisibility(1);
    }
  }

  // Of all that is shown; what lies behind it is not drawn.
  Bounds reachOf(const ViewState& state) const {
    Bounds reach = bounds_;
    if (!state.cloud)
      for (const auto& u : underlays_)
        if (u->layer.actor->GetVisibility() != 0) {
          const double* b = u->layer.actor->GetBounds();
          reach.extend(Eigen::Vector3d(b[0], b[2], b[4]));
          reach.extend(Eigen::Vector3d(b[1], b[3], b[5]));
        }
    return reach;
  }

  void updateGrid(const ViewState& state) {
    grid_.hide();
    if (!state.grid || !state.environment || bounds_.empty()) return;
    grid_.mapper->SetColorModeToDirectScalars();
    grid_.set(groundGrid(bounds_), false);
  }

  void updateCut(const ViewState& state) {
    std::vector<Layer*> layers = {&opaque_,  &transparent_, &graded_,   &graded_transparent_,
                                  &shapes_,  &selected_,    &walkable_, &edges_,
                                  &outline_, &cloud_};
    for (const auto& u : underlays_) layers.push_back(&u->layer);
    for (const auto& layer : painted_) layers.push_back(layer.get());
    for (Layer* layer : layers) {
      layer->mapper->RemoveAllClippingPlanes();
      if (!state.cut_height_m) continue;
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(0, 0, *state.cut_height_m);
      plane->SetNormal(0, 0, -1);
      layer->mapper->AddClippingPlane(plane);
    }
  }

  void updateCamera(const Camera& camera) {
    auto* vtk = renderer_->GetActiveCamera();
    const Eigen::Vector3d eye = camera.eye(), up = camera.up();
    vtk->SetPosition(eye.x(), eye.y(), eye.z());
    vtk->SetFocalPoint(camera.target.x(), camera.target.y(), camera.target.z());
    vtk->SetViewUp(up.x(), up.y(), up.z());
    vtk->SetViewAngle(camera.view_angle_rad / kRadPerDeg);
    vtk->SetParallelProjection(camera.orthographic ? 1 : 0);
    vtk->SetParallelScale(camera.heightAtTarget_m() / 2);
    if (reach_.empty()) {
      vtk->SetClippingRange(0.1, 1000);
      return;
    }
    const Eigen::Vector3d centre = (reach_.min + reach_.max) / 2;
    const double reach = 2 * reach_.diagonal() + 10;  // the grid reaches farther than the model
    const double depth = (centre - eye).dot(camera.forward());
    if (camera.orthographic) {
      vtk->SetClippingRange(depth - reach, depth + reach);
      return;
    }
    // As far away as the model allows: how finely depths can be told apart hangs on the nearest one.
    const Eigen::Vector3d outside = (eye - reach_.max).cwiseMax(reach_.min - eye).cwiseMax(0.0);
    const double nearest = std::max(0.04, 0.5 * outside.norm());
    vtk->SetClippingRange(nearest, std::max(depth + reach, 10 * nearest));
  }

  vtkNew<ForeignContextWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderStepsPass> steps_;
  vtkNew<vtkEDLShading>
      depth_shading_;  // eye-dome lighting, of a bare cloud at rest: it costs as much as a million points
  Layer opaque_, transparent_, graded_, graded_transparent_, shapes_, selected_, walkable_, edges_, outline_, grid_,
      cloud_;
  std::vector<std::unique_ptr<Layer>> painted_;  // one for each image in sight
  std::vector<std::uint32_t>
      runs_;  // of what opaque_ and transparent_ show; empty: their colours cannot be changed alone
  TextureCache textures_;
  EdgeCache edge_cache_;
  struct UnderlayLayer {
    Layer layer;
    std::shared_ptr<const Cloud> cloud;
    std::size_t step = 0;
  };
  std::vector<std::unique_ptr<UnderlayLayer>> underlays_;
  Bounds bounds_, reach_;  // of the environment; of all that is shown
  std::optional<ViewState> drawn_;
  struct PixelTexture {
    std::weak_ptr<const PixelPicture> of;  // gone: the texture is free for another
    GLuint texture = 0;
  };
  std::vector<PixelTexture> pixels_;
  bool fine_ = false;
  int width_ = 0, height_ = 0;  // of the picture as it is shown
};

}  // namespace

std::unique_ptr<SceneView> makeVtkSceneView() { return std::make_unique<VtkSceneView>(); }

}  // namespace standpoint
