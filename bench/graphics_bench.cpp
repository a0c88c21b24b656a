// SPDX-License-Identifier: GPL-3.0-or-later
// bench_graphics MODEL...: what a frame of the whole editor takes at each level of graphics while the view is turned,
// and how long it is until the view is sharp and until it is shaded once it stands still. A window of 1280×800 drawn by
// the machine's OpenGL without a display (EGL).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"
#include "project/verb.h"

using namespace standpoint;

namespace {

constexpr int kFrames = 60;

// On the clock, and of all threads: the second says the same while others work on the machine, too.
struct Spent {
  double clock_ms = 0, processor_ms = 0;
  Spent& operator+=(const Spent& o) {
    clock_ms += o.clock_ms;
    processor_ms += o.processor_ms;
    return *this;
  }
};

Spent spent(const auto& work) {
  const auto from = std::chrono::steady_clock::now();
  const std::clock_t processor_from = std::clock();
  work();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count(),
          1000.0 * static_cast<double>(std::clock() - processor_from) / CLOCKS_PER_SEC};
}

double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

struct Times {
  Spent moving, sharp, shaded;
};

Times measure(Editor& editor, Offscreen& offscreen) {
  constexpr int kBefore = 5;  // frames that build what the level needs
  std::vector<double> clock, processor;
  editor.fine_picture = false;
  for (int i = 0; i < kBefore + kFrames; ++i) {
    editor.view.camera.azimuth_rad += 2 * std::numbers::pi / kFrames;
    const Spent frame = spent([&] { offscreen.frame(editor); });
    if (i < kBefore) continue;
    clock.push_back(frame.clock_ms);
    processor.push_back(frame.processor_ms);
  }
  Times times{.moving = {median(clock), median(processor)}, .sharp = {}, .shaded = {}};
  editor.fine_picture = true;
  times.sharp = times.shaded = spent([&] { offscreen.frame(editor); });
  while (offscreen.scene().refining()) times.shaded += spent([&] { offscreen.frame(editor); });
  return times;
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return std::printf("bench_graphics MODEL...\n"), 2;
  auto offscreen = Offscreen::create(1280, 800, 1);
  if (!offscreen) return std::printf("no OpenGL without a display: %s\n", describe(offscreen.error()).c_str()), 1;
  for (int i = 1; i < count; ++i) {
    Editor editor({verbs().begin(), verbs().end()}, [] {});
    editor.session.start("import", {{"files", {words[i]}}});
    editor.session.wait();
    editor.update();
    if (!editor.environment()) return std::printf("%s cannot be opened\n", words[i]), 1;
    editor.picker.wait();
    (*offscreen)->adopt(editor);
    editor.graphics.begin((*offscreen)->scene().means());
    std::printf("%s: %llu triangles\n", words[i], static_cast<unsigned long long>(editor.triangles()));
    double low_ms = 0;
    for (const auto choice : {GraphicsChoice::low, GraphicsChoice::medium, GraphicsChoice::high}) {
      editor.settings.graphics = choice;
      editor.update();
      const Times t = measure(editor, **offscreen);
      if (choice == GraphicsChoice::low) low_ms = t.moving.processor_ms;
      std::printf(
          "  %-7s in motion %5.1f ms (%5.1f CPU-ms, %.2f of Low), sharp %4.0f ms (%4.0f), shaded %4.0f ms (%4.0f)\n",
          graphicsName(choice), t.moving.clock_ms, t.moving.processor_ms, t.moving.processor_ms / low_ms,
          t.sharp.clock_ms, t.sharp.processor_ms, t.shaded.clock_ms, t.shaded.processor_ms);
    }
  }
  return 0;
}
