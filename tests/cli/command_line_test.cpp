// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

struct Ran {
  int code;
  std::string out, err;
};

Ran command(const std::vector<std::string>& words, std::span<const Verb> table = verbs()) {
  std::ostringstream out;
  std::ostringstream err;
  Progress progress;
  const int code = runCommandLine(table, words, {out, err, false}, progress);
  return {code, out.str(), err.str()};
}

TEST(CommandLine, WithWrongUsageExitsWithTwo) {
  EXPECT_EQ(command({}).code, 2);
  EXPECT_EQ(command({"fly"}).code, 2);
  EXPECT_EQ(command({"optimize"}).code, 2);
  EXPECT_EQ(command({"optimize", "p", "--budget", "many"}).code, 2);
  EXPECT_EQ(command({"optimize", "p", "--nonsense"}).code, 2);
  EXPECT_EQ(command({"station", "p", "--add", "S", "--at", "1,x,3"}).code, 2);
}

TEST(CommandLine, HelpNamesEveryVerbAndEveryOption) {
  const auto all = command({"help"});
  EXPECT_EQ(all.code, 0);
  for (const auto& v : verbs()) {
    EXPECT_NE(all.out.find(v.name), std::string::npos) << v.name;
    const auto one = command({"help", v.name});
    EXPECT_EQ(one.code, 0);
    for (const auto& p : v.parameters) EXPECT_NE(one.out.find(p.name), std::string::npos) << v.name << " " << p.name;
  }
  EXPECT_EQ(command({"--help"}).code, 0);
  EXPECT_EQ(command({"help", "fly"}).code, 2);
}

TEST(CommandLine, OnAMissingProjectOrFileExitsWithFour) {
  EXPECT_EQ(command({"optimize", "/nonexistent/p"}).code, 4);
  EXPECT_EQ(command({"info", "/nonexistent/x.e57"}).code, 4);
  const TemporaryFolder folder;
  EXPECT_EQ(command({"import", "/nonexistent/x.ifc", "-o", (folder.path() / "p").string()}).code, 4);
}

TEST(CommandLine, WithJsonPrintsOneObjectOnStandardOutputEvenForAnError) {
  const auto ran = command({"optimize", "/nonexistent/p", "--json"});
  const auto answer = nlohmann::json::parse(ran.out);
  EXPECT_NE(answer["error"]["source"].get<std::string>().find("/nonexistent/p"), std::string::npos);
}

TEST(CommandLine, TakesNegativeCoordinates) {
  const TemporaryFolder folder;
  Progress progress;
  const auto p = folder.path().string() + "/p";
  ASSERT_TRUE(saveProject(twoStoreyDocument(), p, progress));
  const auto ran = command({"target", p, "--add", "T", "--at", "-1.5,-2,3", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(ran.out)["placed"]["at"], nlohmann::json({-1.5, -2.0, 3.0}));
}

Result<Outcome> lossy(const Document& d, const nlohmann::json&, Progress&) {
  Outcome outcome{d, {}, {}, "done"};
  outcome.answer = nlohmann::json::object();
  outcome.report.lose("#12", "its shape");
  return outcome;
}

TEST(CommandLine, ExitsWithThreeWhenSomethingWasLostUnlessThatIsAllowed) {
  const std::vector<Verb> table = {{"lossy", "Loses something", VerbScope::files, {}, lossy}};
  const auto ran = command({"lossy"}, table);
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("#12"), std::string::npos);
  EXPECT_EQ(command({"lossy", "--allow-loss"}, table).code, 0);
}

Result<Outcome> losesBolts(const Document& d, const nlohmann::json&, Progress&) {
  Outcome outcome{d, {}, {}, "done"};
  outcome.answer = nlohmann::json::object();
  for (int i = 0; i < 597; ++i)
    outcome.report.lose("#" + std::to_string(i), "IfcBolt " + std::to_string(i) + " produced no geometry");
  return outcome;
}

TEST(CommandLine, TellsManyAlikeIssuesInOneLineUnlessAllAreAskedFor) {
  const std::vector<Verb> table = {{"lossy", "Loses bolts", VerbScope::files, {}, losesBolts}};
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const auto few = command({"lossy"}, table);
  EXPECT_EQ(few.code, 3);
  EXPECT_EQ(few.err,
            "loss: #0: IfcBolt 0 produced no geometry (the first of 597 alike; list them with --all-issues)\n");
  EXPECT_EQ(lines(command({"lossy", "--all-issues"}, table).err), 597);
  EXPECT_EQ(nlohmann::json::parse(command({"lossy", "--json"}, table).out).at("issues").size(), 597U);
}

TEST(CommandLine, ABudgetThatIsNotMetExitsWithThreeAndStatesTheLeastOneThatIs) {
  const TemporaryFolder folder;
  Progress progress;
  const auto p = folder.path().string() + "/p";
  ASSERT_TRUE(saveProject(twoStoreyDocument(), p, progress));
  const std::vector<std::string> few = {"optimize", p, "--max-deviation", "0.001", "--budget", "10"};
  const auto missed = command(few);
  EXPECT_EQ(missed.code, 3);
  EXPECT_NE(missed.err.find("loss: budget: cannot reach 10 triangles with a maximum deviation of 1 mm; the minimum"),
            std::string::npos)
      << missed.err;
  auto allowed = few;
  allowed.insert(allowed.end(), {"--allow-loss", "--json"});
  const auto answered = command(allowed);
  EXPECT_EQ(answered.code, 0);
  const auto least = nlohmann::json::parse(answered.out).at("smallest_budget").get<int>();
  EXPECT_NE(missed.err.find("the minimum is " + std::to_string(least)), std::string::npos) << missed.err;
  EXPECT_EQ(command({"optimize", p, "--max-deviation", "0.001", "--budget", std::to_string(least)}).code, 0);
}

Result<Outcome> cancellable(const Document& d, const nlohmann::json&, Progress& progress) {
  progress.cancel();
  if (auto ok = progress.check(); !ok) return failure(ok.error());
  return Outcome{d, {}, {}, {}};
}

TEST(CommandLine, CancelledExitsWithOneHundredAndThirty) {
  const std::vector<Verb> table = {{"wait", "Is cancelled meanwhile", VerbScope::files, {}, cancellable}};
  EXPECT_EQ(command({"wait"}, table).code, 130);
}

TEST(CommandLine, DoesNotReplaceAProjectUnlessToldTo) {
  const TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(twoStoreyDocument(), folder.path(), progress));
  const auto ran = command({"import", "house.ifc", "-o", folder.path().string()});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("replace the project in it"), std::string::npos);
  EXPECT_TRUE(loadProject(folder.path(), progress));
}

}  // namespace
}  // namespace standpoint
