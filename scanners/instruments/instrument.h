// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace standpoint {

// A figure with its evidence, as every figure of an instrument file has it: "S59" (data sheet or paper), "derived",
// "unsourced" (may be used, never claimed).
struct Evidence {
  std::string mark;
  std::string source;
};

// A setting as the device offers it, in the device's own words: resolution = 3mm | 6mm | 12mm.
struct SettingChoice {
  std::string value;  // "12mm"
  std::string label;  // "Low (12 mm @ 10 m)"
  // What the choice changes: column/row counts, measurement rate, noise factor, passes, seconds, range (see the
  // schema).
  std::map<std::string, double> effects;
};
struct InstrumentSetting {
  std::string key;  // "resolution"
  std::string label;
  std::string unit;
  std::vector<SettingChoice> choices;  // empty: a number from minimum to maximum
  double minimum = 0, maximum = 0;
  std::string default_value;  // default value
};

struct RangeNoise {
  double range_m = 0;
  double reflectivity = 0;
  double sigma_m = 0;
};

// How the instrument answers to more than one surface in its beam (physics.md §4.3, §4.4).
struct Waveform {
  double pulse_width_s = 0;      // FWHM; time of flight
  double fine_wavelength_m = 0;  // L: half of the finest tone's modulation wavelength; phase shift
  double field_of_view_rad = 0;  // of a phase-shift receiver, full angle; 0 = it sees nothing beside the beam
  int max_returns = 1;           // that are reported of one pulse; the strongest where it is one
};

// How the sheet's noise is spread over columns and rows (§3.5). The shares are of the sheet's variance, so that its σ
// stays: what they leave is white. column_extra and the wobble come on top of the sheet.
struct CorrelatedNoise {
  double column_fraction = 0;       // common to all pulses of a column
  double along_fraction = 0;        // with long memory along a column
  double column_correlation = 0;    // ρ of one column to the next: AR(1)
  double hurst = 0.5;               // H of the part along a column; 0.5 = no memory
  double column_extra_m = 0;        // σ of another part common to a column, with the same ρ
  double wobble_m = 0;              // p in p sin(2πk v + φ_j): range, along the mirror's turn v
  int wobble_order = 1;             // k
  double elevation_wobble_rad = 0;  // the same sine's amplitude in elevation
  double azimuth_flicker_rad = 0;   // σ, one value for each column
  double clock_jitter_s = 0;        // σ of a pulse's time stamp: moves it along the turn of the head
};

// A receiver that gets too much light (§4.9).
struct Saturation {
  double level_db = 0;           // 10 lg x from which it saturates
  double walk_m_per_decade = 0;  // range bias b lg(x / x_sat) above that
  double pedestal = 0;           // share of the beam's power in its wide wings: the halo of a reflector
};

// How much longer a range is with little light than with much (§4.10), by received power: linear between the powers,
// constant beyond them.
struct RangeOffset {
  std::vector<double> power_db;  // 10 lg x, rising, at most kMostOffsets; empty = there is none
  std::vector<double> offset_m;  // one for each
};
constexpr std::size_t kMostOffsets = 4;

// How the amplitude of a return strays (docs/explanation/scanning.md).
struct AmplitudeNoise {
  double aperture_m = 0;  // diameter of the receiver's opening: over it speckle is averaged
  double jitter = 0;      // 1 σ of a strong return as a share of it: the pulse's energy, the detector's gain
};

// A measured amplitude over range, where the near range is no simple law: below `below_m` that polynomial, in dB.
struct NearRangeCurve {
  double below_m = 0;                // 0 = there is none
  std::vector<double> amplitude_db;  // coefficients of 1, R, R² …, R in m
  double far_db = 0;                 // beyond, the amplitude is far_db - 20 lg R
};

