// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/theme.h"

namespace standpoint {

namespace {

ImVec4 rgb(unsigned hex, float alpha = 1) {
  return {static_cast<float>(hex >> 16 & 255U) / 255, static_cast<float>(hex >> 8 & 255U) / 255,
          static_cast<float>(hex & 255U) / 255, alpha};
}

void applyShapes(ImGuiStyle& style) {
  style.WindowPadding = {10, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {6, 3};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  style.WindowRounding = 6;
  style.ChildRounding = 0;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 3;
  style.TabRounding = 4;
  style.WindowBorderSize = 1;
  style.PopupBorderSize = 1;
  style.ChildBorderSize = 1;
  style.FrameBorderSize = 0;
  style.TabBorderSize = 0;
  style.WindowTitleAlign = {0.02F, 0.5F};
  style.DisabledAlpha = 0.45F;
}

void applyDarkSurfaces(ImVec4* c) {
  c[ImGuiCol_Text] = rgb(0xdee2e9);
  c[ImGuiCol_TextDisabled] = rgb(0x848d9c);
  c[ImGuiCol_TextSelectedBg] = rgb(0x4090f7, 0.35F);
  c[ImGuiCol_WindowBg] = rgb(0x23272e);
  c[ImGuiCol_ChildBg] = rgb(0x23272e, 0);
  c[ImGuiCol_PopupBg] = rgb(0x2a2f37);
  c[ImGuiCol_Border] = rgb(0x3a414d);
  c[ImGuiCol_MenuBarBg] = rgb(0x1a1d22);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = rgb(0x1f2329);
  c[ImGuiCol_ModalWindowDimBg] = rgb(0x0c0e11, 0.55F);
  c[ImGuiCol_TableHeaderBg] = rgb(0x2a2f37);
  c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = rgb(0x343a45);
  c[ImGuiCol_TableRowBg] = rgb(0, 0);
  c[ImGuiCol_TableRowBgAlt] = rgb(0xffffff, 0.018F);
  c[ImGuiCol_ScrollbarBg] = rgb(0, 0);
  c[ImGuiCol_ScrollbarGrab] = rgb(0x444c59);
  c[ImGuiCol_ScrollbarGrabHovered] = rgb(0x566070);
  c[ImGuiCol_ScrollbarGrabActive] = rgb(0x667286);
  c[ImGuiCol_Separator] = rgb(0x363c46);
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = rgb(0x4090f7);
}

void applyDarkControls(ImVec4* c) {
  c[ImGuiCol_FrameBg] = rgb(0x1b1e24);
  c[ImGuiCol_FrameBgHovered] = rgb(0x2c323c);
  c[ImGuiCol_FrameBgActive] = rgb(0x333a46);
  c[ImGuiCol_Button] = rgb(0x353c48);
  c[ImGuiCol_ButtonHovered] = rgb(0x424b5a);
  c[ImGuiCol_ButtonActive] = rgb(0x2f6fc4);
  c[ImGuiCol_Header] = rgb(0x4090f7, 0.30F);
  c[ImGuiCol_HeaderHovered] = rgb(0x4090f7, 0.18F);
  c[ImGuiCol_HeaderActive] = rgb(0x4090f7, 0.45F);
  c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = rgb(0x1f2329);
  c[ImGuiCol_TabHovered] = rgb(0x323944);
  c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = rgb(0x23272e);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrab] = rgb(0x4090f7);
  c[ImGuiCol_SliderGrabActive] = rgb(0x6cabff);
  c[ImGuiCol_PlotHistogram] = rgb(0x4090f7);
  c[ImGuiCol_NavHighlight] = rgb(0x4090f7);
  c[ImGuiCol_DragDropTarget] = rgb(0x4090f7);
}

void applyLightSurfaces(ImVec4* c) {
  c[ImGuiCol_Text] = rgb(0x20252d);
  c[ImGuiCol_TextDisabled] = rgb(0x5a6270);
  c[ImGuiCol_TextSelectedBg] = rgb(0x1a63c9, 0.28F);
  c[ImGuiCol_WindowBg] = rgb(0xf6f7f9);
  c[ImGuiCol_ChildBg] = rgb(0xf6f7f9, 0);
  c[ImGuiCol_PopupBg] = rgb(0xffffff);
  c[ImGuiCol_Border] = rgb(0xb9c0ca);
  c[ImGuiCol_MenuBarBg] = rgb(0xe2e5ea);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = rgb(0xe2e5ea);
  c[ImGuiCol_ModalWindowDimBg] = rgb(0x3a4049, 0.45F);
  c[ImGuiCol_TableHeaderBg] = rgb(0xe6e9ee);
  c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = rgb(0xd3d8df);
  c[ImGuiCol_TableRowBg] = rgb(0, 0);
  c[ImGuiCol_TableRowBgAlt] = rgb(0, 0.025F);
  c[ImGuiCol_ScrollbarBg] = rgb(0, 0);
  c[ImGuiCol_ScrollbarGrab] = rgb(0xb4bbc6);
  c[ImGuiCol_ScrollbarGrabHovered] = rgb(0x98a1ae);
  c[ImGuiCol_ScrollbarGrabActive] = rgb(0x7f8997);
  c[ImGuiCol_Separator] = rgb(0xd0d5dc);
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = rgb(0x1a63c9);
}

void applyLightControls(ImVec4* c) {
  c[ImGuiCol_FrameBg] = rgb(0xe6e9ef);
  c[ImGuiCol_FrameBgHovered] = rgb(0xdbe4f1);
  c[ImGuiCol_FrameBgActive] = rgb(0xcfddf2);
  c[ImGuiCol_Button] = rgb(0xdde1e7);
  c[ImGuiCol_ButtonHovered] = rgb(0xcfd6df);
  c[ImGuiCol_ButtonActive] = rgb(0xa9c6ef);
  c[ImGuiCol_Header] = rgb(0x1a63c9, 0.22F);
  c[ImGuiCol_HeaderHovered] = rgb(0x1a63c9, 0.12F);
  c[ImGuiCol_HeaderActive] = rgb(0x1a63c9, 0.32F);
  c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = rgb(0xe2e5ea);
  c[ImGuiCol_TabHovered] = rgb(0xd3dae4);
  c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = rgb(0xf6f7f9);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrab] = rgb(0x1a63c9);
  c[ImGuiCol_SliderGrabActive] = rgb(0x124a99);
  c[ImGuiCol_PlotHistogram] = rgb(0x1a63c9);
  c[ImGuiCol_NavHighlight] = rgb(0x1a63c9);
  c[ImGuiCol_DragDropTarget] = rgb(0x1a63c9);
}

}  // namespace

Tone::operator ImU32() const { return ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x > 0.5F ? light : dark; }

ImVec4 colour(ImU32 packed) { return ImGui::ColorConvertU32ToFloat4(packed); }

void applyTheme(float scale, Theme theme) {
  ImGuiStyle style;
  if (theme == Theme::light) {
    ImGui::StyleColorsLight(&style);
    applyLightSurfaces(style.Colors);
    applyLightControls(style.Colors);
  } else {
    ImGui::StyleColorsDark(&style);
    applyDarkSurfaces(style.Colors);
    applyDarkControls(style.Colors);
  }
  applyShapes(style);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace standpoint
