// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/man_pages.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "cli/option_words.h"
#include "emulated-ui/verbs/rehearse_verb.h"

namespace standpoint {
namespace {

// As a reader sees it: without changes of font, hyphens plain.
std::string shown(std::string page) {
  for (const char* font : {"\\fB", "\\fI", "\\fR"})
    for (std::size_t i = 0; (i = page.find(font, i)) != std::string::npos;) page.erase(i, 3);
  for (std::size_t i = 0; (i = page.find("\\-", i)) != std::string::npos;) page.erase(i, 1);
  return page;
}

TEST(ManPages, OfAVerbHasItsSummaryAndEachOfItsOptions) {
  for (const auto& verb : allVerbs()) {
    const auto page = shown(manPage(verb));
    EXPECT_NE(page.find(std::string("standpoint ") + call(verb)), std::string::npos) << verb.name;
    EXPECT_NE(page.find(verb.summary), std::string::npos) << verb.name;
    for (const auto& p : verb.parameters) {
      EXPECT_NE(page.find("\n.TP\n" + spelling(p)), std::string::npos) << verb.name << " " << p.name;
      EXPECT_NE(page.find(p.help), std::string::npos) << verb.name << " " << p.name;
    }
  }
}

TEST(ManPages, OfTheProgramNamesEachVerb) {
  std::ifstream in(SOURCE_DIR "/packaging/man/standpoint.1");
  const auto page = shown(manPageWithVerbs(allVerbs(), {std::istreambuf_iterator<char>(in), {}}));
  EXPECT_EQ(page.find(kManVerbsMark), std::string::npos);
  for (const auto& verb : allVerbs())
    EXPECT_NE(page.find(std::string("\nstandpoint-") + verb.name + "(1)\n" + verb.summary), std::string::npos)
        << verb.name;
}

TEST(ManPages, OfTheEditorNamesEachOfItsOptions) {
  std::ifstream in(SOURCE_DIR "/packaging/man/standpoint-editor.1");
  const auto page = shown({std::istreambuf_iterator<char>(in), {}});
  std::ifstream code(SOURCE_DIR "/editor/main.cpp");
  const std::string source{std::istreambuf_iterator<char>(code), {}};
  int options = 0;
  for (std::size_t i = 0; (i = source.find("word == \"--", i)) != std::string::npos; ++i) {
    const auto first = source.find('"', i) + 1;
    const auto option = source.substr(first, source.find('"', first) - first);
    EXPECT_NE(page.find(option), std::string::npos) << option;
    ++options;
  }
  EXPECT_GT(options, 5);
}

TEST(ManPages, TakeNoTextForARequest) {
  const Verb verb{"cut", "Cut", VerbScope::files, {{"at", ParameterKind::path, ".ifc or \\ or 'x'"}}, {}};
  const auto page = manPage(verb);
  EXPECT_NE(page.find("\n\\&.ifc or \\e or 'x'"), std::string::npos) << page;
}

}  // namespace
}  // namespace standpoint
