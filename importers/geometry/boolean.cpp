// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include "importers/geometry/boolean_ways.h"
#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

constexpr std::size_t kMaxFaces = 100000;

// What a correct result's volume must lie between, and what it must lie within.
struct Limits {
  double low, high;
  Bounds3 within;
  bool holds(double v) const {
    const double slack = 1e-6 + 1e-3 * std::abs(high);
    return v >= low - slack && v <= high + slack;
  }
  // Kernels that take a tool outside of the host for a cavity leave its shell there; the volume alone may not tell.
  bool reachedBeyond(const PolyMesh& mesh) const {
    const Bounds3 b(mesh.points);
    constexpr double kSlack_m = 10 * kSnap_m;
    return !mesh.faces.empty() && !((b.low.array() >= within.low.array() - kSlack_m).all() &&
                                    (b.high.array() <= within.high.array() + kSlack_m).all());
  }
};

Result<PolyMesh> checked(Result<PolyMesh> result, const Limits& range, const char* way) {
  if (!result) return result;
  if (!isFinite(*result)) return failure(ErrorKind::unusable, std::string(way) + ": a point is not a number");
  const double v = volume(*result);
  if (range.reachedBeyond(*result))
    return failure(ErrorKind::unusable, std::string(way) + ": the result extends beyond the body");
  if (range.holds(v)) return result;
  return failure(ErrorKind::unusable, std::string(way) + ": the result's volume " + std::to_string(v) +
                                          " m3 is not between " + std::to_string(range.low) + " and " +
                                          std::to_string(range.high));
}

std::optional<Error> unusable(const PolyMesh& mesh) {
  if (!isFinite(mesh)) return Error{ErrorKind::unusable, "Boolean: invalid coordinate or index", {}};
  if (mesh.faces.size() > kMaxFaces) return Error{ErrorKind::unusable, "Boolean: a body has too many faces", {}};
  return std::nullopt;
}

PolyMesh outward(const PolyMesh& mesh) {
  PolyMesh result = mesh;
  if (volume(result) < 0) flip(result);
  return result;
}

Error joined(const std::vector<Error>& errors) {
  Error all{ErrorKind::unusable, "all methods failed", {}};
  for (const Error& error : errors) all.message += "; " + error.message;
  return all;
}

// The tools that share a direction with the host, in the plane. What is left for the other ways stays in `tools`.
PolyMesh subtractPrisms(PolyMesh host, std::vector<PolyMesh>& tools, std::vector<Error>& errors) {
  const std::optional<CommonDirection> common = commonDirection(host, tools);
  if (!common) {
    errors.push_back({ErrorKind::unusable, "in the plane: no common direction", {}});
    return host;
  }
  std::vector<PolyMesh> flat, rest;
  double tool_volume = 0;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (common->fits[i]) tool_volume += volume(tools[i]);
    (common->fits[i] ? flat : rest).push_back(tools[i]);
  }
  const double before = volume(host);
  Result<PolyMesh> result =
      checked(combinePrisms(host, flat, common->direction, Operation::difference),
              {std::max(0.0, before - tool_volume), before, Bounds3(host.points)}, "in the plane");
  if (!result) {
    errors.push_back(result.error());
    return host;
  }
  tools = std::move(rest);
  return std::move(*result);
}

Result<PolyMesh> carveAway(const PolyMesh& host, const PolyMesh& tool) {
  const double before = volume(host);
  return checked(combineWithCarve(host, tool, Operation::difference),
                 {std::max(0.0, before - volume(tool)), before, Bounds3(host.points)}, "carve");
}

// Groups of tools that keep apart from each other, each tool in the first group where it does.
std::vector<std::vector<std::size_t>> apart(const std::vector<PolyMesh>& tools) {
  std::vector<Bounds3> bounds;
  for (const PolyMesh& tool : tools) bounds.emplace_back(tool.points);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const auto free = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return std::none_of(group.begin(), group.end(),
                          [&](std::size_t k) { return bounds[i].overlaps(bounds[k], 10 * kSnap_m); });
    });
    if (free == groups.end())
      groups.push_back({i});
    else
      free->push_back(i);
  }
  return groups;
}

