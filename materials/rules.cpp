// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "core/json_file.h"
#include "materials/colour.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

// Each distinct name of a model is held against every rule: these keep the product of the two within a second or so.
constexpr std::uintmax_t kLargestRules = 1U << 20U;
constexpr std::size_t kMostRules = 10'000;

Result<void> checkColours(const std::string& globs, const JsonPlace& at) {
  for (std::size_t begin = 0; begin < globs.size();) {
    const auto end = std::min(globs.find('|', begin), globs.size());
    const auto colour = globs.substr(begin, end - begin);
    if (std::find(kColourBands.begin(), kColourBands.end(), colour) == kColourBands.end()) {
      std::string known;
      for (const auto band : kColourBands) known += (known.empty() ? "" : ", ") + std::string(band);
      return at.unusable("'" + colour + "' is not a colour; valid colours: " + known);
    }
    begin = end + 1;
  }
  return {};
}

class RulesReader {
 public:
  RulesReader(std::string file, const std::vector<PhysicalMaterial>& library, WordLists words)
      : root_{std::move(file), {}}, words_(std::move(words)) {
    for (const auto& material : library) ids_.insert(material.id);
  }

  Result<RuleSet> read(const nlohmann::json& content) {
    RuleSet set;
    TRY(checkKeys(content, root_, {"words", "rules", "implausible", "then"}));
    TRY(readWords(content));
    if (!content.contains("rules")) return (root_ / "rules").unusable("is missing");
    for (const char* key : {"rules", "implausible"})
      if (content.contains(key) && !content[key].is_array()) return (root_ / key).unusable("must be a list");
    const auto& list = content["rules"];
    if (list.size() > kMostRules)
      return (root_ / "rules").unusable("contains more than " + std::to_string(kMostRules) + " rules");
    for (std::size_t i = 0; i < list.size(); ++i) {
      TRY_ASSIGN(auto rule, readRule(list[i], root_ / "rules" / i));
      rule.place = "rule " + std::to_string(i) + " of " + root_.file;
      set.rules.push_back(std::move(rule));
    }
    if (content.contains("implausible"))
      for (std::size_t i = 0; i < content["implausible"].size(); ++i) {
        TRY_ASSIGN(auto entry, readImplausible(content["implausible"][i], root_ / "implausible" / i));
        set.implausible.push_back(std::move(entry));
      }
    set.words = std::move(words_);
    return set;
  }

 private:
  Result<void> readWords(const nlohmann::json& content) {
    const auto found = content.find("words");
    if (found == content.end()) return {};
    if (!found->is_object()) return (root_ / "words").unusable("must be an object of lists");
    for (const auto& [name, list] : found->items()) {
      const auto at = root_ / "words" / name;
      if (name.empty() || name.find_first_of("{}|&!") != std::string::npos)
        return at.unusable("must not contain { } | & !");
      if (!list.is_array() || list.empty()) return at.unusable("must be a list of texts");
      auto& words = words_[name];
      words.clear();
      for (std::size_t i = 0; i < list.size(); ++i) {
        TRY_ASSIGN(auto word, textOf(list[i], at / i));
        if (word.find_first_of("{}|&") != std::string::npos)
          return (at / i).unusable("must be a single word; use { } | & only in patterns");
        words.push_back(std::move(word));
      }
    }
    return {};
  }

  Result<std::string> readPattern(const nlohmann::json& entry, const JsonPlace& at, const char* key) const {
    if (!entry.contains(key)) return std::string();
    auto text = readText(entry, at, key);
    if (!text) return text;
    if (auto flaw = flawOf(*text, words_); !flaw.empty()) return (at / key).unusable(flaw);
    return text;
  }

  static Result<std::optional<ValueRange>> readRange(const nlohmann::json& entry, const JsonPlace& at,
                                                     const char* key) {
    const auto found = entry.find(key);
    if (found == entry.end()) return std::optional<ValueRange>();
    if (!found->is_array() || found->size() != 2) return (at / key).unusable("must be [from, to]");
    TRY_ASSIGN(const auto from, readNumber((*found)[0], at / key / std::size_t{0}, 0, 1));
    TRY_ASSIGN(const auto to, readNumber((*found)[1], at / key / std::size_t{1}, from, 1));
    return std::optional(ValueRange{static_cast<float>(from), static_cast<float>(to)});
  }

  Result<std::string> readAssigned(const nlohmann::json& entry, const JsonPlace& at) const {
    auto assign = readText(entry, at, "assign");
    if (assign && !ids_.contains(*assign)) return (at / "assign").unusable("'" + *assign + "' is not in the library");
    return assign;
  }

  Result<AssignmentRule> readRule(const nlohmann::json& entry, const JsonPlace& at) const {
    TRY(checkKeys(entry, at,
                  {"ifc_class", "material", "name", "type", "storey", "group", "layer", "colour", "metallic",
                   "roughness", "transmission", "assign", "hidden", "confidence"}));
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
      TRY_ASSIGN(auto pattern, readPattern(entry, at, key));
      asks = asks || !pattern.empty();
      rule.*field = std::move(pattern);
    }
    TRY(checkColours(rule.colour, at / "colour"));
    for (const auto& [key, field] : {std::pair{"metallic", &AssignmentRule::metallic},
                                     {"roughness", &AssignmentRule::roughness},
                                     {"transmission", &AssignmentRule::transmission}}) {
      TRY_ASSIGN(auto range, readRange(entry, at, key));
      asks = asks || range.has_value();
      rule.*field = range;
    }
    if (!asks) return at.unusable("has no pattern and would match everything");
    TRY_ASSIGN(auto assign, readAssigned(entry, at));
    rule.assign = std::move(assign);
    if (const auto hidden = entry.find("hidden"); hidden != entry.end()) {
      if (!hidden->is_boolean()) return (at / "hidden").unusable("must be true or false");
      if (rule.material.empty()) return (at / "hidden").unusable("requires a pattern for the material");
      rule.hidden = hidden->get<bool>();
    }
    if (entry.contains("confidence")) {
      TRY_ASSIGN(const auto confidence, readNumber(entry["confidence"], at / "confidence", 0, 1));
      rule.confidence = confidence;
    }
    return rule;
  }

  Result<Implausible> readImplausible(const nlohmann::json& entry, const JsonPlace& at) const {
    TRY(checkKeys(entry, at, {"ifc_class", "assigned", "why"}));
    TRY_ASSIGN(auto ifc_class, readPattern(entry, at, "ifc_class"));
    if (!entry.contains("assigned")) return (at / "assigned").unusable("is missing");
    TRY_ASSIGN(auto assigned, readPattern(entry, at, "assigned"));
    TRY_ASSIGN(auto why, readText(entry, at, "why"));
    return Implausible{std::move(ifc_class), std::move(assigned), std::move(why)};
  }

  JsonPlace root_;
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
