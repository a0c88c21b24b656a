// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/set_run.h"

#include <algorithm>
#include <chrono>
#include <map>

#include <fmt/format.h>

#include "core/sha256.h"
#include "project/dataset/label_sink.h"
#include "project/dataset/set_environment.h"
#include "project/dataset/set_folder.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

// A stage of the whole whose work has stages of its own.
class InnerProgress {
 public:
  InnerProgress(Progress& outer, const std::string& name, double from, double to) {
    outer.stage(name, from, to);
    inner_.onChange([this, &outer] {
      outer.advance(inner_.fraction());
      if (outer.cancelled()) inner_.cancel();
    });
    if (outer.cancelled()) inner_.cancel();
  }
  Progress& operator*() { return inner_; }

 private:
  Progress inner_;
};

class SetRun {
 public:
  SetRun(const Recipe& recipe, const SetRunOptions& options, SetFolder folder, Report& report)
      : recipe_(recipe),
        options_(options),
        folder_(std::move(folder)),
        report_(report),
        variants_(variantsOf(recipe)),
        places_(placesOf(recipe, options.shard.value_or(Shard()))) {}

  Result<SetRunCount> run(Progress& progress) {
    TRY(checkEarlier());
    count_.places = places_.size();
    for (std::size_t first = 0; first < places_.size();) {
      std::size_t next = first;
      while (next < places_.size() && places_[next].environment == places_[first].environment) ++next;
      if (auto done = environment(first, next, progress); !done) return withHint(done.error());
      first = next;
    }
    return count_;
  }

 private:
  double fraction(std::size_t place) const {
    return static_cast<double>(place) / static_cast<double>(std::max<std::size_t>(places_.size(), 1));
  }

  // What an earlier run made is never thrown away unasked.
  Result<void> checkEarlier() const {
    if (options_.resume) return {};
    std::error_code error;
    for (const auto& place : places_)
      for (const auto& variant : variants_)
        if (fs::exists(folder_.path() / filesOf(recipe_, place, variant).record, error))
          return failure(ErrorKind::usage, "has scans of this recipe already: resume the run, or choose a new folder",
                         options_.set.string());
    return {};
  }

  tl::unexpected<Error> withHint(Error error) const {
    const auto made = count_.scans - count_.resumed;
    if (made > 0)
      error.message +=
          fmt::format("; {} scan{} made and kept; resume the run to continue", made, made == 1 ? " was" : "s were");
    return failure(std::move(error));
  }

  // All scans at these places are there: neither model nor ray scene is needed.
  bool isFinished(std::size_t first, std::size_t next) {
    if (!options_.resume) return false;
    const auto record = readEnvironmentRecord(folder_.path(), recipe_.environments[places_[first].environment]);
    std::error_code error;
    if (!record || fs::file_size(folder_.path() / record->picture.path, error) != record->picture.bytes || error)
      return false;
    SetRunCount found;
    for (std::size_t k = first; k < next; ++k) {
      const auto& none = record->without_room;
      if (std::find(none.begin(), none.end(), places_[k].station) != none.end()) {
        ++found.without_room;
        continue;
      }
      for (const auto& variant : variants_) {
        const auto scan = finishedScan(folder_.path(), recipe_, filesOf(recipe_, places_[k], variant));
        if (!scan) return false;
        take(*scan, found);
      }
    }
    count_.scans += found.scans;
    count_.resumed += found.scans;
    count_.points += found.points;
    count_.bytes += found.bytes;
    count_.without_room += found.without_room;
    return true;
  }

  static void take(const SetRecord& record, SetRunCount& count) {
    ++count.scans;
    count.points += record.points;
    for (const auto& file : record.files) count.bytes += file.bytes;
  }

  Result<void> environment(std::size_t first, std::size_t next, Progress& progress) {
    const auto index = places_[first].environment;
    if (isFinished(first, next)) return {};
    std::optional<SetEnvironment> opened;
    {
      InnerProgress opening(progress, "Open " + recipe_.environments[index].id, fraction(first), fraction(first));
      TRY_ASSIGN(opened, openEnvironment(recipe_, index, report_, *opening));
    }
    TRY(folder_.begin(recipe_));
    constexpr const char* kChanged = "this environment has changed since the set was begun: choose a new folder";
    TRY(folder_.putSame(pictureFile(recipe_.environments[index]), opened->picture, kChanged));
    TRY(folder_.putSame(environmentFile(recipe_.environments[index]), opened->described, kChanged));
    std::size_t begin = 0;  // of the environment in the order of all places
    while (placesInOrder()[begin].environment != index) ++begin;
    for (std::size_t v = 0; v < variants_.size();) {  // variants with the same materials follow each other
      std::size_t end = v;
      while (end < variants_.size() && variants_[end].materials == variants_[v].materials) ++end;
      TRY(withOneMaterial(*opened, begin, first, next, v, end, progress));
      v = end;
    }
    return {};
  }

  const std::vector<SetPlace>& placesInOrder() {
    if (all_.empty()) all_ = placesOf(recipe_);
    return all_;
  }

