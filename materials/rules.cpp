// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "materials/colour.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

// Each distinct name of a model is held against every rule: these keep the product of the two within a second or so.
constexpr std::uintmax_t kLargestRules = 1U << 20U;
constexpr std::size_t kMostRules = 10'000;

void checkColours(JsonFields& f, const std::string& globs) {
  for (std::size_t begin = 0; begin < globs.size();) {
    const auto end = std::min(globs.find('|', begin), globs.size());
    const auto colour = globs.substr(begin, end - begin);
    if (std::find(kColourBands.begin(), kColourBands.end(), colour) == kColourBands.end()) {
      std::string known;
      for (const auto band : kColourBands) known += (known.empty() ? "" : ", ") + std::string(band);
      f.wrong("colour", "'" + colour + "' is not a colour; valid colours: " + known);
    }
    begin = end + 1;
  }
}

class RulesReader {
 public:
  RulesReader(std::string file, const std::vector<PhysicalMaterial>& library, WordLists words)
      : fault_(std::move(file)), words_(std::move(words)) {
    for (const auto& material : library) ids_.insert(material.id);
  }

  Result<RuleSet> read(const nlohmann::json& content) {
    RuleSet set;
    JsonFields root(fault_, content, "");
    root.each("words", [&](const std::string& name, const nlohmann::json& list, const std::string& pointer) {
      readWords(name, list, pointer);
    });
    if (const auto* rules = root.required("rules"); rules != nullptr && rules->size() > kMostRules)
      root.wrong("rules", "contains more than " + std::to_string(kMostRules) + " rules");
    TRY(fault_.result());  // patterns need the words, and too many rules are not read
    root.list("rules", [&](JsonFields& f) {
      set.rules.push_back(readRule(f));
      set.rules.back().place = "rule " + std::to_string(set.rules.size() - 1) + " of " + fault_.file();
    });
    root.list("implausible", [&](JsonFields& f) { set.implausible.push_back(readImplausible(f)); });
    root.skip("then");
    root.close();
    TRY(fault_.result());
    set.words = std::move(words_);
    return set;
  }

 private:
  void readWords(const std::string& name, const nlohmann::json& list, const std::string& pointer) {
    if (name.empty() || name.find_first_of("{}|&!") != std::string::npos)
      fault_.say(pointer, "must not contain { } | & !");
    if (!list.is_array() || list.empty()) return fault_.needs(pointer, list, "a list of texts");
    auto& words = words_[name];
    words.clear();
    for (std::size_t i = 0; i < list.size(); ++i) {
      words.push_back(textAt(fault_, list[i], pointer + "/" + std::to_string(i)));
      if (words.back().find_first_of("{}|&") != std::string::npos)
        fault_.say(pointer + "/" + std::to_string(i), "must be a single word; use { } | & only in patterns");
    }
  }

  std::string readPattern(JsonFields& f, const char* key) const {
    auto text = f.textOr(key, "");
    if (!text.empty())
      if (const auto flaw = flawOf(text, words_); !flaw.empty()) f.wrong(key, flaw);
    return text;
  }

  static std::optional<ValueRange> readRange(JsonFields& f, const char* key) {
    const auto* value = f.raw(key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_array() || value->size() != 2) {
      f.needs(key, *value, "[from, to]");
      return std::nullopt;
    }
    const double from = numberAt(f.fault(), (*value)[0], f.pointer(key) + "/0", 0, 1);
    const double to = numberAt(f.fault(), (*value)[1], f.pointer(key) + "/1", from, 1);
    return ValueRange{static_cast<float>(from), static_cast<float>(to)};
  }

  AssignmentRule readRule(JsonFields& f) const {
    AssignmentRule rule;
    bool asks = false;
    for (const auto& [key, field] : {std::pair{"ifc_class", &AssignmentRule::ifc_class},
                                     {"material", &AssignmentRule::material},
                                     {"name", &AssignmentRule::name},
                                     {"type", &AssignmentRule::type},
                                     {"storey", &AssignmentRule::storey},
                                     {"group", &AssignmentRule::group},
                                     {"layer", &AssignmentRule::layer},
                                     {"colour", &AssignmentRule::colour}}) {
      rule.*field = readPattern(f, key);
      asks = asks || !(rule.*field).empty();
    }
    checkColours(f, rule.colour);
    for (const auto& [key, field] : {std::pair{"metallic", &AssignmentRule::metallic},
                                     {"roughness", &AssignmentRule::roughness},
                                     {"transmission", &AssignmentRule::transmission}}) {
      rule.*field = readRange(f, key);
      asks = asks || (rule.*field).has_value();
    }
    rule.hidden = f.flagOr("hidden", rule.hidden);
    if (f.has("hidden") && rule.material.empty()) f.wrong("hidden", "requires a pattern for the material");
    rule.confidence = f.numberOr("confidence", rule.confidence, 0, 1);
    rule.assign = f.text("assign");
    if (!ids_.contains(rule.assign)) f.wrong("assign", "'" + rule.assign + "' is not in the library");
    f.close();  // an unknown key may be the pattern that is not there
    if (!asks) f.wrong("", "has no pattern and would match everything");
    return rule;
  }

  Implausible readImplausible(JsonFields& f) const {
    Implausible entry;
    entry.ifc_class = readPattern(f, "ifc_class");
    f.required("assigned");
    entry.assigned = readPattern(f, "assigned");
    entry.why = f.text("why");
    return entry;
  }

  JsonFault fault_;
  WordLists words_;
  std::set<std::string> ids_;
};

// "then": "default" asks for the default rules after these.
Result<bool> wantsDefault(const nlohmann::json& content, const JsonPlace& root) {
  if (!content.is_object() || !content.contains("then")) return false;
  if (content["then"] != "default") return (root / "then").unusable("must be \"default\"");
  return true;
}

}  // namespace

Result<std::string> readRulesText(const std::filesystem::path& file) { return readWholeFile(file, kLargestRules); }

Result<RuleSet> parseAssignmentRules(const std::string& text, const std::string& file_name,
                                     const std::vector<PhysicalMaterial>& library,
                                     const std::filesystem::path& default_file) {
  TRY_ASSIGN(const auto content, parseJson(text, file_name));
  TRY_ASSIGN(const auto more, wantsDefault(content, JsonPlace{file_name, {}}));
  RuleSet defaults;
  if (more) {
    auto read = readAssignmentRules(default_file, library);
    if (!read) return read;
    defaults = std::move(*read);
  }
  auto set = RulesReader(file_name, library, defaults.words).read(content);
  if (!set) return set;
  set->own = default_file.empty() ? 0 : set->rules.size();  // else they are the default rules themselves
  if (!more) return set;
  // The default patterns keep the words that they were written with.
  for (const auto& [name, words] : defaults.words)
    if (set->words.at(name) != words)
      return (JsonPlace{file_name, {}} / "words" / name)
          .unusable("is a list of the default rules: choose another name");
  set->rules.insert(set->rules.end(), defaults.rules.begin(), defaults.rules.end());
  set->implausible.insert(set->implausible.end(), defaults.implausible.begin(), defaults.implausible.end());
  return set;
}

Result<RuleSet> readAssignmentRules(const std::filesystem::path& file, const std::vector<PhysicalMaterial>& library,
                                    const std::filesystem::path& default_file) {
  TRY_ASSIGN(const auto text, readRulesText(file));
  return parseAssignmentRules(text, file.filename().string(), library, default_file);
}

}  // namespace standpoint