// A call costs what the host costs, so tools that keep apart go together: a slab with 65 openings took 11.4 s one by
// one. A group that does not work goes one by one while that works; what fails stays in `tools`, and all that comes
// after it.
PolyMesh subtractWithCarve(PolyMesh host, std::vector<PolyMesh>& tools, std::vector<Error>& errors) {
  std::vector<bool> done(tools.size(), false);
  bool works = true;
  const auto take = [&](Result<PolyMesh> result, std::span<const std::size_t> which) {
    if (!result) return false;
    host = std::move(*result);
    for (const std::size_t i : which) done[i] = true;
    return true;
  };
  for (const auto& group : apart(tools)) {
    PolyMesh together;
    for (const std::size_t i : group) append(together, tools[i]);
    if (group.size() > 1 && take(carveAway(host, together), group)) continue;
    for (std::size_t k = 0; works && k < group.size(); ++k) {
      auto result = carveAway(host, tools[group[k]]);
      if (!result) errors.push_back(result.error());
      works = take(std::move(result), std::span(group).subspan(k, 1));
    }
    if (!works) break;
  }
  std::vector<PolyMesh> left;
  for (std::size_t i = 0; i < tools.size(); ++i)
    if (!done[i]) left.push_back(std::move(tools[i]));
  tools = std::move(left);
  return host;
}

Result<PolyMesh> combineTwo(const PolyMesh& a, const PolyMesh& b, Operation operation, const Limits& range) {
  const std::span<const PolyMesh> second(&b, 1);
  std::vector<Error> errors;
  std::optional<PolyMesh> torn;  // of the right volume, but open: stands when no other way does better
  const bool solids = isClosed(a) && isClosed(b);
  const auto keep = [&](Result<PolyMesh> result, const char* way) {
    result = checked(std::move(result), range, way);
    if (result && solids && !result->faces.empty() && !isClosed(*result)) {
      if (!torn) torn = std::move(*result);
      result = failure(ErrorKind::unusable, std::string(way) + ": the result is not closed");
    }
    if (!result) errors.push_back(result.error());
    return result;
  };
  if (const auto common = commonDirection(a, second)) {
    if (auto result = keep(combinePrisms(a, second, common->direction, operation), "in the plane")) return result;
  }
  if (auto result = keep(combineWithCarve(a, b, operation), "carve")) return result;
  if (auto result = keep(combineWithCgal(a, second, operation), "CGAL")) return result;
  if (torn) return std::move(*torn);
  return failure(joined(errors));
}

}  // namespace

Result<PolyMesh> subtract(const PolyMesh& host, std::span<const PolyMesh> tools) {
  if (auto error = unusable(host)) return failure(*error);
  PolyMesh body = outward(host);
  const Bounds3 bounds(body.points);
  std::vector<PolyMesh> left;
  for (const PolyMesh& tool : tools) {
    if (auto error = unusable(tool)) return failure(*error);
    if (!tool.faces.empty() && bounds.overlaps(Bounds3(tool.points), kSnap_m)) left.push_back(outward(tool));
  }
  if (left.empty() || body.faces.empty()) return host;
  std::vector<Error> errors;
  body = subtractPrisms(std::move(body), left, errors);
  if (!left.empty()) body = subtractWithCarve(std::move(body), left, errors);
  if (left.empty()) return body;
  double tool_volume = 0;
  for (const PolyMesh& tool : left) tool_volume += volume(tool);
  const double before = volume(body);
  Result<PolyMesh> result = checked(combineWithCgal(body, left, Operation::difference),
                                    {std::max(0.0, before - tool_volume), before, Bounds3(body.points)}, "CGAL");
  if (result) return result;
  errors.push_back(result.error());
  return failure(joined(errors));
}

Result<PolyMesh> intersect(const PolyMesh& a, const PolyMesh& b) {
  for (const PolyMesh* mesh : {&a, &b}) {
    if (auto error = unusable(*mesh)) return failure(*error);
  }
  if (a.faces.empty() || b.faces.empty() || !Bounds3(a.points).overlaps(Bounds3(b.points), kSnap_m)) return PolyMesh{};
  const PolyMesh first = outward(a), second = outward(b);
  return combineTwo(first, second, Operation::intersection,
                    {0.0, std::min(volume(first), volume(second)), Bounds3(first.points)});
}

Result<PolyMesh> unite(const PolyMesh& a, const PolyMesh& b) {
  for (const PolyMesh* mesh : {&a, &b}) {
    if (auto error = unusable(*mesh)) return failure(*error);
  }
  if (a.faces.empty() || b.faces.empty()) return a.faces.empty() ? b : a;
  const PolyMesh first = outward(a), second = outward(b);
  const double va = volume(first), vb = volume(second);
  PolyMesh both = first;
  append(both, second);
  return combineTwo(first, second, Operation::unite, {std::max(va, vb), va + vb, Bounds3(both.points)});
}

}  // namespace standpoint::geometry
