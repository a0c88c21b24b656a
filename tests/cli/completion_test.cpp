// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/completion.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "emulated-ui/verbs/rehearse_verb.h"

namespace standpoint {
namespace {

// What bash would offer for these words, of which the last is being typed.
std::vector<std::string> offered(const std::string& words, const std::string& more = {}) {
  const auto file =
      std::filesystem::path(BINARY_DIR) / "scratch" / ("standpoint-" + std::to_string(getpid()) + ".bash");
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << bashCompletion(allVerbs());
  const auto command = "bash -c '" + more + " source \"" + file.string() + "\"; COMP_WORDS=(" + words +
                       "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _standpoint; printf \"%s\\n\" \"${COMPREPLY[@]}\"'";
  std::unique_ptr<FILE, int (*)(FILE*)> out(popen(command.c_str(), "r"), pclose);
  std::string text;
  for (int c = 0; (c = std::fgetc(out.get())) != EOF;) text += static_cast<char>(c);
  std::istringstream lines(text);
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) found.push_back(line);
  std::filesystem::remove(file);
  return found;
}

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(Completion, OffersEachVerb) {
  const auto verbs = offered("standpoint \"\"");
  for (const auto& verb : allVerbs()) EXPECT_TRUE(has(verbs, verb.name)) << verb.name;
  EXPECT_EQ(offered("standpoint opt"), std::vector<std::string>{"optimize"});
  EXPECT_TRUE(has(offered("standpoint help sc"), "scan"));
}

TEST(Completion, OffersEachOptionOfEachVerb) {
  for (const auto& verb : allVerbs()) {
    const auto options = offered(std::string("standpoint ") + verb.name + " -");
    for (const auto& p : verb.parameters)
      EXPECT_TRUE(p.positional || has(options, std::string("--") + p.name)) << verb.name << " " << p.name;
    EXPECT_TRUE(has(options, "--json")) << verb.name;
  }
}

TEST(Completion, OffersTheWordsOfAChoiceAndTheInstruments) {
  EXPECT_EQ(offered("standpoint scan house --compensator \"\""), (std::vector<std::string>{"on", "off"}));
  const auto ids = offered("standpoint scan house --instrument leica-r",
                           "standpoint() { echo \"2 instruments: faro-focus, leica-rtc360\"; };");
  EXPECT_EQ(ids, std::vector<std::string>{"leica-rtc360"});
  EXPECT_TRUE(offered("standpoint scan house -o \"\"").empty());  // a path: bash's own
}

}  // namespace
}  // namespace standpoint
