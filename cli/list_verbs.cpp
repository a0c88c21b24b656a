// SPDX-License-Identifier: GPL-3.0-or-later
// Writes what is generated from the table of verbs:
//   list-verbs docs/reference/verbs.md        the page's generated part anew
//   list-verbs --man PAGE FOLDER              standpoint(1) from PAGE, and a page for each verb
//   list-verbs --bash-completion FILE
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "cli/completion.h"
#include "cli/man_pages.h"
#include "cli/verb_list.h"
#include "core/part_file.h"
#include "emulated-ui/verbs/rehearse_verb.h"

namespace {

namespace fs = std::filesystem;
using namespace standpoint;

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

int write(const fs::path& file, const std::string& text) {
  const auto written = writeWholeText(file, text);
  if (!written) std::cerr << describe(written.error()) << '\n';
  return written ? 0 : 4;
}

int lacks(const fs::path& page, const std::string& mark) {
  std::cerr << page.string() << ": the line '" << mark << "' is not in it\n";
  return 3;
}

int writePage(const fs::path& file) {
  const auto page = textOf(file);
  const auto mark = page.find(kVerbListMark);
  return mark == std::string::npos ? lacks(file, kVerbListMark)
                                   : write(file, verbList(allVerbs(), page.substr(0, mark)));
}

int writeManPages(const fs::path& file, const fs::path& folder) {
  const auto page = textOf(file);
  if (page.find(kManVerbsMark) == std::string::npos) return lacks(file, kManVerbsMark);
  for (const auto& verb : allVerbs())
    if (const int code = write(folder / (std::string("standpoint-") + verb.name + ".1"), manPage(verb)); code != 0)
      return code;
  return write(folder / "standpoint.1", manPageWithVerbs(allVerbs(), page));
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.size() == 3 && words[0] == "--man") return writeManPages(words[1], words[2]);
  if (words.size() == 2 && words[0] == "--bash-completion") return write(words[1], bashCompletion(allVerbs()));
  if (words.size() == 1 && words[0].front() != '-') return writePage(words[0]);
  std::cerr << "usage: list-verbs docs/reference/verbs.md | --man PAGE FOLDER | --bash-completion FILE\n";
  return 2;
}
