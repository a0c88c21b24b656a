// SPDX-License-Identifier: GPL-3.0-or-later
// bench_instrument MODEL E,N,H: what a frame of the whole editor takes while an RTC360 scans in the room: the head
// turns, two fans sweep, points appear as they are measured, and its panel and the display on its body show the
// progress. From where an operator stands two metres away, and from before its display. A window of 1280×800 drawn by
// the machine's OpenGL without a display (EGL), at the level of graphics that the editor chooses by itself.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/desk_on_model.h"
#include "core/units.h"

using namespace standpoint;

namespace {

using Clock = std::chrono::steady_clock;
constexpr int kMostFrames = 300;
constexpr double kMost_s = 12;

double secondsSince(Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); }

void press(InstrumentDesk& desk, const std::vector<std::string>& widgets) {
  for (const auto& text : widgets) {
    const auto equals = text.find('=');
    act(desk, {RehearsalAction::Kind::press,
               text.substr(0, equals),
               equals == std::string::npos ? "" : text.substr(equals + 1),
               0,
               {}});
    if (!desk.said.empty()) std::printf("%s: %s\n", text.c_str(), desk.said.c_str());
  }
}

struct Times {
  double median_ms = 0, worst_tenth_ms = 0;
  int frames = 0, redrawn = 0;
};

// While the device measures.
Times measure(Editor& editor, Offscreen& offscreen, InstrumentDesk& desk) {
  std::vector<double> all;
  Times times;
  std::shared_ptr<const PixelPicture> display = editor.display;
  const auto from = Clock::now();
  while (times.frames < kMostFrames && secondsSince(from) < kMost_s && desk.shown()->state().running) {
    const auto begun = Clock::now();
    offscreen.frame(editor);
    if (editor.held.motion.fans.empty()) continue;
    all.push_back(1000 * secondsSince(begun));
    times.redrawn += editor.display != display ? 1 : 0;
    display = editor.display;
    ++times.frames;
  }
  if (all.empty()) return times;
  std::sort(all.begin(), all.end());
  times.median_ms = all[all.size() / 2];
  times.worst_tenth_ms = all[all.size() * 9 / 10];
  return times;
}

void say(const char* where, const Times& t) {
  std::printf(
      "%-24s %4d frames: median %5.1f ms (%.0f a second), nine of ten below %5.1f ms; its display was new in %d\n",
      where, t.frames, t.median_ms, t.median_ms > 0 ? 1000 / t.median_ms : 0, t.worst_tenth_ms, t.redrawn);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return std::printf("bench_instrument MODEL E,N,H (a place on a floor, in the file's frame)\n"), 2;
  DeskOnModel opened;
  if (!opened.open(words[1], words[2], "instrument")) return 1;
  auto& offscreen = opened.offscreen;
  auto& editor = opened.editor;
  auto& desk = opened.desk;
  desk.time_factor = 1;  // so that there is time to count

  press(desk, {"power"});
  desk.shown()->tick(60);
  press(desk, {"job", "new_job", "name=House", "create", "settings", "resolution=6mm", "images=off", "back", "scan"});
  const auto waited = Clock::now();
  while (editor.held.motion.fans.empty() && secondsSince(waited) < 60) offscreen->frame(editor);

  const auto& pose = editor.session.document().job->stations.front().true_pose;
  auto& camera = editor.view.camera;
  camera.orthographic = false;
  camera.view_angle_rad = 60 * kRadPerDeg;
  camera.target = pose.translation;
  camera.distance_m = 2;
  camera.azimuth_rad = 0.6;
  camera.elevation_rad = 0.1;
  editor.fine_picture = false;
  say("two metres away", measure(editor, *offscreen, desk));
  camera.distance_m = 0.5;
  camera.view_angle_rad = 32 * kRadPerDeg;
  say("before its display", measure(editor, *offscreen, desk));
  return 0;
}
