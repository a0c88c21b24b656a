// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/class_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/classroom/dates.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;

Result<ClassList> listOf(const std::string& text, Report* report = nullptr) {
  const TemporaryFolder folder;
  Report said;
  auto list = readClassList(folder.write("geo-2026.csv", text), said);
  if (report != nullptr) *report = said;
  return list;
}
std::string refusal(const std::string& text) {
  const auto list = listOf(text);
  return list ? "read" : describe(list.error());
}

TEST(ClassList, IsReadAsSpreadsheetsWriteIt) {
  Report report;
  const auto list = listOf(
      "\xEF\xBB\xBFName;ID;Username;Group\r\n\"Шевченко; О. \"\"Оля\"\"\";s-1;olya;A\r\n;;;\r\nB;s-2;;B", &report);
  ASSERT_TRUE(list) << describe(list.error());
  EXPECT_EQ(list->name, "geo-2026");
  ASSERT_EQ(list->students.size(), 2U);
  EXPECT_EQ(list->students[0].name, "Шевченко; О. \"Оля\"");
  EXPECT_EQ(list->students[0].username, "olya");
  EXPECT_EQ(list->students[1].username, "s-2") << "the id where there is no user name";
  ASSERT_EQ(report.issues.size(), 1U);
  EXPECT_EQ(report.issues[0].message, "column 'Group' is not used");
}

TEST(ClassList, ThatIsWrongIsRefusedWithItsLine) {
  EXPECT_THAT(refusal("id,name\ns-1,M\xFCller\n"), HasSubstr("geo-2026.csv line 2: is not UTF-8"));
  EXPECT_THAT(refusal(std::string("i\0d\0", 4)), HasSubstr("line 1: is not UTF-8"));
  EXPECT_THAT(refusal("name,mail\nA,b\n"), HasSubstr("line 1: there is no column 'id'; the columns are name, mail"));
  EXPECT_THAT(refusal("id,id\na,b\n"), HasSubstr("column 'id' is there twice"));
  EXPECT_THAT(refusal("id\na\nb\na\n"), HasSubstr("line 4: id 'a' is also in line 2"));
  EXPECT_THAT(refusal("id,username\na,x\nb,x\n"), HasSubstr("line 3: username 'x' is also in line 2"));
  EXPECT_THAT(refusal("id,name\na,b,c\n"), HasSubstr("line 2: 3 cells, but 2 columns"));
  EXPECT_THAT(refusal("id,name\n,Nobody\n"), HasSubstr("line 2: 'id' is empty"));
  EXPECT_THAT(refusal("id\n../../etc\n"), HasSubstr("can contain only"));
  EXPECT_THAT(refusal("id\n=1+1\n"), HasSubstr("can contain only"));
  EXPECT_THAT(refusal("id,name\na,\"open\nb,c\n"), HasSubstr("line 2: the quotation mark has no end"));
  EXPECT_THAT(refusal("id\n"), HasSubstr("has no student"));
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
}

TEST(Deadline, IsReadInItsForms) {
  setenv("TZ", "Europe/Berlin", 1);
  tzset();
  EXPECT_EQ(*utcFrom("2026-12-01T18:00", "d"), "2026-12-01T17:00:00Z");
  EXPECT_EQ(*utcFrom("2026-07-01", "d"), "2026-07-01T21:59:59Z");
  EXPECT_EQ(*utcFrom("2026-12-01T18:00Z", "d"), "2026-12-01T18:00:00Z");
  EXPECT_EQ(localText("2026-12-01T17:00:00Z"), "2026-12-01 18:00");
  for (const char* wrong :
       {"", "tomorrow", "2026-13-01", "2026-02-30", "01.12.2026", "2026-12-01T25:00", "2026-12-01 18:00"})
    EXPECT_FALSE(utcFrom(wrong, "d")) << wrong;
  unsetenv("TZ");
  tzset();
}

}  // namespace
}  // namespace standpoint
