// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/history.h"

#include <any>
#include <string>

#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

Document named(const std::string& name) {
  Document d;
  d.name = name;
  return d;
}

TEST(History, GoesBackAndForthThroughTheValues) {
  History h(named("a"));
  h.push(named("b"), "became b");
  h.push(named("c"), "became c");
  EXPECT_EQ(h.undoDescription(), "became c");
  h.undo();
  EXPECT_EQ(h.current().name, "b");
  EXPECT_EQ(h.redoDescription(), "became c");
  h.undo();
  EXPECT_FALSE(h.canUndo());
  h.undo();
  EXPECT_EQ(h.current().name, "a");
  h.redo();
  h.redo();
  h.redo();
  EXPECT_EQ(h.current().name, "c");
}

TEST(History, DropsWhatWasUndoneWhenSomethingNewHappens) {
  History h(named("a"));
  h.push(named("b"), "b");
  h.undo();
  h.push(named("c"), "c");
  EXPECT_FALSE(h.canRedo());
  EXPECT_EQ(h.current().name, "c");
}

TEST(History, DoesNotRememberAChangeThatChangedNothing) {
  History h(named("a"));
  h.push(named("a"), "nothing");
  EXPECT_FALSE(h.canUndo());
}

TEST(History, KnowsWhetherTheCurrentValueIsTheSavedOne) {
  History h(named("a"));
  h.push(named("b"), "b");
  h.markSaved();
  EXPECT_FALSE(h.modified());
  h.undo();
  EXPECT_TRUE(h.modified());
  h.redo();
  EXPECT_FALSE(h.modified());
  h.undo();
  h.push(named("c"), "c");
  EXPECT_TRUE(h.modified()) << "the saved value is gone from the history";
}

TEST(History, HasStepsOfWhatIsShownThatChangeNoDocument) {
  History h(named("a"));
  h.markSaved();
  h.pushShown(std::string("box"), "box set");
  EXPECT_EQ(h.undoDescription(), "box set");
  EXPECT_FALSE(h.modified()) << "no file keeps it";
  EXPECT_EQ(h.unsavedChanges(), 0U);
  h.push(named("b"), "became b");
  EXPECT_EQ(std::any_cast<std::string>(h.shown()), "box") << "it is still shown so";
  EXPECT_TRUE(h.modified());
  EXPECT_EQ(h.unsavedChanges(), 1U);
  h.undo();
  EXPECT_FALSE(h.modified());
  h.undo();
  EXPECT_FALSE(h.shown().has_value());
  h.redo();
  EXPECT_EQ(std::any_cast<std::string>(h.shown()), "box");
}

}  // namespace
}  // namespace standpoint
