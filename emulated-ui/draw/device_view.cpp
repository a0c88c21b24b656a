// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/draw/device_view.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

// A display that is not lit fully, over what was drawn before.
void dim(double light, ImVec2 at, ImVec2 size) {
  const auto dark = static_cast<ImU32>(150 * (1 - light) * (1 - light));
  if (dark == 0) return;
  ImGui::SetCursorScreenPos(at);
  if (ImGui::BeginChild("light", size, false, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoInputs))
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, dark << IM_COL32_A_SHIFT);
  ImGui::EndChild();
}

void dialogButton(Pen& pen, const Widget& w, ImVec2 at, ImVec2 size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (area(("##" + w.id).c_str(), at, size)) pen.pressed(w.id);
  const bool hovered = ImGui::IsItemHovered() && w.enabled;
  const float rounding = pen.skin.rounding * pen.unit;
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, hovered ? pen.skin.tile_hover : pen.skin.tile, rounding);
  list->AddRect(at, {at.x + size.x, at.y + size.y}, pen.skin.off, rounding, 0, pen.hair());
  centred(list, at, size, pen.skin.tile_text, w.label);
  frame(pen, w, at, size);
}

// A card over the dimmed screen: its buttons beside one another where the display is wide.
void dialogCard(Pen& pen, const Dialog& dialog, ImVec2 at, ImVec2 size) {
  constexpr float kWidest = 30;  // of a card, in heights of letters
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(0, 0, 0, 110));
  const float margin = 1.2F * pen.unit, gap = 0.5F * pen.unit;
  const float width = std::min(size.x - 2 * margin, kWidest * pen.text()), inner = width - 2 * margin;
  const float text_height = wrappedHeight(dialog.text, inner);
  const auto n = static_cast<float>(dialog.buttons.size());
  const bool beside = size.x > size.y;
  const float rows = beside ? std::min(1.0F, n) : n;
  const float height = text_height + 3 * margin + rows * (pen.touch() + gap) - gap;
  const ImVec2 card{at.x + (size.x - width) / 2, at.y + std::max(margin, (size.y - height) / 2)};
  list->AddRectFilled(card, {card.x + width, card.y + height}, pen.skin.display, 0.5F * pen.unit);
  list->AddRect(card, {card.x + width, card.y + height}, pen.skin.accent, 0.5F * pen.unit, 0, pen.hair(1.5F));
  wrapped({card.x + margin, card.y + margin}, inner, pen.skin.text, dialog.text);
  const float button = beside ? (inner - (n - 1) * gap) / std::max(1.0F, n) : inner;
  ImVec2 next{card.x + margin, card.y + 2 * margin + text_height};
  for (const auto& b : dialog.buttons) {
    dialogButton(pen, b, next, {button, pen.touch()});
    if (beside)
      next.x += button + gap;
    else
      next.y += pen.touch() + gap;
  }
}

// What the device reads or computes, as a line below its title.
void workingLine(const Pen& pen, ImVec2 at, float width) {
  if (!pen.view.working) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float height = 0.3F * pen.unit, fraction = std::clamp(static_cast<float>(*pen.view.working), 0.02F, 1.0F);
  list->AddRectFilled(at, {at.x + width, at.y + height}, pen.skin.line);
  list->AddRectFilled(at, {at.x + fraction * width, at.y + height}, pen.skin.accent);
}

// Of the face that is shown: pixels per point, and the pixels that it takes.
float scaleOf(const DeviceFace& face, float width, float height) {
  return std::max(0.05F, std::min(width / face.box[0], height / face.box[1]));
}

// A layout that lacks the screen is of another device.
const Layout& layoutOf(const Device& device, DeviceView& view, const std::string& screen) {
  if (!view.layout || (!screen.empty() && !view.layout->screens.contains(screen)))
    view.layout = std::make_shared<const Layout>(plainLayout(device.type().definition));
  return *view.layout;
}

const DeviceFace& shownFace(const Layout& layout, const DeviceView& view, const std::string& screen) {
  if (!screen.empty()) return faceOf(layout, screen);
  for (const auto& face : layout.faces)
    if (face.id == view.face) return face;
  return layout.faces.front();
}

// Letters that are made for about this height, until it goes out of scope.
class Letters {
 public:
  Letters(const DeviceView& view, float pixels) {
    if (view.font) font_ = view.font(pixels);
    if (font_ != nullptr) ImGui::PushFont(font_);
  }
  ~Letters() {
    if (font_ != nullptr) ImGui::PopFont();
  }
  Letters(const Letters&) = delete;
  Letters& operator=(const Letters&) = delete;