// What the instrument's own filters find fault with; 0 = it has no such filter.
struct PointFilters {
  double deviation_m = 0;  // σ of the ranges in one echo: a mixed point
  double weak_factor = 0;  // less received power than that times the least that is detected
  bool overload = false;   // more than the receiver can measure
  bool operator==(const PointFilters&) const = default;
};

// What takes its pictures.
struct PanoramaCamera {
  std::uint32_t columns = 0;  // of the panorama that is delivered
  int shots = 1;              // around the horizon, each with its own exposure …
  bool hdr = false;           // … unless brackets make one of all
  double offset_up_m = 0;     // of the camera above the laser's centre
  // What the settings choose.
  bool metered = true;  // each exposure follows what its shot sees; else all are alike
  double stops = 0;     // of all exposures: +1 is twice the light
  double warmth = 0;    // of the white balance: 1 = warm, -1 = cold
  double flash = 0;     // share of its full light
};

// What tells an instrument on a tripod how far it leans.
struct Compensator {
  std::string kind;              // "liquid", "inclinometer", "imu" or "self_levelling"
  double range_rad = 0;          // of the tilt that it corrects; 0 = no limit is known
  double accuracy_rad = 0;       // 1 σ of each of its two axes
  double reduced_range_rad = 0;  // up to here it still works, less well; 0 = there is no such range
  double reduced_accuracy_rad = 0;
};

// What turns on an instrument that is carried or driven: laser heads that sweep whole turns, each with its channels.
struct MovingHead {
  std::string mount;  // what carries it: "hand", "body", "vehicle", "aircraft" or "any"
  int heads = 1;
  std::vector<double> channel_elevations_rad;       // of one head, in the order in which they fire
  double points_per_s = 0;                          // of all heads, one return each
  double min_rotation_hz = 0, max_rotation_hz = 0;  // 0 and 0: a beam that does not turn, along the head's x
  double second_rotation_hz = 0;                    // of the head about another axis; 0 = none
  double turn_rad = 0;                              // the part of a turn that is measured …
  double turn_middle_rad = 0;                       // … and its middle, counter-clockwise from the head's x
  double start_rad = 0;  // where a turn begins, counter-clockwise; it goes clockwise seen from above
  // All channels fire once in a firing; 0: a setting says how many firings there are.
  double firing_s = 0, first_channel_s = 0, channel_s = 0;
  std::vector<double> azimuth_offsets_rad;  // of the channels, as the turn goes; repeated; empty = none
  std::vector<double> channel_heights_m;    // of the channels' beam origins along the head's axis; empty = 0
  double beam_radius_m = 0;                 // about the axis, from which ranges are measured
  std::vector<double> tilts_rad;            // of each head about the device's y: forward; empty = upright
  std::vector<double> forward_m, up_m;      // of each head in the device; empty = 0
  double cloud_accuracy_m = 0;              // of a whole cloud with the maker's trajectory, 1 σ; 0 = not stated
  // Above which the device tells whoever carries it to slow down; 0 = it does not.
  double most_speed_mps = 0, most_turn_radps = 0;
};

