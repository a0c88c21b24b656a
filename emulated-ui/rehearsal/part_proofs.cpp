// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/part_proofs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_set>

#include "emulated-ui/host.h"
#include "emulated-ui/rehearsal/all_setups.h"
#include "emulated-ui/sighting.h"
#include "pointclouds/formats.h"
#include "scanners/forecast/surface_samples.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kSamplesOfAll = 200000;
constexpr double kNear_m = 0.05;   // a point so near shows the place
constexpr double kPatch_m = 0.25;  // unseen places so near belong to one hole
constexpr std::string_view kPart = "part.";

// Which surfaces are meant, and which points are on them.
class PartOf {
 public:
  PartOf(const ExercisePart& part, const Environment& environment, const Vector3d& shift_m)
      : part_(part), shift_m_(shift_m) {
    for (std::uint32_t i = 0; i < environment.products.size(); ++i)
      if (isMeant(environment.products[i])) {
        products_.insert(i);
        labels_.insert(environment.products[i].global_id + "/" + environment.products[i].id);
      }
  }
  bool has(const SurfaceSample& sample) const {
    return sample.exposed && products_.contains(sample.product) && inBox(sample.place.position) &&
           (part_.floor.empty() || sample.place.normal.z() > 0.9);
  }
  bool isLabel(const LabelledProduct& label) const { return labels_.contains(label.global_id + "/" + label.id); }
  bool inBox(const Vector3d& local) const {
    if (part_.box.empty()) return true;
    const Vector3d p = local + shift_m_;
    for (int k = 0; k < 3; ++k)
      if (p[k] < part_.box[static_cast<std::size_t>(k)] || p[k] > part_.box[static_cast<std::size_t>(k) + 3])
        return false;
    return true;
  }

 private:
  bool isMeant(const Product& product) const {
    if (!part_.floor.empty())
      return product.storey == part_.floor &&
             (product.ifc_class.starts_with("IfcSlab") || product.ifc_class.starts_with("IfcCovering"));
    return part_.product.empty() || product.name == part_.product || product.global_id == part_.product ||
           product.id == part_.product;
  }
  const ExercisePart& part_;
  Vector3d shift_m_;
  std::set<std::uint32_t> products_;
  std::set<std::string> labels_;
};

using Cell = std::tuple<std::int32_t, std::int32_t, std::int32_t>;
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    const auto [x, y, z] = c;
    return static_cast<std::size_t>(x) * 73856093U ^ static_cast<std::size_t>(y) * 19349663U ^
           static_cast<std::size_t>(z) * 83492791U;
  }
};
Cell cellOf(const Vector3d& p) {
  const auto at = [](double v) { return static_cast<std::int32_t>(std::floor(v / kNear_m)); };
  return {at(p.x()), at(p.y()), at(p.z())};
}

struct SeenPart {
  double points = 0;
  std::unordered_set<Cell, CellHash> cells;

  bool near(const Vector3d& p) const {
    const auto [x, y, z] = cellOf(p);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (cells.contains({x + i, y + j, z + k})) return true;
    return false;
  }
};

// Puts the points of one scan where they truly are, to the parts that they are on.
class PartReader final : public PointSink {
 public:
  PartReader(const std::vector<PartOf>& parts, std::vector<SeenPart>& seen, const Pose& pose)
      : parts_(parts), seen_(seen), pose_(pose) {}
  Result<void> begin(const ScanHeader& header) override {
    is_of_.assign(parts_.size(), std::vector<bool>(header.products.size()));
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (std::size_t i = 0; i < header.products.size(); ++i) is_of_[k][i] = parts_[k].isLabel(header.products[i]);
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (block.product.empty()) return {};
    for (std::size_t i = 0; i < block.size(); ++i)
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (!is_of_[k][block.product[i]]) continue;
        const Vector3d p = pose_ * Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
        if (!parts_[k].inBox(p)) continue;
        seen_[k].points += 1;
        seen_[k].cells.insert(cellOf(p));
      }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  const std::vector<PartOf>& parts_;
  std::vector<SeenPart>& seen_;
  Pose pose_;
  std::vector<std::vector<bool>> is_of_;
};

