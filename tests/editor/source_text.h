// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue_file.h"

namespace standpoint {

// What C++ sources say, read as text.

inline std::string allOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Literal {
  std::string text, before;  // `before`: what of its line leads to it
};

// Literals that follow each other are one.
inline std::vector<Literal> literalsIn(const std::string& source) {
  std::vector<Literal> all;
  std::size_t ended = std::string::npos;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source.compare(i, 2, "//") == 0) i = std::min(source.find('\n', i), source.size() - 1);
    if (source[i] == '\'') i += source[i + 1] == '\\' ? 3 : 2;
    if (source[i] != '"') continue;
    std::size_t end = i + 1;
    while (end < source.size() && source[end] != '"') end += source[end] == '\\' ? 2 : 1;
    const auto text = withoutEscapes(source.substr(i + 1, end - i - 1));
    const auto line = source.rfind('\n', i) + 1;
    const bool goes_on = ended != std::string::npos && source.find_first_not_of(" \n", ended) == i;
    if (goes_on)
      all.back().text += text;
    else
      all.push_back({text, source.substr(line, i - line)});
    i = end;
    ended = end + 1;
  }
  return all;
}

// The places outside of literals and brackets where one of the signs stands, up to the bracket that closes around them.
inline std::vector<std::size_t> signsAt(const std::string& code, std::size_t begin, std::string_view signs) {
  std::vector<std::size_t> places;
  std::size_t i = begin;
  for (int depth = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '"')
      for (++i; i < code.size() && code[i] != '"';) i += code[i] == '\\' ? 2 : 1;
    else if (c == '\'')
      i += code[i + 1] == '\\' ? 3 : 2;
    else if (c == '(' || c == '{' || c == '[')
      ++depth;
    else if ((c == ')' || c == '}' || c == ']') && --depth < 0)
      break;
    else if (depth == 0 && signs.find(c) != std::string_view::npos)
      places.push_back(i);
  }
  places.push_back(std::min(i, code.size()));
  return places;
}

inline std::vector<std::string> piecesOf(const std::string& code, const std::vector<std::size_t>& signs) {
  std::vector<std::string> pieces;
  std::size_t begin = 0;
  for (const auto end : signs) pieces.push_back(code.substr(begin, end - begin)), begin = end + 1;
  return pieces;
}

// The arguments of a call that begins at `at`.
inline std::vector<std::string> argumentsAt(const std::string& source, std::size_t at) {
  auto signs = signsAt(source, at, ",");
  const auto all = source.substr(at, signs.back() - at);
  for (auto& sign : signs) sign -= at;
  return piecesOf(all, signs);
}

// The sentences that an argument can become: its literals, where figures and names are places {}. Both of a condition;
// none of what has no literal.
inline std::vector<std::string> sentencesOf(const std::string& argument) {
  static const std::regex spec(R"(\{[^{}]*\})"), doubled(R"(\{\{|\}\})"),
      wrapped(R"re(^\s*std::string\(("(?:[^"\\]|\\.)*")\)\s*$)re");
  const auto literals = literalsIn(argument);
  if (literals.empty()) return {};
  const auto first = argument.find_first_not_of(" \n");
  if (const auto branches = piecesOf(argument, signsAt(argument, 0, "?")); branches.size() > 1) {
    const auto rest = argument.substr(branches[0].size() + 1);
    auto colons = signsAt(rest, 0, ":");
    std::erase_if(colons, [&](std::size_t i) {
      return i < rest.size() && (rest.compare(i, 2, "::") == 0 || (i > 0 && rest[i - 1] == ':'));
    });
    if (colons.size() < 2) return {};
    auto texts = sentencesOf(rest.substr(0, colons[0]));
    for (auto& text : sentencesOf(rest.substr(colons[0] + 1))) texts.push_back(std::move(text));
    return texts;
  }
  if (argument.compare(first, 12, "fmt::format(") == 0) return {std::regex_replace(literals[0].text, spec, "{}")};
  std::string text;
  for (const auto& piece : piecesOf(argument, signsAt(argument, 0, "+"))) {
    const auto bare = std::regex_replace(piece, wrapped, "$1");
    const auto begin = bare.find_first_not_of(" \n");
    const bool says = begin != std::string::npos && bare[begin] == '"';
    text += says ? literalsIn(bare)[0].text : "{}";
  }
  return {text};
}

// "file.cpp:12: " before what is found at `at`.
inline std::string placeIn(const std::filesystem::path& file, const std::string& source, std::size_t at) {
  const auto line = 1 + std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return file.filename().string() + ":" + std::to_string(line) + ": ";
}

}  // namespace standpoint
