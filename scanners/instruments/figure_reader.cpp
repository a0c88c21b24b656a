// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/figure_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace standpoint {

void FigureReader::fail(const std::string& pointer, std::string message) {
  if (!error_) error_ = Error{ErrorKind::unusable, std::move(message), file_ + " " + (pointer.empty() ? "/" : pointer)};
}

FigureReader::Group FigureReader::open(const Json& value, std::string pointer) {
  static const Json kEmpty = Json::object();
  Group group{&value, std::move(pointer), {}};
  if (!value.is_object()) {
    fail(group.pointer, "must be an object");
    group.object = &kEmpty;
  }
  if (group.object->contains("source")) group.source = text(group, "source");
  if (group.object->contains("note")) group.note = text(group, "note");
  return group;
}

void FigureReader::close(const Group& group) {
  for (const auto& item : group.object->items())
    if (!group.seen.contains(item.key())) fail(group.pointer + "/" + item.key(), "unknown key");
}

const FigureReader::Json& FigureReader::member(Group& group, const std::string& key) {
  static const Json kEmpty = Json::object();
  group.seen.insert(key);
  const auto found = group.object->find(key);
  if (found != group.object->end()) return *found;
  fail(group.pointer + "/" + key, "is missing");
  return kEmpty;
}

std::string FigureReader::text(Group& group, const std::string& key) {
  const Json& value = member(group, key);
  if (value.is_string()) return value.get<std::string>();
  fail(group.pointer + "/" + key, "must be a text");
  return {};
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
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(number)) {
    fail(pointer, "must be a number");
    return domain.low * domain.scale;
  }
  if (number < domain.low || number > domain.high) {
    std::ostringstream message;
    message << number << " is out of range: from " << domain.low << " to " << domain.high;
    fail(pointer, message.str());
    return domain.low * domain.scale;  // what comes after may make an integer of it
  }
  return number * domain.scale;
}

double FigureReader::figure(Group& group, const std::string& key, const Domain& domain) {
  const Json& value = member(group, key);
  const std::string pointer = group.pointer + "/" + key;
  if (error_) return domain.low * domain.scale;
  if (!value.is_object()) {
    cite(pointer, group.source, group.note);
    return checked(pointer, value, domain);
  }
  Group own = open(value, pointer);
  cite(pointer, own.source, own.note);
  const double number = checked(pointer + "/value", member(own, "value"), domain);
  close(own);
  return number;
}

int FigureReader::count(Group& group, const std::string& key, const Domain& domain) {
  const double number = figure(group, key, domain);
  if (number != std::floor(number)) fail(group.pointer + "/" + key, "must be a whole number");
  return static_cast<int>(number);
}

const FigureReader::Json& FigureReader::list(Group& group, const std::string& key, std::size_t most) {
  static const Json kEmpty = Json::array();
  const Json& found = member(group, key);
  if (found.is_array() && !found.empty() && found.size() <= most) return found;
  fail(group.pointer + "/" + key, "must be a list of 1 to " + std::to_string(most) + " entries");
  return kEmpty;
}

std::string FigureReader::word(Group& parent, const std::string& key, const std::vector<std::string>& words) {
  Group group = child(parent, key);
  cite(group.pointer, group.source, group.note);
  std::string value = text(group, "value");
  if (std::find(words.begin(), words.end(), value) == words.end()) {
    std::string allowed;
    for (const auto& w : words) allowed += (allowed.empty() ? "\"" : ", \"") + w + "\"";
    fail(group.pointer + "/value", "must be one of " + allowed);
  }
  close(group);
  return value;
}

std::vector<double> FigureReader::figures(Group& group, const std::string& key, const Domain& domain,
                                          std::size_t most) {
  Group own = child(group, key);
  cite(own.pointer, own.source, own.note);
  std::vector<double> numbers;
  const Json& values = list(own, "value", most);
  for (std::size_t i = 0; i < values.size(); ++i)
    numbers.push_back(checked(own.pointer + "/value/" + std::to_string(i), values[i], domain));
  close(own);
  return numbers;
}

void FigureReader::readSources(Group& root) {
  Group group = child(root, "sources");
  for (const auto& item : group.object->items()) sources_[item.key()] = text(group, item.key());
}

}  // namespace standpoint
