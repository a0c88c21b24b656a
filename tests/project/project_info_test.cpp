// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "project/storage/session.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

TEST(ProjectInfo, TellsWhatAProjectHoldsInTheFilesFrame) {
  const TemporaryFolder folder;
  Progress progress;
  const auto project = (folder.path() / "p").string();
  Document document = twoStoreyDocument();
  ASSERT_TRUE(saveProject(document, project, progress));
  ASSERT_TRUE(runOnDisk(*findVerb(verbs(), "station"),
                        {{"project", project}, {"add", "A"}, {"at", {500001, 5600001, 1.5}}}, progress));
  const auto outcome = run("info", {}, {{"file", project}});
  ASSERT_TRUE(outcome) << describe(outcome.error());
  EXPECT_EQ(outcome->answer["products"], document.imported->products.size());
  EXPECT_EQ(outcome->answer["triangles"], triangleCount(*document.imported));
  EXPECT_EQ(outcome->answer["survey"]["stations"], 1);
  EXPECT_GE(outcome->answer["bounds"][0][0], 499'990);
  EXPECT_TRUE(outcome->answer["max_deviation_m"].is_null());  // it has not been optimised
}

TEST(ProjectInfo, AFolderThatIsNoProjectIsAnErrorThatNamesIt) {
  const TemporaryFolder folder;
  const auto outcome = run("info", {}, {{"file", folder.path().string()}});
  ASSERT_FALSE(outcome);
  EXPECT_NE(describe(outcome.error()).find(folder.path().string()), std::string::npos);
}

}  // namespace
}  // namespace standpoint
