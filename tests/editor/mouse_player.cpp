// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/editor/mouse_player.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "editor/widgets/keyboard.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;

bool isOnDevice(const GuiItem& item) { return item.window.find("/body_") != std::string::npos; }

// Options have their widget's id below them on the stack.
bool isOption(const GuiItem& item, const std::string& widget, const std::string& option) {
  if (item.label != option) return false;
  const auto* window = ImGui::FindWindowByName(item.window.c_str());
  return window != nullptr && item.id == ImHashStr(option.c_str(), 0, ImHashStr(widget.c_str(), 0, window->ID));
}

bool isWhole(const GuiItem& item, const std::string& widget) {
  return item.label == "##" + widget || item.label == "###" + widget ||
         (widget == "back" && item.label == "title_back");
}

// What of it a pointer reaches.
ImRect shownOf(const GuiItem& item, const ImGuiWindow& window) {
  ImRect shown = item.rect;
  shown.ClipWith(window.ClipRect);
  shown.ClipWith(window.OuterRectClipped);
  return shown;
}

}  // namespace

std::string MousePlayer::play(const RehearsalAction& action) {
  gui_.frames(2);
  if (action.kind != Kind::press && action.kind != Kind::hand) {
    act(desk_, action);
    gui_.frames(2);
    return refusal();
  }
  const auto done_before = desk_.rehearsal->actions().size();
  const int clicks_before = clicks_;
  auto wrong = action.kind == Kind::press ? press(action) : hand(action);
  const bool arrived = clicks_ == clicks_before || desk_.rehearsal->actions().size() > done_before;
  return !wrong.empty() || arrived ? wrong : "nothing came of the click";
}

// What the device changed besides is told as well, and is none.
std::string MousePlayer::refusal() const {
  return desk_.said == desk_.shown()->state().moved_along ? std::string() : desk_.said;
}

void MousePlayer::click(ImVec2 at) {
  gui_.moveTo(at);
  gui_.press();
  gui_.frame();
  ++clicks_;
}

void MousePlayer::drag(ImVec2 from, ImVec2 to) {
  auto& io = ImGui::GetIO();
  gui_.moveTo(from);
  io.MouseDown[0] = true;
  gui_.frame();
  constexpr int kSteps = 8;
  for (int i = 1; i <= kSteps; ++i) {
    const float share = static_cast<float>(i) / kSteps;
    io.MousePos = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    gui_.frame();
  }
  io.MouseDown[0] = false;
  gui_.frames(3);
  ++clicks_;
}

const Widget* MousePlayer::onDevice(const std::string& id) {
  screen_ = desk_.shown()->screen();
  return findWidget(screen_, id);
}

std::optional<ImRect> MousePlayer::visible(const Widget& widget, const std::string& option, std::string* scroll) const {
  for (const auto& item : itemProbe().items) {
    if (!isOnDevice(item) || item.disabled) continue;
    if (option.empty() ? !isWhole(item, widget.id) : !isOption(item, widget.id, option)) continue;
    const auto* window = ImGui::FindWindowByName(item.window.c_str());
    if (window == nullptr) continue;
    const auto shown = shownOf(item, *window);
    if (shown.GetWidth() > 0.9F * item.rect.GetWidth() && shown.GetHeight() > 0.6F * item.rect.GetHeight())
      return shown;
    if (scroll != nullptr) *scroll = item.window;
  }
  return std::nullopt;
}

