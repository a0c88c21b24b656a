// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/desktop/frame_pacer.h"
#include "editor/model/graphics.h"
#include "editor/shell/actions.h"
#include "item_probe.h"

namespace standpoint {
namespace {

GraphicsPace paceOf(bool by_processor) {
  GraphicsPace pace;
  pace.begin({.by_processor = by_processor, .no_sky = {}, .no_smoothing = {}, .no_shading = {}});
  return pace;
}

// What is said in so many seconds of frames that take this long.
std::vector<std::string> run(GraphicsPace& pace, double frame_s, double seconds) {
  std::vector<std::string> said;
  for (double t = 0; t < seconds; t += frame_s)
    if (auto words = pace.moved(frame_s); !words.empty()) said.push_back(std::move(words));
  return said;
}

TEST(GraphicsPace, DrawsTheLowestLevelUntilTheMachineIsKnown) {
  EXPECT_EQ(GraphicsPace().level(), GraphicsLevel::low);
  EXPECT_EQ(paceOf(true).level(), GraphicsLevel::medium);
  EXPECT_EQ(paceOf(false).level(), GraphicsLevel::high);
}

TEST(GraphicsPace, LowersALevelOnceBelow25FramesForASustainedTimeAndSaysSo) {
  auto pace = paceOf(true);
  EXPECT_TRUE(run(pace, 0.030, 60).empty()) << "33 frames per second are enough";
  const auto said = run(pace, 1.0 / 14, 60);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0], "Graphics lowered to Low: 14 frames per second");
  EXPECT_EQ(pace.level(), GraphicsLevel::low);
}

TEST(GraphicsPace, IsLoweredByAnInstrumentThatWorksSlowlyAndNotRaisedByOneThatWorksQuickly) {
  const auto work = [](GraphicsPace& pace, double frame_s, double seconds) {
    std::vector<std::string> said;
    for (double t = 0; t < seconds; t += frame_s)
      if (auto words = pace.worked(frame_s); !words.empty()) said.push_back(std::move(words));
    return said;
  };
  auto pace = paceOf(true);
  const auto said = work(pace, 1.0 / 14, 60);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0], "Graphics lowered to Low: 14 frames per second");
  EXPECT_TRUE(work(pace, 0.005, 60).empty()) << "most of these pictures is kept from the one before";
  EXPECT_EQ(pace.level(), GraphicsLevel::low);
  EXPECT_EQ(run(pace, 0.005, 30).size(), 1U) << "whole ones are drawn so quickly, too";
}

TEST(GraphicsPace, SaysOfNoLevelThatItCostsLessThanALowerOne) {
  auto pace = paceOf(true);
  pace.measured(GraphicsLevel::low, 0.020);
  pace.measured(GraphicsLevel::medium, 0.041);
  pace.measured(GraphicsLevel::high, 0.038);
  EXPECT_TRUE(pace.about(GraphicsChoice::high).ends_with("about 41 ms for a full frame on this computer"))
      << pace.about(GraphicsChoice::high);
}

TEST(GraphicsPace, GoesDownStepByStep) {
  auto pace = paceOf(false);
  const auto said = run(pace, 0.1, 30);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0], "Graphics lowered to Medium: 10 frames per second");
  EXPECT_EQ(said[1], "Graphics lowered to Low: 10 frames per second");
}

TEST(GraphicsPace, DrawsMovingPicturesSmallerBelow30FramesBeforeItLowersALevel) {
  auto pace = paceOf(true);
  EXPECT_TRUE(run(pace, 0.036, 0.6).empty());
  EXPECT_EQ(pace.motionSize(), 0.75);
  EXPECT_TRUE(run(pace, 0.036, 60).empty()) << "28 frames per second are no reason for another level";
  EXPECT_EQ(pace.motionSize(), 0.5);
  EXPECT_EQ(pace.level(), GraphicsLevel::medium);
}

TEST(GraphicsPace, DrawsSmallerAtALevelThatWasChosenToo) {
  auto pace = paceOf(true);
  pace.choose(GraphicsChoice::high);
  run(pace, 0.1, 60);
  EXPECT_EQ(pace.motionSize(), 0.5);
  EXPECT_EQ(pace.level(), GraphicsLevel::high);
}

