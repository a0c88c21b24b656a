// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/properties.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/one_of.h"
#include "core/presentation_layers.h"
#include "importers/ifc/properties.h"

namespace standpoint::ifc {
namespace {

constexpr std::size_t kLongestLabel = 255;

std::string typed(std::string_view keyword, const std::string& argument) {
  return std::string(keyword) + "(" + argument + ")";
}

std::string labelled(const std::string& value) {
  return typed(value.size() <= kLongestLabel ? "IFCLABEL" : "IFCTEXT", stepText(value));
}

bool isWhole(const std::string& number) { return number.find_first_of(".eE") == std::string::npos; }

// "(12,30,0)" of "12, 30, 0"; empty where one is no number.
std::string listText(std::string_view value, bool whole) {
  std::string list = "(";
  while (!value.empty()) {
    const auto end = value.find(", ");
    const std::string number = quantityOf(value.substr(0, end)).number;
    if (number.empty()) return {};
    list += (list.size() > 1 ? "," : "") + (whole ? number : stepReal(number));
    value = end == std::string_view::npos ? std::string_view() : value.substr(end + 2);
  }
  return list + ')';
}

std::string numberText(std::string_view keyword, const std::string& number) {
  constexpr std::array<std::string_view, 3> kWhole{"IFCINTEGER", "IFCPOSITIVEINTEGER", "IFCTIMESTAMP"};
  constexpr std::array<std::string_view, 4> kAny{"IFCCOUNTMEASURE", "IFCNUMERICMEASURE", "IFCQUANTITYCOUNT",
                                                 "IFCQUANTITYNUMBER"};
  if (isOneOf(keyword, kWhole)) return isWhole(number) ? typed(keyword, number) : typed("IFCREAL", stepReal(number));
  return typed(keyword, isOneOf(keyword, kAny) && isWhole(number) ? number : stepReal(number));
}

// At most so many separators count.
std::vector<std::string> splitText(std::string_view text, std::string_view separator, int most = -1) {
  std::vector<std::string> parts;
  for (; most != 0; --most) {
    const auto end = text.find(separator);
    if (end == std::string_view::npos) break;
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end + separator.size());
  }
  parts.emplace_back(text);
  return parts;
}

// Low, high and set point of "5 (2 … 8)", "2 … 8" or "5"; empty where there is none.
std::vector<std::string> boundsOf(std::string_view text) {
  constexpr std::string_view kTo = " … ", kRange = " (";
  const auto to = text.find(kTo);
  if (to == std::string_view::npos) return {"", "", std::string(text)};
  const auto range = text.ends_with(')') ? text.find(kRange) : std::string_view::npos;
  const bool both = range != std::string_view::npos && range < to;
  const std::size_t low = both ? range + kRange.size() : 0, high = to + kTo.size();
  return {std::string(text.substr(low, to - low)), std::string(text.substr(high, text.size() - high - (both ? 1 : 0))),
          std::string(both ? text.substr(0, range) : std::string_view())};
}

bool isQuantity(const Property& p) { return keywordOf(p.type).starts_with("IFCQUANTITY") && !p.value.empty(); }

// "Ss_25_10" and "Walls" of "Ss_25_10 Walls": a code has a digit.
std::pair<std::string, std::string> codeAndTitle(const std::string& text) {
  const auto space = text.find(' ');
  const bool code = space != std::string::npos && text.find_first_of("0123456789") < space;
  return code ? std::pair(text.substr(0, space), text.substr(space + 1)) : std::pair(text, std::string());
}

}  // namespace

namespace {

bool isText(const Property& p) {
  constexpr std::array<std::string_view, 9> kTexts{"IFCLABEL", "IFCTEXT",         "IFCIDENTIFIER",
                                                   "IFCDATE",  "IFCDATETIME",     "IFCDURATION",
                                                   "IFCTIME",  "IFCURIREFERENCE", "IFCDESCRIPTIVEMEASURE"};
  return isOneOf(keywordOf(p.type), kTexts);
}

}  // namespace