std::optional<ImRect> MousePlayer::reach(const Widget& widget, const std::string& option) {
  const auto scrolled = [&]() -> std::optional<ImRect> {
    std::string in;
    auto found = visible(widget, option, &in);
    for (const float wheel : {-1.0F, 1.0F}) {
      for (int i = 0; i < 40 && !found && !in.empty(); ++i) {
        const auto* window = ImGui::FindWindowByName(in.c_str());
        const float before = window->Scroll.y;
        gui_.moveTo(window->OuterRectClipped.GetCenter());
        ImGui::GetIO().MouseWheel = wheel;
        gui_.frames(2);
        found = visible(widget, option, &in);
        if (window->Scroll.y == before) break;
      }
    }
    return found;
  };
  if (auto found = scrolled()) return found;
  for (int tab = 0; tab < 6; ++tab) {
    const auto& items = itemProbe().items;
    const auto title = std::find_if(items.begin(), items.end(), [&](const GuiItem& item) {
      return isOnDevice(item) && item.label == "tab" + std::to_string(tab);
    });
    if (title == items.end()) break;
    click(title->rect.GetCenter());
    if (auto found = scrolled()) return found;
  }
  return std::nullopt;
}

std::string MousePlayer::press(const RehearsalAction& action) {
  if (desk_.shown()->asleep()) {
    const auto [x, y, width, height] = desk_.view.display;
    click({x + width / 2, y + height / 2});
  }
  const auto* found = onDevice(action.name);
  if (found == nullptr) return fmt::format("'{}' is not on the screen '{}'", action.name, screen_.id);
  const Widget widget = *found;
  if (!widget.enabled) return fmt::format("'{}' is grey: {}", widget.id, widget.why_not);
  switch (widget.kind) {
    case WidgetKind::choice: return choose(widget, action.value);
    case WidgetKind::text:
    case WidgetKind::number: return enter(widget, action.value);
    case WidgetKind::area: return dragEdges(widget, action.value);
    default: break;
  }
  const bool rows = widget.kind == WidgetKind::list;
  if (widget.kind == WidgetKind::toggle && widget.value == action.value) return {};
  const auto place = reach(widget, rows ? action.value : std::string());
  if (!place) return fmt::format("'{}' {} is nowhere in sight", widget.id, action.value);
  auto at = place->GetCenter();
  float u = 0, v = 0;
  if (widget.kind == WidgetKind::preview && std::sscanf(action.value.c_str(), "%f,%f", &u, &v) == 2)
    at = {place->Min.x + u * place->GetWidth(), place->Min.y + v * place->GetHeight()};
  click(at);
  return refusal();
}

std::string MousePlayer::choose(const Widget& widget, const std::string& value) {
  const auto option = std::find_if(widget.options.begin(), widget.options.end(),
                                   [&](const WidgetOption& o) { return o.value == value; });
  if (option == widget.options.end()) return fmt::format("'{}' has no '{}'", widget.id, value);
  const auto chosen = [&] {
    const auto* now = onDevice(widget.id);
    return now != nullptr && now->value == option->label;
  };
  if (chosen()) return {};
  if (const auto place = reach(widget, value)) {
    click(place->GetCenter());
  } else if (const auto whole = reach(widget)) {
    // A slider has a stop for each option; a tile goes on to the next one with each press.
    const auto n = static_cast<float>(widget.options.size());
    const float share = static_cast<float>(option - widget.options.begin()) / std::max(1.0F, n - 1);
    const float inset = 0.05F * whole->GetWidth();
    for (int i = 0; i < static_cast<int>(n) && !chosen(); ++i)
      click({whole->Min.x + inset + share * (whole->GetWidth() - 2 * inset), whole->GetCenter().y});
  } else {
    return fmt::format("'{}' is nowhere in sight", widget.id);
  }
  if (const auto said = refusal(); !said.empty() || chosen()) return said;
  return fmt::format("'{}' is not '{}' after the press", widget.id, value);
}

std::string MousePlayer::enter(const Widget& widget, const std::string& value) {
  const auto place = reach(widget);
  if (!place) return fmt::format("'{}' is nowhere in sight", widget.id);
  click({place->Min.x + 0.3F * place->GetWidth(), place->GetCenter().y});
  gui_.key(65, true);
  gui_.type(value);
  gui_.key(kKeyEnter);
  gui_.frames(2);
  const auto* now = onDevice(widget.id);
  if (const auto said = refusal(); !said.empty() || now == nullptr || now->value == value) return said;
  const bool number = widget.kind == WidgetKind::number;
  if (number && std::strtod(now->value.c_str(), nullptr) == std::strtod(value.c_str(), nullptr)) return {};
  return fmt::format("'{}' reads '{}' after '{}' was typed", widget.id, now->value, value);
}

