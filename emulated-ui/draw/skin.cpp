// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/draw/skin.h"

#include <array>

#include <imgui.h>

namespace standpoint {

namespace {

constexpr ImU32 grey(int value) { return IM_COL32(value, value, value, 255); }

// A dark body with a light display and red accents; a blue one on a light body; yellow on black; red on grey; plain.
constexpr std::array kSkins = {
    Skin{"generic", grey(58), grey(84), grey(245), IM_COL32(52, 73, 94, 255), grey(255), grey(255),
         IM_COL32(226, 232, 240, 255), grey(36), IM_COL32(52, 120, 190, 255), grey(255), IM_COL32(52, 120, 190, 255),
         grey(36), grey(106), IM_COL32(208, 213, 219, 255), grey(255), IM_COL32(178, 34, 20, 255), grey(140), 0.3F},
    Skin{"leica", IM_COL32(46, 48, 51, 255), IM_COL32(78, 81, 86, 255), IM_COL32(244, 245, 246, 255),
         IM_COL32(58, 61, 66, 255), grey(255), grey(255), IM_COL32(228, 232, 238, 255), IM_COL32(33, 36, 41, 255),
         IM_COL32(190, 36, 36, 255), grey(255), IM_COL32(190, 36, 36, 255), IM_COL32(33, 36, 41, 255),
         IM_COL32(104, 111, 120, 255), IM_COL32(210, 214, 219, 255), grey(255), IM_COL32(178, 34, 20, 255), grey(140),
         0.3F},
    Skin{"faro", IM_COL32(214, 217, 221, 255), IM_COL32(176, 181, 188, 255), IM_COL32(24, 34, 48, 255),
         IM_COL32(15, 82, 148, 255), grey(255), IM_COL32(43, 58, 78, 255), IM_COL32(58, 77, 102, 255),
         IM_COL32(236, 241, 247, 255), IM_COL32(24, 118, 200, 255), grey(255), IM_COL32(24, 118, 200, 255),
         IM_COL32(232, 238, 245, 255), IM_COL32(160, 176, 195, 255), IM_COL32(66, 84, 107, 255), grey(255),
         IM_COL32(255, 150, 130, 255), IM_COL32(122, 140, 162, 255), 0.5F},
    Skin{"trimble", IM_COL32(33, 36, 40, 255), IM_COL32(90, 94, 99, 255), IM_COL32(250, 250, 250, 255),
         IM_COL32(0, 74, 121, 255), grey(255), grey(255), IM_COL32(226, 238, 247, 255), IM_COL32(30, 41, 52, 255),
         IM_COL32(0, 99, 163, 255), grey(255), IM_COL32(224, 152, 0, 255), IM_COL32(30, 41, 52, 255),
         IM_COL32(96, 107, 118, 255), IM_COL32(206, 214, 221, 255), IM_COL32(30, 32, 36, 255),
         IM_COL32(178, 34, 20, 255), grey(140), 0.2F},
    Skin{"riegl", IM_COL32(120, 124, 128, 255), IM_COL32(160, 164, 168, 255), IM_COL32(238, 240, 242, 255),
         IM_COL32(70, 74, 80, 255), grey(255), grey(255), IM_COL32(232, 235, 238, 255), IM_COL32(34, 37, 41, 255),
         IM_COL32(176, 80, 20, 255), grey(255), IM_COL32(176, 80, 20, 255), IM_COL32(34, 37, 41, 255),
         IM_COL32(98, 103, 110, 255), IM_COL32(204, 208, 213, 255), grey(255), IM_COL32(178, 34, 20, 255), grey(140),
         0.2F}};

}  // namespace

std::span<const Skin> skins() { return kSkins; }

const Skin& skinOf(const std::string& name) {
  for (const auto& skin : kSkins)
    if (name == skin.name) return skin;
  return kSkins.front();
}

}  // namespace standpoint
