// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/instrument.h"

#include <array>
#include <memory>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/instrument/desk.h"
#include "editor/instrument/ticker.h"
#include "editor/shell/icons.h"
#include "editor/shell/widgets.h"

namespace standpoint {

namespace {

constexpr std::array kClockFactors = {1.0, 5.0, 20.0, 100.0};

class InstrumentPanel {
 public:
  explicit InstrumentPanel(std::function<void()> wake) : ticker_(std::move(wake)) {}

  void draw(Editor& editor) {
    followProject(desk_, editor);
    if (desk_.shown() == nullptr) return ui::emptyState(editor, ICON_TABLET, "The device cannot start", desk_.problem.c_str());
    standSomewhere(editor);
    advance(desk_, editor);   // before drawing: the last state of a clock that then stops is on the screen
    controls();
    if (desk_.shown() == nullptr) return;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const bool beside = room.x > editor.px(440);   // else the rest comes below
    const float below = beside ? 0 : std::min(editor.px(260), 0.4F * room.y);
    const float width = beside ? std::min(0.54F * room.x, editor.px(560)) : room.x;
    if (ImGui::BeginChild("device", {width, room.y - below})) device(editor);
    ImGui::EndChild();
    if (beside) ImGui::SameLine();
    if (desk_.shown() != nullptr && ImGui::BeginChild("beside", {0, 0})) tabs(editor);
    if (desk_.shown() != nullptr) ImGui::EndChild();
    desk_.was_busy = desk_.rehearsal != nullptr || (desk_.host && desk_.host->busy());
    ticker_.run(desk_.was_busy);
  }

 private:
  void device(Editor& editor) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    auto* task = desk_.running()->task();
    desk_.view.working = task != nullptr && !desk_.shown()->state().running ? std::optional(task->progress().fraction()) : std::nullopt;   // a scan has a bar of its own
    const auto press = drawDevice(*desk_.shown(), desk_.view, room.x, room.y - editor.px(40));
    if (press) act(desk_, {RehearsalAction::Kind::press, press->widget, press->value, 0, {}});
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetColorU32(desk_.refused.empty() ? ImGuiCol_TextDisabled : ImGuiCol_Text));
    ui::wrapped(desk_.refused.empty() ? "Screens are ours; not affiliated with or endorsed by the makers." : desk_.refused);
    ImGui::PopStyleColor();
  }

  void tabs(Editor& editor) {
    if (!ImGui::BeginTabBar("desk")) return;
    if (ImGui::BeginTabItem("Hands")) {
      drawHands(desk_, editor);
      ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("Exercise")) {
      drawExercises(desk_, editor);
      ImGui::EndTabItem();
    }
    if (desk_.shown() != nullptr && ImGui::BeginTabItem("Help")) {
      drawHelp(desk_, editor);
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }

  // On the open project the tripod begins at its first station; in an exercise the student carries it there.
  void standSomewhere(Editor& editor) {
    const auto& job = editor.session.document().job;
    if (desk_.rehearsal || desk_.host->busy() || !desk_.shown()->state().around.station.empty() || !job || job->stations.empty()) return;
    (void)desk_.shown()->hand("stand_at", job->stations.front().name);
  }

  void scannerChoice() {
    if (desk_.scanners.size() < 2) return;
    const auto& now = desk_.shown()->type().instrument;
    ui::propertyLabel("Scanner");
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::BeginCombo("##scanner", (now.maker + " " + now.model).c_str())) return;
    for (const auto& [id, title] : desk_.scanners)
      if (ImGui::Selectable((title + "###" + id).c_str(), id == now.id)) wanted_ = desk_.device, wanted_instrument_ = id;
    ImGui::EndCombo();
  }

  void controls() {
    if (!ui::beginProperties("instrument")) return;
    const bool fixed = desk_.rehearsal != nullptr || desk_.running()->busy();
    ui::propertyLabel("Device");
    ImGui::SetNextItemWidth(-1);
    ImGui::BeginDisabled(fixed);
    if (ImGui::BeginCombo("##device", desk_.shown()->type().definition.title.c_str())) {
      for (const auto& device : emulatedDevices())
        if (ImGui::Selectable(device.title, &device == desk_.device)) wanted_ = &device, wanted_instrument_.clear();
      ImGui::EndCombo();
    }
    scannerChoice();
    ImGui::EndDisabled();
    ui::propertyLabel("Clock");
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##clock", clockName(desk_.time_factor).c_str())) {
      for (const double factor : kClockFactors)
        if (ImGui::Selectable(clockName(factor).c_str(), factor == desk_.time_factor)) desk_.time_factor = factor;
      ImGui::EndCombo();
    }
    ui::endProperties();
  }

 public:
  void takeWishes(Editor& editor) {
    if (wanted_ != nullptr) chooseDevice(desk_, editor, *wanted_, wanted_instrument_);
    wanted_ = nullptr;
  }

 private:
  static std::string clockName(double factor) { return factor == 1 ? "real time" : fmt::format("{:.0f} times faster", factor); }

  Ticker ticker_;
  InstrumentDesk desk_;
  const EmulatedDevice* wanted_ = nullptr;
  std::string wanted_instrument_;
};

}  // namespace

void attachInstrument(Editor& editor) {
  editor.draw_instrument = [panel = std::make_shared<InstrumentPanel>(editor.wake)](Editor& e) {
    panel->draw(e);
    panel->takeWishes(e);
  };
}

}  // namespace standpoint
