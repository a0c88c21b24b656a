// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "demo_verbs.h"
#include "editor/pictures.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {
namespace {

struct ShownPicture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

ShownPicture readPicture(const std::filesystem::path& file) {
  ShownPicture p;
  int channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &p.width, &p.height, &channels, 3);
  if (data == nullptr) return p;
  p.rgb.assign(data, data + static_cast<std::size_t>(p.width) * p.height * 3);
  stbi_image_free(data);
  return p;
}

// Distinct colours, to 5 bits a channel, within a part of the picture given in shares of it.
std::size_t coloursIn(const ShownPicture& p, double x0, double y0, double x1, double y1) {
  std::set<int> colours;
  for (int y = static_cast<int>(y0 * p.height); y < static_cast<int>(y1 * p.height); ++y)
    for (int x = static_cast<int>(x0 * p.width); x < static_cast<int>(x1 * p.width); ++x) {
      const auto* c = &p.rgb[(static_cast<std::size_t>(y) * p.width + x) * 3];
      colours.insert((c[0] >> 3) << 10 | (c[1] >> 3) << 5 | c[2] >> 3);
    }
  return colours.size();
}

std::size_t differing(const ShownPicture& a, const ShownPicture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < std::min(a.rgb.size(), b.rgb.size()); i += 3)
    count += a.rgb[i] != b.rgb[i] || a.rgb[i + 1] != b.rgb[i + 1] || a.rgb[i + 2] != b.rgb[i + 2] ? 1 : 0;
  return count;
}

// STANDPOINT_PICTURE_SIZE=2560x1600@2 draws them larger, for people to look at.
TEST(Pictures, OfTheDemoHouseShowItAndDifferFromEachOther) {
  int width = 1280, height = 800;
  float scale = 1;
  if (const char* wanted = std::getenv("STANDPOINT_PICTURE_SIZE"))
    std::sscanf(wanted, "%dx%d@%f", &width, &height, &scale);
  auto offscreen = Offscreen::create(width, height, scale);
  if (!offscreen) GTEST_SKIP() << describe(offscreen.error());
  Editor editor(verbsWithDemo(), [] {});
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  editor.session.wait();
  (*offscreen)->adopt(editor);
  const auto written = drawPictures(editor, **offscreen, std::filesystem::path(BINARY_DIR) / "pictures");
  ASSERT_TRUE(written) << describe(written.error());
  ASSERT_GE(written->size(), 5U);
  std::vector<ShownPicture> pictures;
  for (const auto& file : *written) {
    pictures.push_back(readPicture(file));
    ASSERT_EQ(pictures.back().width, width) << file;
    ASSERT_EQ(pictures.back().height, height) << file;
    EXPECT_GT(coloursIn(pictures.back(), 0.3, 0.15, 0.7, 0.7), 60U) << file << ": the view is empty";
    EXPECT_GT(coloursIn(pictures.back(), 0, 0.1, 0.2, 0.9), 15U) << file << ": the left area is empty";
  }
  for (std::size_t i = 1; i < pictures.size(); ++i)
    EXPECT_GT(differing(pictures[0], pictures[i]), pictures[0].rgb.size() / 300)
        << (*written)[i] << " shows the same as the first";
}

TEST(Pictures, OfAnEmptyEditorInviteToImport) {
  auto offscreen = Offscreen::create(900, 600, 1);
  if (!offscreen) GTEST_SKIP() << describe(offscreen.error());
  Editor editor(verbsWithDemo(), [] {});
  (*offscreen)->adopt(editor);
  const auto file = std::filesystem::path(BINARY_DIR) / "pictures" / "empty.png";
  std::filesystem::create_directories(file.parent_path());
  ASSERT_TRUE((*offscreen)->picture(editor, file));
  EXPECT_GT(coloursIn(readPicture(file), 0.3, 0.2, 0.7, 0.6), 10U);
}

}  // namespace
}  // namespace standpoint
