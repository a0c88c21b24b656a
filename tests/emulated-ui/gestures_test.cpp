// SPDX-License-Identifier: GPL-3.0-or-later
#include <variant>

#include "emulated-ui/rehearsal/exercise.h"
#include "tests/emulated-ui/x7.h"

namespace standpoint {
namespace {

// An RTC360 with a job of three set-ups, none of which is linked.
class Gestures : public testing::Test {
 protected:
  Gestures() : d("leica-rtc360") {
    EXPECT_TRUE(d.press({"power"}));
    d->tick(30);
    EXPECT_TRUE(d.press({"job", "new_job", "name=House", "create"}));
    for (int n = 1; n <= 3; ++n) {
      StoredSetup s;
      s.project = "House";
      s.number = n;
      s.name = "Setup 00" + std::to_string(n);
      s.station = "S" + std::to_string(n);
      s.file = s.name + ".e57";
      s.plan_x_m = 4 * n;
      d->project()->setups.push_back(s);
    }
  }
  LinkOrder ordered() {
    const auto order = d->takeOrder();
    EXPECT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
    return order && std::holds_alternative<LinkOrder>(*order) ? std::get<LinkOrder>(*order) : LinkOrder{};
  }
  testing::AssertionResult by(Gesture gesture, const std::string& widget, const std::string& value = {}) {
    const auto done = d->act(widget, value, gesture);
    return done ? testing::AssertionSuccess() : testing::AssertionFailure() << describe(done.error());
  }

