// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/proofs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/decompositions.h"
#include "core/units.h"
#include "emulated-ui/hand_over.h"
#include "emulated-ui/rehearsal/all_setups.h"
#include "emulated-ui/rehearsal/field_proofs.h"
#include "emulated-ui/rehearsal/office_cleaning.h"
#include "emulated-ui/rehearsal/part_proofs.h"
#include "emulated-ui/rehearsal/survey_proofs.h"
#include "pointclouds/formats.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

double percentile(std::vector<float>& values, double fraction) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

constexpr std::size_t kMostKept = 4000000;  // of a scan's points; a larger one is thinned

// Holds each point against what is known of it.
class TruthReader final : public PointSink {
 public:
  Result<void> begin(const ScanHeader& header) override {
    const auto cells = static_cast<std::size_t>(header.rows) * header.columns;
    step_ = cells / kMostKept + 1;
    up_ = header.file_from_scanner.rotation * Eigen::Vector3d::UnitZ();
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    points_ += static_cast<double>(block.size());
    const auto& t = block.truth;
    if (t.flags.empty()) return {};
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto flags = t.flags[i];
      mixed_ += (flags & point_flag::kMixed) != 0;
      mirrored_ += (flags & point_flag::kMirrored) != 0;
      weather_ += (flags & point_flag::kWeather) != 0;
      moving_ += (flags & point_flag::kMoving) != 0;
      if (flags != 0 || (seen_++ % step_) != 0) continue;
      const Eigen::Vector3f p(block.x_m[i], block.y_m[i], block.z_m[i]), q(t.x_m[i], t.y_m[i], t.z_m[i]);
      range_.push_back(p.norm() - t.range_m[i]);
      place_.push_back((p - q).norm());
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  // A normal σ from the median of the absolute errors about their own median: a constant offset is no noise.
  double sigma_m() {
    const auto offset = static_cast<float>(percentile(range_, 0.5));
    for (float& r : range_) r = std::abs(r - offset);
    return 1.4826 * percentile(range_, 0.5);
  }
  std::map<std::string, double> figures() {
    const auto fraction = [&](double n) { return points_ > 0 ? n / points_ : 0; };
    return {{"data.points", points_},
            {"data.noise", sigma_m() * 1000},
            {"data.error", percentile(place_, 0.95) * 1000},
            {"data.mixed", fraction(mixed_)},
            {"data.mirrored", fraction(mirrored_)},
            {"data.weather", fraction(weather_)},
            {"data.moving", fraction(moving_)}};
  }
  const Eigen::Vector3d& up() const { return up_; }

 private:
  std::size_t step_ = 1, seen_ = 0;
  double points_ = 0, mixed_ = 0, mirrored_ = 0, weather_ = 0, moving_ = 0;
  std::vector<float> range_, place_;
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();
};

std::map<std::string, double> readData(const StoredSetup& setup, const Document& document) {
  Progress quiet;
  TruthReader reader;
  const auto* format = cloudFormatFor(setup.file);
  if (format == nullptr || !format->read(setup.file, reader, quiet)) return {};
  auto figures = reader.figures();
  // How far the delivered cloud leans against the world: its pose against the true one.
  for (const auto& station : document.job->stations)
    if (station.name == setup.station) {
      const auto stood = leaning(station.true_pose.rotation, setup.stood_x_deg, setup.stood_y_deg);
      const Eigen::Vector3d true_up = stood * Eigen::Vector3d::UnitZ();
      figures["data.tilt"] = std::acos(std::clamp(true_up.dot(reader.up()), -1.0, 1.0)) / kRadPerDeg;
    }
  return figures;
}

std::string settingsText(const SettingValues& values) {
  std::string text;
  for (const auto& [key, value] : values) text += key + "=" + value + " ";
  return text;
}

// What the verb `plan` says of the stations that were scanned from, with the settings of the newest scan.
std::map<std::string, double> readPlan(const Device& device, const Document& document,
                                       const std::vector<std::string>& stations) {
  if (!document.imported) return {};
  const auto* newest = device.newestSetup();
  PlanOptions options;
  options.stations.names = stations;
  options.instrument = device.type().instrument.id;
  options.settings = newest->settings;
  options.samples = 10000;
  Progress quiet;
  const auto planned = runPlan(document, options, quiet);
  if (!planned) return {};
  std::map<std::string, double> figures;
  figures["plan.coverage"] = planned->answer.coverage;
  double least = 1;
  // Each station needs one good neighbour.
  std::map<std::string, double> best;
  for (const auto& pair : planned->answer.pairs)
    for (const auto& side : {pair.a, pair.b}) {
      double& overlap = best[side];
      overlap = std::max(overlap, pair.overlap);
    }
  for (const auto& [station, overlap] : best) least = std::min(least, overlap);
  figures["plan.overlap"] = best.empty() ? 0 : least;
  return figures;
}

// Σ of the targets' places: how wide they lie along their three principal directions.
Eigen::Vector3d spreadOf(const std::vector<Target>& targets) {
  if (targets.size() < 2) return Eigen::Vector3d::Zero();
  const auto count = static_cast<double>(targets.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& t : targets) middle += (t.centre - targets[0].centre) / count;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto& t : targets) {
    const Eigen::Vector3d off = t.centre - targets[0].centre - middle;
    moments += off * off.transpose() / count;
  }
  return principalAxes(moments).values.cwiseMax(0).cwiseSqrt().reverse();
}

