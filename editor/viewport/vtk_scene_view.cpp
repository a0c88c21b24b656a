// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/vtk_scene_view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkRenderState.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>
#include <vtkTranslucentPass.h>
#include <vtk_glew.h>

#include "core/units.h"
#include "editor/viewport/backdrop.h"
#include "editor/viewport/drawn_over.h"
#include "editor/viewport/finish.h"
#include "editor/viewport/picture_window.h"
#include "editor/viewport/point_composer.h"
#include "editor/viewport/point_layers.h"
#include "editor/viewport/scene_layers.h"
#include "editor/viewport/still_parts.h"

namespace standpoint {

namespace {

// A fine picture is drawn twice as large and shrunk, up to this many pixels.
constexpr int kFineFactor = 2;
constexpr double kArrivingSize = 0.5;  // of a picture in which a model arrives, each way
constexpr std::int64_t kMostFinePixels = 12000000;

// Those things of a picture that are to be drawn now.
class SomeOfThem {
 public:
  SomeOfThem(const vtkRenderState& all, const std::function<bool(const vtkProp*)>& drawn) : state_(all.GetRenderer()) {
    state_.SetFrameBuffer(all.GetFrameBuffer());
    state_.SetRequiredKeys(all.GetRequiredKeys());
    for (int i = 0; i < all.GetPropArrayCount(); ++i)
      if (drawn(all.GetPropArray()[i])) props_.push_back(all.GetPropArray()[i]);
    state_.SetPropArrayAndCount(props_.data(), static_cast<int>(props_.size()));
  }
  const vtkRenderState* state() const { return &state_; }

 private:
  std::vector<vtkProp*> props_;
  vtkRenderState state_;
};

// What is opaque, with something behind it and something among it.
class PassWithOurs : public vtkOpaquePass {
 public:
  static PassWithOurs* New();
  vtkTypeMacro(PassWithOurs, vtkOpaquePass);
  std::function<void()> draw_behind, draw_among;
  std::function<bool(const vtkProp*)> drawn;
  void Render(const vtkRenderState* state) override {
    draw_behind();
    vtkOpaquePass::Render(SomeOfThem(*state, drawn).state());
    draw_among();
  }
};
vtkStandardNewMacro(PassWithOurs);

class TranslucentPass : public vtkTranslucentPass {
 public:
  static TranslucentPass* New();
  vtkTypeMacro(TranslucentPass, vtkTranslucentPass);
  std::function<bool(const vtkProp*)> drawn;
  void Render(const vtkRenderState* state) override { vtkTranslucentPass::Render(SomeOfThem(*state, drawn).state()); }
};
vtkStandardNewMacro(TranslucentPass);

// A box of plaster in one of glass: a driver that draws by the processor compiles what draws them.
std::shared_ptr<const Environment> anyModel() {
  Environment model;
  model.surfaces = {{"plaster", {0.8F, 0.8F, 0.8F, 1}}, {"glass", {0.6F, 0.8F, 0.9F, 0.4F}}};
  for (std::uint32_t surface = 0; surface < 2; ++surface) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f place(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      mesh.positions.push_back((surface == 0 ? 1.0F : 2.0F) * (place - Eigen::Vector3f::Constant(0.5F)));
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    mesh.surface_of_triangle.assign(mesh.triangles.size(), surface);
    model.meshes.push_back(std::make_shared<Mesh>(std::move(mesh)));
    model.products.emplace_back();
    model.instances.push_back({surface, surface, Eigen::Affine3d::Identity()});
  }
  return std::make_shared<const Environment>(std::move(model));
}

bool drawnByProcessor() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name != nullptr ? name : "";
  for (const char* known : {"llvmpipe", "softpipe", "swrast", "SWR", "Software"})
    if (renderer.find(known) != std::string_view::npos) return true;
  return false;
}

// Points may have come while it moved.
bool onlyCameraDiffers(const ViewState& a, const ViewState& b) {
  ViewState moved = a;
  moved.camera = b.camera;
  moved.underlays = b.underlays;
  return moved == b && !(a.camera == b.camera);
}

// Of the working instrument, or points as they are measured.
bool onlyPartsMove(const ViewState& a, const ViewState& b) {
  if (!a.working || !b.working || !(a.working->stands == b.working->stands)) return false;
  ViewState moved = a;
  moved.working = b.working;
  moved.display = b.display;
  moved.underlays = b.underlays;
  return moved == b;
}

class VtkSceneView : public PaintedScene {
 public:
  VtkSceneView() {
    setUpWindow();
    setUpLights();
  }
  ~VtkSceneView() override {
    still_.reset();
    backdrop_.reset();
    composer_.reset();
    finish_.reset();
    for (const auto& p : pixels_) glDeleteTextures(1, &p.texture);
    window_->Finalize();
  }
  VtkSceneView(const VtkSceneView&) = delete;
  VtkSceneView& operator=(const VtkSceneView&) = delete;

