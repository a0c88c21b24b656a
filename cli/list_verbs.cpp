// SPDX-License-Identifier: GPL-3.0-or-later
// Rewrites the generated part of docs/reference/verbs.md: list-verbs docs/reference/verbs.md
#include <fstream>
#include <iostream>
#include <iterator>

#include "cli/verb_list.h"
#include "core/part_file.h"
#include "emulated-ui/rehearsal/rehearse_verb.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: list-verbs docs/reference/verbs.md\n";
    return 2;
  }
  std::ifstream in(arguments[1]);
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const auto mark = page.find(standpoint::kVerbListMark);
  if (mark == std::string::npos) {
    std::cerr << arguments[1] << ": the line '" << standpoint::kVerbListMark << "' is not in it\n";
    return 3;
  }
  const auto written =
      standpoint::writeWholeText(arguments[1], standpoint::verbList(standpoint::allVerbs(), page.substr(0, mark)));
  if (!written) std::cerr << standpoint::describe(written.error()) << '\n';
  return written ? 0 : 4;
}
