// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/instrument.h"

#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "editor/instrument/desk.h"
#include "editor/instrument/speaker.h"
#include "editor/instrument/ticker.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

constexpr float kWaitsInSilence_s = 0.5F;
constexpr float kWordsBelow_pt = 58;                                  // room for what is said below a device
constexpr float kNarrowestDevice_em = 13.5F, kNarrowestText_em = 11;  // in heights of the text
constexpr std::array kClockFactors = {1.0, 5.0, 20.0, 100.0};

bool pointerOnView() {
  const auto* hovered = ImGui::GetCurrentContext()->HoveredWindow;
  const auto* view = ImGui::FindWindowByName("###viewport");
  return view != nullptr && hovered != nullptr && hovered->RootWindow == view;
}

bool takesText(const Screen& screen) {
  return !screen.has_dialog && std::any_of(screen.widgets.begin(), screen.widgets.end(), [](const Widget& w) {
    return w.enabled && (w.kind == WidgetKind::text || w.kind == WidgetKind::number);
  });
}

class InstrumentPanel {
 public:
  explicit InstrumentPanel(const std::function<void()>& wake) : ticker_(wake), speaker_(wake) {}

  void draw(Editor& editor) {
    followProject(desk_, editor);
    followLanguage(desk_);
    if (desk_.shown() == nullptr)
      return ui::emptyState(editor, ICON_TABLET, "Cannot start the device", desk_.problem.c_str());
    standSomewhere(editor);
    advance(desk_, editor);  // before drawing: the last state of a clock that then stops is on the screen
    controls();
    if (desk_.shown() == nullptr) return;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float least = kNarrowestDevice_em * ImGui::GetFontSize();
    const auto [as_wide, as_high] = deviceSize(*desk_.shown(), desk_.view, room.x, room.y - editor.px(kWordsBelow_pt));
    // A portrait device has the rest beside it, a landscape one below; also where there is no room for both.
    const bool beside = as_wide < as_high && room.x > least + kNarrowestText_em * ImGui::GetFontSize();
    const float below =
        beside ? 0 : std::clamp(room.y - as_high - editor.px(kWordsBelow_pt), 0.3F * room.y, 0.6F * room.y);
    const float most = std::max(least, std::min(0.54F * room.x, editor.px(560)));
    const float width = beside ? std::clamp(as_wide, least, most) : room.x;
    if (ImGui::BeginChild("device", {width, room.y - below})) device(editor);
    ImGui::EndChild();
    if (beside) ImGui::SameLine();
    if (desk_.shown() != nullptr && ImGui::BeginChild("beside", {0, 0})) tabs(editor);
    if (desk_.shown() != nullptr) ImGui::EndChild();
    sound(editor);
    const bool exercising = desk_.rehearsal != nullptr && !desk_.ended();
    desk_.was_busy = desk_.shown() != nullptr && (exercising || desk_.running()->busy());
    ticker_.askFor(desk_.was_busy || ImGui::IsMouseDown(ImGuiMouseButton_Left));  // a finger that stays down is a hold
  }

  InstrumentDesk& desk() { return desk_; }