double heightSpread(const std::vector<Target>& targets) {
  if (targets.empty()) return 0;
  const auto [low, high] = std::minmax_element(
      targets.begin(), targets.end(), [](const Target& a, const Target& b) { return a.centre.z() < b.centre.z(); });
  return high->centre.z() - low->centre.z();
}

// Least number of targets that two setups after another both found.
double commonTargets(const Device& device) {
  const auto setups = allSetups(device);
  double least = setups.size() < 2 ? 0 : std::numeric_limits<double>::max();
  for (std::size_t i = 1; i < setups.size(); ++i) {
    double common = 0;
    for (const auto& a : setups[i - 1]->targets)
      for (const auto& b : setups[i]->targets) common += a.found && b.found && a.name == b.name ? 1 : 0;
    least = std::min(least, common);
  }
  return least;
}

// Over all targets that were fitted; without any the fact is not there.
template <class Value>
std::optional<Fact> over(const Device& device, double start, Value value) {
  std::optional<double> result;
  for (const auto* s : allSetups(device))
    for (const auto& t : s->targets)
      if (t.found) result = value(result.value_or(start), t);
  return factOf(result);
}

std::optional<Fact> worstTrueLink(const Device& device) {
  std::optional<double> worst;
  for (const auto* s : allSetups(device))
    if (s->link && s->link->joined) worst = std::max(worst.value_or(0), s->link->true_error_m * 1000);
  return factOf(worst);
}

double linksThat(const Device& device, bool joined) {
  double n = 0;
  for (const auto* s : allSetups(device)) n += s->link && s->link->joined == joined ? 1 : 0;
  return n;
}

std::optional<Fact> leastOverlap(const Device& device) {
  std::optional<double> least;
  for (const auto* s : allSetups(device))
    if (s->link && s->link->joined) least = std::min(least.value_or(1), s->link->overlap);
  return factOf(least);
}

double goodCopies(const Device& device, const fs::path& folder) {
  double good = 0;
  for (const auto* s : allSetups(device)) good += isHandedOver(*s, officeBeside(folder / "scans")) ? 1 : 0;
  return good;
}

}  // namespace

const std::vector<ProofRow>& proofRows() {
  static const std::vector<ProofRow> kRows = {
      {"data.points", "", numbers(0, 1e12), "points of the newest scan"},
      {"data.noise", "mm", numbers(0, 1e6), "σ of the range against the truth in the newest scan"},
      {"data.error", "mm", numbers(0, 1e6), "95th percentile of the point position errors"},
      {"data.tilt", "°", numbers(0, 90), "tilt of the delivered cloud"},
      {"data.mixed", "", numbers(0, 1), "fraction of points between two surfaces"},
      {"data.mirrored", "", numbers(0, 1), "fraction of points seen in a mirror or pane"},
      {"data.weather", "", numbers(0, 1), "fraction of points on drops, flakes or fog"},
      {"data.moving", "", numbers(0, 1), "fraction of points on moving objects"},
      {"plan.coverage", "", numbers(0, 1), "fraction of surfaces covered by the scans"},
      {"plan.overlap", "", numbers(0, 1), "smallest overlap of a setup with its best neighbour"},
      {"targets.count", "", numbers(0, 1e4), "targets in place"},
      {"targets.spread", "m", numbers(0, 1e4), "spread of the targets along their longest direction (σ)"},
      {"targets.width", "m", numbers(0, 1e4), "spread across it (σ); near zero if collinear"},
      {"targets.heights", "m", numbers(0, 1e4), "height difference between highest and lowest target"},
      {"targets.common", "", numbers(0, 1e4), "smallest number of targets common to two consecutive setups"},
      {"targets.points", "", numbers(0, 1e9), "lowest number of points on a found target"},
      {"targets.residual", "mm", numbers(0, 1e6), "largest fit residual"},
      {"targets.error", "mm", numbers(0, 1e6), "largest error of a fitted centre"},
      {"links.joined", "", numbers(0, 1e4), "accepted links"},
      {"links.failed", "", numbers(0, 1e4), "links not found"},
      {"links.overlap", "", numbers(0, 1), "smallest overlap of a joined link"},
      {"links.error", "mm", numbers(0, 1e6), "largest true error of a joined link"},
      {"office.copies", "", numbers(0, 1e4), "complete copies in the office"},
      {"cleaning.recall", "", numbers(0, 1), "fraction of the points on moving objects that cleaning removed"},
      {"cleaning.precision", "", numbers(0, 1), "fraction of the removed points that are not on a static surface"},
      {"cleaning.lost", "", numbers(0, 1), "fraction of the points on static surfaces that cleaning removed"},
      {"survey.walls", "", numbers(0, 1), "fraction of the area's walls seen at 60° incidence or less"},
      {"survey.coverage", "", numbers(0, 1), "fraction of the area's surfaces covered by a station"},
      {"survey.reached", "", numbers(0, 1), "fraction of all surfaces visible from the area that a station covers"},
      {"survey.overlap", "", numbers(0, 1), "smallest overlap of a station with its best neighbour"},
      {"survey.stations", "", numbers(0, 1e4), "stations in place"},
  };
  static const std::vector<ProofRow> rows = [] {
    auto all = kRows;
    all.insert(all.end(), fieldProofRows().begin(), fieldProofRows().end());
    all.insert(all.end(), walkProofRows().begin(), walkProofRows().end());
    return all;
  }();
  return rows;
}

