// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include <gtest/gtest.h>

#include "optimizer/optimizer.h"
#include "project/materials/materials_verb.h"
#include "project/materials/verification.h"
#include "project/model/import_verb.h"
#include "project/model/model_verbs.h"
#include "project/model/treatments.h"
#include "project/survey/register_verb.h"
#include "project/survey/survey_verbs.h"
#include "project/survey/underlays.h"
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
          options[q.name] = q.kind == ParameterKind::list     ? nlohmann::json::array({"x"})
                            : q.kind == ParameterKind::choice ? nlohmann::json(q.choices.front())
                                                              : nlohmann::json("x");
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

TEST(Options, ThatAreATripleHaveThreeNumbers) {
  const std::vector<std::pair<const char*, nlohmann::json>> wrong = {
      {"station", {{"add", "S"}, {"at", {1, 2}}}},
      {"georeference", {{"origin", {1, 2}}}},
      {"target", {{"add", "T"}, {"on", {1, 2}}, {"normal", {1, 0}}}},
      {"target", {{"add", "T"}, {"at", {1, 2, 3, 4}}}},
      {"station", {{"add", "S"}, {"on", {1}}}}};
  for (const auto& [verb, options] : wrong) {
    const auto bad = checkOptions(*findVerb(verbs(), verb), options);
    ASSERT_FALSE(bad) << options;
    EXPECT_EQ(bad.error().kind, ErrorKind::usage);
    EXPECT_NE(bad.error().message.find("must be three numbers"), std::string::npos) << bad.error().message;
  }
  const auto floor = checkOptions(*findVerb(verbs(), "station"), {{"add", "S"}, {"on", {1, 2}}});
  ASSERT_TRUE(floor);
  const auto typed = optionsFrom(stationFields(), *floor);
  ASSERT_TRUE(typed && typed->on);
  EXPECT_EQ(typed->on->x_m, 1);
  EXPECT_EQ(typed->on->y_m, 2);
  EXPECT_FALSE(typed->on->z_m);
}

TEST(Options, ThatHaveANotationAreReadBeforeTheVerbRuns) {
  const nlohmann::json wanted = {{"instrument", "leica-rtc360"}, {"output", "x.e57"}};
  const auto checked = [&](const char* option, const nlohmann::json& value) {
    auto options = wanted;
    options[option] = value;
    return checkOptions(*findVerb(verbs(), "scan"), options);
  };
  for (const char* shard : {"1/2x", "0/2", "3/2", "1", "1/", "/2", "-1/2", "1/2 ", " 1/2", "1.0/2", ""}) {
    const auto bad = checked("shard", shard);
    ASSERT_FALSE(bad) << shard;
    EXPECT_EQ(bad.error().message, "'" + std::string(shard) + "' is not i/n with 1 <= i <= n");
    EXPECT_EQ(bad.error().source, "--shard");
  }
  EXPECT_TRUE(checked("shard", "2/2"));
  EXPECT_FALSE(checked("weather", "rain=much"));
  EXPECT_FALSE(checked("sun", "135"));
  EXPECT_FALSE(checked("without", "no-such-effect"));
  EXPECT_FALSE(checked("field-fault", {"until=2"}));
}

TEST(Options, AreWrittenAsTheyAreRead) {
  const nlohmann::json job = {{"instrument", "leica-rtc360"},
                              {"stations", "S1,S2"},
                              {"set", {"resolution=12mm", "double_scan=on"}},
                              {"seed", 7},
                              {"without", "striping,footprint"},
                              {"quality", "reference"},
                              {"weather", "visibility=5 rain=2.5"},
                              {"sun", "135,40,600"},
                              {"field-fault", {"until=0.5", "noise=2"}},
                              {"note", {"operator=A=B"}},
                              {"panorama", true},
                              {"panorama-size", 1024},
                              {"compensator", "off"},
                              {"shard", "1/2"},
                              {"output", "x.e57"}};
  const auto checked = checkOptions(*findVerb(verbs(), "scan"), job);
  ASSERT_TRUE(checked) << describe(checked.error());
  auto options = optionsFrom(scanFields(), *checked);
  ASSERT_TRUE(options) << describe(options.error());
  EXPECT_EQ(options->shard->count, 2U);
  EXPECT_EQ(options->weather->rain_mm_h, 2.5);
  EXPECT_EQ(options->notes.front().second, "A=B");
  auto written = jobOptions(scanFields(), *options);
  const auto again = optionsFrom(scanFields(), written);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sun->irradiance_W_m2, 600);
  EXPECT_EQ(again->without, options->without);
  EXPECT_EQ(again->quality, ScanQuality::reference);
  for (const char* rewritten : {"sun", "without"}) written[rewritten] = job[rewritten];
  EXPECT_EQ(written, job);
}

TEST(VerbTable, HasOptionsOfATypeOfItsOwnForEveryVerb) {
  std::set<std::type_index> types{typeid(void)};
  for (const auto& v : verbs()) EXPECT_TRUE(types.insert(v.options_type).second) << v.name;
}

