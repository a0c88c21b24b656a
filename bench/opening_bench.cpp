// SPDX-License-Identifier: GPL-3.0-or-later
// bench_opening MODEL...: the longest frames of the whole editor from the request to open a model until everything that
// is made in the background for it is there, in a window of 1280×800 drawn by the machine's OpenGL without a display
// (EGL). The processor time of the drawing thread says the same while others work on the machine, too.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"
#include "project/verb.h"

using namespace standpoint;

namespace {

using Clock = std::chrono::steady_clock;

double sinceMs(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

double threadMs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Frame {
  double at_ms = 0, clock_ms = 0, thread_ms = 0;
  std::string running;
};

Frame drawn(Editor& editor, Offscreen& offscreen, Clock::time_point begun) {
  Frame frame{.at_ms = sinceMs(begun), .running = editor.jobRuns() ? "a job runs" : "no job"};
  for (const auto& task : editor.session.running()) frame.running = task->title() + ", " + task->progress().stageName();
  const auto from = Clock::now();
  const double thread_from = threadMs();
  offscreen.frame(editor);
  frame.clock_ms = sinceMs(from);
  frame.thread_ms = threadMs() - thread_from;
  return frame;
}

void print(const Frame& frame) {
  std::printf("    %5.0f ms (%5.0f ms of its thread) at %5.1f s: %s\n", frame.clock_ms, frame.thread_ms,
              frame.at_ms / 1e3, frame.running.c_str());
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return std::printf("bench_opening MODEL...\n"), 2;
  for (int i = 1; i < count; ++i) {
    const auto started = Clock::now();
    auto offscreen = Offscreen::create(1280, 800, 1);
    if (!offscreen) return std::printf("no OpenGL without a display: %s\n", describe(offscreen.error()).c_str()), 1;
    Editor editor({verbs().begin(), verbs().end()}, [] {});
    (*offscreen)->adopt(editor);
    editor.graphics.begin((*offscreen)->scene().means());
    (*offscreen)->frame(editor);
    std::printf("%s\n  first frame after %.0f ms\n", words[i], sinceMs(started));

    const auto begun = Clock::now();
    editor.session.start("import", {{"files", {words[i]}}}, "Import");
    std::vector<Frame> frames;
    constexpr int kAfter = 10;  // frames once all is there: what a view at rest still makes
    for (int after = 0; after < kAfter; ++after) {
      frames.push_back(drawn(editor, **offscreen, begun));
      if (editor.jobRuns() || !editor.session.running().empty()) after = 0;
    }
    if (!editor.environment()) return std::printf("  cannot be opened\n"), 1;
    const double whole_s = sinceMs(begun) / 1e3;
    const auto long_ones = std::count_if(frames.begin(), frames.end(), [](const Frame& f) { return f.clock_ms > 100; });
    std::printf("  %llu triangles after %.1f s; %zu frames, %td longer than 100 ms; the longest:\n",
                static_cast<unsigned long long>(editor.triangles()), whole_s, frames.size(), long_ones);
    std::sort(frames.begin(), frames.end(), [](const Frame& a, const Frame& b) { return a.clock_ms > b.clock_ms; });
    for (std::size_t k = 0; k < std::min<std::size_t>(6, frames.size()); ++k) print(frames[k]);
  }
  return 0;
}
