// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/forecast.h"

#include <algorithm>
#include <map>

#include "project/dataset/cloud_size.h"
#include "project/dataset/set_environment.h"
#include "scanners/forecast/scan_forecast.h"
#include "survey/instruments.h"
#include "survey/scanning/scan_world.h"
#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

constexpr double kBytesOfId = 2, kBytesOfInstance = 4, kBytesOfArrayHead = 128;

// Points of each class of each map, by split.
using ClassPoints = std::map<std::string, std::vector<std::vector<double>>>;

class SetForecaster {
 public:
  SetForecaster(const Recipe& recipe, std::size_t samples) : recipe_(recipe), samples_(samples) {
    // What differs in nothing that a forecast knows is forecast once.
    each_ = recipe.weather.size() * recipe.seeds.size() * recipe.effects.size();
    for (const auto& fault : recipe.field_faults) faults_ += fault.fault.until_fraction;
  }

  Result<SetForecast> make(Report& report, Progress& progress) {
    const auto count = static_cast<double>(recipe_.environments.size());
    for (std::size_t e = 0; e < recipe_.environments.size(); ++e) {
      progress.stage("Forecast " + recipe_.environments[e].id, static_cast<double>(e) / count,
                     static_cast<double>(e + 1) / count);
      TRY(environment(e, report, progress));
    }
    addClasses();
    return std::move(forecast_);
  }

 private:
  Result<void> environment(std::size_t index, Report& report, Progress& progress) {
    const auto& environment = recipe_.environments[index];
    Progress inner;  // its stages are not those of the whole
    inner.onChange([&] {
      if (progress.cancelled()) inner.cancel();
    });
    TRY_ASSIGN(const auto opened, openEnvironment(recipe_, index, report, inner));
    SetEnvironmentForecast row{environment.id, environment.building, recipe_.splitOf(environment),
                               opened.station.size(), opened.document.job->stations.size()};
    for (const auto& text : opened.unmapped)
      if (std::find(forecast_.unmapped.begin(), forecast_.unmapped.end(), text) == forecast_.unmapped.end())
        forecast_.unmapped.push_back(text);
    TRY_ASSIGN(const auto samples, sampleSurfaces(*opened.scene, samples_, recipe_.seed, inner));
    auto& points = points_[row.split];
    if (points.empty())
      for (const auto& map : recipe_.classes) points.emplace_back(map.map.classes.size(), 0);
    for (const auto& materials : recipe_.materials) {
      TRY_ASSIGN(const auto document, withMaterials(opened.document, materials, inner));
      TRY_ASSIGN(const auto preparation, prepareScan(document, opened.scene, inner));
      for (const auto& instrument : recipe_.instruments) {
        TRY(progress.check());
        TRY(scans(opened, document, preparation, instrument, samples, points, row, inner));
      }
    }
    forecast_.scans += row.scans;
    forecast_.points += row.points;
    forecast_.instrument_seconds += row.instrument_seconds;
    forecast_.bytes += row.bytes;
    forecast_.environments.push_back(std::move(row));
    return {};
  }

  Result<void> scans(const SetEnvironment& opened, const Document& document,
                     const std::shared_ptr<const ScanPreparation>& preparation, const RecipeInstrument& setting,
                     const SurfaceSamples& samples, std::vector<std::vector<double>>& points,
                     SetEnvironmentForecast& row, Progress& progress) {
    TRY_ASSIGN(const auto instrument, instrumentNamed(setting.instrument));
    TRY_ASSIGN(const auto settings, resolveSettings(instrument, setting.settings));
    const std::shared_ptr<const MaterialAssignment> assignment(document.materials,
                                                               &document.materials->result.assignment);
    const Expectation expectation(opened.scene, assignment, ReturnLaw(instrument, settings));
    const auto arrays = static_cast<double>(recipe_.classes.size());
    const double label = kBytesOfId * arrays + kBytesOfInstance, head = kBytesOfArrayHead * (arrays + 1);
    const double times = static_cast<double>(each_) * faults_;
    const auto count = each_ * recipe_.field_faults.size();
    const double cells = static_cast<double>(settings.rows) * settings.columns;
    const auto& stations = document.job->stations;
    std::vector<ScanForecast> forecasts;
    for (const auto& station : stations) forecasts.push_back(forecastScan(expectation, station.true_pose, samples, {}));
    const auto most = std::max_element(forecasts.begin(), forecasts.end(),
                                       [](const auto& a, const auto& b) { return a.points < b.points; });
    TRY_ASSIGN(const auto size, measureCloudSize(recipe_, setting, document,
                                                 stations[static_cast<std::size_t>(most - forecasts.begin())],
                                                 preparation, most->points, progress));
    for (std::size_t k = 0; k < stations.size(); ++k) {
      const auto& scan = forecasts[k];
      row.scans += count;
      row.points += scan.points * times;
      row.instrument_seconds += scan.seconds * times;
      row.bytes += static_cast<double>(count) * (size.of(cells, 0) + head) + scan.points * times * (size.point + label);
      addBalance(*document.environment(), samples, stations[k].true_pose, settings, scan, times, points);
    }
    return {};
  }

  // Each sample stands for as many points as fit on its area; all together for those of the scan.
  void addBalance(const Environment& environment, const SurfaceSamples& samples, const Pose& pose,
                  const ScanSettings& settings, const ScanForecast& scan, double times,
                  std::vector<std::vector<double>>& points) const {
    std::vector<double> weights(samples.samples.size(), 0);
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (scan.seen[k] == 0) continue;
      const double spacing = spacingAt(settings, pose, samples.samples[k].place);
      if (spacing > 0) sum += weights[k] = 1 / (spacing * spacing);
    }
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k] == 0) continue;
      const auto& sample = samples.samples[k];
      const bool above = sample.place.position.z() > pose.translation.z();
      for (std::size_t m = 0; m < recipe_.classes.size(); ++m) {
        const auto of_point = recipe_.classes[m].map.classesOf(environment.products[sample.product].ifc_class);
        points[m][of_point[above]] += scan.points * times * weights[k] / sum;
      }
    }
  }

  void addClasses() {
    for (std::size_t m = 0; m < recipe_.classes.size(); ++m)
      for (const auto& split : recipe_.splits) {
        const auto found = points_.find(split.name);
        if (found == points_.end()) continue;
        const auto& classes = recipe_.classes[m].map.classes;
        double all = 0;
        for (std::size_t k = 0; k < classes.size(); ++k) all += classes[k].ignored ? 0 : found->second[m][k];
        for (std::size_t k = 0; k < classes.size(); ++k) {
          if (classes[k].ignored) continue;
          const double points = found->second[m][k], share = all > 0 ? points / all : 0;
          forecast_.classes.push_back(
              {recipe_.classes[m].id, split.name, classes[k].name, points, share, share < recipe_.starved_below});
        }
      }
  }

  const Recipe& recipe_;
  std::size_t samples_;
  std::size_t each_ = 1;
  double faults_ = 0;  // how many whole scans the faults leave
  ClassPoints points_;
  SetForecast forecast_;
};

}  // namespace

Result<SetForecast> forecastSet(const Recipe& recipe, std::size_t samples, Report& report, Progress& progress) {
  return SetForecaster(recipe, samples).make(report, progress);
}

}  // namespace standpoint
