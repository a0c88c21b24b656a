// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/window.h"

#include <algorithm>
#include <atomic>
#include <unistd.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <vtk_glew.h>

#include "editor/desktop/frame_pacer.h"
#include "editor/desktop/input_queue.h"
#include "editor/desktop/interface_scale.h"
#include "editor/desktop/user_folders.h"
#include "editor/model/recovery_keeper.h"
#include "editor/shell/actions.h"
#include "editor/shell/import_preview.h"
#include "editor/shell/shell.h"
#include "editor/viewport/display_picture.h"
#include "editor/viewport/kept_frame.h"
#include "editor/viewport/lost_display.h"
#include "editor/viewport/vtk_scene_view.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

std::atomic<FramePacer*> shown_window{nullptr};

class GlfwEvents : public EventSource {
 public:
  void poll() override { glfwPollEvents(); }
  void wait() override { glfwWaitEvents(); }
  void waitAtMost(double seconds) override { glfwWaitEventsTimeout(seconds); }
};

// Of two times to come; below 0: never.
double sooner(double a_s, double b_s) { return a_s < 0 ? b_s : b_s < 0 ? a_s : std::min(a_s, b_s); }

class Window {
 public:
  Window(Editor& editor, GLFWwindow* handle, FramePacer& pacer, bool after_crash)
      : editor_(editor),
        handle_(handle),
        pacer_(pacer),
        keeper_(recoveryFolder(recoveryRoot(), getpid()), after_crash),
        settings_keeper_(settingsFile(), editor.settings) {
    ImGui::CreateContext();
    auto& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    keyboard::connect();
    io.ClipboardUserData = handle_;
    io.SetClipboardTextFn = [](void* window, const char* text) {
      glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
    };
    io.GetClipboardTextFn = [](void* window) { return glfwGetClipboardString(static_cast<GLFWwindow*>(window)); };
    listen();
    whenDisplayIsLost([this] { keeper_.keepLast(editor_.session); });
    scene_ = makeVtkSceneView();
    beside_ = makeVtkSceneView();
    scene_->texture(ViewState(), 8, 8, false);  // loads the OpenGL functions
    editor_.graphics.begin(scene_->means());
    editor_.scene = scene_.get();
    editor_.scene_beside = beside_.get();
    ImGui_ImplOpenGL3_Init("#version 150");
    makeCursors();
    rescale();
  }
  ~Window() {
    whenDisplayIsLost(nullptr);
    for (auto* cursor : cursors_)
      if (cursor != nullptr) glfwDestroyCursor(cursor);
    editor_.scene = editor_.scene_beside = nullptr;
    beside_.reset();
    scene_.reset();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void run(const std::function<void()>& ready) {
    ready();
    while (!editor_.quit) {
      waitForWork();
      if (glfwWindowShouldClose(handle_) != 0) {
        glfwSetWindowShouldClose(handle_, GLFW_FALSE);
        invoke(editor_, "quit");
        pacer_.drawSome();
      }
      drawFrame();
      keepWork();
    }
  }

 private:
  void keepWork() {
    keeper_.keep(editor_.session, editor_.settings.recovery);
    rememberPlace();
    if (!editor_.dialogs.start_as_usual) settings_keeper_.keep(editor_.settings);
    const auto& copying = editor_.session.keepingProblem();
    const auto& problem = keeper_.problem().empty() ? copying : keeper_.problem();
    if (problem == editor_.keeping_problem) return;
    editor_.keeping_problem = problem;
    pacer_.drawSome();
  }

  // Where there is no window manager, nothing is ever maximised or minimised.
  void rememberPlace() {
    if (glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) != 0) return;
    WindowPlace place = editor_.settings.window.value_or(WindowPlace());
    place.maximised = glfwGetWindowAttrib(handle_, GLFW_MAXIMIZED) != 0;
    if (!place.maximised) {
      glfwGetWindowPos(handle_, &place.x, &place.y);
      glfwGetWindowSize(handle_, &place.width, &place.height);
    }
    editor_.settings.window = place;
  }

  static Window& of(GLFWwindow* handle) { return *static_cast<Window*>(glfwGetWindowUserPointer(handle)); }

