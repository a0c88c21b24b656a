// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/option_words.h"

#include <string_view>

#include <fmt/format.h>

namespace standpoint {

std::string placeholder(const Parameter& p) {
  switch (p.kind) {
    case ParameterKind::number:
    case ParameterKind::integer: return *p.unit != 0 ? p.unit : "N";
    case ParameterKind::choice: return fmt::format("{}", fmt::join(p.choices, "|"));
    case ParameterKind::triple: return "X,Y,Z";
    case ParameterKind::pairs: return "KEY=VALUE ...";
    case ParameterKind::path: return "PATH";
    default: return "TEXT";
  }
}

std::string spelling(const Parameter& p) {
  if (p.positional) return p.kind == ParameterKind::list ? fmt::format("{}...", p.name) : p.name;
  return (std::string_view(p.name) == "output" ? "-o, --" : "--") + std::string(p.name);
}

std::string defaultOf(const Parameter& p) {
  const auto& value = p.default_value;
  if (p.required) return "required";
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

std::string call(const Verb& verb) {
  std::string line = verb.name;
  if (takesProject(verb)) line += " PROJECT";
  for (const auto& p : verb.parameters) {
    if (p.positional) line += p.required ? " " + spelling(p) : " [" + spelling(p) + "]";
    if (!p.positional && p.required)
      line += std::string_view(p.name) == "output" ? " -o OUT" : " " + spelling(p) + " …";
  }
  return verb.scope == VerbScope::creates ? line + " -o PROJECT" : line;
}

bool takesProject(const Verb& verb) { return verb.scope == VerbScope::changes || verb.scope == VerbScope::reads; }

}  // namespace standpoint