  std::uint64_t texture(const ViewState& state, int width, int height, bool fine) override {
    const int w = std::max(width, 8), h = std::max(height, 8);
    const bool resized = width_ != w || height_ != h;
    const bool changed = !drawn_ || !(*drawn_ == state);
    // What is new is shown before it is made fine: its first picture has enough to make.
    fine_wanted_ = fine;
    if (layers_.building() || !drawn_ || drawn_->environment != state.environment) fine = false;
    // A picture that was made fine stays so until something changes.
    if (!changed && !resized && fine && !fine_ && !window_->hasPixels(w * factorOf(true), h * factorOf(true))) {
      // That takes as long as to draw it: one after the other.
      window_->makeReady(w * factorOf(true), h * factorOf(true));
    } else if (changed || resized || (fine && !fine_) || layers_.building() || arriving_) {
      const bool after_measuring = std::exchange(measured_, false);
      const bool counts = changed && !fine && !resized && !after_measuring && drawn_;
      if (counts && onlyCameraDiffers(*drawn_, state)) ++moved_pictures_;
      if (counts && onlyPartsMove(*drawn_, state)) ++worked_pictures_;
      width_ = w;
      height_ = h;
      draw(state, fine, resized);
      shading_ = shades(state);
      if (shading_) finish().begin();
      show(finished(state));
    } else if (refining()) {
      if (points_.pending() && points_.refine()) {
        takePoints();
        window_->Render();
      }
      show(finished(state));
    }
    if (shown_ != 0) smooth(shown_);
    return shown_;
  }

  std::vector<Repainted> takeRepainted() override { return std::exchange(repainted_, {}); }

  bool prepare(const ViewState& state, int width, int height) override {
    const int w = std::max(width, 8), h = std::max(height, 8);
    if (drawn_ && drawn_->environment && drawn_->environment != any_model_) return false;  // a model has been drawn
    if (!window_->hasPixels(w, h)) {
      texture(state, w, h, false);
    } else if (!any_model_) {
      any_model_ = anyModel();
      ViewState with = state;
      with.environment = any_model_;
      frame(with.camera, bounds(*any_model_), 1);
      texture(with, w, h, false);
    } else if (!window_->hasPixels(w * factorOf(true), h * factorOf(true))) {
      window_->makeReady(w * factorOf(true), h * factorOf(true));
    } else {
      return false;
    }
    return true;
  }

  bool refining() const override {
    return layers_.building() || arriving_ || (fine_wanted_ && !fine_) ||
           (fine_ && ((shading_ && !finish_->shaded()) || points_.pending()));
  }
  std::string trouble() const override { return points_.trouble(); }

  GraphicsMeans means() override {
    GraphicsMeans means{.by_processor = drawnByProcessor()};
    means.no_sky = backdrop().problem();
    means.no_smoothing = finish().noSmoothing();
    means.no_shading = finish().noShading();
    return means;
  }

  std::uint64_t movedPictures() const override { return moved_pictures_; }
  std::uint64_t workedPictures() const override { return worked_pictures_; }

  // The first picture builds and compiles what it needs; the quickest of the next three was held up the least.
  double cost_s(const ViewState& state, int width, int height) override {
    ViewState moved = state;
    double least_s = 0;
    const auto moved_before = moved_pictures_;
    for (int i = 0; i < 4 && (i < 2 || least_s < 0.1); ++i) {
      moved.camera.azimuth_rad += 1e-4;
      glFinish();
      const auto begun = std::chrono::steady_clock::now();
      texture(moved, width, height, false);
      glFinish();
      const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
      least_s = i < 2 ? took_s : std::min(least_s, took_s);
    }
    moved_pictures_ = moved_before;
    measured_ = true;
    return least_s;
  }

