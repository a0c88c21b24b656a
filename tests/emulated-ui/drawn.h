// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <imgui.h>
#include <imgui_internal.h>

#include "emulated-ui/draw/device_view.h"
#include "tests/emulated-ui/working.h"

namespace standpoint {

// A device in a window without a display, and a finger on it.
class Draw : public testing::Test {
 protected:
  static constexpr float kWidth = 420, kHeight = 560;

  explicit Draw(const std::string& id = "faro-focus") : d(id) {
    ImGui::CreateContext();
    auto& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 700};
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
  }
  ~Draw() override { ImGui::DestroyContext(); }

  void open(const std::string& screen) {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(200);
    d->show(screen);
    frame();
    frame();
  }
  // With the device's own layout.
  void layOut(const std::string& id) {
    const auto& device = *findDevice(id);
    auto layout = loadLayout(device, d->type());
    ASSERT_TRUE(layout) << describe(layout.error());
    view.layout = std::make_shared<const Layout>(*std::move(layout));
  }
  std::optional<Press> frame() {
    ImGui::GetIO().DeltaTime = 1.0F / 60;
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({kWidth, kHeight});
    ImGui::Begin("device", nullptr, ImGuiWindowFlags_NoDecoration);
    const auto press = drawDevice(*d, view, kWidth - 16, kHeight - 16);
    ImGui::End();
    ImGui::EndFrame();
    return press;
  }
  // Goes down at `from`, along to `to`, and lifts.
  std::optional<Press> drag(ImVec2 from, ImVec2 to) {
    auto& io = ImGui::GetIO();
    std::optional<Press> press;
    const auto step = [&] {
      if (auto p = frame()) press = p;
    };
    io.MousePos = from;
    step();
    io.MouseDown[0] = true;
    for (int i = 0; i <= 5; ++i) {
      io.MousePos = {from.x + (to.x - from.x) * static_cast<float>(i) / 5,
                     from.y + (to.y - from.y) * static_cast<float>(i) / 5};
      step();
    }
    io.MouseDown[0] = false;
    step();
    step();
    return press;
  }
  // The same, down the display.
  std::optional<Press> finger(ImVec2 at, float by) { return drag(at, {at.x, at.y + by}); }
  ImGuiWindow* scrolled() const {
    for (auto* window : ImGui::GetCurrentContext()->Windows)
      if (std::string(window->Name).find("/region") != std::string::npos && window->ScrollMax.y > 0) return window;
    return nullptr;
  }

  TestDevice d;
  DeviceView view;
};

}  // namespace standpoint
