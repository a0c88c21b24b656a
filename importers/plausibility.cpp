// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/plausibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace standpoint {
namespace {

struct Placed {
  std::uint32_t product = 0;
  Bounds bounds;  // local frame
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string size(double metres) {
  const double m = std::abs(metres);
  return m >= 1e6    ? fmt::format("{:.0f} km", metres / 1000)
         : m >= 1000 ? fmt::format("{:.3g} km", metres / 1000)
         : m >= 1    ? fmt::format("{:.3g} m", metres)
         : m >= 0.01 ? fmt::format("{:.3g} cm", metres * 100)
                     : fmt::format("{:.3g} mm", metres * 1000);
}

class Judge {
 public:
  Judge(ImportedModel& model, double metres_per_unit, UpAxis up)
      : model_(model), metres_per_unit_(metres_per_unit), up_(up) {
    const auto bounds = productBounds(model.environment);
    for (std::uint32_t i = 0; i < bounds.size(); ++i)
      if (model.environment.products[i].tangible && !bounds[i].empty()) placed_.push_back({i, bounds[i]});
  }

  void run() {
    if (placed_.empty()) return;
    beyondAnyMap();
    for (int axis = 0; axis < 3; ++axis) farParts(axis);
    unit();
    upAxis();
    origin();
  }

 private:
  void warn(const std::string& message) { model_.report.warn("model", message); }
  const std::string& idOf(const Placed& p) const { return model_.environment.products[p.product].id; }

  std::string names(const std::vector<Placed>& some) const {
    std::string text;
    for (std::size_t i = 0; i < some.size() && i < 5; ++i) text += (i ? ", " : "") + idOf(some[i]);
    return some.size() > 5 ? text + ", …" : text;
  }

  // The Earth is 40 000 km around, and no projection counts beyond that.
  void beyondAnyMap() {
    constexpr double kEarth_m = 4e7;
    std::vector<Placed> lost, kept;
    for (const Placed& p : placed_) {
      const Eigen::Vector3d a = p.bounds.min + model_.georeference.shift_m,
                            b = p.bounds.max + model_.georeference.shift_m;
      (std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()) > kEarth_m ? lost : kept).push_back(p);
    }
    if (lost.empty()) return;
    model_.report.warn(
        idOf(lost[0]),
        fmt::format("{} products are outside any map area ({}): check their placements in the model, or exclude them",
                    lost.size(), names(lost)));
    if (!kept.empty()) placed_ = std::move(kept);
  }

  // The widest gap along an axis, when it is out of proportion. What lies beyond is left out of the other questions.
  void farParts(int axis) {
    constexpr double kFar_m = 1000;
    if (apart_ >= 3 || placed_.empty()) return;
    std::stable_sort(placed_.begin(), placed_.end(),
                     [&](const Placed& a, const Placed& b) { return a.bounds.min[axis] < b.bounds.min[axis]; });
    double reach = placed_[0].bounds.max[axis], gap = 0;
    std::size_t split = 0;
    for (std::size_t i = 1; i < placed_.size(); ++i) {
      if (placed_[i].bounds.min[axis] - reach > gap) gap = placed_[i].bounds.min[axis] - reach, split = i;
      reach = std::max(reach, placed_[i].bounds.max[axis]);
    }
    if (gap < kFar_m) return;
    std::vector<Placed> below(placed_.begin(), placed_.begin() + static_cast<std::ptrdiff_t>(split)),
        above(placed_.begin() + static_cast<std::ptrdiff_t>(split), placed_.end());
    if (gap < 5 * std::max(extent(below)[axis], extent(above)[axis])) return;
    if (below.size() < above.size()) std::swap(below, above);
    if (above.size() * 10 <= below.size() || above.size() <= 2)
      model_.report.warn(
          idOf(above[0]),
          fmt::format(
              "{} of {} products are {} from the rest ({}): check their placements in the model, or exclude them",
              above.size(), placed_.size(), size(gap), names(above)));
    else
      warn(
          fmt::format("the model consists of two parts {} apart, with {} and {} products (the smaller with {}): if "
                      "these are two models, import them separately, each with a shift of its own",
                      size(gap), below.size(), above.size(), names(above)));
    placed_ = std::move(below);
    ++apart_;
    farParts(axis);
  }

  static Eigen::Vector3d extent(const std::vector<Placed>& some) {
    Bounds all;
    for (const Placed& p : some) all.extend(p.bounds);
    return all.max - all.min;
  }

  // Longest edge of the products of a class; empty when there are too few to speak for the model.
  std::vector<Placed> ofClass(std::string_view ifc_class) const {
    std::vector<Placed> found;
    for (const Placed& p : placed_)
      if (model_.environment.products[p.product].ifc_class.starts_with(ifc_class)) found.push_back(p);
    return found;
  }

  void unit() {
    struct Usual {
      const char* ifc_class;
      const char* what;
      double least, most, typical;
    };
    constexpr std::array<Usual, 4> kUsual{{{"IfcDoor", "doors", 0.4, 20, 2.1},
                                           {"IfcWindow", "windows", 0.1, 60, 1.5},
                                           {"IfcWall", "walls", 0.1, 600, 4},
                                           {"", "", 0, 0, 15}}};
    for (const Usual& usual : kUsual) {
      const bool whole = *usual.ifc_class == '\0';
      const auto some = ofClass(usual.ifc_class);
      if (some.empty()) continue;
      std::vector<double> longest;
      for (const Placed& p : some) longest.push_back((p.bounds.max - p.bounds.min).maxCoeff());
      const Eigen::Vector3d all = extent(placed_);
      const double measured = whole ? all.maxCoeff() : median(std::move(longest));
      // A road is 20 km long and a screw 3 cm: without parts that are known only what no building can be is pointed
      // out.
      const bool large = whole ? all.z() > 1000 && all.z() > 0.05 * all.maxCoeff() : measured > usual.most;
      const bool small = whole ? measured < 0.1 : measured < usual.least;
      if (measured > 0 && (large || small)) {
        const std::string finding =
            whole ? fmt::format("the whole model is {} {}", size(large ? all.z() : measured), large ? "high" : "large")
                  : fmt::format("the {} are {} large", usual.what, size(measured));
        warn(finding + ": check the unit" + unitRemedy(measured, usual.typical));
      }
      return;
    }
  }