  Result<PixelPicture> pixels(const ViewState& state, int width, int height) override {
    texture(state, width, height, true);
    while (refining()) texture(state, width, height, true);
    return shown_ == 0
               ? failure(ErrorKind::unusable, fmt::format("cannot draw {}x{} pixels: choose fewer", width, height))
               : readBack(shown_, width, height);
  }

  void drawOver(PixelPicture& picture, ImDrawData& drawing) override { putOver(picture, drawing); }

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
    repainted_.push_back({shown->texture, false});
    return shown->texture;
  }

 private:
  void show(GLuint picture) {
    shown_ = picture;
    repainted_.push_back({picture, true});
  }

  // What is drawn larger than the picture is averaged, as the screen would.
  static Result<PixelPicture> readBack(GLuint texture, int width, int height) {
    GLint bound = 0, wide = 0, high = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, texture);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &wide);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &high);
    std::vector<std::array<std::uint8_t, 4>> drawn(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, drawn.data());
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
    const int factor = wide / width;
    if (factor < 1 || wide != factor * width || high != factor * height)
      return failure(ErrorKind::unusable, fmt::format("cannot draw {}x{} pixels: choose fewer", width, height));
    PixelPicture picture{width, height, {}};
    picture.rgba.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        std::array<int, 3> sum{};
        for (int k = 0; k < factor * factor; ++k) {
          const auto from_below = static_cast<std::size_t>((height - 1 - row) * factor + k / factor);
          const auto& p = drawn[from_below * static_cast<std::size_t>(wide) +
                                static_cast<std::size_t>(column * factor + k % factor)];
          for (std::size_t c = 0; c < 3; ++c) sum[c] += p[c];
        }
        const auto mean = [&](std::size_t c) { return static_cast<std::uint8_t>(sum[c] / (factor * factor)); };
        picture.rgba.push_back({mean(0), mean(1), mean(2), 255});
      }
    return picture;
  }

  // Made when they are first needed: a picture at the lowest level does without.
  Backdrop& backdrop() {
    if (!backdrop_) backdrop_ = std::make_unique<Backdrop>();
    return *backdrop_;
  }
  Finish& finish() {
    if (!finish_) finish_ = std::make_unique<Finish>();
    return *finish_;
  }

  void draw(const ViewState& state, bool fine, bool resized) {
    const bool parts = !fine && !resized && !layers_.building() && drawn_ && onlyPartsMove(*drawn_, state);
    const bool moves = drawn_ && ((small_ && !arriving_) || !(drawn_->camera == state.camera));
    arriving_ = !fine && arrives(state);
    small_ = arriving_ || (moves && !fine && !resized && state.graphics.motion_size < 1);
    fine_ = fine;
    factor_ = factorOf(fine);
    const double size = arriving_ ? kArrivingSize : small_ ? state.graphics.motion_size : 1;
    drawn_width_ = atSize(width_, size);
    drawn_height_ = atSize(height_, size);
    window_->setPixels(drawn_width_ * factor_, drawn_height_ * factor_);
    layers_.setPixels(factor_);
    const ViewState* last = drawn_ ? &*drawn_ : nullptr;
    layers_.update(state, last);
    layers_.spareLines(!fine && sparesLines(state));
    if (last == nullptr || last->cloud != state.cloud || last->cloud_paint != state.cloud_paint ||
        last->underlays != state.underlays)
      points_.update(state);
    if (last == nullptr || last->graphics.theme != state.graphics.theme) updateTheme(state.graphics.theme);
    if (last == nullptr || last->still_light != state.still_light) updateSun(state.still_light);
    // The depths of what stands still are those of the camera's range.
    if (!parts || !still_ || !still_->kept()) updateCamera(state.camera);
    updateBackdrop(state);
    if (!points_.empty()) {
      const bool quick = state.quick_points && !fine, half = quick || (small_ && state.graphics.motion_size <= 0.5);
      points_.draw(state, pointLens(state.camera), width_, height_, half, quick);
      takePoints();
    }
    if (!parts && still_) still_->drop();
    if (parts && keepsStill(state)) shown_parts_ = Parts::moving;
    window_->Render();
    shown_parts_ = Parts::all;
    drawn_ = state;
  }

  // A scene in which an instrument works is drawn again and again: what stands still in it only once, and the steps of
  // its edges are softened once.
  bool keepsStill(const ViewState& state) {
    if (!still_) still_ = std::make_unique<StillParts>();
    if (still_->kept()) return true;
    shown_parts_ = Parts::still;
    window_->Render();
    shown_parts_ = Parts::all;
    const DrawnScene drawn = scene();
    if (drawn.colours != 0 && drawn.depths != 0)
      still_->keep(softened(state), drawn.depths, drawn_width_ * factor_, drawn_height_ * factor_);
    return still_->kept();
  }

  int factorOf(bool fine) const {
    const std::int64_t pixels = std::int64_t{width_} * height_ * kFineFactor * kFineFactor;
    return fine && pixels <= kMostFinePixels ? kFineFactor : 1;
  }

  static int atSize(int pixels, double size) { return std::max(8, static_cast<int>(std::lround(pixels * size))); }

  // A picture in which parts of a model come has enough to make: a processor draws it with fewer pixels, and whole at
  // once when they are there.
  bool arrives(const ViewState& state) const {
    const bool new_model = drawn_ && state.environment && drawn_->environment != state.environment;
    return (new_model || layers_.building()) && drawnByProcessor();
  }

  // A processor takes longer over thousands of lines than over the surfaces between them.
  bool sparesLines(const ViewState& state) const {
    return state.graphics.level == GraphicsLevel::low && drawn_ && !(drawn_->camera == state.camera) &&
           drawnByProcessor();
  }

  PointLens pointLens(const Camera& camera) {
    auto* vtk = renderer_->GetActiveCamera();
    PointLens lens;
    auto* matrix = vtk->GetCompositeProjectionTransformMatrix(static_cast<double>(width_) / height_, -1, 1);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) lens.clip_from_local(row, column) = matrix->GetElement(row, column);
    const double* range = vtk->GetClippingRange();
    lens.depths = {range[0], range[1], camera.orthographic};
    return lens;
  }

  void takePoints() {
    if (!composer_) composer_ = std::make_unique<PointComposer>();
    composer_->take(points_.picture());
  }

  // What VTK has drawn last; without colours where it could not.
  DrawnScene scene() const {
    DrawnScene scene{0, 0, drawn_width_, drawn_height_, factor_};
    auto* drawn = window_->GetRenderFramebuffer();
    auto* colours = drawn != nullptr ? drawn->GetColorAttachmentAsTextureObject(0) : nullptr;
    auto* depths = drawn != nullptr ? drawn->GetDepthAttachmentAsTextureObject() : nullptr;
    if (colours != nullptr) scene.colours = colours->GetHandle();
    if (depths != nullptr) scene.depths = depths->GetHandle();
    return scene;
  }

  Lens lens(const Camera& camera) const {
    const double* range = renderer_->GetActiveCamera()->GetClippingRange();
    const double high = camera.orthographic ? camera.heightAtTarget_m() / 2 : std::tan(camera.view_angle_rad / 2);
    return {camera.orthographic, range[0], range[1], high * width_ / height_, high};
  }

  // Maps keep the colours of their legends, and what lies beside its surface, as points do, has no corners. A processor
  // would need a second for what moves.
  bool shades(const ViewState& state) {
    const bool plain = state.colour == ColourMode::model || state.colour == ColourMode::material;
    return state.graphics.level == GraphicsLevel::high && state.environment && plain && !state.cloud &&
           state.underlays.empty() && (fine_ || !drawnByProcessor()) && finish().noShading().empty() &&
           scene().depths != 0;
  }

  GLuint finished(const ViewState& state) {
    if (shading_) {
      const GLuint shaded = finish().shade(scene(), lens(state.camera));
      shading_ = shaded != 0;
      if (shading_) return softened(state, shaded);
    }
    return still_ && still_->kept() ? scene().colours : softened(state);
  }

  // What was drawn, or what became of it, with its edges softened where the level has that.
  GLuint softened(const ViewState& state, GLuint colours = 0) {
    DrawnScene drawn = scene();
    if (colours != 0) drawn.colours = colours;
    const bool smooth_by_its_pixels = factor_ > 1;
    if (drawn.colours == 0 || smooth_by_its_pixels || state.graphics.level == GraphicsLevel::low) return drawn.colours;
    if (!finish().noSmoothing().empty()) return drawn.colours;
    smooth(drawn.colours);
    const GLuint smoothed = finish().smooth(drawn);
    return smoothed != 0 ? smoothed : drawn.colours;
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
    window_->SetFrameBlitModeToNoBlit();
    window_->SetSwapBuffers(0);  // nor copied within VTK: the picture is taken from the texture that it is drawn to
    window_->SetMultiSamples(0);
    window_->AddRenderer(renderer_);
    renderer_->GradientBackgroundOn();  // also gives the texture an alpha of 1
    renderer_->SetAutomaticLightCreation(0);
    setUpPasses();
  }

  // Plain blending into the same depth buffer: the renderer's own order-independent pass copies the depth first, which
  // fails for a multisampled framebuffer, and then everything translucent shines through walls.
  void setUpPasses() {
    const auto drawn = [this](const vtkProp* prop) {
      return shown_parts_ == Parts::all || layers_.moves(prop) == (shown_parts_ == Parts::moving);
    };
    vtkNew<TranslucentPass> translucent;
    translucent->drawn = drawn;
    steps_->SetTranslucentPass(translucent);
    vtkNew<PassWithOurs> opaque;
    opaque->drawn = drawn;
    opaque->draw_behind = [this] { shown_parts_ == Parts::moving ? still_->putBack() : drawBackdrop(); };
    opaque->draw_among = [this] {
      if (composer_ && !points_.empty() && shown_parts_ != Parts::still) composer_->draw();
    };
    steps_->SetOpaquePass(opaque);
    renderer_->SetPass(steps_);
  }

  // A low sun from the camera's left, the sky from above, and a little from below so that no face is black.
  void setUpLights() {
    sun_ = addLight(VTK_LIGHT_TYPE_CAMERA_LIGHT, kSunBesideCamera, {1.0, 0.985, 0.95}, 0.58);
    addLight(VTK_LIGHT_TYPE_SCENE_LIGHT, {0.35, -0.3, 1.0}, {0.94, 0.97, 1.0}, 0.40);
    addLight(VTK_LIGHT_TYPE_SCENE_LIGHT, {0.8, 0.5, -0.3}, {0.85, 0.9, 1.0}, 0.14);
  }

  void updateSun(bool still) {
    const auto& from = still ? kSunOfScene : kSunBesideCamera;
    sun_->SetLightType(still ? VTK_LIGHT_TYPE_SCENE_LIGHT : VTK_LIGHT_TYPE_CAMERA_LIGHT);
    sun_->SetTransformMatrix(nullptr);
    sun_->SetPosition(from[0], from[1], from[2]);
    sun_->SetFocalPoint(0, 0, 0);
  }

  vtkLight* addLight(int type, std::array<double, 3> position, std::array<double, 3> colour, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightType(type);
    light->SetPosition(position[0], position[1], position[2]);
    light->SetFocalPoint(0, 0, 0);
    light->SetColor(colour.data());
    light->SetIntensity(intensity);
    light->SetPositional(0);
    renderer_->AddLight(light);
    return light;  // the renderer keeps it
  }

  void updateTheme(Theme theme) {
    const bool light = theme == Theme::light;
    if (light) {
      renderer_->SetBackground(0.780, 0.800, 0.825);
      renderer_->SetBackground2(0.915, 0.930, 0.950);
    } else {
      renderer_->SetBackground(0.118, 0.129, 0.149);
      renderer_->SetBackground2(0.267, 0.298, 0.345);
    }
  }

  // Seen in parallel there is no horizon: the plain gradient stays.
  void updateBackdrop(const ViewState& state) {
    const bool wanted = state.graphics.level >= GraphicsLevel::medium && state.environment && !layers_.bounds().empty();
    sky_.reset();
    if (wanted && !state.camera.orthographic && backdrop().problem().empty())
      sky_ = Sky{state.camera, state.graphics.theme};
    renderer_->SetGradientBackground(!sky_);
    updateShadow(state);
  }

  // Of what stands there now; cast when the view stands still, because it costs as much as some pictures.
  void updateShadow(const ViewState& state) {
    const bool wanted = sky_ && state.graphics.level == GraphicsLevel::high && !state.cloud && !state.shapes;
    const auto now =
        wanted ? std::optional(Shadowed{state.environment, state.hidden, state.cut_height_m}) : std::nullopt;
    if (shadowed_ == now) return;
    const auto shadow = now && fine_ ? castShadow(state) : GroundShadow();
    backdrop().cast(shadow);
    layers_.cast(state, shadow);
    shadowed_ = fine_ ? now : std::nullopt;
  }

  void drawBackdrop() {
    if (sky_)
      backdrop().draw(sky_->camera, static_cast<double>(width_) / height_, sky_->theme,
                      groundHeight_m(layers_.bounds()));
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
    Bounds reached = layers_.bounds();
    reached.extend(points_.bounds());
    reached.extend(layers_.bodies());
    if (reached.empty()) {
      vtk->SetClippingRange(0.1, 1000);
      return;
    }
    const Eigen::Vector3d centre = (reached.min + reached.max) / 2;
    const double reach = 2 * reached.diagonal() + 10;  // the grid reaches farther than the model
    const double depth = (centre - eye).dot(camera.forward());
    if (camera.orthographic) {
      vtk->SetClippingRange(depth - reach, depth + reach);
      return;
    }
    // As far away as the model allows: how finely depths can be told apart hangs on the nearest one.
    const Eigen::Vector3d outside = (eye - reached.max).cwiseMax(reached.min - eye).cwiseMax(0.0);
    const double nearest = std::max(0.04, 0.5 * outside.norm());
    vtk->SetClippingRange(nearest, std::max(depth + reach, 10 * nearest));
  }

  static constexpr std::array<double, 3> kSunBesideCamera = {-0.45, 0.35, 1.0}, kSunOfScene = {-0.6, -0.5, 0.7};
  vtkLight* sun_ = nullptr;
  vtkNew<PictureWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderStepsPass> steps_;
  SceneLayers layers_{renderer_};
  PointLayers points_;
  std::shared_ptr<const Environment> any_model_;                      // that was drawn to prepare for others
  enum class Parts { all, still, moving } shown_parts_ = Parts::all;  // of the picture that is being drawn
  std::unique_ptr<StillParts> still_;                                 // made when an instrument works
  std::unique_ptr<PointComposer> composer_;                           // made when the first points are drawn
  struct Sky {
    Camera camera;
    Theme theme;
  };
  std::optional<Sky> sky_;  // behind the picture that is drawn
  struct Shadowed {
    std::shared_ptr<const Environment> environment;
    std::shared_ptr<const HiddenProducts> hidden;
    std::optional<double> cut_height_m;
    bool operator==(const Shadowed&) const = default;
  };
  std::optional<Shadowed> shadowed_;  // whose shadow the backdrop has
  std::unique_ptr<Backdrop> backdrop_;
  std::unique_ptr<Finish> finish_;
  GLuint shown_ = 0;  // the picture
  std::vector<Repainted> repainted_;
  std::uint64_t moved_pictures_ = 0, worked_pictures_ = 0;
  int factor_ = 1;  // pixels that are drawn, for each of the picture, each way
  bool shading_ = false;
  bool measured_ = false;  // the last picture was drawn for its time
  std::optional<ViewState> drawn_;
  struct PixelTexture {
    std::weak_ptr<const PixelPicture> of;  // gone: the texture is free for another
    GLuint texture = 0;
  };
  std::vector<PixelTexture> pixels_;
  bool fine_ = false, fine_wanted_ = false;
  bool small_ = false;                      // drawn with fewer pixels, since the camera moves or a model comes
  bool arriving_ = false;                   // since a model comes: to be drawn again
  int width_ = 0, height_ = 0;              // of the picture as it is shown
  int drawn_width_ = 0, drawn_height_ = 0;  // as it is drawn, without its factor
};

}  // namespace

std::unique_ptr<PaintedScene> makeVtkSceneView() { return std::make_unique<VtkSceneView>(); }

std::vector<Repainted> takeRepainted(std::initializer_list<PaintedScene*> scenes) {
  std::vector<Repainted> all;
  for (PaintedScene* scene : scenes) {
    const auto some = scene->takeRepainted();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace standpoint
