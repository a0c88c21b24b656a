// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <filesystem>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

#include "cli/command_line.h"
#include "emulated-ui/verbs/rehearse_verb.h"

namespace {

standpoint::Progress progress;

extern "C" void cancelOnSignal(int) { progress.cancel(); }

// The editor is a program of its own, the only one that links GL; it lies beside this one.
int openEditor(char** arguments) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto editor = (self.parent_path() / "standpoint-editor").string();
  arguments[0] = const_cast<char*>(editor.c_str());
  execv(editor.c_str(), arguments);
  std::cerr << "standpoint: cannot start " << editor << "; check that it is installed\n";
  return standpoint::kFileSystem;
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1 && std::string(arguments[1]) == "edit") return openEditor(arguments + 1);
  std::signal(SIGINT, cancelOnSignal);
  std::signal(SIGTERM, cancelOnSignal);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on files is a full disk: the writer's error, not the program's end
  const std::vector<std::string> words(arguments + 1, arguments + count);
  return standpoint::runCommandLine(standpoint::allVerbs(), words, {std::cout, std::cerr, isatty(STDERR_FILENO) == 1},
                                    progress);
}
