// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "project/materials/verification.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// The lower room with unlike walls: brick in the west, wood in the east, plaster north and south, concrete above and
// below.
const json kWalls = {"class:IfcSlab=concrete_construction",
                     "south0=plaster_gypsum",
                     "north0=plaster_gypsum",
                     "west0=brick_paving_red",
                     "east0=wood_hardwood",
                     "table=paint_black_matt"};

class Verify : public ::testing::Test {
 protected:
  // Scanned once for all tests, into a PTX: its intensities are text.
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    Document d = run("materials", twoStoreyDocument(), {{"assign", kWalls}})->document;
    d = run("station", d, {{"add", "S1"}, {"at", {500002, 5600001.5, 1.6}}})->document;
    scanned_ = scannedTo("scan.ptx", d);
    // Surfaces of one material differ in a scan; without that they are what the library says.
    scannedTo("even.ptx", d, {{"without", "variation"}});
  }
  static Document scannedTo(const std::string& name, const Document& d, json more = json::object()) {
    more.update({{"instrument", "faro-focus-s350"},
                 {"set", {"resolution=1/32", "quality=4x"}},
                 {"output", path("full-" + name).string()}});
    const auto done = run("scan", d, more);
    EXPECT_TRUE(done) << describe(done.error());
    keepEvery(8, "full-" + name, name);
    return done->document;
  }
  static void TearDownTestSuite() { folder_.reset(), scanned_ = {}; }
  static fs::path path(const std::string& name) { return folder_->path() / name; }

  // Columns of the full scan: a text takes its time to read.
  static void keepEvery(int step, const std::string& from, const std::string& to) {
    std::ifstream in(path(from));
    std::ofstream out(path(to));
    int columns = 0, rows = 0;
    in >> columns >> rows;
    out << (columns + step - 1) / step << '\n' << rows << '\n';
    std::string line;
    std::getline(in, line);
    for (int n = -8; std::getline(in, line); ++n)
      if (n < 0 || n / rows % step == 0) out << line << '\n';
  }
  // Rewrites each point's line; nothing = the line is left out.
  template <class Change>
  static fs::path rewritten(const std::string& name, bool with_header, Change change) {
    std::ifstream in(path("scan.ptx"));
    std::ofstream out(path(name));
    std::string line;
    for (int n = 0; std::getline(in, line); ++n) {
      if (n < 10) {
        if (with_header) out << line << '\n';
        continue;
      }
      double x = 0, y = 0, z = 0, intensity = 0;
      std::istringstream(line) >> x >> y >> z >> intensity;
      if (x != 0 || y != 0 || z != 0)
        out << change(x, y, z, intensity) << '\n';
      else if (with_header)
        out << line << '\n';
    }
    return path(name);
  }
  static std::string text(double x, double y, double z, double intensity) {
    std::ostringstream line;
    line.precision(9);
    line << x << ' ' << y << ' ' << z << ' ' << intensity << " 128 128 128";
    return line.str();
  }

  static Document laid(const fs::path& file, const json& at = {}) {
    json options = {{"add", file.string()}, {"name", "cloud"}};
    if (!at.is_null()) options["at"] = at;
    const auto done = run("underlay", scanned_, options);
    EXPECT_TRUE(done) << describe(done.error());
    return done->document;
  }
  static Document swapped(const Document& d, const char* assign) {
    return run("materials", d, {{"assign", {assign}}})->document;
  }
  static Result<Outcome> verified(const Document& d, json more = json::object()) {
    more["instrument"] = "faro-focus-s350";
    return run("verify", d, more);
  }
  static std::string refusal(const Document& d, const json& more = json::object()) {
    const auto done = verified(d, more);
    return done ? "fine" : done.error().message;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static Document scanned_;
};
std::unique_ptr<TemporaryFolder> Verify::folder_;
Document Verify::scanned_;

TEST_F(Verify, FindsNothingWhereNothingIsWrong) {
  const auto done = verified(laid(path("scan.ptx")));
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_TRUE(done->answer.at("no_verdict").is_null()) << done->answer.at("no_verdict");
  EXPECT_TRUE(done->answer.at("proposals").empty()) << done->answer.at("proposals").dump();
  EXPECT_GE(done->answer.at("materials").size(), 4U);
}

TEST_F(Verify, FindsEachMaterialWhereItsFiguresSay) {
  const auto done = verified(laid(path("even.ptx")));
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_TRUE(done->answer.at("proposals").empty()) << done->answer.at("proposals").dump();
  for (const auto& m : done->answer.at("materials")) {
    if (m.at("judged")) {
      EXPECT_NEAR(m.at("off_db").at("median").get<double>(), 0, 0.3) << m.at("material");
    }
  }
}

