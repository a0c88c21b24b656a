// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/figure_reader.h"

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

namespace standpoint {

FigureReader::Group FigureReader::open(const Json& value, std::string pointer) {
  Group group{JsonFields(fault_, value, std::move(pointer))};
  group.source = group.fields.textOr("source", "");
  group.note = group.fields.textOr("note", "");
  return group;
}

FigureReader::Group FigureReader::child(Group& parent, const std::string& key) {
  static const Json kEmpty = Json::object();
  const Json* value = parent.fields.required(key);
  return open(value == nullptr ? kEmpty : *value, parent.fields.pointer(key));
}

void FigureReader::cite(const std::string& pointer, const std::string& mark, const std::string& note) {
  if (mark.empty()) return fail(pointer, "has no source");
  std::istringstream keys(mark);
  std::string key, cited;
  while (keys >> key) {
    const auto found = sources_.find(key);
    if (found == sources_.end() && key != "derived" && key != "unsourced")
      return fail(pointer, "source \"" + key + "\" is not in /sources");
    if (!cited.empty()) cited += "; ";
    cited += found == sources_.end() ? key : found->second;
  }
  evidence_[pointer] = {mark, note.empty() ? cited : cited + " (" + note + ")"};
}

double FigureReader::checked(const std::string& pointer, const Json& value, const Domain& domain) {
  return numberAt(fault_, value, pointer, domain.low, domain.high) * domain.scale;
}

double FigureReader::figure(Group& group, const std::string& key, const Domain& domain) {
  const Json* value = group.fields.required(key);
  const std::string pointer = group.fields.pointer(key);
  if (error()) return domain.low * domain.scale;
  if (!value->is_object()) {
    cite(pointer, group.source, group.note);
    return checked(pointer, *value, domain);
  }
  Group own = open(*value, pointer);
  cite(pointer, own.source, own.note);
  const double number = own.fields.number("value", domain.low, domain.high);
  own.fields.close();
  return number * domain.scale;
}

int FigureReader::count(Group& group, const std::string& key, const Domain& domain) {
  const double number = figure(group, key, domain);
  if (number != std::floor(number)) group.fields.wrong(key, "must be a whole number");
  return static_cast<int>(number);
}

const FigureReader::Json& FigureReader::list(JsonFields& fields, const std::string& key, std::size_t most) {
  static const Json kEmpty = Json::array();
  const Json* found = fields.required(key);
  if (found != nullptr && found->is_array() && !found->empty() && found->size() <= most) return *found;
  fields.wrong(key, "must be a list of 1 to " + std::to_string(most) + " entries");
  return kEmpty;
}

std::string FigureReader::word(Group& parent, const std::string& key, const std::vector<std::string>& words) {
  Group group = child(parent, key);
  cite(group.fields.pointer(), group.source, group.note);
  std::string value = group.fields.wordOf("value", words);
  group.fields.close();
  return value;
}

std::vector<double> FigureReader::figures(Group& group, const std::string& key, const Domain& domain,
                                          std::size_t most) {
  Group own = child(group, key);
  cite(own.fields.pointer(), own.source, own.note);
  std::vector<double> numbers;
  const Json& values = list(own.fields, "value", most);
  for (std::size_t i = 0; i < values.size(); ++i)
    numbers.push_back(checked(own.fields.pointer("value") + "/" + std::to_string(i), values[i], domain));
  own.fields.close();
  return numbers;
}

void FigureReader::readSources(Group& root) {
  JsonFields table = child(root, "sources").fields;
  table.everyText([&](const std::string& key, const std::string& text) { sources_[key] = text; });
}

}  // namespace standpoint
