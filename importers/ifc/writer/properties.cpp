// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/properties.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/one_of.h"
#include "core/presentation_layers.h"

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

Ref PropertyWriter::property(const Property& p) {
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

void PropertyWriter::add(Ref object, const SortedProperties& properties) {
  for (const Property* p : properties.classifications) classifications_[{p->name, p->value}].push_back(object);
  // Sets in the order of their first property; a name occurs once in a set.
  struct Open {
    std::string name;
    bool quantities;
    std::set<std::string> names;
    std::vector<Ref> members;
  };
  std::vector<Open> open;
  for (const Property* p : properties.sets) {
    const Ref as_quantity = isQuantity(*p) ? quantity(*p) : 0;
    const bool quantities = as_quantity != 0;
    auto set = std::find_if(open.begin(), open.end(), [&](const Open& o) {
      return o.name == p->set && o.quantities == quantities && !o.names.contains(p->name);
    });
    if (set == open.end()) set = open.insert(open.end(), {p->set, quantities, {}, {}});
    set->names.insert(p->name);
    set->members.push_back(quantities ? as_quantity : property(*p));
  }
  for (Open& o : open) addSet(object, o.name, std::move(o.members), o.quantities);
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
