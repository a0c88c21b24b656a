// SPDX-License-Identifier: GPL-3.0-or-later
// bench_live_scan MODEL [INSTRUMENT] [SECONDS] [PICTURE.png]: somebody walks through the model with a scanner that
// shows its points as they come. In the window of the whole editor, 1280×800 drawn by the machine's OpenGL without a
// display (EGL): frames a second while one walks and turns, without and with the scan, and points a second. Before that
// the yardstick of the machine: how many of the instrument's pulses one thread casts in a second when nothing else is
// done. Ends with 1 below 30 frames or 200 000 points a second.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include <imgui.h>

#include "editor/model/scan_form.h"
#include "editor/model/walk_recording_steps.h"
#include "editor/model/walking.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"
#include "editor/widgets/keyboard.h"
#include "project/verb.h"

using namespace standpoint;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kLeast_fps = 30, kLeastPoints_per_s = 200000;

double secondsSince(Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); }

struct Frames {
  std::vector<double> ms;
  double seconds = 0, processor_s = 0;
  double fps() const { return static_cast<double>(ms.size()) / seconds; }
  double at(double share) {
    std::sort(ms.begin(), ms.end());
    return ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1))];
  }
};

// To and fro with the view turning and tilting all the time, as fast as frames come.
Frames walk(Editor& editor, Offscreen& offscreen, double seconds) {
  Frames frames;
  const std::clock_t processor = std::clock();
  const auto begun = Clock::now();
  while (secondsSince(begun) < seconds) {
    const auto from = Clock::now();
    const double now_s = secondsSince(begun);
    const bool ahead = static_cast<int>(now_s) % 2 == 0;
    keyboard::change('W', ahead);
    keyboard::change('S', !ahead);
    auto& camera = editor.view.camera;
    const Eigen::Vector3d eye = camera.eye();
    const double frame_s = frames.ms.empty() ? 1.0 / 30 : frames.ms.back() / 1000;
    camera.azimuth_rad += 0.6 * frame_s;
    camera.elevation_rad = 0.3 * std::sin(now_s);
    camera.target = eye + camera.forward() * camera.distance_m;
    ImGui::GetIO().DeltaTime = static_cast<float>(frame_s);
    const auto moved_before = offscreen.scene().movedPictures();
    offscreen.frame(editor);
    frames.ms.push_back(1000 * secondsSince(from));
    if (offscreen.scene().movedPictures() != moved_before) editor.graphics.moved(frames.ms.back() / 1000);
  }
  keyboard::change('W', false);
  keyboard::change('S', false);
  frames.seconds = secondsSince(begun);
  frames.processor_s = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
  return frames;
}

void print(const char* what, Frames frames) {
  std::printf("%-14s %5.1f frames/s, median %4.1f ms, 95 %% %4.1f, worst %5.1f; %.2f processors\n", what, frames.fps(),
              frames.at(0.5), frames.at(0.95), frames.at(1), frames.processor_s / frames.seconds);
}

// Pulses that one thread casts in a second of the clock.
double yardstick(const LiveScanSetup& setup, const Eigen::Vector3d& feet) {
  WalkedPoses poses;
  Camera camera;
  camera.distance_m = 1;
  for (int k = 0; k <= 60; ++k) {
    camera.azimuth_rad = 0.6 * k / 60;
    camera.target = feet + Eigen::Vector3d(0, 0, 1.6) + camera.forward();
    poses.add({k / 60.0, feet, scannerOf(camera, setup.instrument.moving->mount)});
  }
  Progress progress;
  const auto from = Clock::now();
  const auto cast = castAlong(setup, poses, 0, 1, 1, feet, progress);
  const double channels =
      static_cast<double>(setup.instrument.moving->channel_elevations_rad.size()) * setup.instrument.moving->heads;
  return cast ? channels / setup.settings.firing_s / secondsSince(from) : 0;
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return std::printf("bench_live_scan MODEL [INSTRUMENT] [SECONDS] [PICTURE.png]\n"), 2;
  const double seconds = count > 3 ? std::strtod(words[3], nullptr) : 10;
  auto offscreen = Offscreen::create(1280, 800, 1);
  if (!offscreen) return std::printf("no OpenGL without a display: %s\n", describe(offscreen.error()).c_str()), 1;
  Editor editor({verbs().begin(), verbs().end()}, [] {});
  editor.session.start("import", {{"files", {words[1]}}});
  editor.session.wait();
  editor.update();
  if (!editor.environment()) return std::printf("%s cannot be opened\n", words[1]), 1;
  editor.picker.wait();
  (*offscreen)->adopt(editor);
  editor.graphics.begin((*offscreen)->scene().means());
  editor.settings.graphics = GraphicsChoice::low;
  editor.fine_picture = false;
  editor.workspace = Workspace::survey;
  if (count > 2) editor.carried_scan.choice.instrument = words[2];
  const Instrument* const carried = carriedOnFoot(editor);
  if (carried == nullptr) return std::printf("%s is not carried on foot\n", words[2]), 1;
  chooseInstrument(editor.carried_scan.choice, *carried);
  startWalking(editor);
  editor.walk_ground.wait();
  for (int i = 0; i < 5; ++i) (*offscreen)->frame(editor);
  if (!editor.walk.active()) return std::printf("nobody can walk there\n"), 1;
  editor.scan_readiness.follow(editor.session.document(), editor.picker.scene(), [] {});
  editor.scan_readiness.wait();
  const LiveScanSetup setup{editor.scan_readiness.at_hand(), *carried,
                            *resolveMovingSettings(*carried, editor.carried_scan.choice.settings)};
  std::printf("%s, %llu triangles, %s: one thread alone casts %.2f million pulses/s\n", words[1],
              static_cast<unsigned long long>(editor.triangles()), carried->id.c_str(),
              yardstick(setup, editor.walk.feet()) / 1e6);
  print("walking", walk(editor, **offscreen, seconds));
  scanWalk(editor);
  (*offscreen)->frame(editor);
  if (!editor.recording.live.active()) return std::printf("the scan does not begin\n"), 1;
  const auto frames = walk(editor, **offscreen, seconds);
  const auto& figures = editor.recording.live.figures();
  print("and scanning", frames);
  const double points_per_s = static_cast<double>(figures.points) / frames.seconds;
  std::printf("%.0f points/s on the clock, %.0f by the walk's time, 1 pulse in %u, %.2f s behind, %zu shown\n",
              points_per_s, figures.points_per_s, figures.one_pulse_in, figures.behind_s, figures.shown);
  if (count > 4) {
    keyboard::change('W', true);
    for (int i = 0; i < 10; ++i) (*offscreen)->frame(editor);
    if (const auto drawn = (*offscreen)->picture(editor, words[4]); !drawn)
      std::printf("%s\n", describe(drawn.error()).c_str());
  }
  if (!figures.problem.empty()) std::printf("%s\n", figures.problem.c_str());
  return frames.fps() >= kLeast_fps && points_per_s >= kLeastPoints_per_s ? 0 : 1;
}