// What code asks for with a struct, beside what a user would have to write for the same.
struct TypedJob {
  VerbOptions typed;
  std::string verb;
  nlohmann::json job;
};
std::vector<TypedJob> typedJobs() {
  const Eigen::Vector3d p(1, 2, 3.5);
  TargetOptions target{.add = "T1"};
  target.on_surface = p;
  UnderlayOptions fit{.fit = "cloud"};
  fit.to_surface = true;
  ImportVerbOptions update{{.files = {"house.ifc"}}};
  update.update = true;
  return {
      {StationOptions{.add = "S1", .on = FloorPlace{1, 2, 3.5}}, "station", {{"add", "S1"}, {"on", {1, 2, 3.5}}}},
      {StationOptions{.move = "S1", .at = p, .height_m = 1.7, .yaw_deg = 90},
       "station",
       {{"move", "S1"}, {"at", {1, 2, 3.5}}, {"height", 1.7}, {"yaw-deg", 90}}},
      {StationOptions{.remove = "S1"}, "station", {{"remove", "S1"}}},
      {target, "target", {{"add", "T1"}, {"on-surface", {1, 2, 3.5}}}},
      {PlanOptions{.instrument = "leica-rtc360", .settings = {{"resolution", "12mm"}}, .spacing_m = 0.01},
       "plan",
       {{"instrument", "leica-rtc360"}, {"set", {"resolution=12mm"}}, {"spacing", 0.01}}},
      {RegisterOptions{.files = {"a.e57", "b.e57"}, .output = "registered"},
       "register",
       {{"files", {"a.e57", "b.e57"}}, {"output", "registered"}}},
      {MaterialsOptions{}, "materials", nlohmann::json::object()},
      {MaterialsOptions{{.assign = {{"name:a=b", "glass"}}}}, "materials", {{"assign", {"name:a=b=glass"}}}},
      {MaterialsOptions{{.accept = {"weak-1"}, .because = "seen"}},
       "materials",
       {{"accept", {"weak-1"}}, {"because", "seen"}}},
      {VerifyOptions{.underlay = "cloud"}, "verify", {{"underlay", "cloud"}}},
      {UnderlayOptions{.add = "cloud.e57"}, "underlay", {{"add", "cloud.e57"}}},
      {UnderlayOptions{.hide = "cloud"}, "underlay", {{"hide", "cloud"}}},
      {fit, "underlay", {{"register", "cloud"}, {"icp", true}}},
      {update, "import", {{"files", {"house.ifc"}}, {"update", true}}},
      {TreatOptions{.products = {"#1"}, .as = TreatmentKind::as_rules},
       "treat",
       {{"products", {"#1"}}, {"as", "rules"}}},
      {SimplificationRequest{.budget = 0, .max_deviation_m = 0.02},
       "optimize",
       {{"budget", 0}, {"max-deviation", 0.02}, {"engine", "auto"}}},
      {CollideVerbOptions{.agent_radius_m = 0.25, .doors = DoorState::as_set, .closed = {"#7"}},
       "collide",
       {{"agent-radius", 0.25}, {"agent-height", 1.8}, {"doors", "as-set"}, {"closed", {"#7"}}}},
      {GeoreferenceOptions{.origin = p, .rotation_deg = 0},
       "georeference",
       {{"origin", {1, 2, 3.5}}, {"rotation-deg", 0}}},
  };
}

TEST(Options, OfATypeAreThoseThatAJobSays) {
  for (const auto& [typed, name, job] : typedJobs()) {
    const auto* verb = findVerb(verbs(), typed.type());
    ASSERT_NE(verb, nullptr) << name;
    EXPECT_EQ(verb->name, name);
    const auto written = verb->job_options(typed.held());
    const auto checked = checkOptions(*verb, written), by_hand = checkOptions(*verb, job);
    ASSERT_TRUE(checked) << describe(checked.error());
    ASSERT_TRUE(by_hand) << describe(by_hand.error());
    EXPECT_EQ(*checked, *by_hand);
    for (const auto& [key, value] : written.items()) EXPECT_EQ(value, job.at(key)) << name << " " << key;
  }
}

TEST(Options, HaveTheirDefaultsOnce) {
  const auto* collide = findVerb(verbs(), "collide");
  const auto checked = checkOptions(*collide, nlohmann::json::object());
  ASSERT_TRUE(checked);
  EXPECT_EQ(checked->at("agent-radius"), CollideOptions{}.agent_radius_m);
  EXPECT_EQ(checked->at("agent-height"), CollideOptions{}.agent_height_m);
  EXPECT_EQ(checked->at("doors"), "open");
  EXPECT_EQ(checkOptions(*findVerb(verbs(), "optimize"), nlohmann::json::object())->at("max-deviation"),
            OptimizeOptions{}.max_deviation_m);
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