 private:
  void device(Editor& editor) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    auto* task = desk_.running()->task();
    desk_.view.working = task != nullptr && !desk_.shown()->state().running
                             ? std::optional(task->progress().fraction())
                             : std::nullopt;  // a scan has a bar of its own
    const auto press = drawDevice(*desk_.shown(), desk_.view, room.x, room.y - editor.px(kWordsBelow_pt));
    if (displayIsSeen(desk_, editor))
      editor.drawn_display = DrawnDisplay{ImGui::GetWindowDrawList()->_OwnerName, desk_.view.display};
    if (press) {
      act(desk_, {RehearsalAction::Kind::press, press->widget, press->value, 0, {}, press->by});
      const auto& device = *desk_.shown();
      const auto& moved = device.state().moved_along;
      if (!moved.empty()) editor.session.say(LogLevel::note, device.type().definition.title, moved);
    }
    takeKeys(editor);
    sayBelow();
  }

  // What is typed here is not for the view behind it; where no field has been tapped, it is said that one must be.
  void takeKeys(Editor& editor) {
    editor.device_has_keys = ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) ||
                             (ImGui::IsWindowFocused(ImGuiFocusedFlags_ChildWindows) && !pointerOnView());
    const auto& io = ImGui::GetIO();
    const auto tap_first = tr("Tap a field on the screen before you type");
    if (io.WantTextInput && desk_.said == tap_first) desk_.said.clear();
    if (editor.device_has_keys && !io.WantTextInput && !io.InputQueueCharacters.empty() &&
        takesText(desk_.shown()->screen()))
      desk_.said = tap_first;
  }

  // Below the device, so that nothing that is said covers a key of it: what is waited for, why the last press did
  // nothing, what is wrong with a file.
  void sayBelow() {
    const auto waited_for = waits();
    if (!waited_for.empty()) return ui::wrapped(waited_for);
    if (!desk_.said.empty()) return ui::wrapped(desk_.said);
    if (!desk_.layouts.problem().empty()) return ui::wrapped(trf("Layout not used: {}", desk_.layouts.problem()));
    if (!desk_.refused.empty()) return ui::wrapped(desk_.refused);
    ui::dimWrapped("Screens drawn by Standpoint; not affiliated with or endorsed by the manufacturers.");
  }

  // What the device lets hear of what has happened since the last frame.
  void sound(Editor& editor) {
    const auto* device = desk_.shown();
    const auto noted = device == nullptr ? 0 : device->state().noted;
    const auto* due = noted > desk_.heard && editor.settings.sounds ? soundSince(*device, desk_.heard) : nullptr;
    desk_.heard = noted;
    if (due != nullptr) speaker_.play(due->tones);
    const auto problem = speaker_.takeProblem();
    if (!problem.empty()) editor.session.say(LogLevel::warning, tr("Instrument sounds"), problem);
  }

  // In words what the device's clock waits for, once that has taken a moment.
  std::string waits() {
    auto* task = desk_.running()->task();
    stood_s_ = desk_.running()->clockStands() ? stood_s_ + ImGui::GetIO().DeltaTime : 0;
    if (stood_s_ < kWaitsInSilence_s) return {};
    return fmt::format("{} {:.0f} %", desk_.shown()->word("simulation_computes"), 100 * task->progress().fraction());
  }

  void tabs(Editor& editor) {
    if (!ImGui::BeginTabBar("desk")) return;
    page("Equipment", drawHands, editor);
    page("Exercise", drawExercises, editor);
    if (desk_.shown() != nullptr) page("Help", drawHelp, editor);
    ImGui::EndTabBar();
  }

  // What is on it scrolls; the tabs stay.
  void page(const char* title, void (*contents)(InstrumentDesk&, Editor&), Editor& editor) {
    if (!ImGui::BeginTabItem(ui::Label(title))) return;
    if (ImGui::BeginChild(title)) contents(desk_, editor);
    ImGui::EndChild();
    ImGui::EndTabItem();
  }

  // On the open project the tripod begins at its first station; in an exercise the student carries it there.
  void standSomewhere(Editor& editor) {
    const auto& job = editor.session.document().job;
    if (desk_.rehearsal || desk_.host->busy() || desk_.shown()->type().instrument.moving ||
        !desk_.shown()->state().around.station.empty() || !job || job->stations.empty())
      return;
    (void)desk_.shown()->hand("stand_at", job->stations.front().name);
  }

  // Why device and scanner cannot be changed now.
  std::string whyFixed() {
    if (desk_.rehearsal) return "The current exercise uses this device. Leave the exercise to choose another device.";
    return desk_.running()->busy() ? "The instrument is busy. Wait until it has finished, or switch it off." : "";
  }

  template <class Rows>
  void lockedCombo(const char* label, const char* id, const std::string& now, const std::string& why,
                   const Rows& rows) {
    ui::propertyLabel(label);
    ui::tooltip(why);
    ImGui::SetNextItemWidth(-1);
    ImGui::BeginDisabled(!why.empty());
    const bool open = ui::beginDropDown(id, now.c_str());
    if (open) {
      rows();
      ui::endDropDown();
    }
    ImGui::EndDisabled();
    if (!open) ui::tooltip(why);
  }

  void controls() {
    if (!ui::beginProperties("instrument")) return;
    const auto why = whyFixed();
    const auto& type = desk_.shown()->type();
    lockedCombo("Device", "##device", type.definition.title, why, [&] {
      for (const auto& device : emulatedDevices())
        if (ui::choice(device.title().c_str(), &device == desk_.device)) wanted_ = &device, wanted_instrument_.clear();
    });
    if (desk_.scanners.size() > 1)
      lockedCombo("Scanner", "##scanner", type.instrument.maker + " " + type.instrument.model, why, [&] {
        for (const auto& [id, title] : desk_.scanners)
          if (ui::choice((title + "###" + id).c_str(), id == type.instrument.id))
            wanted_ = desk_.device, wanted_instrument_ = id;
      });
    ui::propertyLabel("Clock");
    ImGui::SetNextItemWidth(-1);
    if (ui::beginDropDown("##clock", clockName(desk_.time_factor).c_str())) {
      for (const double factor : kClockFactors)
        if (ui::choice(clockName(factor).c_str(), factor == desk_.time_factor)) desk_.time_factor = factor;
      ui::endDropDown();
    }
    ui::endProperties();
  }

 public:
  void takeWishes(Editor& editor) {
    if (wanted_ != nullptr) chooseDevice(desk_, editor, *wanted_, wanted_instrument_);
    wanted_ = nullptr;
  }

 private:
  static std::string clockName(double factor) { return factor == 1 ? tr("real time") : trf("{:.0f}× speed", factor); }

  Ticker ticker_;
  Speaker speaker_;
  InstrumentDesk desk_;
  const EmulatedDevice* wanted_ = nullptr;
  std::string wanted_instrument_;
  float stood_s_ = 0;  // how long the device's clock has stood
};

}  // namespace

InstrumentDesk& attachInstrument(Editor& editor) {
  const auto panel = std::make_shared<InstrumentPanel>(editor.wake);
  editor.draw_instrument = [panel](Editor& e) {
    panel->draw(e);
    panel->takeWishes(e);
  };
  connect(panel->desk(), editor.session);
  editor.fieldwork.carry = [panel, &editor](const std::string& station) {
    auto& desk = panel->desk();
    if (desk.shown() == nullptr) return;
    carryTo(desk, documentOf(desk, editor), station);
  };
  editor.fieldwork.spend = [panel](double seconds) {
    if (panel->desk().shown() != nullptr) act(panel->desk(), {RehearsalAction::Kind::wait, "", "", seconds, {}});
  };
  editor.fieldwork.stand = [panel, &editor](const std::optional<Eigen::Vector3d>& feet) {
    if (panel->desk().shown() != nullptr) standBy(panel->desk(), documentOf(panel->desk(), editor), feet);
  };
  return panel->desk();
}

}  // namespace standpoint
