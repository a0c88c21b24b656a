// SPDX-License-Identifier: GPL-3.0-or-later
// What leaves for learning management systems, judged by programs that are not ours: a SCORM player and a validator of
// xAPI from npm. STANDPOINT_LMS_TOOLS names a folder in which `npm install scorm-again@3.4.3 jsdom@24
// @learninglocker/xapi-validation@3.0.0` was run; without it these tests are skipped.
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include <expat.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulated-ui/classroom/class_exercise.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string output(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return text;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

// As json lines.
std::vector<json> linesOf(const std::string& text) {
  std::vector<json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    auto parsed = json::parse(line, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << line;
    if (!parsed.is_discarded()) lines.push_back(std::move(parsed));
  }
  return lines;
}

class Exports : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("STANDPOINT_LMS_TOOLS");
    if (folder == nullptr || std::system("command -v node unzip > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "STANDPOINT_LMS_TOOLS, node or unzip is not here";
    tools = folder;
  }
  std::string player(const std::string& package, const std::string& user, const std::vector<std::string>& files) const {
    auto command =
        "node " SOURCE_DIR "/tests/emulated-ui/classroom/scorm_player.mjs " + tools + " " + package + " " + user;
    for (const auto& file : files) command += " '" + file + "'";
    return output(command);
  }
  std::string tools;
};

// Packed, unpacked by another program; its folder.
std::string unpacked(const Classroom& room, const char* name, bool graded) {
  const auto zip = room.path(name) + std::string(".zip");
  const auto done = Classroom::verb(
      "scorm",
      {{"assignment", room.path("C1.json")}, {"class", room.path("class.csv")}, {"graded", graded}, {"output", zip}});
  EXPECT_TRUE(done) << describe(done.error());
  EXPECT_THAT(output("unzip -t " + zip), HasSubstr("No errors detected"));
  output("unzip -q " + zip + " -d " + room.path(name));
  return room.path(name);
}

TEST_F(Exports, AScormPlayerGetsTheMarkOfAResultAndNothingOfOneThatWasTamperedWith) {
  const Classroom room(3);
  auto poor = room.goodActions("s-001");
  poor.erase(0);
  const auto good = room.handIn("s-001", room.goodActions("s-001")).string();
  const auto failed = room.handIn("s-001", poor, "poor").string();
  const auto friends = room.handIn("s-002", room.goodActions("s-002")).string();
  const auto key = *ownKey();
  const auto forged = [&](const char* name, const std::function<void(json&)>& change, bool signed_anew) {
    std::filesystem::copy_file(good, room.folder / name);
    Classroom::tamper(room.folder / name, change, signed_anew ? &key : nullptr);
    return room.path(name);
  };
  const auto edited = forged(
      "edited.json", [](json& r) { r["score"] = 0.5; }, false);
  const auto broken = forged(
      "broken.json", [](json& r) { r["actions"][16]["action"] = "{}"; }, true);
  const auto late = forged(
      "late.json", [](json& r) { r["finished"] = "2100-01-01T00:00:00Z"; }, true);
  const auto other = forged(
      "other.json", [](json& r) { r["assignment_hash"] = "0"; }, true);
  const auto renamed = forged(
      "renamed.json", [](json& r) { r["student"] = "s-002"; }, true);
  const auto folder = unpacked(room, "formative", false);
  const auto said = linesOf(player(
      folder, "us-001",
      {good, failed, friends, edited, broken, late, other, renamed, room.path("C1.json"), room.path("class.csv")}));
  ASSERT_EQ(said.size(), 10U);
  EXPECT_EQ(said[0]["accepted"], true) << said[0];
  EXPECT_EQ(said[0]["raw"], "100");
  EXPECT_EQ(said[0]["after"], "passed");
  EXPECT_EQ(said[0]["interactions"], json::parse(R"([{"id": "level", "type": "performance", "result": "correct"}])"));
  EXPECT_EQ(said[0]["last_error"], "0");
  EXPECT_EQ(said[0]["terminated"], true);
  EXPECT_LE(said[0]["suspend_data"].get<std::string>().size(), 4096U);
  // A mark above the pass mark without what is required: failed, also after the end.
  EXPECT_EQ(said[1]["raw"], "75");
  EXPECT_EQ(said[1]["after"], "failed");
  const char* const kWhy[] = {"another student",
                              "changed after it was signed",
                              "changed at action 17",
                              "deadline has passed",
                              "another exercise",
                              "another student",
                              "not a file that Standpoint wrote",
                              "not a file that Standpoint wrote"};
  for (std::size_t i = 2; i < said.size(); ++i) {
    EXPECT_EQ(said[i]["accepted"], false) << said[i];
    EXPECT_THAT(said[i]["said"].get<std::string>(), HasSubstr(kWhy[i - 2]));
    EXPECT_EQ(said[i]["status"], "not attempted");
    EXPECT_EQ(said[i]["raw"], "");
  }
  const auto stranger = linesOf(player(folder, "somebody", {good}));
  EXPECT_THAT(stranger[0]["said"].get<std::string>(), HasSubstr("not in the class list"));
}

TEST_F(Exports, AGradedPackageTakesOnlyTheLecturersMark) {
  const Classroom room(2);
  const auto result = room.handIn("s-001", room.goodActions("s-001")).string();
  ASSERT_TRUE(room.collect());
  const auto mark = room.path("table/marks/C1-s-001.mark.json");
  std::filesystem::copy_file(mark, room.folder / "own.json");
  const auto key = *ownKey();
  Classroom::tamper(
      room.folder / "own.json", [](json&) {}, &key);
  const auto said = linesOf(player(unpacked(room, "graded", true), "us-001", {mark, result, room.path("own.json")}));
  ASSERT_EQ(said.size(), 3U);
  EXPECT_EQ(said[0]["after"], "passed") << said[0];
  EXPECT_EQ(said[1]["accepted"], false);
  EXPECT_THAT(said[2]["said"].get<std::string>(), HasSubstr("was not signed by your lecturer"));
}

TEST_F(Exports, EveryXapiStatementIsValidAndHasAnIdOfItsOwnThatStays) {
  const Classroom room(4);
  room.handIn("s-001", room.goodActions("s-001"));
  room.handIn("s-002", json::parse(R"([{"press": "power"}])"));
  ASSERT_TRUE(room.collect());
  const auto said = linesOf(output("node " SOURCE_DIR "/tests/emulated-ui/classroom/xapi_check.mjs " + tools + " " +
                                   room.path("table/xapi.json")));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0]["statements"], 4);  // two results with one rule each
  EXPECT_TRUE(said[0]["wrong"].empty()) << said[0];
  const auto before = room.text("table/xapi.json");
  ASSERT_TRUE(room.collect());
  EXPECT_EQ(room.text("table/xapi.json"), before);
  std::set<std::string> ids;
  for (const auto& one : json::parse(before)) {
    const auto id = one["id"].get<std::string>();
    EXPECT_TRUE(std::regex_match(id, std::regex("[0-9a-f]{8}-[0-9a-f]{4}-5[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")))
        << id;
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 4U);
}

