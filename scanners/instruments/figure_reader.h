// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/json_fields.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

constexpr std::uintmax_t kLargestFile = 1U << 20U;  // bytes; no file of figures is larger

// Figures with their sources, on top of the look-ups of JsonFields.
class FigureReader {
 public:
  using Json = nlohmann::json;

  struct Group {
    JsonFields fields;
    std::string source{};  // of its figures that state none themselves
    std::string note{};
  };

  struct Domain {
    double low, high;
    double scale = 1;  // from the file's unit to ours
  };

  explicit FigureReader(std::string file) : fault_(std::move(file)) {}

  const std::optional<Error>& error() const { return fault_.error(); }
  const std::map<std::string, Evidence>& evidence() const { return evidence_; }
  void fail(const std::string& pointer, const std::string& message) { fault_.say(pointer, message); }

  Group open(const Json& value, std::string pointer);
  Group child(Group& parent, const std::string& key);
  // The list at `key`; empty after an error.
  const Json& list(JsonFields& fields, const std::string& key, std::size_t most);
  // A word with its source: {value, source, note}; one of `words`.
  std::string word(Group& parent, const std::string& key, const std::vector<std::string>& words);

  // A figure: a number with its group's source, or {value, source, note} with its own.
  double figure(Group& group, const std::string& key, const Domain& domain);
  int count(Group& group, const std::string& key, const Domain& domain);
  // Several in one: {value: [...], source, note}.
  std::vector<double> figures(Group& group, const std::string& key, const Domain& domain, std::size_t most);
  double checked(const std::string& pointer, const Json& value, const Domain& domain);

  void readSources(Group& root);
  // Every key must be in the file's table of sources; "derived" and "unsourced" stand for themselves.
  void cite(const std::string& pointer, const std::string& mark, const std::string& note);

 private:
  JsonFault fault_;
  std::map<std::string, std::string> sources_;
  std::map<std::string, Evidence> evidence_;
};

}  // namespace standpoint