TEST_F(Verify, NamesTheSwappedWallWithWordsThatMendIt) {
  const Document wrong = swapped(laid(path("even.ptx")), "east0=rubber_black");
  const auto done = verified(wrong);
  ASSERT_TRUE(done) << describe(done.error());
  ASSERT_EQ(done->answer.at("proposals").size(), 1U) << done->answer.at("no_verdict");
  const auto& p = done->answer.at("proposals")[0];
  EXPECT_EQ(p.at("material"), "rubber_black");
  EXPECT_EQ(p.at("products"), json({"east0"}));
  EXPECT_THAT(said(done->report), HasSubstr("rubber_black: behaves like"));
  const auto mended = run("materials", wrong, {{"assign", p.at("assign")}});
  ASSERT_TRUE(mended) << describe(mended.error());
  const auto again = verified(mended->document);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->answer.at("proposals").empty());
  // wood_hardwood, or what sends back as much at 1550 nm
  auto behaves = p.at("alike");
  behaves.push_back(p.at("behaves_like"));
  EXPECT_THAT(behaves.get<std::vector<std::string>>(), ::testing::Contains("wood_hardwood"));
}

TEST_F(Verify, NamesItOnAMadeUpLinearScaleToo) {
  const auto file = rewritten("linear.ptx", true, [](double x, double y, double z, double i) {
    return text(x, y, z, std::min(1.0, 20 * std::pow(10, -6 + 7 * i)));
  });
  const auto done = verified(swapped(laid(file), "east0=rubber_black"));
  ASSERT_TRUE(done) << describe(done.error());
  ASSERT_EQ(done->answer.at("proposals").size(), 1U) << done->answer.at("no_verdict");
  EXPECT_EQ(done->answer.at("proposals")[0].at("products"), json({"east0"}));
}

TEST_F(Verify, OfACloudThatLiesWrongSaysThatInsteadOfProposing) {
  const auto done = verified(swapped(laid(path("scan.ptx"), {0.03, 0.04, 0}), "east0=rubber_black"));
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_TRUE(done->answer.at("proposals").empty());
  EXPECT_THAT(done->answer.at("no_verdict").get<std::string>(), HasSubstr("the cloud is 0.050 m off the model"));
}

TEST_F(Verify, IsKeptInTheProjectUntilSomethingElseIsTrue) {
  const auto done = verified(laid(path("scan.ptx")));
  ASSERT_TRUE(done);
  Progress progress;
  ASSERT_TRUE(saveProject(done->document, path("project"), progress));
  const auto back = loadProject(path("project"), progress);
  ASSERT_TRUE(back) << describe(back.error());
  ASSERT_TRUE(back->verification);
  EXPECT_EQ(AnswerValue<VerifyAnswer>::write(back->verification->answer)["materials"], done->answer["materials"]);
  EXPECT_TRUE(isCurrent(*back->verification, *back));
  EXPECT_FALSE(isCurrent(*back->verification, swapped(*back, "east0=rubber_black")));
  EXPECT_FALSE(
      isCurrent(*back->verification, run("underlay", *back, {{"move", "cloud"}, {"at", {1, 0, 0}}})->document));
}

// Of the findings that `materials` answers.
std::vector<json> measuredOtherwise(const Document& d, json options = json::object()) {
  std::vector<json> found;
  const auto done = run("materials", d, options);
  EXPECT_TRUE(done) << describe(done.error());
  if (done)
    for (const auto& f : done->answer.at("findings"))
      if (f.at("kind") == "measured-otherwise") found.push_back(f);
  return found;
}

TEST_F(Verify, PutsItsProposalsAmongTheFindingsWithARemedyOfOneClick) {
  const Document wrong = swapped(laid(path("scan.ptx")), "east0=rubber_black");
  EXPECT_TRUE(measuredOtherwise(wrong).empty()) << "nothing was measured yet";
  const auto done = verified(wrong);
  ASSERT_TRUE(done) << describe(done.error());
  auto findings = measuredOtherwise(done->document);
  ASSERT_EQ(findings.size(), 1U);
  const json f = findings[0];
  EXPECT_EQ(f.at("products"), json({"east0"}));
  EXPECT_EQ(f.at("severity"), "warning");
  EXPECT_THAT(f.at("message").get<std::string>(), HasSubstr("measurements contradict 'rubber_black' on IfcWall"));
  EXPECT_THAT(f.at("why").get<std::string>(), HasSubstr("By the cloud 'cloud': "));
  for (const auto& use : done->document.materials->result.report.uses)
    if (use.material == "rubber_black") {
      EXPECT_NEAR(f.at("area_m2").get<double>(), use.area_m2, 1e-9) << "nothing else is of rubber";
    }
  const auto mended = run("materials", done->document, f.at("remedies")[0].at("options"));
  ASSERT_TRUE(mended) << describe(mended.error());
  EXPECT_TRUE(measuredOtherwise(mended->document).empty()) << "it was followed";
  EXPECT_TRUE(measuredOtherwise(swapped(done->document, "south0=bark")).empty())
      << "another wall is of something else than when it was measured";
  EXPECT_TRUE(
      measuredOtherwise(run("underlay", done->document, {{"move", "cloud"}, {"at", {1, 0, 0}}})->document).empty());
}