// An instrument from scanners/instruments/<id>.json: data, no code.
struct Instrument {
  std::string id, maker, model;
  std::string technology;  // "time_of_flight" or "phase_shift"
  double wavelength_nm = 0;
  double divergence_rad = 0;   // full angle, 1/e²
  double exit_diameter_m = 0;  // 1/e²
  double min_range_m = 0, max_range_m = 0;
  double reference_reflectivity = 0;  // at which max_range_m holds
  double min_elevation_rad = 0, max_elevation_rad = 0;
  double angle_sigma_rad = 0;                   // accuracy of an angle: systematic part and jitter together
  double angle_jitter_rad = 0;                  // the part that differs from pulse to pulse
  double range_bias_m = 0, range_bias_ppm = 0;  // accuracy: systematic, drawn once per scan
  std::vector<RangeNoise> range_noise;          // 1 σ on a plane
  double noise_knee_m = 0;  // of a sheet with one figure: where σ on white is √2 of the floor; …
                            // … 0 = as the technology's class has it
  double near_range_m = 0;  // η_opt = 1 / (1 + (near_range / R)^power), physics.md §2.2; 0 = none
  int near_range_power = 2;
  NearRangeCurve near_range_curve;                     // instead of these two, where there is one
  double detection_softness = 0;                       // σ of the detection threshold as a share of it, §2.7
  double intensity_low_db = 0, intensity_high_db = 0;  // 10 lg x that is stored as 0 and as 1
  int intensity_levels = 0;                            // quantisation of the stored intensity
  RangeOffset range_offset;
  AmplitudeNoise amplitude;
  double sun_noise = 0;  // variance that 1000 W/m² on a white surface head-on add to the dark receiver's, in its units
  double unambiguous_m = 0;  // of a phase-shift instrument: longer ranges are folded by it; 0 = none is known
  PointFilters filters;
  double mirror_max_hz = 0;      // 0 = no published limit
  double column_factor = 1;      // share of measured columns that the device adds beyond the grid (overlap)
  double overhead_s = 0;         // spin-up and saving, part of scan_seconds
  double trunnion_height_m = 0;  // of the tilting axis above the tripod plate
  double tripod_height_m = 0;    // default height of the axis above the ground
  double imaging_seconds = 0;
  PanoramaCamera camera;
  std::vector<InstrumentSetting> settings;
  std::map<std::string, Evidence> evidence;  // by JSON pointer
  Waveform waveform;
  CorrelatedNoise correlated;
  Saturation saturation;
  std::optional<Compensator> compensator;
  std::optional<MovingHead> moving;  // then it has no mirror, stand and pictures, and scanning needs a trajectory
};

Result<Instrument> readInstrument(const std::filesystem::path& file);
// The files of a folder that should hold an instrument each, sorted.
Result<std::vector<std::filesystem::path>> instrumentFiles(const std::filesystem::path& folder);
// Every *.json of the folder, by id. An unknown key, a missing source or a figure out of its unit's range is an error
// with file and JSON pointer.
Result<std::vector<Instrument>> readInstruments(const std::filesystem::path& folder);

using SettingValues = std::vector<std::pair<std::string, std::string>>;  // key, value, in the device's words

// What a scan with these settings does: the grid, the time, the noise. Refused settings name what the device allows.
// Column j looks along azimuth_from + j · step, clockwise from +X of the scanner's frame; row i along the middle of the
// i-th of `rows` equal steps from elevation_from up to elevation_to.
struct ScanSettings {
  SettingValues values;  // complete: defaults filled in, in the instrument's order
  std::uint32_t columns = 0, rows = 0;
  double azimuth_from_rad = 0, azimuth_to_rad = 0;
  double elevation_from_rad = 0, elevation_to_rad = 0;
  double max_range_m = 0, reference_reflectivity = 0;  // the instrument's own, or those of the chosen range mode
  double noise_factor = 1;
  int passes = 1;     // 2 = double scan
  bool laser = true;  // false: pictures only
  bool imaging = false;
  double unambiguous_m = 0;              // the instrument's own, or that of the chosen rate
  PointFilters drops;                    // by these filters points are dropped; others of the instrument only flag them
  double nearest_m = 0, farthest_m = 0;  // the user's gate on the measured range; 0 = none
  PanoramaCamera camera;                 // the instrument's, as the settings have it
  double scan_seconds = 0, imaging_seconds = 0;  // of the real instrument
  double rotation_hz = 0, firing_s = 0;          // of an instrument that moves, which has no grid
};
// Of an instrument that stands.
Result<ScanSettings> resolveSettings(const Instrument& instrument, const SettingValues& values);
// Of one that is carried: neither grid nor time, which its way decides.
Result<ScanSettings> resolveMovingSettings(const Instrument& instrument, const SettingValues& values);

}  // namespace standpoint