TEST(GraphicsPace, DrawsWholePicturesOnAGraphicsCard) {
  auto pace = paceOf(false);
  run(pace, 0.1, 60);
  EXPECT_EQ(pace.motionSize(), 1);
}

// From a frame that is pixels alone to one that has next to none.
TEST(GraphicsPace, FindsTheLargestSizeThatKeeps30FramesOr60AtLowAndStaysThere) {
  for (const auto& [choice, limit_s] :
       {std::pair(GraphicsChoice::medium, 1.0 / 30), std::pair(GraphicsChoice::low, 1.0 / 60)})
    for (const double whole_s : {0.012, 0.020, 0.034, 0.050, 0.090})
      for (const double pixels : {1.0, 0.6, 0.1}) {
        auto pace = paceOf(true);
        pace.choose(choice);
        const auto frame_s = [&] { return whole_s * (1 - pixels + pixels * pace.motionSize() * pace.motionSize()); };
        int changes = 0;
        for (int i = 0; i < 5000; ++i) {
          const double before = pace.motionSize();
          pace.moved(frame_s());
          changes += before != pace.motionSize() ? 1 : 0;
        }
        EXPECT_LE(changes, 2) << whole_s << " s, " << pixels;
        EXPECT_TRUE(frame_s() <= limit_s || pace.motionSize() == 0.5) << whole_s << " s, " << pixels;
      }
}

TEST(GraphicsPace, DrawsLargerAgainAfterASlowTime) {
  auto pace = paceOf(true);
  run(pace, 0.06, 2);
  ASSERT_EQ(pace.motionSize(), 0.5);
  run(pace, 0.008, 3);
  EXPECT_EQ(pace.motionSize(), 1);
}

TEST(GraphicsPace, IsNotImpressedByAStall) {
  auto pace = paceOf(true);
  EXPECT_TRUE(run(pace, 0.016, 3).empty());
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(pace.moved(1.2), "") << "something else was busy";
    EXPECT_TRUE(run(pace, 0.016, 1.5).empty());
  }
  EXPECT_EQ(pace.level(), GraphicsLevel::medium);
}

TEST(GraphicsPace, IsNotImpressedByAFewSlowFrames) {
  auto pace = paceOf(true);
  EXPECT_TRUE(run(pace, 0.1, 1.2).empty());
  EXPECT_EQ(pace.level(), GraphicsLevel::medium);
}

// A level that is too slow, and one below it that is quick: the worst that a rule without memory could meet.
TEST(GraphicsPace, NeverGoesToAndFroBetweenTwoLevels) {
  auto pace = paceOf(true);
  int changes = 0;
  for (int i = 0; i < 200000; ++i)
    changes += pace.moved(pace.level() == GraphicsLevel::low ? 0.012 : 0.060).empty() ? 0 : 1;
  EXPECT_EQ(changes, 3) << "down, one try up, down";
  EXPECT_EQ(pace.level(), GraphicsLevel::low);
}

TEST(GraphicsPace, DoesNotEvenTryWhereTheCostsAreKnown) {
  auto pace = paceOf(true);
  pace.measured(GraphicsLevel::low, 0.005);
  pace.measured(GraphicsLevel::medium, 0.050);
  int changes = 0;
  for (int i = 0; i < 200000; ++i)
    changes += pace.moved(pace.level() == GraphicsLevel::low ? 0.012 : 0.060).empty() ? 0 : 1;
  EXPECT_EQ(changes, 1);
}

TEST(GraphicsPace, ComesBackAfterASlowTimeIsOver) {
  auto pace = paceOf(true);
  run(pace, 0.1, 5);  // a scan is being made beside it
  ASSERT_EQ(pace.level(), GraphicsLevel::low);
  EXPECT_TRUE(run(pace, 0.012, 4).empty()) << "not at once";
  const auto said = run(pace, 0.012, 10);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0], "Graphics raised to Medium: 83 frames per second");
}

TEST(GraphicsPace, LeavesAloneWhatTheUserChose) {
  auto pace = paceOf(true);
  pace.choose(GraphicsChoice::high);
  EXPECT_TRUE(run(pace, 0.5, 60).empty());
  EXPECT_EQ(pace.level(), GraphicsLevel::high);
  pace.choose(GraphicsChoice::automatic);
  EXPECT_EQ(pace.level(), GraphicsLevel::medium);
}

