// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "project/verbs/file_verbs.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

InstrumentRow rowOf(const KnownInstrument& known) {
  const auto& i = known.instrument;
  InstrumentRow row{i.id,      i.maker,    i.model, i.technology, i.wavelength_nm, i.max_range_m, i.moving.has_value(),
                    known.own, known.file, {}};
  for (const auto& s : i.settings) {
    std::vector<std::string> choices;
    for (const auto& c : s.choices) choices.push_back(c.value);
    if (choices.empty())
      row.settings[s.key] = InstrumentRange{s.minimum, s.maximum, s.unit};
    else
      row.settings[s.key] = std::move(choices);
  }
  return row;
}

}  // namespace

const Fields<InstrumentsOptions>& instrumentsFields() {
  using O = InstrumentsOptions;
  static const Fields<O> fields = {{"copy", &O::copy, "id of the instrument to copy into the folder of your own ones"},
                                   {"as", &O::as, "id of the copy"}};
  return fields;
}

const AnswerFields<InstrumentRange>& answerFields(const InstrumentRange*) {
  using A = InstrumentRange;
  static const AnswerFields<A> fields = {{"from", &A::from}, {"to", &A::to}, {"unit", &A::unit}};
  return fields;
}

const AnswerFields<InstrumentRow>& answerFields(const InstrumentRow*) {
  using A = InstrumentRow;
  static const AnswerFields<A> fields = {{"id", &A::id},
                                         {"maker", &A::maker},
                                         {"model", &A::model},
                                         {"technology", &A::technology},
                                         {"wavelength_nm", &A::wavelength_nm},
                                         {"max_range_m", &A::max_range_m},
                                         {"moving", &A::moving},
                                         {"own", &A::own},
                                         {"file", &A::file},
                                         {"settings", &A::settings}};
  return fields;
}

const AnswerFields<BrokenInstrumentRow>& answerFields(const BrokenInstrumentRow*) {
  using A = BrokenInstrumentRow;
  static const AnswerFields<A> fields = {
      {"id", &A::id}, {"file", &A::file}, {"source", &A::source}, {"message", &A::message}};
  return fields;
}

const AnswerFields<InstrumentCopy>& answerFields(const InstrumentCopy*) {
  using A = InstrumentCopy;
  static const AnswerFields<A> fields = {{"id", &A::id}, {"from", &A::from}, {"file", &A::file}};
  return fields;
}

const AnswerFields<InstrumentsAnswer>& answerFields(const InstrumentsAnswer*) {
  using A = InstrumentsAnswer;
  static const AnswerFields<A> fields = {{"copied", &A::copied, kLeftOut},
                                         {"own_folder", &A::own_folder},
                                         {"schema", &A::schema},
                                         {"instruments", &A::instruments},
                                         {"broken", &A::broken}};
  return fields;
}

Result<Answered<InstrumentsAnswer>> runInstruments(const Document& document, const InstrumentsOptions& options,
                                                   Progress&) {
  Answered<InstrumentsAnswer> outcome{document};
  auto& answer = outcome.answer;
  const auto &id = options.copy, &new_id = options.as;
  if (id.empty() != new_id.empty())
    return failure(ErrorKind::usage, "--copy ID and --as NEW must be used together", id.empty() ? "--copy" : "--as");
  if (!id.empty()) {
    TRY_ASSIGN(auto file, copyInstrument(id, new_id));
    answer.copied = InstrumentCopy{new_id, id, file};
    outcome.description = fmt::format("Copied {} to {}", id, file.string());
  }
  TRY_ASSIGN(const auto files, instrumentsWithFiles());
  answer.own_folder = ownInstrumentsFolder();
  answer.schema = shippedInstrumentsFolder() / "schema.json";
  std::string ids;
  for (const auto& k : files.usable) {
    answer.instruments.push_back(rowOf(k));
    ids += (ids.empty() ? "" : ", ") + k.instrument.id;
  }
  for (const auto& b : files.broken) {
    answer.broken.push_back({b.id, b.file, b.error.source, b.error.message});
    outcome.report.warn(b.error.source, "broken: " + b.error.message);
  }
  if (outcome.description.empty()) outcome.description = fmt::format("{} instruments: {}", files.usable.size(), ids);
  return outcome;
}

}  // namespace standpoint
