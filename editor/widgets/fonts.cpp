// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>

#include <imgui.h>
#include <imgui_freetype.h>

#include "editor/model/style.h"
#include "editor/widgets/theme.h"

namespace standpoint {

namespace {

// Latin, Greek, Cyrillic, punctuation, arrows, mathematics: what names in models and our own texts need.
constexpr std::array<ImWchar, 13> kTextRanges = {0x20,   0x17f,  0x370,  0x3ff,  0x400,  0x52f, 0x2010,
                                                 0x2044, 0x2070, 0x22ff, 0x25a0, 0x25ff, 0};
constexpr std::array<ImWchar, 3> kIconRanges = {0xf000, 0xf2e0, 0};

std::string firstFile(std::initializer_list<const char*> candidates) {
  static const std::array<const char*, 3> roots = {"/usr/share/fonts", "/usr/local/share/fonts", "/usr/share"};
  for (const char* root : roots)
    for (const char* candidate : candidates) {
      const auto file = std::filesystem::path(root) / candidate;
      std::error_code ignored;
      if (std::filesystem::is_regular_file(file, ignored)) return file.string();
    }
  return {};
}

ImFont* addFont(const std::string& file, float size) {
  auto& fonts = *ImGui::GetIO().Fonts;
  if (file.empty()) {
    ImFontConfig config;
    config.SizePixels = size;
    return fonts.AddFontDefault(&config);
  }
  return fonts.AddFontFromFileTTF(file.c_str(), size, nullptr, kTextRanges.data());
}

// Icons are a little smaller than capitals of the same size would need, and sit lower.
void mergeIcons(const std::string& file, float size, float scale) {
  if (file.empty()) return;
  ImFontConfig config;
  config.MergeMode = true;
  config.GlyphMinAdvanceX = std::round(size * 1.15F);
  config.GlyphOffset = {0, std::round(0.5F * scale)};
  ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), std::round(size * 0.95F), &config, kIconRanges.data());
}

}  // namespace

Fonts buildFonts(float scale) {
  auto& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  const auto regular =
      firstFile({"opentype/inter/Inter-Regular.otf", "truetype/inter/Inter-Regular.ttf",
                 "truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf", "truetype/dejavu/DejaVuSans.ttf"});
  const auto bold = firstFile({"opentype/inter/Inter-SemiBold.otf", "truetype/inter/Inter-SemiBold.ttf",
                               "truetype/dejavu/DejaVuSans-Bold.ttf"});
  const auto mono =
      firstFile({"truetype/jetbrains-mono/JetBrainsMono-Regular.ttf", "truetype/dejavu/DejaVuSansMono.ttf"});
  const auto icons =
      firstFile({"truetype/font-awesome/fontawesome-webfont.ttf", "opentype/font-awesome/FontAwesome.otf",
                 "fonts-font-awesome/fonts/fontawesome-webfont.ttf"});
  Fonts fonts;
  const auto sized = [&](float points) { return std::round(points * scale); };
  fonts.text = addFont(regular, sized(14.5F));
  mergeIcons(icons, sized(14.5F), scale);
  fonts.bold = addFont(bold.empty() ? regular : bold, sized(14.5F));
  mergeIcons(icons, sized(14.5F), scale);
  fonts.small = addFont(regular, sized(12.5F));
  mergeIcons(icons, sized(12.5F), scale);
  fonts.mono = addFont(mono, sized(13));
  fonts.huge = addFont(regular, sized(30));
  mergeIcons(icons, sized(30), scale);
  atlas.Build();
  return fonts;
}

}  // namespace standpoint
