// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "editor/desktop/user_folders.h"
#include "editor/device_pictures.h"
#include "editor/instrument/instrument.h"
#include "editor/pictures.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shots.h"
#include "editor/viewport/offscreen.h"
#include "editor/viewport/plain_message.h"
#include "editor/viewport/window.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "pointclouds/formats.h"
#include "project/model/import_verb.h"

namespace {

using namespace standpoint;

constexpr double kFlight_s = 0.25;

constexpr const char* kUsage =
    "standpoint-editor [PROJECT or MODEL...]\nstandpoint-editor --pictures OUTDIR [--size 1280x800] [--scale 1] "
    "[--language en] [--theme dark|light] PROJECT or MODEL\nstandpoint-editor --devices OUTDIR [--language en] "
    "[--scale 1]\n  --pictures  "
    "render the editor "
    "without a display and save screenshots as PNG files\n  --devices   render every screen of every emulated device, "
    "one folder per device\n";

struct Arguments {
  std::vector<std::string> paths;  // one project, or models that belong together
  std::string pictures, devices, language = "en";
  Theme theme = Theme::dark;
  int width = 1280, height = 800;
  bool sized = false;  // on the command line
  float scale = 1;
  std::optional<ShotOptions> shot;
  bool help = false;
};

// Of the editor's own window: a picture of the model has other limits.
Result<void> takeWindowSize(Arguments& arguments, const std::string& value) {
  const bool read = std::sscanf(value.c_str(), "%dx%d", &arguments.width, &arguments.height) == 2;
  if (!read || arguments.width < 640 || arguments.height < 400 || arguments.width > 8192 || arguments.height > 8192)
    return failure(ErrorKind::usage,
                   fmt::format("invalid size '{}': use WIDTHxHEIGHT from 640x400 to 8192x8192", value), "--size");
  arguments.sized = true;
  return {};
}

Result<Arguments> parse(const std::vector<std::string>& words) {
  Arguments result;
  std::string size;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& word = words[i];
    const bool takes_value = word == "--pictures" || word == "--scale" || word == "--devices" || word == "--language" ||
                             word == "--theme" || isShotOption(word);
    if (takes_value && i + 1 >= words.size()) return failure(ErrorKind::usage, "missing value", word);
    if (word == "--size") {  // whose it is, is known at the end
      size = words[++i];
      continue;
    }
    TRY_ASSIGN(const bool taken, takes_value ? takeShotOption(word, words[i + 1], result.shot) : Result<bool>(false));
    if (taken) {
      ++i;
    } else if (word == "--help" || word == "-h") {
      result.help = true;
    } else if (word == "--pictures") {
      result.pictures = words[++i];
    } else if (word == "--devices") {
      result.devices = words[++i];
    } else if (word == "--language") {
      result.language = words[++i];
    } else if (word == "--theme") {
      const auto theme = themeOf(words[++i]);
      if (!theme)
        return failure(ErrorKind::usage, fmt::format("unknown theme '{}': use dark or light", words[i]), word);
      result.theme = *theme;
    } else if (word == "--scale") {
      result.scale = std::strtof(words[++i].c_str(), nullptr);
      if (!(result.scale >= 0.5F && result.scale <= 4))
        return failure(ErrorKind::usage, fmt::format("invalid scale '{}': use a number from 0.5 to 4", words[i]), word);
    } else if (!word.empty() && word[0] == '-') {
      return failure(ErrorKind::usage, fmt::format("unknown option '{}'\n{}", word, kUsage));
    } else {
      result.paths.push_back(word);
    }
  }
  if (!size.empty() && result.shot) {
    TRY(takeShotOption("--size", size, result.shot));
  } else if (!size.empty()) {
    TRY(takeWindowSize(result, size));
  }
  if (!result.pictures.empty() && result.paths.empty())
    return failure(ErrorKind::usage, "--pictures requires a project or model");
  if (result.shot && (result.shot->file.empty() || result.paths.empty()))
    return failure(ErrorKind::usage,
                   fmt::format("a picture or film requires its file and a project or model\n{}", shotUsage()));
  return result;
}

std::vector<Verb> allVerbs() { return {verbs().begin(), verbs().end()}; }

int fail(const Error& error) {
  std::cerr << "standpoint-editor: " << describe(error) << '\n';
  switch (error.kind) {
    case ErrorKind::usage: return 2;
    case ErrorKind::file_system: return 4;
    case ErrorKind::cancelled: return 130;
    default: return 3;
  }
}

// One folder is a project; files are models that make one environment, and clouds that lie under it or are looked at
// alone. Who names them on the command line has chosen already: there is no preview.
void openAll(Editor& editor, const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> files;
  bool clouds_alone = true;
  for (const auto& path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored) || std::filesystem::path(path).filename() == "project.json") {
      openPath(editor, path);
      return;
    }
    clouds_alone = clouds_alone && readableCloudFormat(path) != nullptr;
    files.emplace_back(path);
  }
  if (files.empty()) return;
  if (clouds_alone) editor.workspace = Workspace::inspect;
  const auto title = files.size() == 1 ? "Import " + files.front().filename().string() : "Import models";
  if (editor.session.start(ImportVerbOptions{{.files = files}}, title) && files.size() == 1)
    editor.settings.remember(files.front());
}

