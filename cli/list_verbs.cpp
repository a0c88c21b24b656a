// SPDX-License-Identifier: GPL-3.0-or-later
// Rewrites the generated part of docs/reference/verbs.md: list-verbs docs/reference/verbs.md
#include <fstream>
#include <iostream>
#include <iterator>

#include "cli/verb_list.h"
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
  std::ofstream out(arguments[1]);
  out << standpoint::verbList(standpoint::allVerbs(), page.substr(0, mark));
  return out.flush() ? 0 : 4;
}
