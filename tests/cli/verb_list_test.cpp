// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/verb_list.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "emulated-ui/verbs/rehearse_verb.h"

namespace standpoint {
namespace {

TEST(VerbList, DocsListEveryVerbWithEveryOption) {
  std::ifstream in(SOURCE_DIR "/docs/reference/verbs.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const auto mark = page.find(kVerbListMark);
  ASSERT_NE(mark, std::string::npos) << "docs/reference/verbs.md has lost the line above its generated part";
  EXPECT_TRUE(verbList(allVerbs(), page.substr(0, mark)) == page)
      << "docs/reference/verbs.md is out of date: build/release/bin/list-verbs docs/reference/verbs.md";
}

TEST(VerbList, SaysWhatAnOptionMayBeAndWhatItIsWhereNothingIsSaid) {
  const Verb verb{"cut",
                  "Cut a model",
                  VerbScope::reads,
                  {{"where", ParameterKind::choice, "side to keep", "", "left", -1e300, 1e300, {"left", "right"}},
                   {"height", ParameterKind::number, "above the floor", "m", {}, 0, 3, {}, true, true}},
                  {}};
  const auto page = verbList(std::span(&verb, 1), "Intro\n");
  EXPECT_NE(page.find("`standpoint cut PROJECT height [OPTIONS]`"), std::string::npos) << page;
  EXPECT_NE(page.find("| `--where` | one of left, right | left | side to keep |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `height` | a number in m from 0 to 3 | required | above the floor |"), std::string::npos);
}

TEST(VerbList, MakesTheRowsOfTheTableOfVerbsAnew) {
  const std::vector<Verb> two = {{"make", "Make a model", VerbScope::creates, {}, {}},
                                 {"cut", "Cut a model", VerbScope::changes, {}, {}}};
  const auto page = verbList(two, std::string("Intro\n\n") + kVerbTableHead + "| old | row |\n\nMore\n");
  EXPECT_TRUE(page.starts_with(std::string("Intro\n\n") + kVerbTableHead +
                               "| [`make -o PROJECT`](#make) | Make a model |\n"
                               "| [`cut PROJECT`](#cut) | Cut a model |\n\nMore\n"))
      << page;
}

}  // namespace
}  // namespace standpoint
