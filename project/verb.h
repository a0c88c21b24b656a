// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <any>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "project/document.h"

namespace standpoint {

enum class ParameterKind {
  text,     // string
  number,   // double, in Parameter::unit, within [minimum, maximum]
  integer,  // whole number, within [minimum, maximum]
  flag,     // true when given
  choice,   // one of Parameter::choices
  path,     // file or folder
  triple,   // "E,N,H" or "X,Y,Z": array of Parameter::min_numbers to three numbers
  pairs,    // "key=value ...": array of strings
  list,     // array of strings
};

// One option of a verb: the one truth for command line, help, job files, and the editor's widgets.
struct Parameter {
  const char* name;  // "max-deviation"; on the command line --max-deviation, in a job "max-deviation"
  ParameterKind kind;
  const char* help;
  const char* unit = "";              // "m", "deg"
  nlohmann::json default_value = {};  // default; null = none
  double minimum = -1e300, maximum = 1e300;
  std::vector<const char*> choices = {};
  bool positional = false;
  bool required = false;
  std::size_t min_numbers = 3;  // of a triple; 2 where the height may be left out
  const char* label = "";       // what the editor's forms call it; empty: as its name does
  const char* term = "";        // the technical term for it, where the label is a plain one: "MSFT_lod"
  // Of a value that fits the kind: an error where its text says nothing that the verb can use. Empty: all that fits.
  std::function<Result<void>(const nlohmann::json&)> check = {};
};

enum class VerbScope {
  creates,  // makes a document (import): `project` is written
  changes,  // document → document: the project is read, changed and written
  reads,    // document → answer: the project is read
  files,    // no document at all
};

// What a door gets of a verb. `answer` is what --json prints, `typed` the struct that it was written from (see
// project/answer_fields.h); `description` is the undo list's line ("Moved station S2 by
// 0.35 m"); `text` is what people read below it on the command line, where the plain figures of `answer` do not say
// enough.
struct Outcome {
  Document document;
  nlohmann::json answer = nlohmann::json::object();
  Report report;
  std::string description;
  std::string text = {};
  std::any typed = {};
};

// An action as the doors see it: `run` takes options that checkOptions has passed. A verb's own function is typed;
// verbOf() of project/fields.h makes the entry. A verb never changes its argument: undo is the previous value.
struct Verb {
  const char* name;  // "optimize"
  const char* summary;
  VerbScope scope;
  std::vector<Parameter> parameters;  // without the project itself
  std::function<Result<Outcome>(const Document&, const nlohmann::json& options, Progress&)> run;
  std::vector<std::string> answer_names = {};  // keys of its answer; with '/' those of the rows below a key
  bool without_model = false;                  // of those that take a document: one of point clouds alone will do
  // The struct of its options, and what a job file would say for one; of a verb that is typed.
  std::type_index options_type = typeid(void);
  std::function<nlohmann::json(const std::any& options)> job_options = {};
  // Of a verb that is too long to be run again: its change from `base` to `result`, made to the project as others have
  // written it meanwhile.
  std::function<Document(const Document& base, const Document& result, const Document& newest)> carry_over = {};
};

// The options of a verb as code gives them; their type says which verb is meant: start(StationOptions{.add = "S1"}).
class VerbOptions {
 public:
  template <class O>
  requires(std::is_class_v<O>&& std::is_aggregate_v<O>) VerbOptions(O options) : options_(std::move(options)) {}

  std::type_index type() const { return options_.type(); }
  const std::any& held() const { return options_; }

 private:
  std::any options_;
};

// The tables of verbs: this one and emulated-ui's; the doors join them.
std::span<const Verb> verbs();
const Verb* findVerb(std::span<const Verb> table, std::string_view name);
const Verb* findVerb(std::span<const Verb> table, std::type_index options_type);

// Its help, with the technical term where it has one.
std::string fullHelp(const Parameter& parameter);
// What an option may be, in words: "a number in m, at least 0", "one of open, closed".
std::string domainOf(const Parameter& parameter);

// Fills in defaults and checks kinds, domains, unknown and missing options; errors name the option and what it may be.
Result<nlohmann::json> checkOptions(const Verb& verb, const nlohmann::json& options);

// checkOptions, then run; `changes` and `reads` need what import makes, and a model in it unless `without_model`. Every
// door goes here, so what import makes is not null.
Result<Outcome> runVerb(const Verb& verb, const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
