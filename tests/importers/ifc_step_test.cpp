// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <zlib.h>

#include "importers/ifc/model/step_file.h"
#include "tests/importers/ifc_fixture.h"

namespace standpoint::ifc {
namespace {

StepFile parsed(const std::string& data, Report& report) {
  auto file = StepFile::parse(
      "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n",
      "test.ifc", report);
  EXPECT_TRUE(file.has_value()) << describe(file.error());
  return file ? std::move(*file) : StepFile();
}

TEST(StepFile, ReadsArgumentsOfEveryKind) {
  Report report;
  const StepFile file = parsed("#7=IFCTHING(-1.5E2,'a',.T.,#9,(1,2,3),$,*,IFCLENGTHMEASURE(2.5),42);\n", report);
  const Entity e = file.entity(7);
  EXPECT_EQ(e.typeName(), "IFCTHING");
  EXPECT_EQ(e[0].number(), -150);
  EXPECT_EQ(e[1].text(), "a");
  EXPECT_TRUE(e[2].isTrue());
  EXPECT_EQ(e[3].reference(), 9U);
  EXPECT_FALSE(e.ref(3));  // the file has no #9
  EXPECT_EQ(e[4].size(), 3U);
  EXPECT_FALSE(e[5].present());
  EXPECT_FALSE(e[6].present());
  EXPECT_EQ(e[7].number(), 2.5);
  EXPECT_EQ(e[7].typeName(), "IFCLENGTHMEASURE");
  EXPECT_EQ(e[8].integer(), 42);
  EXPECT_FALSE(e[9].present());
  EXPECT_TRUE(report.issues.empty());
}

TEST(StepFile, ReadsLinesEndedByCarriageReturnsCommentsAndBrokenRecords) {
  Report report;
  const StepFile file = parsed("#1=IFCA\r(1,/* a ) ; comment */\r2);#2=IFCB('x;y)''z',3);\r", report);
  EXPECT_EQ(file.entity(1)[1].integer(), 2);
  EXPECT_EQ(file.entity(2)[0].text(), "x;y)'z");
  EXPECT_EQ(file.entity(2)[1].integer(), 3);
}

TEST(StepFile, KeepsTheFirstOfTwoRecordsOfOneNumberAndSaysSo) {
  Report report;
  const StepFile file = parsed("#2=IFCB(1);\n#1=IFCA(1);\n#2=IFCB(2);\n", report);
  EXPECT_EQ(file.records().size(), 2U);
  EXPECT_EQ(file.entity(2)[0].integer(), 1);
  ASSERT_EQ(report.issues.size(), 1U);
  EXPECT_EQ(report.issues[0].source, "#2");
}

TEST(StepFile, DecodesEscapesToUtf8) {
  EXPECT_EQ(decodeText("W\\X\\E4nde"), "W\xC3\xA4nde");
  EXPECT_EQ(decodeText("\\X2\\03B103B2\\X0\\!"), "\xCE\xB1\xCE\xB2!");
  EXPECT_EQ(decodeText("\\X2\\D83DDE00\\X0\\"), "\xF0\x9F\x98\x80");
  EXPECT_EQ(decodeText("\\X4\\0001F600\\X0\\"), "\xF0\x9F\x98\x80");
  EXPECT_EQ(decodeText("\\S\\d"), "\xC3\xA4");
  EXPECT_EQ(decodeText("a\\\\b''c"), "a\\b'c");
  EXPECT_EQ(decodeText("\xE4"), "\xC3\xA4");      // Latin-1
  EXPECT_EQ(decodeText("\xC3\xA4"), "\xC3\xA4");  // UTF-8 already
  EXPECT_EQ(decodeText("\\X2\\00"), "00");        // broken escapes do not swallow the text
}

TEST(StepFile, SaysWhereACutFileEnds) {
  Report report;
  const auto file = StepFile::parse("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=IFCA('abc", "cut.ifc", report);
  ASSERT_FALSE(file.has_value());
  EXPECT_EQ(file.error().kind, ErrorKind::unusable);
  EXPECT_EQ(file.error().source, "cut.ifc line 5");
}

TEST(StepFile, KeepsWhatWasCompleteBeforeTheCut) {
  Report report;
  const auto file = StepFile::parse("ISO-10303-21;\nDATA;\n#1=IFCA(1);\n#2=IFCA('abc", "cut.ifc", report);
  ASSERT_TRUE(file.has_value());
  EXPECT_EQ(file->records().size(), 1U);
  ASSERT_EQ(report.losses(), 1U);
  EXPECT_EQ(report.issues.front().source, "line 4");
}

TEST(StepFile, ReportsALossWhereTheDataSectionIsNotEnded) {
  Report report;
  const auto file = StepFile::parse("ISO-10303-21;\nDATA;\n#1=IFCA(1);\n", "cut.ifc", report);
  ASSERT_TRUE(file.has_value());
  EXPECT_EQ(report.losses(), 1U);
}

TEST(StepFile, RefusesWhatIsNoStepFile) {
  for (const std::string text : {"", "hello", "glTF....", "\xFF\xFE\x00\x01", ";;;;", "#", "#1", "#1=", "'"}) {
    Report report;
    const auto file = StepFile::parse(text, "x", report);
    EXPECT_FALSE(file.has_value() && !file->records().empty()) << text;
  }
}

TEST(StepFile, NestedListsOfAnyDepthAreWalkedWithoutRecursion) {
  Report report;
  const StepFile file = parsed("#1=IFCA(" + std::string(200000, '(') + std::string(200000, ')') + ",7);\n", report);
  EXPECT_EQ(file.entity(1)[1].integer(), 7);
}

TEST(StepFile, UnpacksGzip) {
  const std::string text = test::ifcText("");
  std::string packed(text.size() + 1000, '\0');
  z_stream stream{};
  ASSERT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  ASSERT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  const auto model = test::tryImport(packed);
  ASSERT_TRUE(model.has_value()) << describe(model.error());
  EXPECT_EQ(model->environment.spatial.size(), 3U);
  EXPECT_FALSE(test::tryImport(packed.substr(0, packed.size() / 2)).has_value());
}

}  // namespace
}  // namespace standpoint::ifc