// Without a display.
Result<void> openIn(Editor& editor, Offscreen& offscreen, const std::vector<std::string>& paths) {
  openAll(editor, paths);
  editor.session.wait();
  if (!editor.session.errors().empty()) return tl::unexpected<Error>(editor.session.errors().front().error);
  // The clouds, too: nobody waits for them in front of a window.
  for (editor.update(); editor.readingCloud() || !editor.underlays.reading().empty(); editor.update())
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  if (!editor.session.errors().empty()) return tl::unexpected<Error>(editor.session.errors().front().error);
  offscreen.adopt(editor);
  return {};
}

volatile std::sig_atomic_t interrupted = 0;
char** command_line = nullptr;

int makeOneShot(const Arguments& arguments) {
  auto offscreen = Offscreen::create(arguments.width, arguments.height, arguments.scale);
  if (!offscreen) return fail(offscreen.error());
  Editor editor(allVerbs(), [] {});
  if (auto opened = openIn(editor, **offscreen, arguments.paths); !opened) return fail(opened.error());
  Progress progress;
  Report report;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  progress.onChange([&] {
    if (interrupted != 0) progress.cancel();
    if (terminal) std::cerr << fmt::format("\r{} {:3.0f} %", progress.stageName(), 100 * progress.fraction());
  });
  std::signal(SIGINT, [](int) { interrupted = 1; });
  const auto made = makeShot(editor, **offscreen, *arguments.shot, report, progress);
  if (terminal) std::cerr << '\n';
  for (const auto& issue : report.issues) std::cerr << issue.source << ": " << issue.message << '\n';
  if (!made) return fail(made.error());
  std::cout << arguments.shot->file.string() << '\n';
  return 0;
}

int makePictures(const Arguments& arguments) {
  auto offscreen = Offscreen::create(arguments.width, arguments.height, arguments.scale);
  if (!offscreen) return fail(offscreen.error());
  Editor editor(allVerbs(), [] {});
  editor.settings.language = arguments.language;
  editor.settings.theme = arguments.theme;
  speak(arguments.language);
  printReportsAsSpoken();
  attachInstrument(editor);
  if (auto opened = openIn(editor, **offscreen, arguments.paths); !opened) return fail(opened.error());
  auto written = drawPictures(editor, **offscreen, arguments.pictures);
  if (!written) return fail(written.error());
  for (const auto& file : *written) std::cout << file.string() << '\n';
  return 0;
}

int makeDevicePictures(const Arguments& arguments) {
  auto written = drawDevicePictures(arguments.devices, arguments.language, arguments.scale);
  if (!written) return fail(written.error());
  std::cout << *written << " pictures in " << arguments.devices << '\n';
  return 0;
}

// Mesa draws without a graphics card, where it is installed. Once: what this has started ends here if that fails, too.
int goOnWithoutOpenGl(const Error& error) {
  constexpr const char* kSoftware = "LIBGL_ALWAYS_SOFTWARE";
  if (std::getenv(kSoftware) == nullptr) {
    std::cerr << "standpoint-editor: " << describe(error) << "; trying software rendering\n";
    setenv(kSoftware, "1", 1);
    setenv("__GLX_VENDOR_LIBRARY_NAME", "mesa", 1);
    execv("/proc/self/exe", command_line);
  }
  showPlainMessage(
      "Standpoint cannot open its window",
      describe(error) +
          "\n\nThis display has no OpenGL 3.2, and software rendering does not help. Install the package "
          "libgl1-mesa-dri, or update the graphics driver, and start again.\n\nWithout a window: the command "
          "'standpoint' has every step of the work, and 'standpoint-editor --pictures FOLDER PROJECT' draws "
          "the editor.");
  return fail(error);
}

int openWindow(const Arguments& arguments) {
  Editor editor(allVerbs(), wakeWindow);
  editor.flight = CameraFlight(kFlight_s);
  attachInstrument(editor);
  const auto crashes = takeNewCrashes(recoveryRoot());
  const auto prepare = [&] {
    auto stored = readSettings(settingsFile());
    editor.settings = std::move(stored.settings);
    if (arguments.sized) editor.settings.window.reset();
    speak(editor.settings.language);
    if (!stored.problem.empty()) editor.say(std::move(stored.problem));
    editor.dialogs.recovery = findLeftWork(recoveryRoot());
  };
  const auto open = [&] { openAll(editor, arguments.paths); };
  if (crashes.again_at_start) {
    editor.settings.graphics = GraphicsChoice::low;
    editor.dialogs.bare = true;
    editor.dialogs.start_as_usual = [&] { prepare(), open(); };
  } else {
    prepare();
  }
  const auto ready = [&] {
    if (!crashes.again_at_start) open();
  };
  const auto shown = runWindow(editor, arguments.width, arguments.height, crashes.any, ready);
  if (!shown && shown.error().source == kNoOpenGl) return goOnWithoutOpenGl(shown.error());
  if (editor.dialogs.start_as_usual)
    return shown ? 0 : fail(shown.error());  // the user's preferences stay as they were
  if (auto written = writeSettings(editor.settings, settingsFile()); !written)
    std::cerr << describe(written.error()) << '\n';
  return shown ? 0 : fail(shown.error());
}

}  // namespace

int main(int count, char** words) {
  command_line = words;
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on files is a full disk: the writer's error, not the program's end
  const auto arguments = parse({words + 1, words + count});
  if (!arguments) return fail(arguments.error());
  if (arguments->help) {
    std::cout << kUsage << shotUsage();
    return 0;
  }
  if (arguments->shot) return makeOneShot(*arguments);
  if (!arguments->devices.empty()) return makeDevicePictures(*arguments);
  return arguments->pictures.empty() ? openWindow(*arguments) : makePictures(*arguments);
}