// The places of the largest patch: those that hang together by steps of kPatch_m.
std::vector<Vector3d> largestPatch(const std::vector<Vector3d>& places) {
  std::vector<std::size_t> group(places.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  std::vector<std::size_t> by_x(places.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(), [&](auto a, auto b) { return places[a].x() < places[b].x(); });
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t k = i + 1; k < by_x.size() && places[by_x[k]].x() - places[by_x[i]].x() <= kPatch_m; ++k)
      if ((places[by_x[i]] - places[by_x[k]]).squaredNorm() <= kPatch_m * kPatch_m)
        group[root(by_x[i])] = root(by_x[k]);
  std::map<std::size_t, std::size_t> count;
  for (std::size_t i = 0; i < places.size(); ++i) ++count[root(i)];
  const auto most =
      std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<Vector3d> patch;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (root(i) == most->first) patch.push_back(places[i]);
  return patch;
}

}  // namespace

std::map<std::string, double> readParts(const Exercise& exercise, const Device& device, const Document& document) {
  std::map<std::string, double> figures;
  if (exercise.parts.empty() || !document.imported || !document.job) return figures;
  Progress quiet;
  const auto environment = document.environment();
  const auto scene = RayScene::build(environment, quiet);
  if (!scene) return figures;
  const auto samples = sampleSurfaces(**scene, kSamplesOfAll, 1, quiet);
  if (!samples) return figures;
  const Vector3d shift = document.georeference->shift_m;
  std::vector<PartOf> parts;
  for (const auto& [name, part] : exercise.parts) parts.emplace_back(part, *environment, shift);
  std::vector<SeenPart> seen(parts.size());
  for (const auto* setup : allSetups(device)) {
    const auto* station = stationOf(document, setup->station);
    const auto* format = cloudFormatFor(setup->file);
    if (station == nullptr || format == nullptr) continue;
    PartReader reader(
        parts, seen,
        {leaning(station->true_pose.rotation, setup->stood_x_deg, setup->stood_y_deg), station->true_pose.translation});
    (void)format->read(setup->file, reader, quiet);  // what is gone shows nothing
  }
  std::size_t k = 0;
  for (const auto& [name, part] : exercise.parts) {
    double all = 0;
    std::vector<Vector3d> unseen;
    for (const auto& sample : samples->samples) {
      if (!parts[k].has(sample)) continue;
      all += 1;
      if (!seen[k].near(sample.place.position)) unseen.push_back(sample.place.position);
    }
    const double each = samples->each_m2(), seen_m2 = (all - static_cast<double>(unseen.size())) * each;
    const auto prefix = std::string(kPart) + name + ".";
    const auto figure = [&](const char* what) -> double& { return figures[prefix + what]; };
    figure("area") = all * each;
    figure("seen") = all > 0 ? seen_m2 / (all * each) : 0;
    figure("points") = seen[k].points;
    if (seen[k].points > 0 && seen_m2 > 0) figure("spacing") = std::sqrt(seen_m2 / seen[k].points) * 1000;
    figure("hole") = 0;
    if (!unseen.empty()) {
      const auto patch = largestPatch(unseen);
      Vector3d middle = shift;
      for (const auto& p : patch) middle += p / static_cast<double>(patch.size());
      figure("hole") = static_cast<double>(patch.size()) * each;
      figure("hole_x") = middle.x(), figure("hole_y") = middle.y(), figure("hole_z") = middle.z();
    }
    ++k;
  }
  return figures;
}

std::optional<PartFigure> partFigure(const std::string& fact, const Exercise& exercise) {
  if (!fact.starts_with(kPart)) return std::nullopt;
  const auto dot = fact.rfind('.');
  if (dot < kPart.size() || !exercise.parts.contains(fact.substr(kPart.size(), dot - kPart.size())))
    return std::nullopt;
  const auto what = fact.substr(dot + 1);
  if (what == "area" || what == "hole") return PartFigure{"m²", numbers(0, 1e9)};
  if (what == "seen") return PartFigure{"", numbers(0, 1)};
  if (what == "points") return PartFigure{"", numbers(0, 1e12)};
  if (what == "spacing") return PartFigure{"mm", numbers(0, 1e6)};
  if (what == "hole_x" || what == "hole_y" || what == "hole_z") return PartFigure{"m", numbers(-1e9, 1e9)};
  return std::nullopt;
}

}  // namespace standpoint