std::optional<Fact> Proofs::fact(const std::string& name, const Exercise& exercise, const Device& device,
                                 const Document& document, const fs::path& folder) {
  if (auto own = namedProof(name, exercise, device, document)) return own;
  if (partFigure(name, exercise)) {
    std::string of = "files:";
    for (const auto* s : allSetups(device)) of += s->file + ";";
    if (parts_of_ != of) parts_ = readParts(exercise, device, document), parts_of_ = of;
    const auto found = parts_.find(name);
    return found == parts_.end() ? std::nullopt : std::optional(numberFact(found->second));
  }
  if (isCleaningFact(name)) {
    const auto office = officeBeside(folder / "scans");
    std::error_code error;
    const auto written = fs::last_write_time(cleanedIn(office), error);
    const auto of = error ? "none" : fmt::format("{}", written.time_since_epoch().count());
    if (cleaning_of_ != of) cleaning_ = readCleaning(office), cleaning_of_ = of;
    const auto found = cleaning_.find(name);
    return found == cleaning_.end() ? std::nullopt : std::optional(numberFact(found->second));
  }
  const auto& rows = proofRows();
  if (std::none_of(rows.begin(), rows.end(), [&](const ProofRow& row) { return name == row.name; }))
    return std::nullopt;
  const auto* newest = device.newestSetup();
  if (name.starts_with("data.")) {
    if (newest == nullptr) return std::nullopt;
    if (data_of_ != newest->file) data_ = readData(*newest, document), data_of_ = newest->file;
    const auto found = data_.find(name);
    return found == data_.end() ? std::nullopt : std::optional(numberFact(found->second));
  }
  if (name.starts_with("plan.")) {
    if (newest == nullptr) return std::nullopt;
    std::vector<std::string> names;
    for (const auto* s : allSetups(device))
      if (std::find(names.begin(), names.end(), s->station) == names.end()) names.push_back(s->station);
    const auto of = fmt::format("{} {}", fmt::join(names, ","), settingsText(newest->settings));
    if (plan_of_ != of) plan_ = readPlan(device, document, names), plan_of_ = of;
    const auto found = plan_.find(name);
    return found == plan_.end() ? std::nullopt : std::optional(numberFact(found->second));
  }
  if (name.starts_with("survey.")) {
    std::string of = settingsText(device.state().settings);
    double count = 0;
    if (document.job)
      for (const auto& s : document.job->stations) {
        of += fmt::format("{} {} {} {};", s.name, s.true_pose.translation.x(), s.true_pose.translation.y(),
                          s.true_pose.translation.z());
        count += 1;
      }
    if (name == "survey.stations") return numberFact(count);
    if (survey_of_ != of) survey_ = readSurvey(exercise, device, document, survey_reach_), survey_of_ = of;
    const auto found = survey_.find(name);
    return found == survey_.end() ? std::nullopt : std::optional(numberFact(found->second));
  }
  if (auto field = fieldProof(name, device, document)) return field;
  const auto& targets = document.job ? document.job->targets : std::vector<Target>();
  if (name == "targets.count") return numberFact(static_cast<double>(targets.size()));
  if (name == "targets.spread") return numberFact(spreadOf(targets)[0]);
  if (name == "targets.width") return numberFact(targets.size() < 3 ? 0 : spreadOf(targets)[1]);
  if (name == "targets.heights") return numberFact(heightSpread(targets));
  if (name == "targets.common") return numberFact(commonTargets(device));
  if (name == "targets.points")
    return over(device, 1e9,
                [](double r, const FittedTarget& t) { return std::min(r, static_cast<double>(t.points)); });
  if (name == "targets.residual")
    return over(device, 0, [](double r, const FittedTarget& t) { return std::max(r, t.residual_m * 1000); });
  if (name == "targets.error")
    return over(device, 0, [](double r, const FittedTarget& t) { return std::max(r, t.error_m * 1000); });
  if (name == "links.joined") return numberFact(linksThat(device, true));
  if (name == "links.failed") return numberFact(linksThat(device, false));
  if (name == "links.overlap") return leastOverlap(device);
  if (name == "links.error") return worstTrueLink(device);
  return name == "office.copies" ? std::optional(numberFact(goodCopies(device, folder))) : std::nullopt;
}

}  // namespace standpoint