  void push(const InputEvent& event) {
    input_.push(event);
    last_moved_s_ = glfwGetTime();
  }

  // GLFW names keys by their place on an American keyboard; plus and minus lie elsewhere on others, and on the number
  // pad.
  static int plusOrMinus(int key, int scancode) {
    if (key == GLFW_KEY_KP_ADD) return kKeyPlus;
    if (key == GLFW_KEY_KP_SUBTRACT) return kKeyMinus;
    const char* name = glfwGetKeyName(key, scancode);
    if (name == nullptr || name[0] == 0 || name[1] != 0) return key;
    return name[0] == '+' ? kKeyPlus : name[0] == '-' ? kKeyMinus : key;
  }

  void listen() {
    glfwSetWindowUserPointer(handle_, this);
    using Kind = InputEvent::Kind;
    glfwSetCursorPosCallback(handle_, [](GLFWwindow* w, double x, double y) { of(w).push({Kind::move, x, y}); });
    glfwSetMouseButtonCallback(handle_, [](GLFWwindow* w, int button, int action, int modifiers) {
      double x = 0, y = 0;
      glfwGetCursorPos(w, &x, &y);
      of(w).push({Kind::button, x, y, button, action == GLFW_PRESS, modifiers});
    });
    glfwSetScrollCallback(handle_, [](GLFWwindow* w, double x, double y) { of(w).push({Kind::scroll, x, y}); });
    glfwSetKeyCallback(handle_, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
      if (key >= 0 && action != GLFW_REPEAT)
        of(w).push({Kind::key, 0, 0, plusOrMinus(key, scancode), action == GLFW_PRESS, modifiers});
    });
    glfwSetCharCallback(handle_, [](GLFWwindow* w, unsigned code) {
      of(w).push({Kind::character, 0, 0, static_cast<int>(code)});
    });
    glfwSetWindowFocusCallback(
        handle_, [](GLFWwindow* w, int focused) { of(w).focus_lost_ = of(w).focus_lost_ || focused == 0; });
    glfwSetDropCallback(handle_, [](GLFWwindow* w, int count, const char** paths) {
      if (count > 0) openFiles(of(w).editor_, {paths, paths + count});
      of(w).pacer_.drawSome();
    });
    glfwSetFramebufferSizeCallback(handle_, [](GLFWwindow* w, int, int) { of(w).pacer_.drawSome(); });
    glfwSetWindowContentScaleCallback(handle_, [](GLFWwindow* w, float, float) { of(w).pacer_.drawSome(); });
    glfwSetWindowRefreshCallback(handle_, [](GLFWwindow* w) { of(w).pacer_.drawSome(); });
  }

  void makeCursors() {
    cursors_[ImGuiMouseCursor_Arrow] = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
    cursors_[ImGuiMouseCursor_TextInput] = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
    cursors_[ImGuiMouseCursor_ResizeNS] = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
    cursors_[ImGuiMouseCursor_ResizeEW] = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
    cursors_[ImGuiMouseCursor_Hand] = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
  }

  void waitForWork() {
    const auto untilFine = [&] { return last_moved_s_ + stillFor_s(fine_picture_s_) - glfwGetTime(); };
    pacer_.waitForWork(events_, [&] {
      FramePacer::Reasons reasons{
          .input = input_.pending(),
          .key_held = keyboard::anyHeld(),
          .walker_moves = editor_.walk.moves() || editor_.fly.moves() || (editor_.held.moves && editor_.device_drawn) ||
                          editor_.flight.flies() || editor_.recording.record.active() || editor_.path_moment.plays,
          .text_edited = ImGui::GetIO().WantTextInput,
          .job_runs = editor_.jobRuns(),
          .refining = refining(),
          .until_due_s = sooner(ui::tooltipDue_s(), sooner(keeper_.untilGrown_s(), settings_keeper_.untilDue_s()))};
      if (reasons.walker_moves || (reasons.key_held && (editor_.walk.active() || editor_.view.tool == Tool::fly)))
        moveOn();
      if (!editor_.fine_picture) reasons.until_fine_s = std::max(0.0, untilFine());
      return reasons;
    });
    if (!editor_.fine_picture) editor_.fine_picture = !input_.pending() && untilFine() <= 0;
  }

  void moveOn() {
    last_moved_s_ = glfwGetTime();
    editor_.fine_picture = false;
  }

  bool refining() const {
    return scene_->refining() || beside_->refining() || editor_.costs_wanted || editor_.shots.busy();
  }

  void takeInput() {
    auto& io = ImGui::GetIO();
    if (focus_lost_) {
      keyboard::releaseAll();
      focus_lost_ = false;
    }
    const auto events = input_.takeFrame();
    if (!events.empty()) {
      pacer_.drawSome();
      editor_.fine_picture = false;
    }
    for (const auto& e : events) apply(io, e);
  }

  static void apply(ImGuiIO& io, const InputEvent& e) {
    switch (e.kind) {
      case InputEvent::Kind::move: io.MousePos = {static_cast<float>(e.x), static_cast<float>(e.y)}; break;
      case InputEvent::Kind::button:
        io.MousePos = {static_cast<float>(e.x), static_cast<float>(e.y)};
        if (e.code >= 0 && e.code < 5) io.MouseDown[e.code] = e.down;
        break;
      case InputEvent::Kind::scroll:
        io.MouseWheelH += static_cast<float>(e.x);
        io.MouseWheel += static_cast<float>(e.y);
        break;
      case InputEvent::Kind::key: keyboard::change(e.code, e.down); break;
      case InputEvent::Kind::character: io.AddInputCharacter(static_cast<unsigned>(e.code)); break;
    }
  }

  // Fonts are made for the exact size, so another monitor or another preference builds them anew.
  void rescale() {
    float x = 1, y = 1;
    glfwGetWindowContentScale(handle_, &x, &y);
    int w = 0, h = 0;
    glfwGetWindowSize(handle_, &w, &h);
    const double monitor = std::max(x, 0.5F), user = editor_.settings.user_scale;
    const auto wanted = static_cast<float>(fittingScale(monitor, user, w, h));
    if (wanted == built_scale_ && editor_.settings.theme == applied_theme_) return;
    applied_theme_ = editor_.settings.theme;
    applyTheme(wanted, applied_theme_);
    pacer_.drawSome();
    if (wanted == built_scale_) return;
    built_scale_ = editor_.scale = wanted;
    editor_.fonts = buildFonts(wanted);
    if (!editor_.fonts.problem.empty()) editor_.say(editor_.fonts.problem);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    kept_.forget();
  }

  void drawFrame() {
    int window_w = 0, window_h = 0, w = 0, h = 0;
    glfwGetWindowSize(handle_, &window_w, &window_h);
    glfwGetFramebufferSize(handle_, &w, &h);
    pacer_.drawn();
    if (w <= 0 || h <= 0) return;  // minimised
    auto& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(window_w), static_cast<float>(window_h)};
    io.DisplayFramebufferScale = {static_cast<float>(w) / static_cast<float>(window_w),
                                  static_cast<float>(h) / static_cast<float>(window_h)};
    const double now = glfwGetTime();
    io.DeltaTime = static_cast<float>(std::clamp(now - last_frame_s_, 1e-4, 0.2));
    last_frame_s_ = now;
    takeInput();
    rescale();
    const auto moved_pictures = scene_->movedPictures(), worked_pictures = scene_->workedPictures();
    ImGui_ImplOpenGL3_NewFrame();
    const auto not_measured = editor_.graphics.notMeasured();
    standpoint::drawFrame(editor_);
    if (editor_.graphics.notMeasured() != not_measured) pacer_.drawSome();  // its line has grown
    kept_.draw(*ImGui::GetDrawData(), takeRepainted({scene_.get(), beside_.get()}));
    if (takeDisplay(editor_, display_, *ImGui::GetDrawData())) pacer_.drawSome();
    glFinish();
    timeFrame(glfwGetTime() - now, scene_->movedPictures() != moved_pictures,
              scene_->workedPictures() != worked_pictures);
    glfwSwapBuffers(handle_);
    showCursor();
    showTitle();
  }

  void timeFrame(double seconds, bool moved, bool worked) {
    if (moved || worked) {
      auto said = moved ? editor_.graphics.moved(seconds) : editor_.graphics.worked(seconds);
      if (!said.empty()) editor_.say(std::move(said));
    }
    if (editor_.fine_picture && !was_fine_) fine_picture_s_ = seconds;
    was_fine_ = editor_.fine_picture;
  }

  void showCursor() {
    const auto wanted = ImGui::GetMouseCursor();
    auto* cursor = wanted >= 0 && wanted < ImGuiMouseCursor_COUNT ? cursors_[wanted] : nullptr;
    glfwSetCursor(handle_, cursor != nullptr ? cursor : cursors_[ImGuiMouseCursor_Arrow]);
  }

  void showTitle() {
    const std::string title = editor_.session.name() + (editor_.session.modified() ? " •" : "") + " – Standpoint";
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(handle_, title.c_str());
  }

  Editor& editor_;
  GLFWwindow* handle_;
  InputQueue input_;
  std::unique_ptr<PaintedScene> scene_, beside_;
  KeptFrame kept_{KeptFrame::Rows::downwards};
  GLFWcursor* cursors_[ImGuiMouseCursor_COUNT] = {};
  DisplayPicture display_;
  FramePacer& pacer_;
  GlfwEvents events_;
  double last_moved_s_ = 0, last_frame_s_ = 0;
  double fine_picture_s_ = 0;  // what the last one took
  bool was_fine_ = false;
  Theme applied_theme_ = Theme::dark;
  RecoveryKeeper keeper_;
  SettingsKeeper settings_keeper_;
  float built_scale_ = 0;
  bool focus_lost_ = false;
  std::string title_;
};