 private:
  ImFont* font_ = nullptr;
};

// What is on the display, over the body.
void display(Pen& pen, const Screen& screen, const DeviceFace& face, ImVec2 at, float scale) {
  const auto [left, top, face_width, face_height] = face.display;
  const ImVec2 size{face_width * scale, face_height * scale};
  const bool dark = screen.id.empty();
  pen.view.display = {at.x + left * scale, at.y + top * scale, size.x, size.y};
  ImGui::SetCursorScreenPos({pen.view.display[0], pen.view.display[1]});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, dark ? IM_COL32(10, 11, 12, 255) : pen.skin.display);
  const bool open =
      ImGui::BeginChild("display", size, false, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  useText(pen);
  if (open && pen.device.asleep() && ImGui::InvisibleButton("asleep", size)) pen.press = Press{"display", {}};
  if (open && !dark) {
    const ImVec2 inside = ImGui::GetCursorScreenPos();
    ImGui::PushID(screen.id.c_str());
    ImGui::BeginDisabled(screen.has_dialog);
    const float keyboard = pen.view.keyboard.field.empty() ? 0 : keyboardHeight(pen, size.y);
    drawRegions(pen, screen, pen.layout.screens.at(screen.id).root, {inside.x, inside.y, size.x, size.y},
                inside.y + size.y - keyboard);
    ImGui::EndDisabled();
    ImGui::PopID();
    workingLine(pen, inside, size.x);
    if (keyboard > 0) {
      ImGui::SetCursorScreenPos({inside.x, inside.y + size.y - keyboard});
      if (ImGui::BeginChild("keyboard", {size.x, keyboard}, false, ImGuiWindowFlags_NoScrollbar)) {
        useText(pen);
        drawKeyboard(pen, {inside.x, inside.y + size.y - keyboard}, {size.x, keyboard});
      }
      ImGui::EndChild();
    }
    if (!pen.editing) pen.view.keyboard = {};
    dim(screen.light, inside, size);
    if (screen.has_dialog) {
      pen.press.reset();
      ImGui::SetCursorScreenPos(inside);
      if (ImGui::BeginChild("dialog", size, false, ImGuiWindowFlags_NoBackground)) {
        useText(pen);
        dialogCard(pen, screen.dialog, inside, size);
      }
      ImGui::EndChild();
    }
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

}  // namespace

std::array<float, 2> deviceSize(const Device& device, const DeviceView& view, float width, float height) {
  const auto plain = view.layout ? nullptr : std::make_shared<const Layout>(plainLayout(device.type().definition));
  const auto& face = shownFace(view.layout ? *view.layout : *plain, view, device.screen().id);
  const float scale = scaleOf(face, width, height);
  return {face.box[0] * scale, face.box[1] * scale};
}

std::optional<Press> drawDevice(const Device& device, DeviceView& view, float width, float height) {
  const Screen screen = device.screen();
  const auto& definition = device.type().definition;
  const Skin skin = skinOf(definition.skin);
  const auto& layout = layoutOf(device, view, screen.id);
  const auto& face = shownFace(layout, view, screen.id);
  view.face = face.id;
  view.cut.clear();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    view.scrolling = view.held = false;
    view.grabbed.clear();
  }
  const float scale = scaleOf(face, width, height);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 at{corner.x + std::max(0.0F, (width - face.box[0] * scale) / 2), corner.y};
  Pen pen{device, view, layout, skin, 0.8F * face.text * scale};
  pen.screen = screen.id;
  const Letters letters(view, pen.text());
  ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, skin.rounding * pen.unit);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.4F * pen.unit, 0.45F * pen.unit});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ScrollbarSize, 0.8F * pen.unit);
  ImGui::PushID(definition.id.c_str());
  if (ImGui::BeginChild(
          "body", {width, face.box[1] * scale}, false,
          ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground)) {
    useText(pen);
    drawBody(pen, screen, face, at, scale);
    display(pen, screen, face, at, scale);
  }
  ImGui::EndChild();
  ImGui::PopID();
  ImGui::PopStyleVar(4);
  ImGui::SetCursorScreenPos({corner.x, corner.y + face.box[1] * scale});
  ImGui::Dummy({width, 0});
  return pen.press;
}

}  // namespace standpoint