// Elements and attributes of a manifest, by expat.
struct Manifest {
  std::vector<std::pair<std::string, std::map<std::string, std::string>>> elements;
};
Manifest manifestOf(const std::string& xml) {
  Manifest found;
  XML_Parser parser = XML_ParserCreate(nullptr);
  XML_SetUserData(parser, &found);
  XML_SetStartElementHandler(parser, [](void* to, const XML_Char* name, const XML_Char** attributes) {
    std::map<std::string, std::string> all;
    for (; *attributes != nullptr; attributes += 2) all[attributes[0]] = attributes[1];
    static_cast<Manifest*>(to)->elements.emplace_back(name, std::move(all));
  });
  EXPECT_EQ(XML_Parse(parser, xml.data(), static_cast<int>(xml.size()), 1), XML_STATUS_OK);
  XML_ParserFree(parser);
  return found;
}

// The rules of SCORM 1.2 that players fail on in silence.
TEST(ScormManifest, NamesFilesThatAreThereAsATrackedPageWithoutMasteryScore) {
  if (std::system("command -v unzip > /dev/null 2>&1") != 0) GTEST_SKIP() << "unzip is not here";
  const Classroom room(2);
  const std::filesystem::path folder = unpacked(room, "package", false);
  const auto manifest = manifestOf(*readWholeFile(folder / "imsmanifest.xml", 1U << 20U));
  std::set<std::string> listed, identifiers, references;
  for (const auto& [name, attributes] : manifest.elements) {
    EXPECT_EQ(name.find("masteryscore"), std::string::npos);
    if (name == "file") listed.insert(attributes.at("href"));
    if (attributes.contains("identifier")) identifiers.insert(attributes.at("identifier"));
    if (attributes.contains("identifierref")) references.insert(attributes.at("identifierref"));
    if (name == "organizations") references.insert(attributes.at("default"));
    if (name != "resource") continue;
    EXPECT_EQ(attributes.at("adlcp:scormtype"), "sco");
    EXPECT_EQ(attributes.at("type"), "webcontent");
    EXPECT_EQ(attributes.at("href"), "index.html");
  }
  for (const auto& reference : references) EXPECT_TRUE(identifiers.contains(reference)) << reference;
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) there.insert(entry.path().filename().string());
  there.erase("imsmanifest.xml");
  EXPECT_EQ(listed, there);
  const auto script = *readWholeFile(folder / "assignment.js", 1U << 20U);
  for (const char* secret : {"s-001", "us-001", "Student 1", "solution"})
    EXPECT_EQ(script.find(secret), std::string::npos) << secret;
}

TEST(ScormPackage, IsTheSameEachTime) {
  const Classroom room(2);
  for (const char* name : {"a.zip", "b.zip"})
    ASSERT_TRUE(Classroom::verb(
        "scorm",
        {{"assignment", room.path("C1.json")}, {"class", room.path("class.csv")}, {"output", room.path(name)}}));
  EXPECT_EQ(room.text("a.zip"), room.text("b.zip"));
}

}  // namespace
}  // namespace standpoint
