// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/instruments.h"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class OwnInstruments : public ::testing::Test {
 protected:
  OwnInstruments() { setenv("STANDPOINT_INSTRUMENTS", own().c_str(), 1); }
  ~OwnInstruments() override { unsetenv("STANDPOINT_INSTRUMENTS"); }
  fs::path own() const { return folder_.path() / "mine"; }

  nlohmann::json answer(const nlohmann::json& options) {
    Progress progress;
    auto outcome = runVerb(*findVerb(verbs(), "instruments"), Document{}, options, progress);
    if (!outcome) throw std::runtime_error(describe(outcome.error()));
    return outcome->answer;
  }
  Error refused(const nlohmann::json& options) {
    Progress progress;
    auto outcome = runVerb(*findVerb(verbs(), "instruments"), Document{}, options, progress);
    return outcome ? Error{ErrorKind::internal, "accepted", ""} : outcome.error();
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(OwnInstruments, NeedNotBeThere) {
  const auto listed = answer(nlohmann::json::object());
  EXPECT_EQ(listed["own_folder"], own().string());
  EXPECT_EQ(listed["instruments"].size(), 27U);
  EXPECT_FALSE(fs::exists(own()));
}

TEST_F(OwnInstruments, AreCopiedEditedAndReadBesideTheShippedOnes) {
  const auto copied = answer({{"copy", "leica-rtc360"}, {"as", "my-rtc360"}});
  const fs::path file = copied["copied"]["file"].get<std::string>();
  EXPECT_EQ(file, own() / "my-rtc360.json");
  EXPECT_EQ(copied["instruments"].size(), 28U);
  EXPECT_EQ(copied["instruments"].back()["own"], true);
  auto text = contentOf(file);
  const auto shipped = contentOf(shippedInstrumentsFolder() / "leica-rtc360.json");
  EXPECT_EQ(text.size(), shipped.size() - 3);  // nothing but the id is another
  const std::string before = "\"min_m\": { \"value\": 0.5";
  text.replace(text.find(before), before.size(), "\"min_m\": { \"value\": 0.7");
  std::ofstream(file) << text;
  EXPECT_EQ(instrumentById("my-rtc360")->min_range_m, 0.7);
  EXPECT_EQ(instrumentById("leica-rtc360")->min_range_m, 0.5);
}

// Neither the shipped instruments nor the user's others are in the way of a mistake in one.
TEST_F(OwnInstruments, OfWhichOneIsWrongAreListedAsBrokenAndTheOthersGoOn) {
  answer({{"copy", "velodyne-vlp-16"}, {"as", "mine"}});
  answer({{"copy", "trimble-x7"}, {"as", "other"}});
  auto text = contentOf(own() / "mine.json");
  text.replace(text.find("\"heads\""), 7, "\"hands\"");
  std::ofstream(own() / "mine.json") << text;
  std::ofstream(own() / "cut.json") << "{ \"id\": \"cut\", ";
  fs::create_directory(own() / "folder.json");

  EXPECT_EQ(instrumentById("leica-rtc360")->id, "leica-rtc360");
  EXPECT_EQ(instrumentById("other")->id, "other");
  EXPECT_EQ(knownInstruments()->size(), 28U);
  const auto wrong = instrumentById("mine");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().source, "mine.json /moving/heads");
  EXPECT_THAT(wrong.error().message, HasSubstr(own().string()));
  EXPECT_THAT(wrong.error().message, HasSubstr("correct the file"));
  EXPECT_EQ(refused({{"copy", "mine"}, {"as", "third"}}).source, "mine.json /moving/heads");
  EXPECT_THAT(refused({{"copy", "leica-rtc360"}, {"as", "cut"}}).message, HasSubstr("already used by"));

  const auto listed = answer(nlohmann::json::object());
  EXPECT_EQ(listed["instruments"].size(), 28U);
  ASSERT_EQ(listed["broken"].size(), 3U);
  EXPECT_EQ(listed["broken"][0]["id"], "cut");
  EXPECT_EQ(listed["broken"][2]["file"], (own() / "mine.json").string());
  EXPECT_EQ(listed["broken"][2]["source"], "mine.json /moving/heads");
  Progress progress;
  const auto outcome = runVerb(*findVerb(verbs(), "instruments"), Document{}, nlohmann::json::object(), progress);
  ASSERT_EQ(outcome->report.issues.size(), 3U);
  EXPECT_EQ(outcome->report.losses(), 0U);
}

TEST_F(OwnInstruments, WithAnIdThatThereIsAreBrokenWithBothFiles) {
  fs::create_directories(own());
  fs::copy_file(shippedInstrumentsFolder() / "trimble-x7.json", own() / "trimble-x7.json");
  EXPECT_EQ(instrumentById("leica-rtc360")->id, "leica-rtc360");
  const auto error = instrumentById("trimble-x7").error();  // whose figures are meant is not for us to say
  EXPECT_EQ(error.source, (own() / "trimble-x7.json").string());
  EXPECT_THAT(error.message, HasSubstr((shippedInstrumentsFolder() / "trimble-x7.json").string()));
}

TEST_F(OwnInstruments, AreNotCopiedOverOthersOrOutOfTheirFolder) {
  EXPECT_EQ(refused({{"copy", "leica-rtc360"}}).kind, ErrorKind::usage);
  EXPECT_EQ(refused({{"copy", "leica-rtc36"}, {"as", "mine"}}).source, "--copy");
  EXPECT_THAT(refused({{"copy", "leica-rtc360"}, {"as", "trimble-x7"}}).message, HasSubstr("trimble-x7.json"));
  for (const char* id : {"../mine", "a/b", "schema", "-x", "Mine", "mine.json", "a b"})
    EXPECT_EQ(refused({{"copy", "leica-rtc360"}, {"as", id}}).source, "--as") << id;
  EXPECT_EQ(refused({{"copy", "leica-rtc360"}, {"as", std::string(65, 'a')}}).source, "--as");
  EXPECT_FALSE(fs::exists(own()));
}

TEST_F(OwnInstruments, AreReadFromAnyFileToo) {
  const auto copied = answer({{"copy", "leica-rtc360"}, {"as", "lab"}});
  const fs::path file = own().parent_path() / "lab.json";
  fs::rename(copied["copied"]["file"].get<std::string>(), file);
  EXPECT_EQ(instrumentNamed(file.string())->id, "lab");
  EXPECT_EQ(instrumentNamed("leica-rtc360")->id, "leica-rtc360");
  EXPECT_EQ(instrumentNamed("lab").error().kind, ErrorKind::usage);
  EXPECT_THAT(instrumentNamed("lab").error().message, HasSubstr("or specify a file"));
  const auto missing = instrumentNamed(own().string() + "/none.json").error();
  EXPECT_EQ(missing.kind, ErrorKind::file_system);
  EXPECT_EQ(missing.source, (own() / "none.json").string());
  EXPECT_THAT(missing.message, HasSubstr("standpoint instruments"));
  auto text = contentOf(file);
  text.replace(text.find("\"range_noise\""), 13, "\"range_nois\"");
  std::ofstream(file) << text;
  const auto wrong = instrumentNamed(file.string()).error();
  EXPECT_EQ(wrong.source, "lab.json /range_noise");
  EXPECT_THAT(wrong.message, HasSubstr(file.string()));
}

TEST_F(OwnInstruments, ThatCannotBeWrittenAreAnError) {
  std::ofstream(own()) << "a file where the folder should be";
  EXPECT_EQ(refused({{"copy", "leica-rtc360"}, {"as", "mine"}}).kind, ErrorKind::file_system);
}

}  // namespace
}  // namespace standpoint
