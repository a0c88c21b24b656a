// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>

#include <imgui.h>
#include <imgui_freetype.h>

#include "editor/model/style.h"
#include "editor/widgets/theme.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

// Latin, Greek, Cyrillic, punctuation, arrows, mathematics: what names in models and our own texts need.
constexpr std::array<ImWchar, 13> kTextRanges = {0x20,   0x17f,  0x370,  0x3ff,  0x400,  0x52f, 0x2010,
                                                 0x2044, 0x2070, 0x22ff, 0x25a0, 0x25ff, 0};
constexpr std::array<ImWchar, 3> kIconRanges = {0xf000, 0xf2e0, 0};

using Roots = std::span<const std::filesystem::path>;

std::string firstFile(Roots roots, std::initializer_list<const char*> candidates) {
  for (const auto& root : roots)
    for (const char* candidate : candidates) {
      const auto file = root / candidate;
      std::error_code ignored;
      if (std::filesystem::is_regular_file(file, ignored) && std::ifstream(file).peek() != EOF) return file.string();
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

struct FontFiles {
  std::string regular, bold, mono, icons;
};

FontFiles filesIn(Roots roots) {
  return {firstFile(roots, {"opentype/inter/Inter-Regular.otf", "truetype/inter/Inter-Regular.ttf",
                            "truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf", "truetype/dejavu/DejaVuSans.ttf"}),
          firstFile(roots, {"opentype/inter/Inter-SemiBold.otf", "truetype/inter/Inter-SemiBold.ttf",
                            "truetype/dejavu/DejaVuSans-Bold.ttf"}),
          firstFile(roots, {"truetype/jetbrains-mono/JetBrainsMono-Regular.ttf", "truetype/dejavu/DejaVuSansMono.ttf"}),
          firstFile(roots, {"truetype/font-awesome/fontawesome-webfont.ttf", "opentype/font-awesome/FontAwesome.otf",
                            "fonts-font-awesome/fonts/fontawesome-webfont.ttf"})};
}

// No font is that small, and Dear ImGui 1.90 ends the program when it is given one.
bool tooSmall(const std::string& file) {
  std::error_code unreadable;
  return !file.empty() && (std::filesystem::file_size(file, unreadable) <= 100 || unreadable);
}

// False where a file holds no font.
bool build(const FontFiles& files, float scale, Fonts& fonts) {
  if (tooSmall(files.regular) || tooSmall(files.bold) || tooSmall(files.mono) || tooSmall(files.icons)) return false;
  auto& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  const auto sized = [&](float points) { return std::round(points * scale); };
  fonts.text = addFont(files.regular, sized(14.5F));
  mergeIcons(files.icons, sized(14.5F), scale);
  fonts.bold = addFont(files.bold.empty() ? files.regular : files.bold, sized(14.5F));
  mergeIcons(files.icons, sized(14.5F), scale);
  fonts.small = addFont(files.regular, sized(12.5F));
  mergeIcons(files.icons, sized(12.5F), scale);
  fonts.mono = addFont(files.mono, sized(13));
  fonts.huge = addFont(files.regular, sized(30));
  mergeIcons(files.icons, sized(30), scale);
  fonts.letters = {fonts.small,
                   fonts.text,
                   addFont(files.regular, sized(16.5F)),
                   addFont(files.regular, sized(19)),
                   addFont(files.regular, sized(23)),
                   fonts.huge};
  return atlas.Build();
}

std::string missing(const FontFiles& files) {
  std::string packages;
  for (const auto& [file, package] : {std::pair{files.regular, "fonts-inter"},
                                      {files.mono, "fonts-jetbrains-mono"},
                                      {files.icons, "fonts-font-awesome"}})
    if (file.empty()) packages += std::string(packages.empty() ? "" : ", ") + package;
  return packages.empty() ? packages : trf("Fonts are missing; install {} and start again", packages);
}

}  // namespace

Fonts buildFonts(float scale) {
  static const std::array<std::filesystem::path, 3> kRoots = {"/usr/share/fonts", "/usr/local/share/fonts",
                                                              "/usr/share"};
  return buildFonts(scale, kRoots);
}

Fonts buildFonts(float scale, Roots roots) {
  const auto files = filesIn(roots);
  Fonts fonts;
  fonts.problem = missing(files);
  if (build(files, scale, fonts)) return fonts;
  build({}, scale, fonts);  // Dear ImGui's own letters, which need no file
  fonts.problem = tr("Font files are damaged; install fonts-inter, fonts-jetbrains-mono and fonts-font-awesome again");
  return fonts;
}

}  // namespace standpoint
