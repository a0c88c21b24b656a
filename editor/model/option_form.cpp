// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/option_form.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

using nlohmann::json;

json linesOf(const std::string& text) {
  json lines = json::array();
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    lines.push_back(line.substr(first, line.find_last_not_of(" \t\r") - first + 1));
  }
  return lines;
}

void fillField(OptionField& field, const json& value) {
  if (value.is_string()) field.text = value.get<std::string>();
  if (value.is_number()) field.number = value.get<double>();
  if (value.is_boolean()) field.flag = value.get<bool>();
  if (value.is_array() && field.parameter->kind == ParameterKind::triple)
    for (std::size_t i = 0; i < std::min<std::size_t>(3, value.size()); ++i) field.triple[i] = value[i].get<double>();
  if (value.is_array() && field.parameter->kind != ParameterKind::triple) {
    field.text.clear();
    for (const auto& item : value) field.text += item.get<std::string>() + "\n";
  }
}

json valueOf(const OptionField& field) {
  switch (field.parameter->kind) {
    case ParameterKind::number: return field.number;
    case ParameterKind::integer: return static_cast<std::int64_t>(std::llround(field.number));
    case ParameterKind::flag: return field.flag;
    case ParameterKind::triple: return field.triple;
    case ParameterKind::pairs:
    case ParameterKind::list: return linesOf(field.text);
    case ParameterKind::text:
    case ParameterKind::choice:
    case ParameterKind::path: return field.text;
  }
  return nullptr;
}

bool isText(ParameterKind kind) {
  return kind == ParameterKind::text || kind == ParameterKind::path || kind == ParameterKind::choice ||
         kind == ParameterKind::list || kind == ParameterKind::pairs;
}

std::string problemOf(const OptionField& field) {
  if (!field.kinds.empty() && !field.text.empty() && kindOf(field.kinds, field.text) == nullptr) {
    const auto extension = std::filesystem::path(field.text).extension().string();
    return extension.empty() ? tr("Choose a format") : trf("No format has the ending '{}'", extension);
  }
  const auto& p = *field.parameter;
  const std::string name = tr(optionLabel(p));
  if (p.required && isText(p.kind) && field.text.empty()) return trf("{} is missing", name);
  if (!field.given) return {};
  const bool numeric = p.kind == ParameterKind::number || p.kind == ParameterKind::integer;
  if (numeric && (field.number < p.minimum || field.number > p.maximum))
    return trf("{} must be from {} to {} {}", name, p.minimum, p.maximum, p.unit);
  if (p.kind == ParameterKind::pairs)
    for (const auto& line : linesOf(field.text))
      if (line.get_ref<const std::string&>().find('=') == std::string::npos)
        return trf("{}: '{}' is not in the form key=value", name, line.get<std::string>());
  return {};
}

}  // namespace

std::string readableOption(const char* name) {
  std::string result = name;
  if (result.ends_with("-deg")) result.resize(result.size() - 4);  // the unit stands beside the value
  std::replace(result.begin(), result.end(), '-', ' ');
  if (!result.empty()) result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  return result;
}

std::string verbTitle(const char* verb) {
  static constexpr std::pair<std::string_view, const char*> kTitles[] = {
      {"add", "Add models"},
      {"assess", "Assess scans"},
      {"bookmark", "Bookmarks"},
      {"clean", "Clean points"},
      {"collide", "Make collision shapes"},
      {"compare", "Compare clouds"},
      {"coverage", "Coverage along trajectories"},
      {"dataset", "Make a dataset"},
      {"info", "Contents of a file"},
      {"locate", "Locate files"},
      {"materials", "Assign materials"},
      {"mover", "Movers"},
      {"optimize", "Optimise the model"},
      {"plan", "Plan coverage"},
      {"register", "Register stations"},
      {"run", "Replay a job"},
      {"score", "Score labels"},
      {"station", "Stations"},
      {"target", "Targets"},
      {"trajectory", "Trajectories"},
      {"treat", "Treat single products"},
      {"underlay", "Underlays"},
      {"verify", "Verify materials"},
      {"waveform", "Waveform of a pulse"},
  };
  const auto* const found =
      std::find_if(std::begin(kTitles), std::end(kTitles), [&](const auto& title) { return title.first == verb; });
  return found == std::end(kTitles) ? readableOption(verb) : found->second;
}

std::string optionLabel(const Parameter& parameter) {
  return *parameter.label == 0 ? readableOption(parameter.name) : parameter.label;
}

OptionForm::OptionForm(const Verb& verb) {
  for (const auto& parameter : verb.parameters) {
    OptionField field;
    field.parameter = &parameter;
    field.given = parameter.required || !parameter.default_value.is_null();
    if (!parameter.default_value.is_null())
      fillField(field, parameter.default_value);
    else if (parameter.kind == ParameterKind::choice && !parameter.choices.empty())
      field.text = parameter.choices.front();
    else if (parameter.minimum > 0)
      field.number = parameter.minimum;
    fields_.push_back(std::move(field));
  }
}

OptionField* OptionForm::find(const char* name) {
  const auto found = std::find_if(fields_.begin(), fields_.end(),
                                  [&](const OptionField& f) { return std::strcmp(f.parameter->name, name) == 0; });
  return found == fields_.end() ? nullptr : &*found;
}

bool OptionForm::hasPlace(const OptionField& field) const {
  return std::none_of(fields_.begin(), fields_.end(), [&](const OptionField& written) {
    const auto* kind = kindOf(written.kinds, written.text);
    return kind != nullptr && std::find(kind->unknown_options.begin(), kind->unknown_options.end(),
                                        field.parameter->name) != kind->unknown_options.end();
  });
}

void OptionForm::fill(const json& options) {
  for (const auto& [key, value] : options.items())
    if (auto* field = find(key.c_str())) {
      fillField(*field, value);
      field->given = true;
    }
}

json OptionForm::options() const {
  json result = json::object();
  for (const auto& field : fields_) {
    if (!field.given || !hasPlace(field)) continue;
    if (isText(field.parameter->kind) && field.text.empty()) continue;
    if (field.parameter->kind == ParameterKind::flag && !field.flag) continue;
    result[field.parameter->name] = valueOf(field);
  }
  return result;
}

std::string OptionForm::problem() const {
  for (const auto& field : fields_)
    if (offers(field))
      if (auto wrong = problemOf(field); !wrong.empty()) return wrong;
  return {};
}

}  // namespace standpoint
