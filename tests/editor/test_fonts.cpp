// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/model/style.h"
#include "editor/widgets/theme.h"
#include "item_probe.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FontFolder : public testing::Test {
 protected:
  Fonts built() {
    const fs::path root = folder.path();
    return buildFonts(1, std::span(&root, 1));
  }
  void write(const char* name, const std::string& bytes) const {
    fs::create_directories((folder.path() / name).parent_path());
    std::ofstream(folder.path() / name) << bytes;
  }
  TemporaryFolder folder;
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(FontFolder, WithoutFontsNamesThePackagesAndHasLettersOfItsOwn) {
  const auto fonts = built();
  EXPECT_EQ(fonts.problem,
            "Fonts are missing; install fonts-inter, fonts-jetbrains-mono, fonts-font-awesome and start again");
  ASSERT_NE(fonts.text, nullptr);
  EXPECT_NE(fonts.text->FindGlyphNoFallback('A'), nullptr);
  editor.fonts = fonts;
  gui.frames(3);
}

TEST_F(FontFolder, OfGarbageIsSaidAndNotDrawnWith) {
  for (const auto& garbage : {std::string("not a font"), std::string(4096, '\x7f')}) {
    write("opentype/inter/Inter-Regular.otf", garbage);
    write("truetype/font-awesome/fontawesome-webfont.ttf", garbage);
    const auto fonts = built();
    EXPECT_THAT(fonts.problem, HasSubstr("damaged"));
    ASSERT_NE(fonts.text, nullptr);
    EXPECT_NE(fonts.text->FindGlyphNoFallback('A'), nullptr);
    editor.fonts = fonts;
    gui.frames(3);
  }
}

TEST_F(FontFolder, OfTheSystemNeedsNoWord) { EXPECT_EQ(buildFonts(1).problem, ""); }

}  // namespace
}  // namespace standpoint
