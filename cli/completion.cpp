// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/completion.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cli/option_words.h"

namespace standpoint {

namespace {

constexpr const char* kHead =
    R"(# bash completion for standpoint, generated from the table of verbs (cli/completion.cpp).
_standpoint() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local verbs="@VERBS@" options="" values="" paths=1
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    values="$verbs --help --version"
  else
    case ${COMP_WORDS[1]} in
      help) values=$verbs ;;
)";

// A value is one of `values`, or a path, or nothing is known of it; else an option is offered where one begins.
constexpr const char* kTail = R"(    esac
  fi
  if [[ -n $values ]]; then
    COMPREPLY=($(compgen -W "$values" -- "$word"))
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  fi
  [[ -z $values && -n $paths ]] || compopt +o default 2>/dev/null
}
complete -o default -F _standpoint standpoint
)";

std::string spelledAsPattern(const Parameter& p) {
  return (std::string_view(p.name) == "output" ? "-o | --" : "--") + std::string(p.name);
}

// What follows an option: a line of the inner case, empty where bash completes a path.
std::string valueCase(const Parameter& p) {
  const auto pattern = spelledAsPattern(p);
  if (p.kind == ParameterKind::choice)
    return fmt::format("          {}) values=\"{}\" ;;\n", pattern, fmt::join(p.choices, " "));
  if (std::string_view(p.name) == "instrument")
    return fmt::format(
        "          {}) values=$(\"${{COMP_WORDS[0]}}\" instruments 2>/dev/null |"
        " sed -n '1s/.*: //; 1s/,//gp') ;;\n",
        pattern);
  if (p.kind == ParameterKind::path || p.kind == ParameterKind::list) return {};
  return fmt::format("          {}) paths=\"\" ;;\n", pattern);
}

}  // namespace

std::string bashCompletion(std::span<const Verb> verbs) {
  std::vector<std::string> names;
  for (const auto& verb : verbs) names.emplace_back(verb.name);
  names.insert(names.end(), {"edit", "help"});
  std::string script = kHead;
  const std::string_view mark = "@VERBS@";
  script.replace(script.find(mark), mark.size(), fmt::format("{}", fmt::join(names, " ")));
  for (const auto& verb : verbs) {
    std::string options, cases;
    for (const auto& p : verb.parameters) {
      if (p.positional) continue;
      options += (std::string_view(p.name) == "output" ? "-o --" : "--") + std::string(p.name) + " ";
      if (p.kind != ParameterKind::flag) cases += valueCase(p);
    }
    script +=
        fmt::format("      {})\n        options=\"{}--json --allow-loss --all-issues --help\"\n", verb.name, options);
    if (!cases.empty()) script += fmt::format("        case $before in\n{}        esac\n", cases);
    script += "        ;;\n";
  }
  return script + kTail;
}

}  // namespace standpoint
