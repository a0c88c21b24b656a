// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/offscreen.h"

#include <string>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <vtk_glew.h>

#include "editor/film/picture_file.h"
#include "editor/shell/shell.h"
#include "editor/viewport/display_picture.h"
#include "editor/viewport/kept_frame.h"
#include "editor/viewport/vtk_scene_view.h"
#include "editor/widgets/theme.h"

namespace standpoint {

namespace {

constexpr int kFramesUntilStill = 6;  // layouts settle within two or three; popups take one more

struct EglContext {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~EglContext() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
  }

  // "" when a context is current, else what failed.
  const char* make() {
    const auto platform =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (platform == nullptr) return "EGL cannot create an off-screen display";
    display = platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
      return "EGL does not support surfaceless displays";
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return "EGL does not support OpenGL";
    const EGLint config_wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    eglChooseConfig(display, config_wanted, &config, 1, &found);
    const EGLint wanted[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, found > 0 ? config : nullptr, EGL_NO_CONTEXT, wanted);
    if (context == EGL_NO_CONTEXT) return "OpenGL 3.2 is not available";
    return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE
               ? ""
               : "cannot activate the OpenGL context";
  }
};

class EglOffscreen : public Offscreen {
 public:
  EglOffscreen(std::unique_ptr<EglContext> egl, int width, int height, float scale)
      : egl_(std::move(egl)), width_(width), height_(height), scale_(scale) {
    ImGui::CreateContext();
    auto& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    io.DeltaTime = 1.0F / 30;
    io.MousePos = {-1, -1};
    applyTheme(scale);  // until an editor with another theme is adopted
    fonts_ = buildFonts(scale);
    scene_ = makeVtkSceneView();
    beside_ = makeVtkSceneView();
    scene_->texture(ViewState(), 8, 8, false);  // loads the OpenGL functions
    ImGui_ImplOpenGL3_Init("#version 150");
    makeTarget();
  }
  ~EglOffscreen() override {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
    beside_.reset();
    scene_.reset();
  }
  EglOffscreen(const EglOffscreen&) = delete;
  EglOffscreen& operator=(const EglOffscreen&) = delete;

  void adopt(Editor& editor) override {
    applyTheme(scale_, editor.settings.theme);
    editor.fonts = fonts_;
    editor.scale = scale_;
    editor.scene = scene_.get();
    editor.scene_beside = beside_.get();
    editor.fine_picture = true;
  }

  SceneView& scene() override { return *scene_; }
  const Fonts& fonts() const override { return fonts_; }

  void frame(Editor& editor) override {
    layOut([&] { drawShell(editor); });
    takeDisplay(editor, display_, *ImGui::GetDrawData());
    paint();
    glFinish();
  }

  Result<void> picture(Editor& editor, const std::filesystem::path& png) override {
    const auto draw = [&] {
      if (ImGui::GetDrawData() != nullptr) takeDisplay(editor, display_, *ImGui::GetDrawData());
      drawShell(editor);
      editor.expected.wait();
    };
    return picture(draw, png);
  }

  Result<void> picture(const std::function<void()>& draw, const std::filesystem::path& png) override {
    for (int i = 0; i < kFramesUntilStill || scene_->refining() || beside_->refining(); ++i) layOut(draw);
    paint();
    return writePicture(drawnPixels(width_, height_), png);
  }

 private:
  static void layOut(const std::function<void()>& draw) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    draw();
    ImGui::Render();
  }

  void paint() {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    kept_.draw(*ImGui::GetDrawData(), takeRepainted({scene_.get(), beside_.get()}));
  }

  void makeTarget() {
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  }

  std::unique_ptr<EglContext> egl_;
  int width_, height_;
  float scale_;
  Fonts fonts_;
  std::unique_ptr<PaintedScene> scene_, beside_;
  KeptFrame kept_{KeptFrame::Rows::upwards};
  DisplayPicture display_;
  GLuint texture_ = 0, framebuffer_ = 0;
};

}  // namespace

Result<std::unique_ptr<Offscreen>> Offscreen::create(int width, int height, float scale) {
  auto egl = std::make_unique<EglContext>();
  if (const char* failed = egl->make(); *failed != 0)
    return failure(ErrorKind::unusable,
                   std::string(failed) + "; check that a Mesa driver (libgl1-mesa-dri) is installed", "EGL");
  return std::make_unique<EglOffscreen>(std::move(egl), width, height, scale);
}

}  // namespace standpoint