  // The unit that brings it nearest to what is usual.
  std::string unitRemedy(double measured, double typical) const {
    constexpr std::array<std::pair<const char*, double>, 5> kUnits{
        {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};
    const char* best = nullptr;
    double best_off = std::abs(std::log(measured / typical)) - 0.5;
    for (const auto& [name, metres] : kUnits)
      if (const double off = std::abs(std::log(measured * metres / metres_per_unit_ / typical)); off < best_off)
        best = name, best_off = off;
    return best ? fmt::format("; if the coordinates are in {}, import the model with this unit", best)
                : std::string("; correct it in the model");
  }

  void tellLying(const std::string& finding) {
    const char* other = up_ == UpAxis::y ? "z" : "y";
    warn(fmt::format("{}: the model may be rotated; if its {} axis points up, import it with this axis up", finding,
                     other));
  }

  void upAxis() {
    const auto doors = ofClass("IfcDoor");
    if (doors.size() >= 2) {
      std::size_t lying = 0;
      for (const Placed& p : doors) {
        const Eigen::Vector3d e = p.bounds.max - p.bounds.min;
        lying += e.z() < 0.4 * std::max(e.x(), e.y()) ? 1 : 0;
      }
      if (lying * 10 >= doors.size() * 8)
        tellLying(fmt::format("{} of {} doors are wider than tall", lying, doors.size()));
      return;
    }
    // A wall alone looks one way and is no model that lies; an IFC says by its schema what is up.
    if (!model_.environment.products[placed_[0].product].ifc_class.empty() && placed_.size() < 10) return;
    // Floors, ceilings and roofs look along one axis, walls along two: where one horizontal axis has most of the area
    // and the model is shortest along it, those are the floors.
    std::array<double, 3> area = areas();
    const Eigen::Vector3d e = extent(placed_);
    for (const int axis : {0, 1}) {
      const int other = 1 - axis;
      const bool most =
          area[static_cast<std::size_t>(axis)] > 1.5 * std::max(area[2], area[static_cast<std::size_t>(other)]);
      if (most && e[axis] < 0.8 * std::min(e.z(), e[other]) && e.z() > 3 && triangleCount(model_.environment) > 100)
        return tellLying("most of its area is vertical and faces one direction");
    }
  }

  // Of every n-th triangle: a hundred thousand tell which way floors look.
  std::array<double, 3> areas() const {
    constexpr std::size_t kEnough = 100'000;
    const std::size_t stride = 1 + triangleCount(model_.environment) / kEnough;
    std::array<double, 3> sum{};
    std::size_t next = 0;
    for (const Instance& i : model_.environment.instances) {
      if (!model_.environment.products[i.product].tangible) continue;
      const Mesh& mesh = *model_.environment.meshes[i.mesh];
      const Eigen::Matrix3d linear = i.world_from_mesh.linear();
      for (; next < mesh.triangles.size(); next += stride) {
        const Triangle& t = mesh.triangles[next];
        const Eigen::Vector3d a = mesh.positions[t[0]].cast<double>();
        const Eigen::Vector3d n = (linear * (mesh.positions[t[1]].cast<double>() - a))
                                      .cross(linear * (mesh.positions[t[2]].cast<double>() - a));
        const double twice = n.norm();
        for (int axis = 0; axis < 3; ++axis)
          if (std::abs(n[axis]) > 0.98 * twice) sum[static_cast<std::size_t>(axis)] += twice;
      }
      next -= mesh.triangles.size();
    }
    return sum;
  }

  void origin() {
    constexpr double kFar_m = 10000;
    Bounds all;
    for (const Placed& p : placed_) all.extend(p.bounds);
    const Eigen::Vector3d shift = model_.georeference.shift_m;
    const Eigen::Vector3d nearest =
        (-shift).cwiseMax(all.min).cwiseMin(all.max) + shift;  // point of the bounds next to the file's origin
    if (nearest.norm() < kFar_m) return;
    std::string text = fmt::format("the geometry is {} from the file's origin", size(nearest.norm()));
    if (shift.isZero())
      return warn(text + " and not shifted, so coordinates lose precision; import the model with an automatic shift");
    text += fmt::format("; a global shift of {:.0f} {:.0f} {:.0f} is applied internally and reversed on export",
                        shift.x(), shift.y(), shift.z());
    if (!model_.georeference.map_from_file && model_.georeference.crs.empty())
      text += "; if these are map coordinates, specify their coordinate reference system";
    model_.report.note("model", text);
  }

  ImportedModel& model_;
  double metres_per_unit_;
  UpAxis up_;
  std::vector<Placed> placed_;
  int apart_ = 0;
};

}  // namespace

void tellImplausible(ImportedModel& model, double metres_per_unit, UpAxis up) {
  Judge(model, metres_per_unit, up).run();
}

}  // namespace standpoint
