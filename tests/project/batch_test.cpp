// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pointclouds/formats.h"
#include "survey/scanning/scan_parts.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Document threeStations() {
  Document d = twoStoreyDocument();
  d = run("station", d, {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}})->document;
  d = run("station", d, {{"add", "S2"}, {"at", {500003.0, 5600001.5, 4.6}}, {"tilt-deg", 1}})->document;
  return run("station", d, {{"add", "S3"}, {"at", {500001.5, 5600001, 1.6}}})->document;
}

json options(const fs::path& output) {
  return {{"instrument", "faro-focus-s350"},
          {"set", {"resolution=1/32", "quality=4x"}},
          {"seed", 5},
          {"truth", true},
          {"output", output.string()}};
}

json withPanorama(const fs::path& output) {
  auto o = options(output);
  o["set"] = {"resolution=1/32", "quality=4x", "colour=on"};
  o["panorama"] = true;
  o["panorama-size"] = 256;
  return o;
}

Result<Outcome> scanUntil(const Document& d, const json& options, const std::string& station,
                          const std::function<void(Progress&)>& act) {
  Progress progress;
  progress.onChange([&] {
    if (progress.stageName().find(station) != std::string::npos) act(progress);
  });
  return runVerb(*findVerb(verbs(), "scan"), d, options, progress);
}

void cancel(Progress& progress) { progress.cancel(); }

// Cancels at the third of three stations and goes on; the output must be that of a run without a break.
void resumes(const char* name, json (*made)(const fs::path&) = options) {
  const TemporaryFolder folder;
  const Document d = threeStations();
  const fs::path whole = folder.path() / "whole" / name;
  const fs::path broken = folder.path() / "broken" / name;
  for (const auto& file : {whole, broken}) fs::create_directories(file.parent_path());
  ASSERT_TRUE(run("scan", d, made(whole)));
  const auto cancelled = scanUntil(d, made(broken), "S3", cancel);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::cancelled);
  EXPECT_THAT(cancelled.error().message, AllOf(HasSubstr("S1, S2"), HasSubstr("resume the scan")));
  auto again = made(broken);
  const auto unasked = run("scan", d, again);
  ASSERT_FALSE(unasked) << "finished stations are not thrown away";
  EXPECT_THAT(unasked.error().message, HasSubstr("S1, S2"));
  again["resume"] = true;
  const auto resumed = run("scan", d, again);
  ASSERT_TRUE(resumed) << describe(resumed.error());
  EXPECT_TRUE(resumed->answer["stations"][1].value("resumed", false));
  EXPECT_FALSE(resumed->answer["stations"][2].contains("resumed"));
  EXPECT_EQ(resumed->document.job->stations[0].scans.size(), 1U);
  std::vector<fs::path> files;
  if (fs::is_directory(whole))
    for (const char* s : {"S1.e57", "S2.e57", "S3.e57"}) files.emplace_back(s);
  else
    files.emplace_back();
  for (const auto& file : files)
    EXPECT_TRUE(bytes(file.empty() ? whole : whole / file) == bytes(file.empty() ? broken : broken / file)) << file;
  EXPECT_FALSE(fs::exists(folder.path() / "broken" / (std::string(name) + ".parts"))) << "nothing is left behind";
}

TEST(Batch, ResumedIntoOneE57HasTheBytesOfARunWithoutABreak) { resumes("all.e57"); }
TEST(Batch, ResumedIntoOnePtxHasTheBytesOfARunWithoutABreak) { resumes("all.ptx"); }
TEST(Batch, ResumedIntoAFolderHasTheBytesOfARunWithoutABreak) { resumes("scans"); }

// What the scan writes so is what `convert` makes of its floats, and a run that goes on in another way starts anew.
TEST(Batch, WritesIntegersThatConvertWouldWrite) {
  const TemporaryFolder folder;
  const Document d = threeStations();
  const auto scan = [&](const char* name, const char* as) {
    auto o = options(folder.path() / name);
    o["stations"] = "S1";
    if (as) o["as"] = as;
    const auto done = run("scan", d, o);
    ASSERT_TRUE(done) << describe(done.error());
    EXPECT_EQ(done->report.losses(), 0U);
  };
  scan("float.e57", nullptr);
  for (const char* as : {"scaled", "spherical"}) {
    SCOPED_TRACE(as);
    scan("direct.e57", as);
    Report report;
    Progress progress;
    ASSERT_TRUE(convertCloud({folder.path() / "float.e57"}, folder.path() / "converted.e57", as, report, progress));
    // The guid tells them apart, so the checksums of its pages do, too.
    const auto direct = measureCloud(folder.path() / "direct.e57", progress);
    const auto converted = measureCloud(folder.path() / "converted.e57", progress);
    ASSERT_TRUE(direct && converted);
    EXPECT_GT(direct->points, 10000U);
    EXPECT_EQ(direct->points, converted->points);
    EXPECT_EQ(direct->bounds_file_m.min, converted->bounds_file_m.min);
    EXPECT_EQ(direct->bounds_file_m.max, converted->bounds_file_m.max);
    EXPECT_EQ(fs::file_size(folder.path() / "direct.e57"), fs::file_size(folder.path() / "converted.e57"));
  }
  EXPECT_LT(fs::file_size(folder.path() / "converted.e57"),
            1.01 * static_cast<double>(fs::file_size(folder.path() / "float.e57")));
  const auto refused = run("scan", d, [&] {
    auto o = options(folder.path() / "x.las");
    o["as"] = "scaled";
    return o;
  }());
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("no variant 'scaled'"));
}