std::string MousePlayer::dragEdges(const Widget& widget, const std::string& value) {
  std::array<double, 4> wanted{};
  if (std::sscanf(value.c_str(), "%lf,%lf,%lf,%lf", &wanted[0], &wanted[1], &wanted[2], &wanted[3]) != 4)
    return fmt::format("'{}' is no area", value);
  const auto& instrument = desk_.shown()->type().instrument;
  constexpr double kDegPerRad = 57.29577951308232;
  const double low = instrument.min_elevation_rad * kDegPerRad, high = instrument.max_elevation_rad * kDegPerRad;
  for (const int edge : {1, 0, 2, 3}) {
    const auto* now = onDevice(widget.id);
    const auto place = now == nullptr ? std::nullopt : reach(*now);
    if (!place) return fmt::format("'{}' is nowhere in sight", widget.id);
    now = onDevice(widget.id);
    std::array<double, 4> edges{};
    for (int i = 0; i < 4; ++i) edges[i] = std::strtod(now->options[i].value.c_str(), nullptr);
    const auto x = [&](double deg) {
      return std::clamp(place->Min.x + place->GetWidth() * static_cast<float>(deg / 360), place->Min.x + 1,
                        place->Max.x - 2);
    };
    const auto y = [&](double deg) {
      return std::clamp(place->Min.y + place->GetHeight() * static_cast<float>((high - deg) / (high - low)),
                        place->Min.y + 1, place->Max.y - 2);
    };
    const float middle_x = (x(edges[0]) + x(edges[1])) / 2, middle_y = (y(edges[2]) + y(edges[3])) / 2;
    if (edge < 2)
      drag({x(edges[edge]), middle_y}, {x(wanted[edge]), middle_y});
    else
      drag({middle_x, y(edges[edge])}, {middle_x, y(wanted[edge])});
    if (const auto said = refusal(); !said.empty()) return said;
  }
  return {};
}

std::string MousePlayer::hand(const RehearsalAction& action) {
  if (!gui_.click("Equipment")) return "no tab 'Equipment' beside the device";
  gui_.frames(3);
  const auto wanted = action.name == "stand_at" ? "##station" : "###" + action.name;
  const auto find = [&]() -> const GuiItem* {
    for (const auto& item : itemProbe().items) {
      const bool beside = item.window.find("/beside_") != std::string::npos;
      const auto at = item.label.rfind(wanted);
      if (beside && at != std::string::npos && at + wanted.size() == item.label.size()) return &item;
    }
    return nullptr;
  };
  const GuiItem* item = find();
  for (int i = 0; i < 40 && item != nullptr; ++i) {
    const auto* window = ImGui::FindWindowByName(item->window.c_str());
    if (shownOf(*item, *window).GetHeight() > 0.8F * item->rect.GetHeight()) break;
    const float wheel = item->rect.Min.y < window->OuterRectClipped.GetCenter().y ? 1.0F : -1.0F;
    gui_.moveTo(window->OuterRectClipped.GetCenter());
    ImGui::GetIO().MouseWheel = wheel;
    gui_.frames(2);
    item = find();
  }
  if (item == nullptr) return fmt::format("no '{}' beside the device", wanted);
  click(item->rect.GetCenter());
  if (action.name == "stand_at") {
    const auto& items = itemProbe().items;
    const auto station = std::find_if(items.begin(), items.end(), [&](const GuiItem& i) {
      return i.label == action.value && i.window.starts_with("##Combo");
    });
    if (station == items.end()) return fmt::format("no station '{}' to choose", action.value);
    click(station->rect.GetCenter());
  }
  gui_.frames(2);
  return refusal();
}

}  // namespace standpoint