  Result<void> withOneMaterial(const SetEnvironment& opened, std::size_t begin, std::size_t first, std::size_t next,
                               std::size_t v, std::size_t end, Progress& progress) {
    const bool first_materials = v == 0;
    std::optional<Document> document;
    std::shared_ptr<const ScanPreparation> preparation;
    for (std::size_t k = first; k < next; ++k) {
      const auto station = opened.station[numberOf(places_[k], begin)];
      if (!station) {
        count_.without_room += first_materials;
        continue;
      }
      for (std::size_t i = v; i < end; ++i) {
        TRY(progress.check());
        const auto files = filesOf(recipe_, places_[k], variants_[i]);
        if (options_.resume) {
          if (const auto record = finishedScan(folder_.path(), recipe_, files)) {
            take(*record, count_);
            ++count_.resumed;
            continue;
          }
        }
        if (!preparation) {
          TRY_ASSIGN(document, withMaterials(opened.document, recipe_.materials[variants_[v].materials], progress));
          TRY_ASSIGN(preparation, prepareScan(*document, opened.scene, progress));
        }
        const double from = fraction(k), each = (fraction(k + 1) - from) / static_cast<double>(variants_.size());
        InnerProgress scanning(
            progress,
            fmt::format("Scan {} ({} of {})", files.scan, count_.scans + 1, places_.size() * variants_.size()),
            from + each * static_cast<double>(i), from + each * static_cast<double>(i + 1));
        TRY(scan(*document, preparation, document->job->stations[*station].name, k, i, files, *scanning));
      }
    }
    return {};
  }

  // Of a place in the order of its environment.
  std::size_t numberOf(const SetPlace& place, std::size_t begin) {
    const auto& all = placesInOrder();
    std::size_t k = begin;
    while (all[k].strategy != place.strategy || all[k].number != place.number) ++k;
    return k - begin;
  }

  ScanVerbOptions optionsOf(const SetPlace& place, const SetVariant& v, const std::string& station) const {
    const auto& instrument = recipe_.instruments[v.instrument];
    const auto& weather = recipe_.weather[v.weather];
    const auto& effects = recipe_.effects[v.effects];
    ScanVerbOptions options;
    options.stations.names = {station};
    options.instrument = instrument.instrument;
    options.settings = instrument.settings;
    options.seed = seedOf(recipe_, place, v);
    options.ideal = effects.ideal;
    options.without = effects.without;
    options.quality = recipe_.quality;
    options.weather = weather.weather;
    options.sun = weather.sun;
    options.interference = weather.interference;
    options.field_fault = recipe_.field_faults[v.fault].fault;
    options.truth = recipe_.truth;
    options.as = recipe_.as;
    options.threads = options_.threads;
    return options;
  }

  Result<void> scan(const Document& document, std::shared_ptr<const ScanPreparation> preparation,
                    const std::string& station, std::size_t place, std::size_t variant, const SetFiles& files,
                    Progress& progress) {
    const auto started = std::chrono::steady_clock::now();
    auto options = optionsOf(places_[place], variants_[variant], station);
    options.output = folder_.workFile(files.cloud);
    std::vector<fs::path> labels;
    for (const auto& file : files.labels) labels.push_back(folder_.workFile(file));
    const auto sink = std::make_shared<LabelSink>(recipe_.classes, labels, folder_.workFile(files.instances));
    ScanSurroundings company;
    company.preparation = std::move(preparation);
    company.watcher = sink;
    TRY_ASSIGN(const auto scanned, runScan(document, options, company, progress));
    for (const auto& issue : scanned.report.issues)
      if (issue.severity != Severity::note) report_.issues.push_back({issue.severity, files.scan, issue.message});
    const auto& row = scanned.answer.stations.front();
    SetRecord record{row.points, row.pulses, row.returns, row.instrument_seconds, options.seed, {}, {}};
    for (std::size_t m = 0; m < recipe_.classes.size(); ++m) record.classes[recipe_.classes[m].id] = sink->counts()[m];
    std::vector<fs::path> all = {files.cloud};
    all.insert(all.end(), files.labels.begin(), files.labels.end());
    all.push_back(files.instances);
    for (const auto& file : all) {
      const auto made = folder_.workFile(file);
      std::error_code error;
      TRY_ASSIGN(auto sum, sha256OfFile(made, progress));
      record.files.push_back({file.generic_string(), fs::file_size(made, error), std::move(sum)});
    }
    for (const auto& file : all) TRY(folder_.put(file));
    TRY(folder_.putText(files.record, textOf(record, recipe_, files.scan)));
    take(record, count_);
    count_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return {};
  }

  const Recipe& recipe_;
  const SetRunOptions& options_;
  SetFolder folder_;
  Report& report_;
  std::vector<SetVariant> variants_;
  std::vector<SetPlace> places_, all_;
  SetRunCount count_;
};

}  // namespace

Result<SetRunCount> runSet(const Recipe& recipe, const SetRunOptions& options, Report& report, Progress& progress) {
  TRY_ASSIGN(auto folder, SetFolder::open(options.set, recipe));
  return SetRun(recipe, options, std::move(folder), report).run(progress);
}

}  // namespace standpoint
