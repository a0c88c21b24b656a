// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/editor.h"
#include "editor/shell/icons.h"
#include "editor/shell/widgets.h"
#include "emulated-ui/draw.h"
#include "emulated-ui/host.h"
#include "emulated-ui/menus.h"

namespace standpoint {

namespace {

// Wakes the window twenty times a second while the instrument's clock runs; sleeps otherwise, so that nothing is drawn when
// nothing changes.
class Ticker {
 public:
  explicit Ticker(std::function<void()> wake) : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { run(stop); }) {}
  void run(bool on) {
    {
      const std::lock_guard lock(mutex_);
      on_ = on;
    }
    condition_.notify_one();
  }

 private:
  void run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (condition_.wait(lock, stop, [this] { return on_; })) {
      lock.unlock();
      wake_();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      lock.lock();
    }
  }

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any condition_;
  bool on_ = false;
  std::jthread thread_;
};

constexpr std::array kClockFactors = {1.0, 5.0, 20.0, 100.0};

class InstrumentPanel {
 public:
  explicit InstrumentPanel(std::function<void()> wake) : ticker_(std::move(wake)) {}

  void draw(Editor& editor) {
    adoptProject(editor);
    if (!host_) return ui::emptyState(editor, ICON_TABLET, "The device cannot start", problem_.c_str());
    drawControls(editor);
    if (!host_) return;
    advance(editor);   // before drawing: the last state of a clock that then stops is on the screen
    drawDevice(host_->device(), kLeicaSkin, ImGui::GetContentRegionAvail().x, ImGui::GetContentRegionAvail().y - editor.px(44), refused_);
    ImGui::Dummy({0, editor.px(2)});
    ui::dimText(refused_.empty() ? "Screens are ours; not affiliated with or endorsed by the makers." : refused_);
    was_busy_ = host_->busy();
    ticker_.run(was_busy_);
  }

 private:
  // A project that was opened or imported has its own instrument, with its memory filled from what the project holds.
  void adoptProject(Editor& editor) {
    const auto key = std::pair(editor.session.folder(), editor.session.document().imported.get());
    if (host_ && (key == project_ || host_->busy())) return;
    const bool moved_only = host_ && key.second == project_.second;
    project_ = key;
    if (moved_only) return;   // saved elsewhere: the same instrument goes on
    chooseDevice(editor, device_);
    last_ = std::chrono::steady_clock::now();
  }

  void chooseDevice(Editor& editor, const EmulatedDevice* device) {
    device_ = device;
    host_.reset();
    auto type = loadDevice(*device);
    if (!type) {
      problem_ = describe(type.error());
      return;
    }
    host_ = std::make_unique<DeviceHost>(*std::move(type), editor.session.document(), editor.wake);
  }

  void drawControls(Editor& editor) {
    std::string& standing = station_;
    const auto& job = editor.session.document().job;
    bool there = false;
    if (job)
      for (const auto& s : job->stations) there = there || s.name == standing;
    if (!there) standing = job && !job->stations.empty() ? job->stations.front().name : std::string();
    if (!ui::beginProperties("instrument")) return;
    ui::propertyLabel("Stands at");
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##station", standing.empty() ? "no station yet" : standing.c_str())) {
      if (job)
        for (const auto& s : job->stations)
          if (ImGui::Selectable(s.name.c_str(), s.name == standing)) standing = s.name;
      ImGui::EndCombo();
    }
    ui::propertyLabel("Device");
    ImGui::SetNextItemWidth(-1);
    ImGui::BeginDisabled(host_->busy());
    if (ImGui::BeginCombo("##device", device_->title)) {
      for (const auto& device : emulatedDevices())
        if (ImGui::Selectable(device.title, &device == device_)) wanted_ = &device;
      ImGui::EndCombo();
    }
    ImGui::EndDisabled();
    ui::propertyLabel("Clock");
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##clock", clockName(host_->time_factor).c_str())) {
      for (const double factor : kClockFactors)
        if (ImGui::Selectable(clockName(factor).c_str(), factor == host_->time_factor)) host_->time_factor = factor;
      ImGui::EndCombo();
    }
    ui::endProperties();
    if (wanted_ != nullptr) chooseDevice(editor, std::exchange(wanted_, nullptr));
    if (host_ && host_->device().state().around.station != standing) (void)host_->device().hand("stand_at", standing);
  }

  static std::string clockName(double factor) { return factor == 1 ? "real time" : fmt::format("{:.0f} times faster", factor); }

  void advance(Editor& editor) {
    const auto now = std::chrono::steady_clock::now();
    // A window that slept gives no lump of time to an instrument that was idle meanwhile.
    const double seconds = was_busy_ ? std::chrono::duration<double>(now - last_).count() : 0;
    last_ = now;
    const auto scans = editor.session.folder().empty() ? std::filesystem::path() : editor.session.folder() / "scans";
    const bool may_store = editor.session.whyNotAdopt().empty();
    if (auto stored = host_->update(editor.session.document(), scans, seconds, may_store)) editor.session.adopt(*std::move(stored));
    if (const auto view = host_->device().takeView()) editor.showCloud(view->file);
  }

  Ticker ticker_;
  std::unique_ptr<DeviceHost> host_;
  const EmulatedDevice* device_ = &emulatedDevices().front();
  const EmulatedDevice* wanted_ = nullptr;
  std::pair<std::filesystem::path, const Environment*> project_{"?", nullptr};
  std::string problem_, refused_, station_;
  std::chrono::steady_clock::time_point last_;
  bool was_busy_ = false;
};

}  // namespace

void attachInstrument(Editor& editor) {
  editor.draw_instrument = [panel = std::make_shared<InstrumentPanel>(editor.wake)](Editor& e) { panel->draw(e); };
}

}  // namespace standpoint
