// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/import_preview.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <map>
#include <thread>
#include <utility>

#include "editor/words/words.h"

namespace standpoint {

namespace {

using nlohmann::json;

std::string doubtOf(const Eigen::Vector3d& size_m) {
  const double largest = size_m.maxCoeff();
  if (largest <= 0) return "The file contains no geometry";
  if (size_m.z() > 1000) return "Taller than any building. Check the unit: mm or in?";
  if (largest > 20000) return "Larger than a town. Check the unit (mm or in?) and look for misplaced products.";
  if (largest < 0.2) return "Smaller than a hand. Check the unit: is the file in m?";
  if (size_m.z() > 3 * std::max(size_m.x(), size_m.y()) && size_m.z() > 30)
    return "Much taller than wide. Check the up axis.";
  return {};
}

}  // namespace

json importOptions(const std::vector<std::filesystem::path>& files, const ImportOverrides& overrides) {
  json names = json::array();
  for (const auto& file : files) names.push_back(file.string());
  json options = {{"files", std::move(names)}, {"shift", overrides.shift.empty() ? "auto" : overrides.shift}};
  if (!overrides.unit.empty()) options["unit"] = overrides.unit;
  if (!overrides.up.empty()) options["up"] = overrides.up;
  if (!overrides.crs.empty()) options["crs"] = overrides.crs;
  if (overrides.types) options["types"] = true;
  return options;
}

ImportFacts factsOf(const Document& document, const Report& report) {
  ImportFacts facts;
  for (const auto& issue : report.issues) {
    facts.notes += issue.severity == Severity::note ? 1 : 0;
    facts.warnings += issue.severity == Severity::warning ? 1 : 0;
    facts.losses += issue.severity == Severity::loss ? 1 : 0;
  }
  if (!document.imported) return facts;
  const Environment& environment = *document.imported;
  std::map<std::string, ClassCount> classes;
  for (const auto& product : environment.products) ++classes[product.ifc_class].products;
  for (const auto& instance : environment.instances)
    classes[environment.products[instance.product].ifc_class].triangles +=
        environment.meshes[instance.mesh]->triangles.size();
  for (auto& [name, count] : classes) {
    count.ifc_class = name;
    facts.classes.push_back(count);
  }
  std::stable_sort(facts.classes.begin(), facts.classes.end(),
                   [](const ClassCount& a, const ClassCount& b) { return a.triangles > b.triangles; });
  facts.products = environment.products.size();
  facts.triangles = sceneTriangleCount(environment);
  facts.triangles_of_spaces = triangleCount(environment) - facts.triangles;
  facts.bounds_file_m = bounds(environment);
  if (!facts.bounds_file_m.empty()) {
    facts.size_m = facts.bounds_file_m.max - facts.bounds_file_m.min;
    if (document.georeference) {
      facts.bounds_file_m.min += document.georeference->shift_m;
      facts.bounds_file_m.max += document.georeference->shift_m;
    }
  }
  facts.doubt = doubtOf(facts.size_m);
  return facts;
}

std::string sizeText(const Eigen::Vector3d& size_m) {
  const double largest = size_m.maxCoeff();
  const int decimals = largest < 1 ? 3 : largest < 1000 ? 2 : 0;
  return figures("{:.{}f} × {:.{}f} × {:.{}f} m", size_m.x(), decimals, size_m.y(), decimals, size_m.z(), decimals);
}

ImportPreview::~ImportPreview() {
  if (task_) task_->progress().cancel();
}

void ImportPreview::open(std::vector<std::filesystem::path> files, const Verb& verb, std::function<void()> wake) {
  close();
  files_ = std::move(files);
  verb_ = &verb;
  wake_ = std::move(wake);
  stage_ = Stage::reading;
  start();
}

void ImportPreview::show(std::vector<std::filesystem::path> files, Outcome outcome) {
  close();
  files_ = std::move(files);
  facts_ = factsOf(outcome.document, outcome.report);
  issues_ = entriesOf(outcome.report);
  outcome_ = std::move(outcome);
  stage_ = Stage::ready;
}

bool ImportPreview::hasIfc() const {
  return std::any_of(files_.begin(), files_.end(), [](const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (auto& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension.starts_with(".ifc");
  });
}

std::string ImportPreview::fileNames() const {
  if (files_.empty()) return {};
  const auto first = files_.front().filename().string();
  return files_.size() == 1 ? first : trf("{} and {} more", first, files_.size() - 1);
}

void ImportPreview::start() {
  if (task_) {
    task_->progress().cancel();
    leaving_.push_back(std::move(task_));
  }
  read_with_ = overrides;
  task_ = std::make_unique<Task<Outcome>>(
      trf("Read {}", fileNames()),
      [verb = verb_, options = importOptions(files_, overrides)](Progress& progress) {
        return runVerb(*verb, Document(), options, progress);
      },
      wake_);
}

void ImportPreview::readAgain() {
  if (changed() && verb_ != nullptr) start();
}

void ImportPreview::close() {
  if (task_) {
    task_->progress().cancel();
    leaving_.push_back(std::move(task_));
  }
  stage_ = Stage::closed;
  files_.clear();
  outcome_.reset();
  facts_ = {};
  error_ = {};
  overrides = read_with_ = outcome_with_ = {};
  ++closed_;
  first_size_m_.reset();
  has_first_ = false;
}

bool ImportPreview::poll() {
  std::erase_if(leaving_, [](const auto& task) { return task->done(); });
  if (!task_ || !task_->done()) return false;
  auto result = task_->take();
  task_.reset();
  if (!result) {
    error_ = result.error();
    if (!outcome_) stage_ = Stage::failed;
    overrides = read_with_ = outcome_with_;  // what could be read is shown on
    return true;
  }
  error_ = {};
  outcome_with_ = read_with_;
  facts_ = factsOf(result->document, result->report);
  issues_ = entriesOf(result->report);
  outcome_ = *std::move(result);
  stage_ = Stage::ready;
  if (!has_first_) size_at_first_m_ = facts_.size_m;
  has_first_ = true;
  first_size_m_.reset();
  if ((facts_.size_m - size_at_first_m_).norm() > 1e-6 * facts_.size_m.norm()) first_size_m_ = size_at_first_m_;
  return true;
}

void ImportPreview::wait() {
  while (task_)
    if (!poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

Outcome ImportPreview::take() {
  Outcome outcome = *std::move(outcome_);
  close();
  return outcome;
}

}  // namespace standpoint
