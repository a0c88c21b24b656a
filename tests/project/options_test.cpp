// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

TEST(VerbTable, HasUniqueNamesSummariesAndHelpForEveryOption) {
  std::set<std::string> names;
  for (const auto& v : verbs()) {
    EXPECT_TRUE(names.insert(v.name).second) << v.name;
    EXPECT_GT(std::string(v.summary).size(), 10U) << v.name;
    ASSERT_NE(v.run, nullptr) << v.name;
    std::set<std::string> options;
    for (const auto& p : v.parameters) {
      EXPECT_TRUE(options.insert(p.name).second) << v.name << " " << p.name;
      EXPECT_GT(std::string(p.help).size(), 3U) << v.name << " " << p.name;
      EXPECT_EQ(p.kind == ParameterKind::choice, !p.choices.empty()) << v.name << " " << p.name;
    }
  }
}

TEST(VerbTable, AcceptsItsOwnDefaults) {
  for (const auto& v : verbs())
    for (const auto& p : v.parameters) {
      if (p.default_value.is_null()) continue;
      nlohmann::json options = {{p.name, p.default_value}};
      for (const auto& q : v.parameters)
        if (q.required)
          options[q.name] = q.kind == ParameterKind::list ? nlohmann::json::array({"x"}) : nlohmann::json("x");
      EXPECT_TRUE(checkOptions(v, options)) << v.name << " " << p.name;
    }
}

TEST(Options, ThatDoNotExistAreNamedWithThoseThatDo) {
  const auto bad = run("optimize", twoStoreyDocument(), {{"bugdet", 100}});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().kind, ErrorKind::usage);
  EXPECT_NE(bad.error().message.find("bugdet"), std::string::npos);
  EXPECT_NE(bad.error().message.find("budget"), std::string::npos);
}

TEST(Options, OutsideTheirDomainAreRefusedWithTheDomain) {
  for (const nlohmann::json& options : {nlohmann::json{{"max-deviation", -1}}, nlohmann::json{{"max-deviation", "2"}},
                                        nlohmann::json{{"budget", 2.5}}, nlohmann::json{{"budget", nullptr}}}) {
    const auto bad = run("optimize", twoStoreyDocument(), options);
    ASSERT_FALSE(bad) << options;
    EXPECT_EQ(bad.error().kind, ErrorKind::usage) << options;
  }
  EXPECT_FALSE(run("target", twoStoreyDocument(), {{"add", "T"}, {"at", {1, 2, 3}}, {"kind", "cube"}}));
}

// Rays to a place beyond single precision would end the program.
TEST(Options, PlacesBeyondWhatCanBeComputedAreRefused) {
  for (const double far : {1e30, -2e9}) {
    const auto bad = run("station", twoStoreyDocument(), {{"add", "S"}, {"on", {far, 0, 0}}});
    ASSERT_FALSE(bad) << far;
    EXPECT_EQ(bad.error().kind, ErrorKind::usage);
    EXPECT_NE(bad.error().message.find("none beyond 1e9"), std::string::npos) << bad.error().message;
  }
}

TEST(Verbs, ThatNeedAModelSayThatThereIsNone) {
  for (const auto& v : verbs()) {
    if (v.scope != VerbScope::changes && v.scope != VerbScope::reads) continue;
    nlohmann::json options = nlohmann::json::object();
    for (const auto& q : v.parameters)
      if (q.required) options[q.name] = q.kind == ParameterKind::list ? nlohmann::json{"x"} : nlohmann::json("x");
    const auto bad = run(v.name, Document{}, options);
    ASSERT_FALSE(bad) << v.name;
    EXPECT_NE(bad.error().message.find("import"), std::string::npos) << v.name;
  }
}

}  // namespace
}  // namespace standpoint
