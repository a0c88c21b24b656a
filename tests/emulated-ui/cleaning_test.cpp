// SPDX-License-Identifier: GPL-3.0-or-later
// What a student cleans out of the copies in the office, and how that is marked.
#include "pointclouds/filters/cleaning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/office_cleaning.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "pointclouds/formats.h"
#include "tests/emulated-ui/marked.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;

struct PointCounts {
  double all = 0, moving = 0, flawed = 0, people = 0, flawed_people = 0;
  double good() const { return all - flawed; }
};

// Of the points as they are read.
class CountingSink final : public PointSink {
 public:
  PointCounts counts;
  Result<void> begin(const ScanHeader& header) override { return header_ = header, Result<void>{}; }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto flags = block.truth.flags[i];
      const bool is_flawed = (flags & kFlawed) != 0;
      const bool is_person = header_.products[block.product[i]].ifc_class == "Person";
      counts.all += 1, counts.flawed += is_flawed ? 1 : 0;
      counts.moving += (flags & point_flag::kMoving) != 0 ? 1 : 0;
      counts.people += is_person ? 1 : 0, counts.flawed_people += is_person && is_flawed ? 1 : 0;
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  ScanHeader header_;
};

PointCounts countsIn(const std::filesystem::path& file) {
  CountingSink sink;
  Progress quiet;
  EXPECT_TRUE(readCloud(file, sink, quiet));
  return sink.counts;
}

RehearsalAction cleanBy(const std::string& filter) {
  return {RehearsalAction::Kind::verb, "clean", "", 0, {{"filters", {filter}}}};
}

bool ruleHolds(const Rehearsal& rehearsal, const std::string& rule) {
  const auto states = rehearsal.judge();
  for (std::size_t i = 0; i < states.size(); ++i)
    if (rehearsal.exercise().rules[i].id == rule) return states[i].held;
  ADD_FAILURE() << rule;
  return false;
}

TEST(CleaningInAnExercise, IsMarkedByWhatItRemovedOfWhatMovedAndOfTheBuilding) {
  const auto known = findExercise("E32");
  ASSERT_TRUE(known) << describe(known.error());
  const TemporaryFolder folder;
  Progress quiet;
  const auto started = Rehearsal::start(known->exercise, {}, folder.path(), {}, quiet);
  ASSERT_TRUE(started) << describe(started.error());
  Rehearsal& rehearsal = **started;
  const auto early = rehearsal.act(cleanBy("moving"), quiet);
  ASSERT_FALSE(early);
  EXPECT_THAT(describe(early.error()), HasSubstr("copy a scan to the office first"));
  for (const auto& action : known->exercise.solution) ASSERT_TRUE(rehearsal.act(action, quiet)) << toJson(action);

  const auto office = folder.path() / "office";
  const auto before = countsIn(office / "all scans.e57"), after = countsIn(cleanedIn(office));
  const auto fact = [&](const std::string& name) {
    const auto found = rehearsal.fact(name);
    return found && found->number ? *found->number : -1;
  };
  ASSERT_GT(before.moving, 10000);
  EXPECT_NEAR(fact("cleaning.recall"), 1 - after.moving / before.moving, 1e-9);
  EXPECT_NEAR(fact("cleaning.precision"), (before.flawed - after.flawed) / (before.all - after.all), 1e-9);
  EXPECT_NEAR(fact("cleaning.lost"), 1 - after.good() / before.good(), 1e-9);
  EXPECT_NEAR(fact("cleaning.Person.recall"), 1 - after.flawed_people / before.flawed_people, 1e-9);
  EXPECT_NEAR(fact("cleaning.Person.precision"),
              (before.flawed_people - after.flawed_people) / (before.people - after.people), 1e-9);
  EXPECT_EQ(fact("cleaning.IfcBeam.recall"), -1) << "there is none in the hall";
  EXPECT_TRUE(marked(rehearsal).passed);

  // Cutting the hall out takes its floor and walls along.
  const auto& cut = known->exercise.mistakes.front().actions.back();
  ASSERT_TRUE(rehearsal.act(cut, quiet)) << toJson(cut);
  EXPECT_GT(fact("cleaning.recall"), 0.6);
  EXPECT_FALSE(ruleHolds(rehearsal, "kept"));
  EXPECT_FALSE(marked(rehearsal).passed);

  const auto by_file = rehearsal.act(cleanBy("moving:against=" + (office / "all scans.e57").string()), quiet);
  ASSERT_FALSE(by_file);
  EXPECT_THAT(describe(by_file.error()), HasSubstr("name no file"));
}

}  // namespace
}  // namespace standpoint
