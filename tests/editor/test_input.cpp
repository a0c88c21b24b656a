// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "editor/desktop/input_queue.h"

namespace standpoint {
namespace {

using Kind = InputEvent::Kind;

InputEvent keyEvent(int code, bool down) { return {Kind::key, 0, 0, code, down}; }
InputEvent buttonEvent(bool down, double x = 0) { return {Kind::button, x, 0, 0, down}; }

TEST(InputQueue, ShowsAQuickKeyDownInOneFrameAndUpInTheNext) {
  InputQueue queue;
  queue.push(keyEvent('F', true));
  queue.push(keyEvent('F', false));
  auto first = queue.takeFrame();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_TRUE(first[0].down);
  auto second = queue.takeFrame();
  ASSERT_EQ(second.size(), 1U);
  EXPECT_FALSE(second[0].down);
  EXPECT_FALSE(queue.pending());
}

TEST(InputQueue, NeverLosesAClickOfADoubleClick) {
  InputQueue queue;
  for (const bool down : {true, false, true, false}) queue.push(buttonEvent(down));
  int presses = 0, frames = 0;
  for (; queue.pending(); ++frames)
    for (const auto& e : queue.takeFrame()) presses += e.down ? 1 : 0;
  EXPECT_EQ(presses, 2);
  EXPECT_EQ(frames, 4);
}

TEST(InputQueue, CoalescesMovesButKeepsTheOneBeforeAClick) {
  InputQueue queue;
  for (int x = 0; x < 100; ++x) queue.push({Kind::move, double(x), 0});
  queue.push(buttonEvent(true, 99));
  queue.push({Kind::move, 500, 0});
  const auto first = queue.takeFrame();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].x, 99);
  EXPECT_EQ(queue.takeFrame().at(0).kind, Kind::button);
  EXPECT_EQ(queue.takeFrame().at(0).x, 500);
}

TEST(InputQueue, HoversWhatIsPressedInTheFrameBefore) {
  InputQueue queue;
  queue.push({Kind::move, 5, 0});
  queue.push(buttonEvent(true, 5));
  queue.push(buttonEvent(false, 5));
  EXPECT_EQ(queue.takeFrame().at(0).kind, Kind::move);
  EXPECT_TRUE(queue.takeFrame().at(0).down);
  queue.push({Kind::move, 9, 0});
  EXPECT_FALSE(queue.takeFrame().at(0).down);
  queue.push(buttonEvent(false, 9));
  EXPECT_EQ(queue.takeFrame().size(), 2U) << "where one lets go needs no frame of its own";
}

TEST(InputQueue, AKeyIsSeenWithTheModifierOfItsMoment) {
  constexpr int kShift = 340;
  InputQueue queue;
  queue.push(keyEvent(kShift, true));
  queue.takeFrame();
  queue.push(keyEvent('T', true));
  queue.push(keyEvent(kShift, false));  // before the key itself goes up, and before the next frame
  queue.push(keyEvent('T', false));
  const auto first = queue.takeFrame();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].code, 'T');
  EXPECT_EQ(queue.takeFrame().size(), 2U);
}

TEST(InputQueue, LetsDifferentKeysPassTogether) {
  InputQueue queue;
  queue.push(keyEvent(341, true));  // left control
  queue.push(keyEvent('Z', true));
  EXPECT_EQ(queue.takeFrame().size(), 2U);
}

TEST(InputQueue, KeepsTypedTextInOrder) {
  InputQueue queue;
  for (const char c : std::string("wall")) queue.push({Kind::character, 0, 0, c});
  std::string typed;
  while (queue.pending())
    for (const auto& e : queue.takeFrame()) typed += static_cast<char>(e.code);
  EXPECT_EQ(typed, "wall");
}

// Typed with 6 ms a key while a frame takes 100: keys and their characters.
TEST(InputQueue, DelaysNoFastTyping) {
  InputQueue queue;
  for (const char c : std::string("walk")) {
    queue.push(keyEvent(c - 32, true));
    queue.push({Kind::character, 0, 0, c});
    queue.push(keyEvent(c - 32, false));
  }
  int frames = 0, presses = 0;
  std::string typed;
  for (; queue.pending(); ++frames)
    for (const auto& e : queue.takeFrame()) {
      if (e.kind == Kind::character) typed += static_cast<char>(e.code);
      if (e.kind == Kind::key && e.down) ++presses;
    }
  EXPECT_EQ(typed, "walk");
  EXPECT_EQ(presses, 4);
  EXPECT_LE(frames, 5) << "one per key";
}

TEST(InputQueue, ACharacterNeverOvertakesTheKeyBeforeIt) {
  InputQueue queue;
  queue.push(keyEvent(259, true));  // Backspace: Dear ImGui would take the character first
  queue.push({Kind::character, 0, 0, '5'});
  ASSERT_EQ(queue.takeFrame().size(), 1U);
  EXPECT_EQ(queue.takeFrame().at(0).kind, Kind::character);
}

TEST(InputQueue, ManyTapsOfOneKeyAreAllSeen) {
  InputQueue queue;
  for (int i = 0; i < 7; ++i) queue.push(keyEvent('N', true)), queue.push(keyEvent('N', false));
  int presses = 0;
  bool down = false;
  while (queue.pending())
    for (const auto& e : queue.takeFrame()) {
      EXPECT_NE(e.down, down);
      down = e.down;
      presses += down ? 1 : 0;
    }
  EXPECT_EQ(presses, 7);
}

}  // namespace
}  // namespace standpoint