std::string stepValue(const Property& p) {
  const std::string_view keyword = keywordOf(p.type);
  if (isText(p)) return typed(keyword, stepText(p.value));
  if (keyword == "IFCBOOLEAN" || keyword == "IFCLOGICAL") {
    if (p.value == "true" || p.value == "false") return typed(keyword, p.value == "true" ? ".T." : ".F.");
    return p.value == "unknown" ? "IFCLOGICAL(.U.)" : labelled(p.value);
  }
  if (keyword.empty() || keyword == "IFCBINARY") return labelled(p.value);
  if (keyword == "IFCCOMPOUNDPLANEANGLEMEASURE" || keyword == "IFCCOMPLEXNUMBER") {
    const std::string list = listText(p.value, keyword != "IFCCOMPLEXNUMBER");
    return list.empty() ? labelled(p.value) : typed(keyword, list);
  }
  const std::string number = quantityOf(p.value).number;
  return number.empty() ? labelled(p.value) : numberText(keyword, number);
}

SortedProperties sorted(const std::vector<Property>& properties, const std::vector<std::string_view>& own) {
  SortedProperties result;
  for (const Property& p : properties) {
    if (p.set == kPresentationLayer)
      result.layers.push_back(p.value);
    else if (p.set == "Classification")
      result.classifications.push_back(&p);
    else if (p.set == "Attributes" && std::find(own.begin(), own.end(), p.name) != own.end() &&
             !result.attributes.contains(p.name))
      result.attributes[p.name] = p.value;
    else
      result.sets.push_back(&p);
  }
  return result;
}

Ref PropertyWriter::unit(const Property& p) { return units_.unitOf(p.type, quantityOf(p.value).unit); }

Ref PropertyWriter::several(const Property& p) {
  const std::string_view type = keywordOf(p.type);
  const auto bracket = type.find('(');
  if (bracket == std::string_view::npos || p.value.empty()) return 0;
  const std::string_view kind = type.substr(0, bracket), member = type.substr(bracket + 1, type.size() - bracket - 2);
  const bool bounded = kind == "IFCPROPERTYBOUNDEDVALUE";
  std::vector<std::string> values;  // as STEP writes them
  std::optional<Ref> of_all;        // their unit
  for (const std::string& text : bounded ? boundsOf(p.value) : splitText(p.value, ", ")) {
    const Property one{"", "", text, propertyTypeOf(member)};
    values.push_back(text.empty() && bounded ? "$" : stepValue(one));
    if (values.back() == "$") continue;
    const Ref own = isText(one) ? 0 : unit(one);
    if (!values.back().starts_with(member) || own != of_all.value_or(own)) return 0;
    of_all = own;
  }
  StepRecord record(kind);
  record.raw(stepText(p.name)).none();
  if (bounded) return out_.shared(record.raw(values[1]).raw(values[0]).ref(of_all.value_or(0)).raw(values[2]));
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ",") + value;
  return out_.shared(record.raw("(" + list + ")").ref(of_all.value_or(0)));
}

Ref PropertyWriter::property(const Property& p) {
  if (const Ref of_several = several(p); of_several != 0) return of_several;
  StepRecord record("IFCPROPERTYSINGLEVALUE");
  record.raw(stepText(p.name)).none();
  if (p.value.empty() && !isText(p)) return out_.shared(record.none(2));
  const std::string value = stepValue(p);
  const bool number = value.find('\'') == std::string::npos;
  return out_.shared(record.raw(value).ref(number ? unit(p) : 0));
}

Ref PropertyWriter::quantity(const Property& p) {
  const std::string value = stepValue(p);
  if (value.starts_with("IFCLABEL")) return 0;
  // The simple quantity's keyword stands for the record, its argument for the value.
  const auto bracket = value.find('(');
  std::string keyword = value.substr(0, bracket);
  if (keyword == "IFCQUANTITYNUMBER") keyword = "IFCQUANTITYCOUNT";  // IFC4 has no other
  return out_.shared(StepRecord(keyword)
                         .raw(stepText(p.name))
                         .none()
                         .ref(unit(p))
                         .raw(value.substr(bracket + 1, value.size() - bracket - 2))
                         .none());
}

