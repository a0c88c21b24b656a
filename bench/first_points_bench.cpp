// SPDX-License-Identifier: GPL-3.0-or-later
// bench_first_points PROJECT or MODEL…: from the press of "Scan" to the first points of a station drawn, in the
// editor's own frames by the machine's OpenGL without a display (EGL), and where that time goes.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "editor/model/scan_form.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"
#include "project/verb.h"

using namespace standpoint;

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

constexpr int kTimes = 15;
constexpr int kFramesAfterInput = 3;  // as the window draws after a click; then it sleeps until something wakes it

std::atomic<bool> woken{false};

void settle(Editor& editor) {
  editor.session.wait();
  editor.update();
  editor.picker.wait();
  editor.update();
}

// A station on the floor in the middle, where the project has none.
void setUp(Editor& editor) {
  if (!editor.session.document().job->stations.empty()) return;
  editor.session.start("station", {{"add", "S1"}});
  settle(editor);
}

struct Times {
  double drawn_ms = 0;
  std::size_t points = 0;  // in the first picture of them
};

Times once(Editor& editor, Offscreen& offscreen, const std::filesystem::path& file) {
  const auto& asked = editor.scan_choice;
  ScanVerbOptions options;
  options.instrument = asked.instrument;
  options.settings = asked.settings;
  options.output = file;
  options.stations.names = {editor.session.document().job->stations.front().name};
  Times times;
  editor.fine_picture = false;  // as after any input
  offscreen.frame(editor);
  const auto pressed = Clock::now();
  editor.startScan(std::move(options), "Scan");
  for (int frames = 0; !editor.session.running().empty(); ++frames) {
    while (frames >= kFramesAfterInput && !woken.exchange(false))
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    offscreen.frame(editor);  // takes the points in, and draws them
    if (editor.cloud() && !editor.cloud()->colours.empty()) break;
  }
  times.drawn_ms = millisecondsSince(pressed);
  times.points = editor.cloud() ? editor.cloud()->colours.size() : 0;
  editor.session.cancelAll();
  settle(editor);
  editor.showClouds({});
  editor.session.errors().clear();
  offscreen.frame(editor);
  return times;
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return std::printf("bench_first_points PROJECT or MODEL...\n"), 2;
  auto offscreen = Offscreen::create(1280, 800, 1);
  if (!offscreen) return std::printf("no OpenGL without a display: %s\n", describe(offscreen.error()).c_str()), 1;
  const auto folder = std::filesystem::temp_directory_path() / "standpoint-first-points";
  std::filesystem::create_directories(folder);
  for (int i = 1; i < count; ++i) {
    Editor editor({verbs().begin(), verbs().end()}, [] { woken = true; });
    const bool project = std::filesystem::is_directory(words[i]);
    if (project)
      editor.session.open(words[i]);
    else
      editor.session.start("import", {{"files", {words[i]}}});
    settle(editor);
    if (!editor.environment()) return std::printf("%s cannot be opened\n", words[i]), 1;
    setUp(editor);
    editor.workspace = Workspace::survey;
    editor.wanted_tab[1] = "scan";
    (*offscreen)->adopt(editor);
    for (int k = 0; k < 3; ++k) (*offscreen)->frame(editor);
    editor.scan_readiness.wait();
    (*offscreen)->frame(editor);
    std::vector<Times> runs;
    for (int k = 0; k < kTimes; ++k) runs.push_back(once(editor, **offscreen, folder / "s.e57"));
    std::sort(runs.begin(), runs.end(), [](const Times& a, const Times& b) { return a.drawn_ms < b.drawn_ms; });
    std::printf("%s: %llu triangles, %s: first points drawn after %.0f ms (median of %d; %.0f to %.0f), %zu of them\n",
                words[i], static_cast<unsigned long long>(editor.triangles()), editor.scan_choice.instrument.c_str(),
                runs[kTimes / 2].drawn_ms, kTimes, runs.front().drawn_ms, runs.back().drawn_ms,
                runs[kTimes / 2].points);
  }
  std::filesystem::remove_all(folder);
  return 0;
}
