// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/class_scores.h"

#include <gtest/gtest.h>

#include "pointclouds/datasets/label_array.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

ClassMap map() {
  ClassMap made;
  made.classes = {{"none", 0, true}, {"wall", 1, false}, {"floor", 2, false}, {"door", 7, false}};
  return made;
}

// By hand: walls 3 of 4 found, one door taken for a wall, one floor given up, one point without a truth.
TEST(ClassScores, AreThoseOfAHandComputedExample) {
  ClassTally tally(map());
  const std::vector<std::uint32_t> truth = {1, 1, 1, 1, 2, 2, 7, 0}, predicted = {1, 1, 1, 2, 2, 0, 1, 1};
  ASSERT_FALSE(tally.add(truth, predicted));
  const auto scores = tally.scores();
  EXPECT_EQ(scores.points, 7U);
  EXPECT_EQ(scores.ignored, 1U);
  EXPECT_EQ(scores.given_up, 1U);
  EXPECT_DOUBLE_EQ(*scores.classes[0].iou(), 3.0 / 5);        // 3 both, 4 + 4 - 3
  EXPECT_DOUBLE_EQ(*scores.classes[0].precision(), 3.0 / 4);  // a door among them
  EXPECT_DOUBLE_EQ(*scores.classes[0].recall(), 3.0 / 4);
  EXPECT_DOUBLE_EQ(*scores.classes[1].iou(), 1.0 / 3);
  EXPECT_DOUBLE_EQ(*scores.classes[2].iou(), 0);
  EXPECT_FALSE(scores.classes[2].precision()) << "nothing was predicted to be a door";
  EXPECT_EQ(scores.counted, 3U);
  EXPECT_DOUBLE_EQ(*scores.mean_iou, (3.0 / 5 + 1.0 / 3 + 0) / 3);
  EXPECT_DOUBLE_EQ(*scores.accuracy, 4.0 / 7);
}

TEST(ClassScores, LeaveAClassThatIsNowhereOutOfTheMean) {
  ClassTally tally(map());
  const std::vector<std::uint32_t> labels = {1, 2};
  ASSERT_FALSE(tally.add(labels, labels));
  EXPECT_EQ(tally.scores().counted, 2U);
  EXPECT_DOUBLE_EQ(*tally.scores().mean_iou, 1);
}

TEST(ClassScores, TellTheFirstLabelThatIsNoneOfTheClasses) {
  const std::vector<std::uint32_t> good = {1, 0, 2}, bad = {1, 5, 2}, far = {1, 1, PointLabels::kNone};
  const auto of_truth = ClassTally(map()).add(bad, good);
  ASSERT_TRUE(of_truth);
  EXPECT_FALSE(of_truth->predicted);
  EXPECT_EQ(of_truth->at, 1U);
  EXPECT_EQ(of_truth->id, 5U);
  const auto beside_ignored = ClassTally(map()).add(good, bad);
  ASSERT_TRUE(beside_ignored) << "also where the truth does not count";
  EXPECT_TRUE(beside_ignored->predicted);
  EXPECT_EQ(beside_ignored->at, 1U);
  EXPECT_EQ(ClassTally(map()).add(good, far)->at, 2U);
}

TEST(PointLabels, AreReadFromNumpyKittiAndText) {
  const TemporaryFolder folder;
  Progress progress;
  auto array = numpyHead("<i4", 2, 2);
  for (const std::int32_t v : {3, 9, -1, 0}) array.append(reinterpret_cast<const char*>(&v), sizeof v);
  const auto numpy = readPointLabels(folder.write("a.npy", array), progress);
  ASSERT_TRUE(numpy) << describe(numpy.error());
  EXPECT_EQ(numpy->ids, (std::vector<std::uint32_t>{3, PointLabels::kNone}));
  EXPECT_EQ(numpy->instances, (std::vector<std::uint32_t>{9, 0}));
  const auto kitti = readPointLabels(folder.write("a.label", std::string("\x0a\x00\x02\x00", 4)), progress);
  ASSERT_TRUE(kitti);
  EXPECT_EQ(kitti->ids, std::vector<std::uint32_t>{10});
  EXPECT_EQ(kitti->instances, std::vector<std::uint32_t>{2});
  EXPECT_EQ(readPointLabels(folder.write("a.labels", "1\r\n2\n"), progress)->ids, (std::vector<std::uint32_t>{1, 2}));
}

TEST(PointLabels, RefuseWhatIsCutShortOrNoNumber) {
  const TemporaryFolder folder;
  Progress progress;
  const auto whole = numpyHead("<u2", 3, 1) + "aabbcc";
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_FALSE(readPointLabels(folder.write("a.npy", whole.substr(0, n)), progress)) << n;
  EXPECT_TRUE(readPointLabels(folder.write("a.npy", whole), progress));
  EXPECT_FALSE(readPointLabels(folder.write("b.npy", numpyHead("<f4", 1, 1) + "aaaa"), progress));
  const auto line = readPointLabels(folder.write("a.txt", "1\nwall\n"), progress);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().source, "a.txt line 2");
}

}  // namespace
}  // namespace standpoint