void PropertyWriter::addSet(Ref object, const std::string& name, std::vector<Ref> members, bool quantities) {
  std::string key = name + (quantities ? "\nq" : "\np");
  for (const Ref r : members) key += ' ' + std::to_string(r);
  const auto [it, is_new] = known_.try_emplace(std::move(key), sets_.size());
  if (is_new) sets_.push_back({name, std::move(members), quantities, {}});
  auto& objects = sets_[it->second].objects;
  if (objects.empty() || objects.back() != object) objects.push_back(object);
}

// Where a property of this name can be, below a group; null where a name on the way to it is taken.
PropertyWriter::Group* PropertyWriter::roomFor(Group& group, std::span<const std::string> path,
                                               const std::string& name) {
  if (path.empty()) return group.names.insert(name).second ? &group : nullptr;
  auto part = std::find_if(group.parts.begin(), group.parts.end(), [&](const Group& g) { return g.name == path[0]; });
  if (part == group.parts.end()) {
    if (!group.names.insert(path[0]).second) return nullptr;
    part = group.parts.insert(part, {path[0], group.quantities, group.members.size(), {}, {}, {}});
    group.members.push_back(0);
  }
  return roomFor(*part, path.subspan(1), name);
}

// What a complex property is used for, and a complex quantity distinguishes, is not kept: its name stands there.
void PropertyWriter::close(Group& group) {
  for (Group& part : group.parts) {
    close(part);
    const std::string name = stepText(part.name);
    StepRecord record(part.quantities ? "IFCPHYSICALCOMPLEXQUANTITY" : "IFCCOMPLEXPROPERTY");
    record.raw(name).none();
    if (part.quantities)
      record.refs(part.members).raw(name).none(2);
    else
      record.raw(name).refs(part.members);
    group.members[part.place] = out_.shared(record);
  }
}

void PropertyWriter::add(Ref object, const SortedProperties& properties) {
  for (const Property* p : properties.classifications) classifications_[{p->name, p->value}].push_back(object);
  // Sets in the order of their first property; a name occurs once in a set.
  std::vector<Group> open;
  for (const Property* p : properties.sets) {
    const Ref as_quantity = isQuantity(*p) ? quantity(*p) : 0;
    const bool quantities = as_quantity != 0;
    const std::vector<std::string> path = splitText(p->set, kWithinProperty, kDeepestProperty);
    const auto within = std::span(path).subspan(1);
    Group* room = nullptr;
    for (std::size_t i = 0; room == nullptr && i < open.size(); ++i)
      if (open[i].name == path[0] && open[i].quantities == quantities) room = roomFor(open[i], within, p->name);
    if (room == nullptr) room = roomFor(open.emplace_back(Group{path[0], quantities}), within, p->name);
    room->members.push_back(quantities ? as_quantity : property(*p));
  }
  for (Group& o : open) {
    close(o);
    addSet(object, o.name, std::move(o.members), o.quantities);
  }
}

void PropertyWriter::finish() {
  for (std::size_t i = 0; i < sets_.size(); ++i) {
    const Shared& s = sets_[i];
    const std::string key = "set " + std::to_string(i);
    StepRecord record(s.quantities ? "IFCELEMENTQUANTITY" : "IFCPROPERTYSET");
    record.text(ids_.make(key)).none().text(s.name).none(s.quantities ? 2 : 1).refs(s.members);
    const Ref set = out_.add(record);
    out_.add(StepRecord("IFCRELDEFINESBYPROPERTIES").text(ids_.make(key + " of")).none(3).refs(s.objects).ref(set));
  }
  for (const auto& [what, objects] : classifications_) {
    const auto& [system, text] = what;
    const auto [code, title] = codeAndTitle(text);
    const Ref of =
        system == "Reference" ? 0 : out_.shared(StepRecord("IFCCLASSIFICATION").none(3).text(system).none(3));
    const Ref reference =
        out_.add(StepRecord("IFCCLASSIFICATIONREFERENCE").none().text(code).text(title).ref(of).none(2));
    out_.add(StepRecord("IFCRELASSOCIATESCLASSIFICATION")
                 .text(ids_.make("classification " + system + " " + text))
                 .none(3)
                 .refs(objects)
                 .ref(reference));
  }
}

}  // namespace standpoint::ifc
