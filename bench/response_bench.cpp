// SPDX-License-Identifier: GPL-3.0-or-later
// bench_response MODEL E,N,H: how soon each emulated device answers a finger. In the window of the whole editor,
// 1280×800 drawn by the machine's OpenGL without a display (EGL), a pointer taps all over the body of every device,
// screen after screen; a tap that changes what the device shows is a press. Two times of each: from the finger's going
// down to the end of the frame that shows the key pressed, and from its lifting to the end of the frame that shows what
// the press did. Ends with 1 where one of them is above 50 ms, or where nothing of a device could be pressed.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>

#include "bench/desk_on_model.h"

using namespace standpoint;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kLimit_ms = 50;
constexpr int kAcross = 14, kDown = 22;
constexpr std::size_t kEnough = 24;  // presses of each device

double msSince(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

// All that a display can show of what a press did.
std::string shownBy(const Device& device) {
  const auto screen = device.screen();
  std::string all = screen.id + "|" + device.state().dialog + (device.asleep() ? "|asleep" : "");
  for (const auto& w : screen.widgets) all += "|" + w.id + "=" + w.value + (w.enabled ? "" : "!");
  return all;
}

struct Times {
  std::vector<double> down_ms, answer_ms;
  std::string slowest;  // the screen and widget of which the worst answer came
  double worst_ms = 0;
};

class Finger {
 public:
  Finger(Editor& editor, Offscreen& offscreen, InstrumentDesk& desk)
      : editor_(editor), offscreen_(offscreen), desk_(desk) {}

  void tap(ImVec2 at, Times& times) {
    auto& io = ImGui::GetIO();
    io.MousePos = at;
    offscreen_.frame(editor_);
    const auto before = shownBy(*desk_.shown());
    const auto screen = desk_.shown()->screen().id;
    const auto noted = desk_.shown()->state().log.size();
    const auto went_down = Clock::now();
    io.MouseDown[0] = true;
    offscreen_.frame(editor_);
    const double down_ms = msSince(went_down);
    const auto lifted = Clock::now();
    io.MouseDown[0] = false;
    offscreen_.frame(editor_);
    const bool acted = shownBy(*desk_.shown()) != before;
    offscreen_.frame(editor_);  // a press acts after its frame has been laid out, so the next one shows it
    const double answer_ms = msSince(lifted);
    if (!acted) return;
    times.down_ms.push_back(down_ms);
    times.answer_ms.push_back(answer_ms);
    if (answer_ms <= times.worst_ms) return;
    const auto& log = desk_.shown()->state().log;
    times.worst_ms = answer_ms;
    times.slowest = log.size() > noted ? log[noted].detail : screen;
  }

 private:
  Editor& editor_;
  Offscreen& offscreen_;
  InstrumentDesk& desk_;
};

// The body of the device with its keys and display, in the window.
ImRect bodyInWindow() {
  ImRect all(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
  for (const auto* window : ImGui::GetCurrentContext()->Windows)
    if (window->Active && std::string(window->Name).find("/body_") != std::string::npos) all.Add(window->Rect());
  return all;
}

void wake(InstrumentDesk& desk) {
  act(desk, {RehearsalAction::Kind::press, desk.shown()->type().definition.keys.front().id, "", 0, {}});
  desk.shown()->tick(200);
}

// Every widget that a pointer finds on the body, screen after screen, once each.
Times measure(Editor& editor, Offscreen& offscreen, InstrumentDesk& desk, const EmulatedDevice& device) {
  Times times;
  Finger finger(editor, offscreen, desk);
  const auto begin = [&] {
    chooseDevice(desk, editor, device, {});
    if (desk.shown() == nullptr) return;
    (void)desk.shown()->hand("stand_at", "S1");
    wake(desk);
    for (int i = 0; i < 4; ++i) offscreen.frame(editor);
  };
  begin();
  std::set<std::pair<std::string, ImGuiID>> tapped;
  for (int i = 0; i < kAcross * kDown && desk.shown() != nullptr && times.answer_ms.size() < kEnough; ++i) {
    const auto body = bodyInWindow();
    if (body.IsInverted()) return times;
    const ImVec2 at{body.Min.x + body.GetWidth() * (static_cast<float>(i % kAcross) + 0.5F) / kAcross,
                    body.Min.y + body.GetHeight() * (static_cast<float>(i / kAcross) + 0.5F) / kDown};
    ImGui::GetIO().MousePos = at;
    offscreen.frame(editor);
    offscreen.frame(editor);  // what the pointer is on is known one frame late
    const auto under = ImGui::GetHoveredID();
    if (under == 0 || !tapped.insert({desk.shown()->screen().id, under}).second) continue;
    finger.tap(at, times);
    if (desk.shown()->busy() || !desk.shown()->on() || !desk.shown()->state().dialog.empty()) begin();
  }
  return times;
}

double median(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return std::printf("bench_response MODEL E,N,H (a place on a floor, in the file's frame)\n"), 2;
  DeskOnModel opened;
  if (!opened.open(words[1], words[2], "response")) return 1;
  opened.editor.fine_picture = false;
  bool slow = false;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // it is watched in a file
  std::printf("%-18s %7s  %-22s %-22s\n", "device", "presses", "down: median, worst", "answer: median, worst");
  for (const auto& device : emulatedDevices()) {
    const auto times = measure(opened.editor, *opened.offscreen, opened.desk, device);
    if (times.answer_ms.empty()) {
      std::printf("%-18s nothing could be pressed\n", device.id);
      slow = true;
      continue;
    }
    const double down_ms = *std::max_element(times.down_ms.begin(), times.down_ms.end());
    std::printf("%-18s %7zu  %6.1f ms, %6.1f ms    %6.1f ms, %6.1f ms on '%s'\n", device.id, times.answer_ms.size(),
                median(times.down_ms), down_ms, median(times.answer_ms), times.worst_ms, times.slowest.c_str());
    slow |= down_ms > kLimit_ms || times.worst_ms > kLimit_ms;
  }
  return slow ? 1 : 0;
}
