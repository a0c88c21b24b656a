// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "editor/device_pictures.h"
#include "editor/instrument/instrument.h"
#include "editor/pictures.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"
#include "editor/viewport/window.h"
#include "editor/words/words.h"
#include "pointclouds/formats.h"
#include "project/model/import_verb.h"

namespace {

using namespace standpoint;

constexpr const char* kUsage =
    "standpoint-editor [PROJECT or MODEL...]\nstandpoint-editor --pictures OUTDIR [--size 1280x800] [--scale 1] "
    "[--language en] PROJECT or MODEL\nstandpoint-editor --devices OUTDIR [--language en] [--scale 1]\n  --pictures  "
    "render the editor "
    "without a display and save screenshots as PNG files\n  --devices   render every screen of every emulated device, "
    "one folder per device\n";

struct Arguments {
  std::vector<std::string> paths;  // one project, or models that belong together
  std::string pictures, devices, language = "en";
  int width = 1280, height = 800;
  float scale = 1;
  bool help = false;
};

Result<Arguments> parse(const std::vector<std::string>& words) {
  Arguments result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& word = words[i];
    const bool takes_value =
        word == "--pictures" || word == "--size" || word == "--scale" || word == "--devices" || word == "--language";
    if (takes_value && i + 1 >= words.size()) return failure(ErrorKind::usage, "missing value", word);
    if (word == "--help" || word == "-h") {
      result.help = true;
    } else if (word == "--pictures") {
      result.pictures = words[++i];
    } else if (word == "--devices") {
      result.devices = words[++i];
    } else if (word == "--language") {
      result.language = words[++i];
    } else if (word == "--size") {
      const bool read = std::sscanf(words[++i].c_str(), "%dx%d", &result.width, &result.height) == 2;
      if (!read || result.width < 640 || result.height < 400 || result.width > 8192 || result.height > 8192)
        return failure(ErrorKind::usage,
                       fmt::format("invalid size '{}': use WIDTHxHEIGHT from 640x400 to 8192x8192", words[i]), word);
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
  if (!result.pictures.empty() && result.paths.empty())
    return failure(ErrorKind::usage, "--pictures requires a project or model");
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

// One folder is a project; files are models that make one environment, and clouds that lie under it. Who names them on
// the command line has chosen already: there is no preview.
void openAll(Editor& editor, const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> models;
  for (const auto& path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored) || std::filesystem::path(path).filename() == "project.json") {
      openPath(editor, path);
      return;
    }
    if (readableCloudFormat(path) != nullptr)
      editor.waiting_clouds.emplace_back(path);
    else
      models.push_back(path);
  }
  if (models.empty()) return;
  const auto title = models.size() == 1 ? "Import " + models.front().filename().string() : "Import models";
  if (editor.session.start(ImportVerbOptions{{.files = models}}, title) && models.size() == 1)
    editor.settings.remember(models.front());
}

int makePictures(const Arguments& arguments) {
  auto offscreen = Offscreen::create(arguments.width, arguments.height, arguments.scale);
  if (!offscreen) return fail(offscreen.error());
  Editor editor(allVerbs(), [] {});
  editor.settings.language = arguments.language;
  speak(arguments.language);
  attachInstrument(editor);
  openAll(editor, arguments.paths);
  editor.session.wait();
  if (!editor.session.errors().empty()) return fail(editor.session.errors().front().error);
  (*offscreen)->adopt(editor);
  auto written = drawPictures(editor, **offscreen, arguments.pictures);
  if (!written) return fail(written.error());
  for (const auto& file : *written) std::cout << file.string() << '\n';
  return 0;
}

int makeDevicePictures(const Arguments& arguments) {
  auto offscreen = Offscreen::create(static_cast<int>(kDevicePicture[0] * arguments.scale),
                                     static_cast<int>(kDevicePicture[1] * arguments.scale), arguments.scale);
  if (!offscreen) return fail(offscreen.error());
  auto written = drawDevicePictures(**offscreen, arguments.devices, arguments.language, arguments.scale);
  if (!written) return fail(written.error());
  std::cout << *written << " pictures in " << arguments.devices << '\n';
  return 0;
}

int openWindow(const Arguments& arguments) {
  Editor editor(allVerbs(), wakeWindow);
  attachInstrument(editor);
  auto stored = readSettings(settingsFile());
  editor.settings = std::move(stored.settings);
  speak(editor.settings.language);
  if (!stored.problem.empty()) editor.say(std::move(stored.problem));
  editor.dialogs.recovery = findRecoveryCopies(recoveryRoot());
  openAll(editor, arguments.paths);
  const auto shown = runWindow(editor, arguments.width, arguments.height);
  if (auto written = writeSettings(editor.settings, settingsFile()); !written)
    std::cerr << describe(written.error()) << '\n';
  return shown ? 0 : fail(shown.error());
}

}  // namespace

int main(int count, char** words) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on files is a full disk: the writer's error, not the program's end
  const auto arguments = parse({words + 1, words + count});
  if (!arguments) return fail(arguments.error());
  if (arguments->help) {
    std::cout << kUsage;
    return 0;
  }
  if (!arguments->devices.empty()) return makeDevicePictures(*arguments);
  return arguments->pictures.empty() ? openWindow(*arguments) : makePictures(*arguments);
}
