// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "project/survey/survey_verbs.h"

namespace standpoint {

// Where a beam points, in the model's file frame: azimuth clockwise from Y.
struct BeamDirection {
  double azimuth_deg = 0, elevation_deg = 0;
};
template <>
struct FieldValue<BeamDirection> {  // "AZIMUTH,ELEVATION"
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<BeamDirection> read(const nlohmann::json& text);
  static nlohmann::json write(const BeamDirection& direction);
};

// What a time-of-flight receiver gets of one pulse, bin by bin, into a CSV file: for teaching.
struct WaveformOptions {
  std::string station;
  std::string instrument;
  KeyValues settings;
  std::optional<BeamDirection> direction;  // required
  std::optional<Effects> without;
  double bin_m = 0;  // 0 = a twentieth of the pulse
  std::filesystem::path output;
};
const Fields<WaveformOptions>& waveformFields();

struct WaveformEcho {
  double range_m = 0, power_db = 0;  // 0 dB: a white wall at 1 m
};
const AnswerFields<WaveformEcho>& answerFields(const WaveformEcho*);
struct WaveformAnswer {
  std::size_t bins = 0;
  double first_m = 0, bin_m = 0;
  std::vector<WaveformEcho> echoes;
  std::filesystem::path file;
};
const AnswerFields<WaveformAnswer>& answerFields(const WaveformAnswer*);
Result<Answered<WaveformAnswer>> runWaveform(const Document& document, const WaveformOptions& options,
                                             Progress& progress);

}  // namespace standpoint
