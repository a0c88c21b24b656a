// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/soup/face_soup.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "importers/soup/soup_mesh.h"

namespace standpoint {

namespace {

// Beyond this a float step is above 4 µm, so a product gets a whole-metre origin of its own.
constexpr double kFarFromOrigin_m = 64;

class SoupModel {
 public:
  SoupModel(FaceSoup& soup, Report& report, Progress& progress) : soup_(soup), report_(report), progress_(progress) {}

  Result<ImportedModel> build(bool z_up, const ImportOptions& options) {
    toMetresZUp(z_up, options.metres_per_unit > 0 ? options.metres_per_unit : 1);
    groupRuns();
    chooseOrigins(options);
    TRY(makeMeshes());
    auto& e = model_.environment;
    e.surfaces = std::move(soup_.surfaces);
    e.products = std::move(soup_.products);
    e.images = std::move(soup_.images);
    sayWhatWasFound();
    model_.report = std::move(report_);
    return std::move(model_);
  }

 private:
  struct ProductRuns {
    std::size_t begin = 0, end = 0;  // into runs
    Bounds box;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  };

  void toMetresZUp(bool z_up, double metres_per_unit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, soup_.positions.size(), 1U << 16U), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        auto& p = soup_.positions[i];
        if (!z_up) p = {p.x(), -p.z(), p.y()};
        p *= metres_per_unit;
      }
    });
  }

  // By product, then by surface; within those the file's order stays.
  void groupRuns() {
    std::stable_sort(soup_.runs.begin(), soup_.runs.end(), [](const FaceRun& a, const FaceRun& b) {
      return std::pair(a.product, a.surface) < std::pair(b.product, b.surface);
    });
    for (std::size_t from = 0, to = 0; from < soup_.runs.size(); from = to) {
      const auto product = soup_.runs[from].product;
      auto& materials = soup_.products[product].materials;
      for (; to < soup_.runs.size() && soup_.runs[to].product == product; ++to)
        if (to == from || soup_.runs[to].surface != soup_.runs[to - 1].surface)
          materials.push_back(soup_.surfaces[soup_.runs[to].surface].name);
      products_.push_back({from, to});
    }
  }

  void chooseOrigins(const ImportOptions& options) {
    tbb::parallel_for(std::size_t{0}, products_.size(), [&](std::size_t i) {
      for (const auto& run : runsOf(i))
        for (auto c = soup_.beginOf(run.begin); c < soup_.beginOf(run.end); ++c)
          products_[i].box.extend(soup_.positions[soup_.corners[c]]);
    });
    Bounds all;
    for (const auto& p : products_) all.extend(p.box);
    const Eigen::Vector3d shift = model_.georeference.shift_m = chooseShift(options, all);
    for (auto& p : products_) {
      const double reach =
          std::max((p.box.min - shift).cwiseAbs().maxCoeff(), (p.box.max - shift).cwiseAbs().maxCoeff());
      p.origin = reach < kFarFromOrigin_m ? shift : Eigen::Vector3d((0.5 * (p.box.min + p.box.max)).array().round());
    }
  }

  std::span<const FaceRun> runsOf(std::size_t product) const {
    return std::span(soup_.runs).subspan(products_[product].begin, products_[product].end - products_[product].begin);
  }

  // Into slots, so the order is the file's whatever the threads do.
  Result<void> makeMeshes() {
    auto& e = model_.environment;
    e.meshes.resize(products_.size());
    e.instances.resize(products_.size());
    std::vector<SoupFindings> findings(products_.size());
    tbb::enumerable_thread_specific<SoupMesher> meshers(std::cref(soup_));
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, products_.size(), [&](std::size_t i) {
      if (progress_.cancelled()) return;
      auto made = meshers.local().mesh(runsOf(i), products_[i].origin);
      findings[i] = made.findings;
      e.instances[i].mesh = static_cast<std::uint32_t>(i);
      e.instances[i].product = soup_.runs[products_[i].begin].product;
      e.instances[i].world_from_mesh.translation() = products_[i].origin - model_.georeference.shift_m;
      e.meshes[i] = std::make_shared<const Mesh>(std::move(made.mesh));
      progress_.advance(0.7 + 0.3 * static_cast<double>(++done) / static_cast<double>(products_.size()));
    });
    for (const auto& f : findings) findings_.add(f);
    dropEmpty();
    return progress_.check();
  }

  // A product whose triangles have all collapsed stays in the list, without a shape.
  void dropEmpty() {
    auto& e = model_.environment;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < e.meshes.size(); ++i) {
      if (!e.meshes[i] || e.meshes[i]->triangles.empty()) continue;
      e.instances[kept] = e.instances[i];
      e.instances[kept].mesh = static_cast<std::uint32_t>(kept);
      e.meshes[kept++] = std::move(e.meshes[i]);
    }
    e.meshes.resize(kept);
    e.instances.resize(kept);
  }

  void sayWhatWasFound() {
    const auto place = [&](const FaceTally& tally) { return soup_.place(tally.first_face); };
    const auto& f = findings_;
    const auto warn = [&](const FaceTally& tally, const char* what) {
      if (tally.count > 0) report_.warn(place(tally), what + (": " + std::to_string(tally.count)));
    };
    warn(f.unclean, "polygons that intersect themselves, have no area or are too complex, triangulated as fans");
    warn(f.collapsed, "degenerate triangles skipped");
    warn(f.twice, "duplicate triangles removed");
    warn(f.repainted, "duplicate triangles with different materials, of which the first was kept");
    if (f.unpainted.count > 0)
      report_.warn("",
                   "vertices of textured surfaces without texture coordinates: " + std::to_string(f.unpainted.count));
    if (f.flat.count > 0)
      report_.note(place(f.flat),
                   "zero-area triangles kept, since their edges may close a solid: " + std::to_string(f.flat.count));
    if (f.inside_out.count > 0)
      report_.note(place(f.inside_out),
                   "closed products that face inward (interior shells or inverted), kept as they are: " +
                       std::to_string(f.inside_out.count));
    if (soup_.runs.empty()) report_.warn("", "no faces: nothing to scan");
  }

  FaceSoup& soup_;
  Report& report_;
  Progress& progress_;
  ImportedModel model_;
  std::vector<ProductRuns> products_;
  SoupFindings findings_;
};

}  // namespace

Result<ImportedModel> modelFrom(FaceSoup&& soup, UpAxis up_of_format, const ImportOptions& options, Report&& report,
                                Progress& progress) {
  const bool z_up = (options.up == UpAxis::automatic ? up_of_format : options.up) == UpAxis::z;
  return SoupModel(soup, report, progress).build(z_up, options);
}

}  // namespace standpoint