  TestDevice d;
};

TEST_F(Gestures, AHeldEntryOpensItsMenuAndTheMenuDeletesIt) {
  ASSERT_TRUE(d.press({"setups"}));
  ASSERT_TRUE(by(Gesture::hold, "setup_list", "1"));
  EXPECT_EQ(d.dialog(), "setup_menu");
  EXPECT_EQ(d->screen().dialog.text, "Setup 002, S2");
  ASSERT_TRUE(d.press({"delete"}));
  EXPECT_EQ(d.dialog(), "delete_question");
  ASSERT_TRUE(d.press({"yes"}));
  EXPECT_EQ(d->project()->setups.size(), 2U);
}

TEST_F(Gestures, AHeldMarkOfTheMapOpensTheSameMenu) {
  ASSERT_TRUE(d.press({"setups"}));
  ASSERT_TRUE(by(Gesture::hold, "plan", "2"));
  EXPECT_EQ(d->screen().dialog.text, "Setup 003, S3");
  ASSERT_TRUE(d.press({"details"}));
  EXPECT_EQ(d.screen(), "setup");
}

TEST_F(Gestures, ATapOnAMarkOpensItsSetup) {
  ASSERT_TRUE(d.press({"setups", "plan=0"}));
  EXPECT_EQ(d.screen(), "setup");
  EXPECT_EQ(d.shows("setup_name"), "Setup 001");
}

TEST_F(Gestures, AHeldKeySwitchesOffWithoutAQuestionAndOnAgain) {
  ASSERT_TRUE(by(Gesture::hold, "power"));
  EXPECT_EQ(d.phase(), "shutting_down");
  d->tick(10);
  EXPECT_FALSE(d->on());
  ASSERT_TRUE(by(Gesture::hold, "power"));
  EXPECT_EQ(d.phase(), "booting");
}

TEST_F(Gestures, WhatCannotBeHeldSaysSo) {
  const auto done = d->act("tools", "", Gesture::hold);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "'tools' does not take the gesture 'hold'");
  EXPECT_EQ(d.screen(), "home");
  ASSERT_TRUE(d.press({"setups"}));
  EXPECT_FALSE(d->act("setup_list", "9", Gesture::hold)) << "no such row";
}

TEST_F(Gestures, ALineFromMarkToMarkOrdersWhatTheButtonOrders) {
  ASSERT_TRUE(d.press({"tools", "link", "link_now"}));
  const auto pressed = ordered();
  for (const char* rows : {"2,1", "1,2"}) {
    ASSERT_TRUE(by(Gesture::join, "plan", rows));
    const auto drawn = ordered();
    EXPECT_EQ(drawn.from_file, pressed.from_file) << rows;
    EXPECT_EQ(drawn.to_file, pressed.to_file) << rows;
    EXPECT_EQ(drawn.turn_deg, pressed.turn_deg);
  }
}

TEST_F(Gestures, ALineMayLeadToAnySetupAndTheDeviceSaysWhichOneItWas) {
  ASSERT_TRUE(d.press({"tools", "link"}));
  ASSERT_TRUE(by(Gesture::join, "plan", "0,2"));
  EXPECT_EQ(ordered().to_file, "Setup 001.e57");
  d->linkDone({true, 0.002, 0.6, 0, 0});
  EXPECT_EQ(d.dialog(), "link_joined");
  EXPECT_EQ(d->screen().dialog.text, "Linked to Setup 001: overlap 60 %, error 2.0 mm.");
  EXPECT_EQ(d->project()->setups[2].link->to, "Setup 001.e57");
}

// What is said is said of the link that was drawn, not of the newest setup.
TEST_F(Gestures, AnOlderPairHasItsOwnOutcome) {
  ASSERT_TRUE(d.press({"tools", "link"}));
  ASSERT_TRUE(by(Gesture::join, "plan", "1,0"));
  ordered();
  d->linkDone({true, 0.002, 0.6, 0, 0});
  EXPECT_EQ(d.dialog(), "link_joined");
  EXPECT_EQ(d.fact("link"), "none") << "of the newest";
}

TEST_F(Gestures, NonsenseIsNoLink) {
  ASSERT_TRUE(d.press({"tools", "link"}));
  for (const char* rows : {"", "1", "1,1", "1,7", "-1,0", "a,b", "1,0,2", "0.5,1"}) {
    (void)d->act("plan", rows, Gesture::join);
    EXPECT_EQ(d.dialog(), "refused") << rows;
    EXPECT_FALSE(d->takeOrder()) << rows;
    ASSERT_TRUE(d.press({"ok"}));
  }
}

TEST_F(Gestures, AHeldLinkIsRemovedAfterAQuestion) {
  d->project()->setups[1].link = LinkResult{true, 0.002, 0.6, 0, 0};
  ASSERT_TRUE(d.press({"tools", "link"}));
  ASSERT_TRUE(by(Gesture::part, "plan", "1"));
  EXPECT_EQ(d.dialog(), "unlink_question");
  ASSERT_TRUE(d.press({"no"}));
  EXPECT_TRUE(d->project()->setups[1].link);
  ASSERT_TRUE(by(Gesture::part, "plan", "1"));
  ASSERT_TRUE(d.press({"yes"}));
  EXPECT_FALSE(d->project()->setups[1].link);
  EXPECT_TRUE(d.happened("unlinked", "Setup 002"));
}

TEST_F(Gestures, ACloudThatIsLaidIsFittedFromThere) {
  ASSERT_TRUE(d.press({"tools", "link", "align"}));
  ASSERT_TRUE(by(Gesture::lay, "plan", "1.25,-0.4,90"));
  EXPECT_EQ(d.shows("shift_x"), "1.25") << "the fields show what the finger has done";
  EXPECT_EQ(d.shows("turn"), "90");
  ASSERT_TRUE(d.press({"optimise"}));
  const auto order = ordered();
  EXPECT_EQ(order.from_file, "Setup 003.e57");
  EXPECT_EQ(order.shift_x_m, 1.25);
  EXPECT_EQ(order.shift_y_m, -0.4);
  EXPECT_EQ(order.turn_deg, 90);
  d->linkDone({});
  EXPECT_EQ(d.dialog(), "link_failed");
  ASSERT_TRUE(d.press({"ok"}));
  EXPECT_EQ(d.shows("turn"), "90") << "it stays where it was laid, to be laid better";
  ASSERT_TRUE(d.press({"lay_back"}));
  EXPECT_EQ(d.shows("turn"), "0");
}

TEST_F(Gestures, TypedNumbersAndFingerLayTheSame) {
  ASSERT_TRUE(d.press({"tools", "link", "align", "shift_x=1.25", "shift_y=-0.4", "turn=90", "optimise"}));
  const auto typed = ordered();
  ASSERT_TRUE(d.press({"lay_back"}));
  ASSERT_TRUE(by(Gesture::lay, "plan", "1.25,-0.4,90"));
  ASSERT_TRUE(d.press({"optimise"}));
  const auto laid = ordered();
  EXPECT_EQ(laid.shift_x_m, typed.shift_x_m);
  EXPECT_EQ(laid.shift_y_m, typed.shift_y_m);
  EXPECT_EQ(laid.turn_deg, typed.turn_deg);
}

TEST_F(Gestures, ACloudIsNotLaidBeyondItsLimits) {
  ASSERT_TRUE(d.press({"tools", "link", "align"}));
  for (const char* laid : {"101,0,0", "0,0,181", "0,0", "nan,0,0", ""}) {
    (void)d->act("plan", laid, Gesture::lay);
    EXPECT_EQ(d.dialog(), "refused") << laid;
    ASSERT_TRUE(d.press({"ok"}));
    EXPECT_EQ(d.shows("shift_x"), "0");
  }
}

// The first line of the map in a symmetrical room shows the cloud turned, as the fit would take it.
TEST_F(Gestures, TheMapShowsTheCloudFromWhereItIsFitted) {
  ASSERT_TRUE(d->trouble("symmetrical_room"));
  ASSERT_TRUE(d.press({"tools", "link", "align"}));
  const auto screen = d->screen();
  const auto* plan = findWidget(screen, "plan");
  ASSERT_TRUE(plan != nullptr && plan->laid);
  EXPECT_EQ(plan->laid->setup, 2);
  EXPECT_EQ(plan->laid->onto, 1);
  EXPECT_EQ(plan->laid->start_turn_deg, 180);
  ASSERT_TRUE(by(Gesture::lay, "plan", "0,0,180"));
  ASSERT_TRUE(d.press({"optimise"}));
  EXPECT_EQ(ordered().turn_deg, 360) << "the ring has turned it back";
}

TEST(GestureActions, AreWrittenAndReadLikeOtherPresses) {
  const nlohmann::json written = {{"press", "plan"}, {"value", "2,0"}, {"by", "join"}};
  const auto action = actionFrom(written, "test", "");
  ASSERT_TRUE(action) << describe(action.error());
  EXPECT_EQ(action->by, Gesture::join);
  EXPECT_EQ(toJson(*action), written);
  EXPECT_EQ(toJson(*actionFrom({{"press", "scan"}}, "test", "")), (nlohmann::json{{"press", "scan"}}))
      << "a tap is written as ever";
  const auto wrong = actionFrom({{"press", "plan"}, {"by", "joyn"}}, "test", "/actions/3");
  ASSERT_FALSE(wrong);
  EXPECT_NE(describe(wrong.error()).find("/actions/3/by"), std::string::npos) << describe(wrong.error());
}

TEST_F(X7, ALineOnTheMapRefinesThePairAsTheButtonDoes) {
  threeLinked();
  ASSERT_TRUE(d.press({"registration", "refine"}));
  const auto pressed = std::get<LinkOrder>(*d->takeOrder());
  linked(0.002, 0.8);
  ASSERT_TRUE(d.press({"back"}));
  ASSERT_TRUE(d->act("plan", "1,2", Gesture::join));
  EXPECT_EQ(d.phase(), "refining");
  const auto drawn = std::get<LinkOrder>(*d->takeOrder());
  EXPECT_EQ(drawn.from_file, pressed.from_file);
  EXPECT_EQ(drawn.to_file, pressed.to_file);
  linked(0.002, 0.8);
  ASSERT_TRUE(d->act("plan", "0,2", Gesture::join));
  EXPECT_EQ(std::get<LinkOrder>(*d->takeOrder()).to_file, "scans/House/Station 001.e57");
  linked(0.002, 0.8);
  EXPECT_EQ(d.fact("link.pair"), "Station 001 – Station 003");
}

TEST_F(X7, AHeldLinkIsRemovedWithItsVerdict) {
  ready();
  secondStation();
  linked(0.002, 0.8);
  ASSERT_TRUE(d.press({"registration"}));
  EXPECT_EQ(d.fact("registration"), "registered");
  ASSERT_TRUE(d->act("plan", "1", Gesture::part));
  ASSERT_TRUE(d.press({"yes"}));
  EXPECT_EQ(d.fact("registration"), "none");
  EXPECT_EQ(d.fact("stations.registered"), "1");
}

TEST(VzIGestures, ALineOnThePlanRegistersTheNewestAgainstTheOther) {
  TestDevice d("riegl-vz-i");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(200);
  auto& s = d->change();
  DeviceProject project{.name = "Quarry"};
  for (int n = 1; n <= 3; ++n) {
    StoredSetup setup;
    setup.file = setup.name = "ScanPos00" + std::to_string(n);
    setup.plan_x_m = 10 * n;
    project.setups.push_back(setup);
  }
  s.projects = {project};
  s.project = 0;
  d->show("registration");
  ASSERT_TRUE(d->act("plan", "2,0", Gesture::join));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
  EXPECT_EQ(std::get<LinkOrder>(*order).from_file, "ScanPos003");
  EXPECT_EQ(std::get<LinkOrder>(*order).to_file, "ScanPos001");
}

}  // namespace
}  // namespace standpoint