TEST_F(Verify, LetsAFindingStandBecauseOfSomething) {
  const auto done = verified(swapped(laid(path("scan.ptx")), "east0=rubber_black"));
  ASSERT_TRUE(done) << describe(done.error());
  const auto id = measuredOtherwise(done->document).at(0).at("id");
  const auto accepted = run("materials", done->document, {{"accept", {id}}, {"because", "a curtain hung there"}});
  ASSERT_TRUE(accepted) << describe(accepted.error());
  Progress progress;
  ASSERT_TRUE(saveProject(accepted->document, path("accepted"), progress));
  const auto back = loadProject(path("accepted"), progress);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_EQ(measuredOtherwise(*back).at(0).at("accepted"), "a curtain hung there");
  const auto again = verified(*back);
  ASSERT_TRUE(again);
  EXPECT_EQ(measuredOtherwise(again->document).at(0).at("accepted"), "a curtain hung there")
      << "measured again, the same came out";
  EXPECT_FALSE(measuredOtherwise(again->document, {{"reopen", {id}}}).at(0).contains("accepted"));
}

TEST_F(Verify, OfAListOfPointsAsksForTheStation) {
  // PTS of the same points: they are in the scanner's frame.
  const auto file = rewritten("list.xyz", false, [](double x, double y, double z, double i) {
    std::ostringstream line;
    line << x << ' ' << y << ' ' << z << ' ' << i;
    return line.str();
  });
  const Document d = laid(file, {500002, 5600001.5, 1.6});
  EXPECT_THAT(refusal(d), HasSubstr("specify the position"));
  const auto done = verified(d, {{"from", {500002, 5600001.5, 1.6}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_TRUE(done->answer.at("no_verdict").is_null());
}

TEST_F(Verify, SaysWhatIsMissing) {
  EXPECT_THAT(refusal(scanned_), HasSubstr("there is no underlay"));
  const auto constant =
      rewritten("constant.ptx", true, [](double x, double y, double z, double) { return text(x, y, z, 0.5); });
  EXPECT_THAT(refusal(laid(constant)), HasSubstr("all points have the same intensity"));
  const auto bare = rewritten("bare.xyz", false, [](double x, double y, double z, double) {
    return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z);
  });
  EXPECT_THAT(refusal(laid(bare)), HasSubstr("the point cloud has no intensity"));
  EXPECT_THAT(refusal(laid(path("scan.ptx"), {100, 0, 0})), HasSubstr("register underlay"));
  Document none = laid(path("scan.ptx"));
  none.materials = nullptr;
  EXPECT_THAT(refusal(none), HasSubstr("no materials assigned"));
  EXPECT_THAT(refusal(laid(path("scan.ptx")), {{"underlay", "clod"}}), HasSubstr("available: cloud"));
  const auto unsaid = run("verify", laid(path("scan.ptx")), json::object());
  ASSERT_FALSE(unsaid);
  EXPECT_THAT(unsaid.error().message, HasSubstr("with the closest wavelength"));
}

TEST_F(Verify, OfAHeapAtOnePlaceProposesNothing) {
  const auto heap = rewritten("heap.ptx", true, [](double, double, double, double i) { return text(0, -1.5, 0, i); });
  const auto done = verified(laid(heap));
  if (!done) return;  // refused: as good
  EXPECT_TRUE(done->answer.at("proposals").empty());
  EXPECT_FALSE(done->answer.at("no_verdict").is_null());
}

TEST_F(Verify, OfAHandfulOfPointsSaysThatTheyAreTooFewAndNotThatTheyLieWrong) {
  int n = 0;
  const auto few = rewritten("few.ptx", true, [&](double x, double y, double z, double intensity) {
    return n++ < 40 ? text(x, y, z, intensity) : std::string("0 0 0 0.5");
  });
  const auto said = refusal(laid(few));
  EXPECT_THAT(
      said, AllOf(HasSubstr("scanner position: 40"), HasSubstr("at least 100 required"), HasSubstr("as an underlay")));
  EXPECT_THAT(said, Not(HasSubstr("--register")));
}

TEST_F(Verify, StopsWhenItIsCancelled) {
  Progress progress;
  progress.cancel();
  const auto done =
      runVerb(*findVerb(verbs(), "verify"), laid(path("scan.ptx")), {{"instrument", "faro-focus-s350"}}, progress);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace standpoint
