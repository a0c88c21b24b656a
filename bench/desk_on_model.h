// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "editor/instrument/desk.h"
#include "editor/instrument/instrument.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"
#include "project/verb.h"

namespace standpoint {

// The whole editor in the workspace of instruments, on a model in which a station S1 stands: 1280×800, drawn by the
// machine's OpenGL without a display (EGL). Its project lies in a folder of its own, which goes with it.
struct DeskOnModel {
  std::unique_ptr<Offscreen> offscreen;
  std::filesystem::path folder;
  Editor editor{{verbs().begin(), verbs().end()}, [] {}};
  InstrumentDesk& desk = attachInstrument(editor);

  ~DeskOnModel() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  // `place`: "E,N,H" on a floor, in the file's frame. Says what went wrong.
  bool open(const char* model, const char* place, const std::string& name) {
    auto made = Offscreen::create(1280, 800, 1);
    if (!made) return std::printf("no OpenGL without a display: %s\n", describe(made.error()).c_str()), false;
    offscreen = *std::move(made);
    folder = std::filesystem::temp_directory_path() / ("standpoint-bench-" + name);
    std::filesystem::remove_all(folder);
    offscreen->adopt(editor);
    std::vector<double> on(3);
    std::sscanf(place, "%lf,%lf,%lf", &on[0], &on[1], &on[2]);
    for (const auto& [verb, options] : {std::pair<const char*, nlohmann::json>{"import", {{"files", {model}}}},
                                        {"station", {{"add", "S1"}, {"on", on}}}}) {
      editor.session.start(verb, options);
      editor.session.wait();
      editor.update();
      if (!editor.session.errors().empty()) return std::printf("cannot open %s or set up there\n", model), false;
    }
    editor.session.save(folder);
    editor.session.wait();
    editor.workspace = Workspace::instrument;
    for (int i = 0; i < 8; ++i) offscreen->frame(editor);
    editor.picker.wait();
    editor.graphics.begin(offscreen->scene().means());
    return true;
  }
};

}  // namespace standpoint