TEST(GraphicsPace, BeginsAnewWithAnotherModel) {
  auto pace = paceOf(true);
  run(pace, 0.1, 5);
  pace.measured(GraphicsLevel::low, 0.005);
  pace.showAnother();
  EXPECT_EQ(pace.level(), GraphicsLevel::medium);
  EXPECT_EQ(pace.notMeasured(), GraphicsLevel::low);
}

TEST(GraphicsPace, SaysWhatEachLevelHasAndCosts) {
  auto pace = paceOf(true);
  EXPECT_EQ(pace.about(GraphicsChoice::automatic),
            "The highest level that keeps 25 frames per second in motion, now Medium");
  EXPECT_EQ(pace.about(GraphicsChoice::low),
            "Anti-aliasing 4× at rest, edges and grid at rest, fewer pixels in motion below 60 frames per second");
  pace.choose(GraphicsChoice::low);
  EXPECT_EQ(pace.about(GraphicsChoice::automatic),
            "The highest level that keeps 25 frames per second in motion, starting at Medium");
  pace.measured(GraphicsLevel::medium, 0.0123);
  EXPECT_EQ(pace.about(GraphicsChoice::medium),
            "Anti-aliasing 4× at rest, by contrast in motion, sky and horizon; about 12 ms for a full frame on this "
            "computer");
  EXPECT_EQ(pace.about(GraphicsChoice::high),
            "Anti-aliasing 4× at rest, by contrast in motion, sky and horizon, soft shadow on the ground, ambient "
            "occlusion at rest");
}

TEST(GraphicsPace, OffersALevelWithoutWhatTheMachineLacksAndSaysSo) {
  GraphicsPace pace;
  pace.begin({.by_processor = false, .no_sky = {}, .no_smoothing = {}, .no_shading = "no shader"});
  EXPECT_EQ(pace.about(GraphicsChoice::high),
            "Anti-aliasing 4× at rest, by contrast in motion, sky and horizon, soft shadow on the ground; without "
            "ambient occlusion "
            "(no shader)");
  pace.begin({.by_processor = true, .no_sky = "old", .no_smoothing = "old", .no_shading = "old"});
  EXPECT_EQ(pace.about(GraphicsChoice::medium),
            "Anti-aliasing 4× at rest; without anti-aliasing in motion (old), sky and horizon (old)");
}

TEST(Graphics, AreSharpWithin100MillisecondsUnlessThatWouldHoldUp) {
  EXPECT_LE(stillFor_s(0.08) + 0.08, 0.1 + 1e-9);
  EXPECT_GE(stillFor_s(0.3), 0.2);
}

TEST(Graphics, AreChosenByCommandsAndKeepWhatPicturesDependOn) {
  Editor editor(verbsWithDemo(), [] {});
  EXPECT_EQ(editor.viewState().graphics, GraphicsLook()) << "pictures without a window";
  ASSERT_TRUE(invoke(editor, "graphics-high"));
  EXPECT_EQ(editor.settings.graphics, GraphicsChoice::high);
  ASSERT_TRUE(invoke(editor, "theme-light"));
  editor.graphics.begin({});
  editor.update();
  EXPECT_EQ(editor.viewState().graphics, (GraphicsLook{GraphicsLevel::high, Theme::light}));
}

// The list of the levels asks for their costs.
TEST(Graphics, AreListedInThePreferences) {
  Editor editor(verbsWithDemo(), [] {});
  GuiDriver gui(editor);
  editor.dialogs.preferences = true;
  gui.frames(3);
  EXPECT_FALSE(editor.costs_wanted) << "there is no model to measure with";
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  gui.settle();
  EXPECT_TRUE(editor.costs_wanted);
  ASSERT_TRUE(gui.click("###graphics-medium"));
  EXPECT_EQ(editor.settings.graphics, GraphicsChoice::medium);
  ASSERT_TRUE(gui.click("###theme-light"));
  EXPECT_EQ(editor.settings.theme, Theme::light);
}

}  // namespace
}  // namespace standpoint
