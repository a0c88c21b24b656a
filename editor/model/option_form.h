// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "editor/model/file_kinds.h"
#include "project/verb.h"

namespace standpoint {

// What a user has filled in for the options of a verb: one field per parameter, generated from the verb's own table.
struct OptionField {
  const Parameter* parameter = nullptr;
  bool given = false;  // an optional one that is not given is not sent
  bool shown = true;   // one that is not keeps what it was filled with
  std::string text;    // text, path, choice; list and pairs: one item per line
  double number = 0;   // number, integer
  bool flag = false;
  std::array<double, 3> triple = {0, 0, 0};
  std::span<const FileKind> kinds = {};  // of a file that is written; none: its ending is not chosen from a list
};

class OptionForm {
 public:
  OptionForm() = default;
  explicit OptionForm(const Verb& verb);  // filled with the defaults

  std::vector<OptionField>& fields() { return fields_; }
  OptionField* find(const char* name);
  // It is shown, and the format of the file that is written has a place for it. What has no place is not sent.
  bool offers(const OptionField& field) const { return field.shown && hasPlace(field); }
  void fill(const nlohmann::json& options);  // sets what it names, leaves the rest
  nlohmann::json options() const;
  // "" when it can be run, else the first thing that is missing or wrong.
  std::string problem() const;

 private:
  bool hasPlace(const OptionField& field) const;

  std::vector<OptionField> fields_;
};

// "max-deviation" → "Max deviation"
std::string readableOption(const char* name);
// What a verb does, as menus and forms call it: "optimize" → "Optimise the model".
std::string verbTitle(const char* verb);
// Its label, else as readableOption() makes it of its name.
std::string optionLabel(const Parameter& parameter);

}  // namespace standpoint
