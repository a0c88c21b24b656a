// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/widgets/widgets.h"
#include "item_probe.h"

namespace standpoint {
namespace {

// The lines that Dear ImGui makes of a text of this width, blanks at their ends taken away.
std::vector<std::string> linesOf(const std::string& text, float width) {
  const ImFont& font = *ImGui::GetFont();
  std::vector<std::string> lines;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    const char* const own = std::find(at, end, '\n');
    const char* to = font.CalcWordWrapPositionA(ImGui::GetFontSize() / font.FontSize, at, own, width);
    if (to == at) ++to;
    lines.emplace_back(at, to);
    while (lines.back().ends_with(' ')) lines.back().pop_back();
    for (at = to; at < end && (*at == ' ' || (at == own && *at == '\n'));) ++at;
  }
  return lines;
}

class Wrapping : public testing::Test {
 protected:
  // At every width from a few letters to all of it.
  template <class Check>
  void atEachWidth(const std::string& text, const Check& check) {
    gui.draws = [&] {
      ImGui::Begin("wrapping");
      const float all = ImGui::CalcTextSize(text.c_str()).x;
      for (float width = 90; width < all; width += 3) check(linesOf(ui::wholeNumbers(text, width), width), width);
      ImGui::End();
    };
    gui.frame();
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Wrapping, ANameIsCutInItsMiddleAndBetweenItsLetters) {
  const std::string name = "Wärmedämmverbundsystem, mineralisch, 140 mm";
  gui.draws = [&] {
    ImGui::Begin("wrapping");
    const auto wide = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
    EXPECT_EQ(ui::fittingMiddle(name, wide(name)), name);
    EXPECT_EQ(ui::fittingMiddle("", 10), "");
    EXPECT_EQ(ui::fittingMiddle(name, 0), "…");
    for (float width = wide("…"); width < wide(name); width += 5) {
      const auto cut = ui::fittingMiddle(name, width);
      EXPECT_LE(wide(cut), width);
      const auto gap = cut.find("…");
      ASSERT_NE(gap, std::string::npos);
      const auto head = cut.substr(0, gap), tail = cut.substr(gap + std::string("…").size());
      EXPECT_TRUE(name.starts_with(head) && name.ends_with(tail)) << cut;
      const auto whole = [](const std::string& part) {  // no half letter
        return part.empty() || (static_cast<unsigned char>(part.front()) & 0xC0U) != 0x80U;
      };
      EXPECT_TRUE(whole(name.substr(head.size())) && whole(tail)) << cut;
    }
    ImGui::End();
  };
  gui.frame();
}

TEST_F(Wrapping, KeepsANumberWholeAndBesideItsUnit) {
  const std::string text =
      "IfcSlab #12 'Floor' is 0.08 m above the instrument centre, which needs 0.20 m of headroom: lower it by 1,234.5 "
      "mm";
  int broken_without = 0, widths = 0;
  const auto parted = [](const std::vector<std::string>& lines) {
    return std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.ends_with("0.") || line.ends_with("1,") || line.ends_with("234.") || line.ends_with("0.08") ||
             line.ends_with("0.20") || line.ends_with("234.5");
    });
  };
  atEachWidth(text, [&](const std::vector<std::string>& lines, float width) {
    EXPECT_EQ(parted(lines), 0) << width;
    broken_without += static_cast<int>(parted(linesOf(text, width)));
    ++widths;
  });
  EXPECT_GT(widths, 50);
  EXPECT_GT(broken_without, 10) << "else it shows nothing";
}

TEST_F(Wrapping, ChangesNoOtherTextAndLosesNoLetter) {
  const std::string words = "Choose a point on a floor. Walls, ceilings and roofs are none; a table is none either.";
  gui.draws = [&] {
    ImGui::Begin("wrapping");
    for (float width = 60; width < 400; width += 7) {
      EXPECT_EQ(ui::wholeNumbers(words, width), words);
      auto numbers = ui::wholeNumbers("needs 0.20 m, has 0.08 m, lower it by 0.12 m", width);
      std::replace(numbers.begin(), numbers.end(), '\n', ' ');
      EXPECT_EQ(numbers, "needs 0.20 m, has 0.08 m, lower it by 0.12 m");
    }
    EXPECT_EQ(ui::wholeNumbers("", 100), "");
    EXPECT_EQ(ui::wholeNumbers("0.123456789", 1), "0.123456789") << "what fits nowhere stays";
    ImGui::End();
  };
  gui.frame();
}

}  // namespace
}  // namespace standpoint