std::vector<MonitorArea> monitorAreas() {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  std::vector<MonitorArea> areas(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < areas.size(); ++i)
    glfwGetMonitorWorkarea(monitors[i], &areas[i].x, &areas[i].y, &areas[i].width, &areas[i].height);
  return areas;
}

// Before it is shown: it does not move in front of somebody.
void putWhereItWas(GLFWwindow* handle, const WindowPlace& was) {
  const auto place = onMonitors(was, monitorAreas());
  glfwSetWindowSize(handle, place.width, place.height);
  glfwSetWindowPos(handle, place.x, place.y);
  if (place.maximised) glfwMaximizeWindow(handle);
}

}  // namespace

void wakeWindow() {
  auto* pacer = shown_window.load(std::memory_order_acquire);
  if (pacer == nullptr) return;
  pacer->wake();
  glfwPostEmptyEvent();
}

Result<void> runWindow(Editor& editor, int width, int height, bool after_crash, const std::function<void()>& ready) {
  static std::string last_glfw_error;
  glfwSetErrorCallback([](int, const char* text) { last_glfw_error = text; });
  if (glfwInit() == GLFW_FALSE)
    return failure(ErrorKind::unusable, last_glfw_error + "; to run without a display, use --pictures OUTDIR PROJECT",
                   "window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* handle = glfwCreateWindow(width, height, "Standpoint", nullptr, nullptr);
  if (handle == nullptr) {
    glfwTerminate();
    return failure(ErrorKind::unusable, last_glfw_error + "; the editor requires OpenGL 3.2", kNoOpenGl);
  }
  glfwSetWindowSizeLimits(handle, 800, 500, GLFW_DONT_CARE, GLFW_DONT_CARE);
  if (editor.settings.window) putWhereItWas(handle, *editor.settings.window);
  glfwShowWindow(handle);
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(1);
  FramePacer pacer;
  shown_window.store(&pacer, std::memory_order_release);
  {
    Window window(editor, handle, pacer, after_crash);
    window.run(ready);
  }
  editor.session.cancelAll();  // a task that still runs may wake a window that is about to go
  editor.session.wait();
  shown_window.store(nullptr);
  glfwDestroyWindow(handle);
  glfwTerminate();
  removeRecovery(recoveryFolder(recoveryRoot(), getpid()));
  return {};
}

}  // namespace standpoint
