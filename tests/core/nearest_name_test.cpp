// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/nearest_name.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(KnownInstead, NamesWhatIsMostAlikeFirst) {
  EXPECT_EQ(knownInstead("scan_begun", {"targets", "scan_started", "linked"}),
            "did you mean 'scan_started'? available: scan_started, targets, linked");
}

TEST(KnownInstead, TakesTheSameBeginningForMoreThanTheSameLength) {
  EXPECT_EQ(knownInstead("scan_begun", {"screen", "linked", "scan_stored"}),
            "did you mean 'scan_stored'? available: scan_stored, screen, linked");
}

TEST(KnownInstead, GuessesNothingWhereNothingIsAlike) {
  EXPECT_EQ(knownInstead("xyz", {"targets", "linked"}), "available: linked, targets");
  EXPECT_EQ(knownInstead("", {"S1"}), "available: S1");
  EXPECT_EQ(knownInstead("S1", {}), "none");
}

TEST(KnownInstead, KeepsALongListShort) {
  EXPECT_EQ(knownInstead("c", {"aaaa", "bb", "c", "dd"}, 2), "did you mean 'c'? closest matches: c, bb, …");
}

TEST(KnownInstead, IsNotSlowedDownByAnEndlessName) {
  EXPECT_NE(knownInstead(std::string(1000000, 'x'), {"scan_started"}).find("scan_started"), std::string::npos);
}

}  // namespace
}  // namespace standpoint