TEST(Batch, GoesOnOnlyWithStationsThatWereWrittenInTheSameWay) {
  const TemporaryFolder folder;
  const Document d = threeStations();
  ASSERT_FALSE(scanUntil(d, options(folder.path() / "scans"), "S2", cancel));
  auto scaled = options(folder.path() / "scans");
  scaled["resume"] = true;
  scaled["as"] = "scaled";
  const auto again = run("scan", d, scaled);
  ASSERT_TRUE(again) << describe(again.error());
  EXPECT_FALSE(again->answer["stations"][0].contains("resumed"));
}

TEST(Batch, ResumedWithPanoramasHasTheBytesOfARunWithoutABreak) { resumes("all.e57", withPanorama); }

TEST(Batch, ScansAgainWhereThePanoramaHasAnotherSize) {
  const TemporaryFolder folder;
  const Document d = threeStations();
  const auto file = folder.path() / "all.e57";
  ASSERT_FALSE(scanUntil(d, withPanorama(file), "S3", cancel));
  auto again = withPanorama(file);
  again["panorama-size"] = 258;
  again["resume"] = true;
  const auto resumed = run("scan", d, again);
  ASSERT_TRUE(resumed) << describe(resumed.error());
  for (const auto& row : resumed->answer["stations"]) EXPECT_FALSE(row.contains("resumed")) << row;
}

TEST(Batch, SurvivesBeingKilled) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  // The same place in this process and in the one that dies, which runs this test from its beginning.
  constexpr auto kPlace = "STANDPOINT_TEST_BATCH_KILLED";
  std::optional<TemporaryFolder> own;
  if (std::getenv(kPlace) == nullptr) setenv(kPlace, own.emplace().path().c_str(), 1);
  const fs::path folder = std::getenv(kPlace);
  const fs::path file = folder / "all.e57";
  const Document d = threeStations();
  EXPECT_EXIT((void)scanUntil(d, options(file), "S3", [](Progress&) { (void)std::raise(SIGKILL); }),
              testing::KilledBySignal(SIGKILL), "");
  unsetenv(kPlace);
  EXPECT_FALSE(fs::exists(file)) << "a part is never mistaken for the whole";
  auto again = options(file);
  again["resume"] = true;
  const auto resumed = run("scan", d, again);
  ASSERT_TRUE(resumed) << describe(resumed.error());
  EXPECT_TRUE(resumed->answer["stations"][0].value("resumed", false));
  EXPECT_TRUE(resumed->answer["stations"][1].value("resumed", false));
  ASSERT_TRUE(run("scan", d, options(folder / "whole.e57")));
  EXPECT_TRUE(bytes(file) == bytes(folder / "whole.e57"));
  fs::remove_all(folder);
}

TEST(Batch, ScansAStationAgainThatWasFinishedOtherwise) {
  const TemporaryFolder folder;
  const Document d = threeStations();
  const auto file = folder.path() / "all.e57";
  ASSERT_FALSE(scanUntil(d, options(file), "S3", cancel));
  const auto moved = run("station", d, {{"move", "S1"}, {"at", {500002.5, 5600002.2, 1.6}}})->document;
  auto again = options(file);
  again["resume"] = true;
  const auto resumed = run("scan", moved, again);
  ASSERT_TRUE(resumed) << describe(resumed.error());
  EXPECT_FALSE(resumed->answer["stations"][0].contains("resumed")) << "it stands elsewhere";
  EXPECT_TRUE(resumed->answer["stations"][1].value("resumed", false));
}

