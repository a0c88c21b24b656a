// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/classroom/collect.h"

namespace standpoint {

namespace {

using nlohmann::json;

// Of our own; UUIDv5 by RFC 4122, so that the same result never becomes two statements in a store.
constexpr const char* kNamespace = "5d1e1f6a-7c0b-4b86-9a3c-0d3b6f1c2e74";
constexpr const char* kBase = "https://standpoint.example/xapi";
constexpr const char* kVerbs = "http://adlnet.gov/expapi/verbs/";
constexpr const char* kActivities = "http://adlnet.gov/expapi/activities/";

std::string uuidOf(const std::string& name) {
  static const auto space = boost::uuids::string_generator()(kNamespace);
  return boost::uuids::to_string(boost::uuids::name_generator_sha1(space)(name));
}

// ISO 8601: PT23M11S.
std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  return fmt::format("PT{}H{}M{}S", whole / 3600, whole / 60 % 60, whole % 60);
}

// A rule's id may be any text, an address may not.
std::string addressPart(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_'
               ? std::string(1, c)
               : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

// Of 0 to 1, without digits that nobody measured.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

class Statements {
 public:
  Statements(const CollectedClass& c, std::string home) : c_(c), home_(std::move(home)) {
    exercise_ = c.assignment.exerciseWith(c.assignment.variants.front()).value_or(Exercise());
    object_ = fmt::format("{}/exercise/{}", kBase, c.assignment.id());
  }

  void add(const CollectedResult& r) {
    const auto& m = *r.verification.marks;
    const auto* student = c_.list.find(r.result.student);
    const json actor = {{"account", {{"homePage", home_}, {"name", student->username}}}};
    json whole = statement(r, actor, m.passed ? "passed" : "failed", "");
    whole["object"] = activity(object_, "simulation", exercise_.title);
    whole["result"] = {{"success", m.passed},
                       {"completion", true},
                       {"duration", duration(m.seconds)},
                       {"score", {{"scaled", rounded(m.score)}, {"raw", m.points}, {"min", 0}, {"max", m.of}}}};
    list_.push_back(std::move(whole));
    for (std::size_t i = 0; i < m.rules.size(); ++i) addRule(r, actor, i);
  }

  std::string text() const { return list_.dump(2) + '\n'; }

 private:
  json statement(const CollectedResult& r, const json& actor, const std::string& verb, const std::string& part) const {
    json context = {{"contextActivities",
                     {{"grouping", {{{"id", fmt::format("{}/class/{}", kBase, c_.assignment.hash.substr(0, 16))}}}}}},
                    {"extensions", {{fmt::format("{}/variant-seed", kBase), r.result.seed}}}};
    if (!part.empty()) context["contextActivities"]["parent"] = {{{"id", object_}}};
    return {{"id", uuidOf(r.result.head + '\n' + verb + '\n' + part)},
            {"version", "1.0.3"},
            {"timestamp", r.result.finished},
            {"actor", actor},
            {"verb", {{"id", kVerbs + verb}, {"display", {{"en", verb}}}}},
            {"context", std::move(context)}};
  }

  static json activity(const std::string& id, const char* type, const Spoken& name) {
    return {{"id", id}, {"definition", {{"type", std::string(kActivities) + type}, {"name", name.texts}}}};
  }

  void addRule(const CollectedResult& r, const json& actor, std::size_t i) {
    const auto& rule = r.verification.marks->rules[i];
    json one = statement(r, actor, "answered", rule.id);
    const auto text = i < exercise_.rules.size() ? exercise_.rules[i].text : Spoken{{{"en", rule.text}}};
    one["object"] = activity(fmt::format("{}/rule/{}", object_, addressPart(rule.id)), "objective", text);
    one["result"] = {{"success", rule.held}};
    if (rule.of > 0)
      one["result"]["score"] = {
          {"scaled", rounded(rule.points / rule.of)}, {"raw", rule.points}, {"min", 0}, {"max", rule.of}};
    list_.push_back(std::move(one));
  }

  const CollectedClass& c_;
  std::string home_, object_;
  Exercise exercise_;
  json list_ = json::array();
};

}  // namespace

std::string xapiStatements(const CollectedClass& c, const std::string& home) {
  Statements statements(c, home);
  for (const auto& r : c.results)
    if (r.counts) statements.add(r);
  return statements.text();
}

Sealed signedMark(const CollectedResult& r, const CollectedClass& c, const SigningKey& key) {
  const auto& m = *r.verification.marks;
  const json payload = {{"assignment_hash", c.assignment.hash},
                        {"exercise", m.exercise},
                        {"student", r.result.student},
                        {"seed", r.result.seed},
                        {"finished", r.result.finished},
                        {"late", r.late},
                        {"score", m.score},
                        {"passed", m.passed},
                        {"seconds", m.seconds},
                        {"head", r.result.head},
                        {"criteria", [&] {
                           json rules = json::array();
                           for (const auto& rule : m.rules)
                             rules.push_back({{"id", rule.id}, {"kind", "rule"}, {"held", rule.held}});
                           return rules;
                         }()}};
  return sealed(kMarkKind, payload.dump(), key);
}

}  // namespace standpoint
