// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "project/verbs/file_verbs.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

using nlohmann::json;

json settingsOf(const Instrument& instrument) {
  json settings = json::object();
  for (const auto& s : instrument.settings) {
    json choices = json::array();
    for (const auto& c : s.choices) choices.push_back(c.value);
    settings[s.key] = s.choices.empty() ? json{{"from", s.minimum}, {"to", s.maximum}, {"unit", s.unit}} : choices;
  }
  return settings;
}

json rowOf(const KnownInstrument& known) {
  const auto& i = known.instrument;
  return {{"id", i.id},
          {"maker", i.maker},
          {"model", i.model},
          {"technology", i.technology},
          {"wavelength_nm", i.wavelength_nm},
          {"max_range_m", i.max_range_m},
          {"moving", i.moving.has_value()},
          {"own", known.own},
          {"file", known.file.string()},
          {"settings", settingsOf(i)}};
}

}  // namespace

const Fields<InstrumentsOptions>& instrumentsFields() {
  using O = InstrumentsOptions;
  static const Fields<O> fields = {{"copy", &O::copy, "id of the instrument to copy into the folder of your own ones"},
                                   {"as", &O::as, "id of the copy"}};
  return fields;
}

Result<Outcome> runInstruments(const Document& document, const InstrumentsOptions& options, Progress&) {
  Outcome outcome{document, json::object(), {}, {}};
  const auto &id = options.copy, &new_id = options.as;
  if (id.empty() != new_id.empty())
    return failure(ErrorKind::usage, "--copy ID and --as NEW must be used together", id.empty() ? "--copy" : "--as");
  if (!id.empty()) {
    TRY_ASSIGN(auto file, copyInstrument(id, new_id));
    outcome.answer["copied"] = {{"id", new_id}, {"from", id}, {"file", file.string()}};
    outcome.description = fmt::format("Copied {} to {}", id, file.string());
  }
  TRY_ASSIGN(const auto known, instrumentsWithFiles());
  outcome.answer["own_folder"] = ownInstrumentsFolder().string();
  outcome.answer["schema"] = (shippedInstrumentsFolder() / "schema.json").string();
  outcome.answer["instruments"] = json::array();
  std::string ids;
  for (const auto& k : known) {
    outcome.answer["instruments"].push_back(rowOf(k));
    ids += (ids.empty() ? "" : ", ") + k.instrument.id;
  }
  if (outcome.description.empty()) outcome.description = fmt::format("{} instruments: {}", known.size(), ids);
  return outcome;
}

}  // namespace standpoint