TEST(Batch, ADamagedTapeIsAnErrorAndNeverPoints) {
  const TemporaryFolder folder;
  const Document d = threeStations();
  const auto file = folder.path() / "all.e57";
  ASSERT_FALSE(scanUntil(d, options(file), "S3", cancel));
  const auto tape = ScanParts(file).pointsOf("S1");
  auto text = bytes(tape);
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
  std::ofstream(tape, std::ios::binary) << text;
  auto again = options(file);
  again["resume"] = true;
  const auto resumed = run("scan", d, again);
  ASSERT_FALSE(resumed);
  EXPECT_THAT(describe(resumed.error()), AllOf(HasSubstr("S1.points"), HasSubstr("damaged")));
  EXPECT_FALSE(fs::exists(file));
  std::ofstream(tape, std::ios::binary) << text.substr(0, 1000);
  const auto cut = run("scan", d, again);
  ASSERT_TRUE(cut) << "a tape of another length than its record says is no finished station: " << describe(cut.error());
  EXPECT_FALSE(cut->answer["stations"][0].contains("resumed"));
}

TEST(EmptyScan, SaysWhyNothingCameBack) {
  const TemporaryFolder folder;
  const auto scanAt = [&](const json& at, json more) {
    const auto d = run("station", twoStoreyDocument(), {{"add", "S"}, {"at", at}, {"stand", "free"}});
    EXPECT_TRUE(d) << describe(d.error());
    auto o = options(folder.path() / "s.e57");
    o.update(more);
    const auto done = run("scan", d->document, o);
    EXPECT_TRUE(done) << describe(done.error());
    EXPECT_EQ(done->answer["stations"][0]["points"].get<int>(), 0);
    return said(done->report);
  };
  EXPECT_THAT(scanAt({500003, 5600002, 200}, json::object()), HasSubstr("no beam hits the model"))
      << "above the scene, which lies in its blind cone";
  EXPECT_THAT(scanAt({501500, 5600002, 1.6}, json::object()), AllOf(HasSubstr("1494 m away"), HasSubstr("350 m")));
  EXPECT_TRUE(cloudFormatFor("s.e57")->info(folder.path() / "s.e57")) << "an honest empty file";
}

TEST(EmptyScan, OfASurfaceThatIsTooNearAllRoundSaysFromWhereOnTheInstrumentMeasures) {
  const TemporaryFolder folder;
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>();
  e->surfaces = d.imported->surfaces;
  addBox(*e, "crate", "IfcFurniture", {-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25});
  d.imported = e;
  d.georeference = std::make_shared<const Georeference>();
  const auto station = run("station", d, {{"add", "S"}, {"at", {0, 0, 0}}, {"stand", "free"}});
  ASSERT_TRUE(station) << describe(station.error());
  const auto done = run(
      "scan", station->document,
      {{"instrument", "leica-rtc360"}, {"set", {"resolution=12mm"}}, {"output", (folder.path() / "s.e57").string()}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer["stations"][0]["points"].get<int>(), 0);
  EXPECT_THAT(said(done->report), HasSubstr("closer than 0.50 m, the minimum range of the Leica RTC360"));
}

TEST(Batch, ConvertTellsHowManyPointsAndBytesItHasWritten) {
  const TemporaryFolder folder;
  const auto o = options(folder.path() / "s.e57");
  ASSERT_TRUE(run("scan", threeStations(), o));
  const auto converted = run("convert", Document(), {{"in", o["output"]}, {"out", (folder.path() / "s.ply").string()}});
  ASSERT_TRUE(converted) << describe(converted.error());
  Progress progress;
  std::uint64_t points = 0, bytes = 0;
  ASSERT_EQ(converted->answer.at("files").size(), 3U) << "a PLY holds one scan";
  for (const auto& file : converted->answer.at("files")) {
    const fs::path written = file.get<std::string>();
    const auto measured = measureCloud(written, progress);
    ASSERT_TRUE(measured);
    points += measured->points;
    bytes += fs::file_size(written);
  }
  EXPECT_GT(points, 10000U);
  EXPECT_EQ(converted->answer.at("points"), points);
  EXPECT_EQ(converted->answer.at("bytes"), bytes);
}

TEST(EmptyScan, OfASceneWithNothingInItIsRefusedOrEmptyInClearWords) {
  const TemporaryFolder folder;
  Document d = twoStoreyDocument();
  auto nothing = std::make_shared<Environment>(*d.imported);
  nothing->instances.clear();
  d.imported = nothing;
  const auto station = run("station", d, {{"add", "S"}, {"at", {500002, 5600002, 1.6}}});
  ASSERT_FALSE(station);
  EXPECT_THAT(station.error().message, HasSubstr("no ground below"));
  const auto planned = run("plan", d, {{"instrument", "leica-rtc360"}});
  ASSERT_FALSE(planned);
  EXPECT_THAT(planned.error().message, HasSubstr("the scene contains no products"));
  const auto free = run("station", d, {{"add", "S"}, {"at", {500002, 5600002, 1.6}}, {"stand", "free"}});
  ASSERT_TRUE(free) << describe(free.error());
  const auto done = run("scan", free->document, options(folder.path() / "s.e57"));
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_THAT(said(done->report), HasSubstr("the scene contains no products"));
}

}  // namespace
}  // namespace standpoint
