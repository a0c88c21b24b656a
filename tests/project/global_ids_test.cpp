// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "project/model/import_verb.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;

std::filesystem::path walls(const TemporaryFolder& folder, const std::string& name,
                            const std::vector<std::string>& global_ids) {
  std::string text = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n";
  for (std::size_t i = 0; i < global_ids.size(); ++i)
    text += "#" + std::to_string(i + 1) + "=IFCWALL('" + global_ids[i] + "',$,'" + name + "',$,$,$,$,$,$);\n";
  std::ofstream(folder.path() / name) << text << "ENDSEC;\nEND-ISO-10303-21;\n";
  return folder.path() / name;
}

std::vector<std::string> warnings(const Report& report) {
  std::vector<std::string> found;
  for (const Issue& i : report.issues)
    if (i.severity == Severity::warning && i.message.find("has the GlobalId") != std::string::npos)
      found.push_back(i.source + ": " + i.message);
  return found;
}

TEST(GlobalIds, TwoProductsWithOneAreAWarningThatNamesBoth) {
  const TemporaryFolder folder;
  Progress progress;
  const auto one = importModels({}, {walls(folder, "a.ifc", {"x", "y", "x", "", ""})}, {}, "", progress);
  ASSERT_TRUE(one) << describe(one.error());
  const auto told = warnings(one->report);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("#3: IfcWall 'a.ifc' has the GlobalId x of IfcWall 'a.ifc' (#1)"));
  EXPECT_EQ(one->report.losses(), 0U);
}

TEST(GlobalIds, TwoFilesThatShareOneAreAWarningWhetherReadAtOnceOrAdded) {
  const TemporaryFolder folder;
  Progress progress;
  const auto a = walls(folder, "a.ifc", {"x", "y"}), b = walls(folder, "b.ifc", {"y", "z", "z"});
  const auto both = importModels({}, {a, b}, {}, "", progress);
  ASSERT_TRUE(both) << describe(both.error());
  EXPECT_EQ(warnings(both->report).size(), 2U);
  const auto first = importModels({}, {a}, {}, "", progress);
  const auto added = addImported(first->document, *importModels({}, {b}, {}, "", progress), progress);
  ASSERT_TRUE(added) << describe(added.error());
  EXPECT_EQ(warnings(added->report).size(), 2U);
  EXPECT_EQ(warnings(*added->document.import_report).size(), 2U);
}

}  // namespace
}  // namespace standpoint
