// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

Result<Outcome> runJobText(const std::filesystem::path& folder, const std::string& text) {
  const auto file = folder / "job.json";
  std::ofstream(file) << text;
  return run("run", {}, {{"job", file.string()}});
}

TEST(Job, ReplaysItsStepsOnTheProject) {
  const TemporaryFolder folder;
  Progress progress;
  const auto project = (folder.path() / "p").string();
  ASSERT_TRUE(saveProject(twoStoreyDocument(), project, progress));
  const auto outcome = runJobText(
      folder.path(),
      json::array({{{"verb", "station"}, {"project", project}, {"add", "A"}, {"at", {500001, 5600001, 1.5}}},
                   {{"verb", "station"}, {"project", project}, {"add", "B"}, {"at", {500003, 5600001, 1.5}}}})
          .dump());
  ASSERT_TRUE(outcome) << describe(outcome.error());
  EXPECT_EQ(outcome->answer["steps"].size(), 2U);
  EXPECT_EQ(loadProject(project, progress)->job->stations.size(), 2U);
}

TEST(Job, StopsAtTheFirstStepThatFailsAndNamesIt) {
  const TemporaryFolder folder;
  const auto outcome = runJobText(folder.path(), R"([{"verb": "station", "project": "/nonexistent", "add": "A"}])");
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().source.find("job.json /0"), std::string::npos);
}

TEST(Job, ThatIsNotAListOfVerbsIsRefused) {
  const TemporaryFolder folder;
  for (const char* text :
       {"", "{", "{}", "[1]", "[{}]", R"([{"verb": 3}])", R"([{"verb": "fly"}])", R"([{"verb": "run", "job": "x"}])"})
    EXPECT_FALSE(runJobText(folder.path(), text)) << text;
  EXPECT_EQ(runJobText(folder.path(), R"([{"verb": "fly"}])").error().source, "job.json /0/verb");
  EXPECT_NE(describe(runJobText(folder.path(), R"([{"verb": "info", "file": "a", "file": "b"}])").error())
                .find("'file' more than once"),
            std::string::npos);
}

}  // namespace
}  // namespace standpoint
