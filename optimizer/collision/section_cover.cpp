// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/collision/section_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace standpoint {

namespace {

using Eigen::Vector2d;

constexpr double kOnEdge = 1e-5;        // m; a point this near to a line is on it
constexpr double kNothing = 1e-6;       // m² of a bit that need not be covered
constexpr std::size_t kMostGiven = 60;  // solids, or gaps: more are parted fast but not covered
constexpr std::size_t kMostBits = 200;
constexpr std::size_t kMostSeeds = 16;  // bits that outlines are grown from, of which the best is taken
constexpr std::size_t kManySides = 60;  // of an outline that is thinned out before it is simplified …
constexpr double kThinned = 0.05;       // … by this share of the tolerance
constexpr std::size_t kMostSides = 1000;

struct Line {
  Vector2d at, normal;  // of length 1
  double before(const Vector2d& p) const { return normal.dot(p - at); }
};

// Its outside is before it.
Line sideOf(const Outline& outline, std::size_t i) {
  const Vector2d &a = outline[i], along = (outline[(i + 1) % outline.size()] - a).normalized();
  return {a, {along.y(), -along.x()}};
}

Line reversed(const Line& line) { return {line.at, -line.normal}; }

// What lies behind the line.
Outline behind(const Outline& outline, const Line& line) {
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const double a = line.before(p), b = line.before(q);
    if (a <= 0) result.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) result.push_back(p + (q - p) * (a / (a - b)));
  }
  return result.size() < 3 ? Outline{} : result;
}

double areaOf(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * sum;
}

Outline common(Outline a, const Outline& b) {
  for (std::size_t i = 0; i < b.size() && !a.empty(); ++i) a = behind(a, sideOf(b, i));
  return a;
}

bool isBehind(const Outline& outline, const Line& line) {
  return std::all_of(outline.begin(), outline.end(), [&](const Vector2d& p) { return line.before(p) <= kOnEdge; });
}

// Andrew's monotone chain.
Outline hullOf(const std::vector<Outline>& outlines) {
  Outline points, hull;
  for (const auto& outline : outlines) points.insert(points.end(), outline.begin(), outline.end());
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  const auto turn = [](const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  for (int pass = 0; pass < 2; ++pass, std::reverse(points.begin(), points.end())) {
    const auto first = hull.size();
    for (const auto& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
  }
  return hull;
}

// Lines that have the bit behind them and the gap before them.
std::vector<Line> partings(const Outline& bit, const Outline& gap) {
  std::vector<Line> result;
  for (std::size_t i = 0; i < gap.size(); ++i)
    if (const Line line = reversed(sideOf(gap, i)); isBehind(bit, line)) result.push_back(line);
  for (std::size_t i = 0; i < bit.size() && result.empty(); ++i)
    if (const Line line = sideOf(bit, i); isBehind(gap, reversed(line))) result.push_back(line);
  return result;
}

// The largest convex outline around the bit that greedy cuts leave, those first that leave least.
Outline grownFrom(const Outline& bit, Outline region, const std::vector<Outline>& gaps) {
  for (std::size_t cuts = 0; cuts <= gaps.size(); ++cuts) {
    std::optional<Outline> next;
    double next_area = std::numeric_limits<double>::infinity();
    for (const auto& gap : gaps) {
      if (areaOf(common(gap, region)) <= kNothing) continue;
      Outline best;
      double best_area = 0;
      for (const auto& line : partings(bit, gap))
        if (auto cut = behind(region, line); areaOf(cut) > best_area) best_area = areaOf(cut), best = std::move(cut);
      if (best_area < next_area) next_area = best_area, next = std::move(best);
    }
    if (!next) return region;
    region = std::move(*next);
    if (region.empty()) return {};
  }
  return {};
}

// What of the bits is out of the region.
std::vector<Outline> without(const std::vector<Outline>& bits, const Outline& region) {
  std::vector<Outline> result;
  for (Outline bit : bits) {
    if (areaOf(common(bit, region)) <= kNothing) {
      result.push_back(std::move(bit));
      continue;
    }
    for (std::size_t i = 0; i < region.size() && !bit.empty(); ++i) {
      const Line side = sideOf(region, i);
      if (auto out = behind(bit, reversed(side)); areaOf(out) > kNothing) result.push_back(std::move(out));
      bit = behind(bit, side);
    }
  }
  return result;
}

// Distances of the points between two corners from their chord, least and greatest.
std::pair<double, double> rangeBetween(const Outline& loop, std::size_t from, std::size_t to) {
  const auto n = loop.size();
  const Vector2d along = (loop[to % n] - loop[from]).normalized();
  const Line chord{loop[from], {along.y(), -along.x()}};
  std::pair<double, double> range{0, 0};
  for (auto i = from + 1; i < to; ++i) {
    const double off = chord.before(loop[i % n]);
    range = {std::min(range.first, off), std::max(range.second, off)};
  }
  return range;
}

// The corners of chords that go as far as they stay within the tolerance, from one of them round to it again; none
// where that takes more than `most`.
std::vector<std::size_t> chordsFrom(const Outline& loop, std::size_t start, double tolerance_m, std::size_t most) {
  const auto n = loop.size();
  std::vector<std::size_t> corners{start};
  while (corners.back() < start + n) {
    if (corners.size() > most) return {};
    const auto from = corners.back();
    auto to = from + 1;
    for (auto next = to + 1; next <= start + n && next < from + n / 2; ++next) {
      const auto [low, high] = rangeBetween(loop, from % n, from % n + next - from);
      if (high - low <= 2 * tolerance_m)
        to = next;
      else if (high - low > 20 * tolerance_m)
        break;
    }
    corners.push_back(to);
  }
  corners.pop_back();
  return corners;
}

Outline thinned(const Outline& loop, double tolerance_m) {
  Outline result;
  for (const auto i : chordsFrom(loop, 0, tolerance_m, loop.size())) result.push_back(loop[i % loop.size()]);
  return result.size() < 3 ? loop : result;
}

}  // namespace

std::vector<Outline> coverOf(const std::vector<Outline>& solids, const std::vector<Outline>& gaps) {
  if (solids.size() > kMostGiven || gaps.size() > kMostGiven) return {};
  const Outline hull = hullOf(solids);
  std::vector<Outline> regions, left = solids;
  std::erase_if(left, [](const Outline& bit) { return areaOf(bit) <= kNothing; });
  while (!left.empty()) {
    if (left.size() > kMostBits || regions.size() > kMostGiven) return {};
    std::stable_sort(left.begin(), left.end(),
                     [](const Outline& a, const Outline& b) { return areaOf(a) > areaOf(b); });
    Outline best;
    double most = 0;
    for (std::size_t i = 0; i < std::min(left.size(), kMostSeeds); ++i) {
      auto region = grownFrom(left[i], hull, gaps);
      double gain = 0;
      for (const auto& other : left) gain += areaOf(common(other, region));
      if (gain > most + kNothing) most = gain, best = std::move(region);
    }
    if (best.empty()) return {};
    left = without(left, best);
    regions.push_back(std::move(best));
  }
  for (std::size_t i = regions.size(); i-- > 0;) {  // what others that were chosen later cover as well
    auto bits = solids;
    for (std::size_t k = 0; k < regions.size(); ++k)
      if (k != i) bits = without(bits, regions[k]);
    if (std::all_of(bits.begin(), bits.end(), [](const Outline& bit) { return areaOf(bit) <= 10 * kNothing; }))
      regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return regions;
}

Outline simplified(const Outline& given, double tolerance_m) {
  if (given.size() <= 4 || given.size() > kMostSides) return given;
  const Outline loop = given.size() > kManySides ? thinned(given, kThinned * tolerance_m) : given;
  const auto n = loop.size();
  if (n > 2 * kManySides) return loop;
  std::vector<std::size_t> best;
  for (std::size_t start = 0; start < n; ++start)
    if (auto corners = chordsFrom(loop, start, tolerance_m, best.empty() ? n : best.size());
        !corners.empty() && (best.empty() || corners.size() < best.size()))
      best = std::move(corners);
  if (best.size() < 3 || best.size() >= n) return loop;
  // Each chord is moved to the middle of what it stands for; where two cross is a corner.
  std::vector<Line> lines;
  for (std::size_t i = 0; i < best.size(); ++i) {
    const auto from = best[i], to = i + 1 < best.size() ? best[i + 1] : best[0] + n;
    const auto [low, high] = rangeBetween(loop, from % n, from % n + to - from);
    const Vector2d along = (loop[to % n] - loop[from % n]).normalized(), normal(along.y(), -along.x());
    lines.push_back({loop[from % n] + normal * (0.5 * (low + high)), normal});
  }
  Outline result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line &a = lines[(i + lines.size() - 1) % lines.size()], &b = lines[i];
    const double sine = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
    const Vector2d& corner = loop[best[i] % n];
    const double da = -a.before(corner), db = -b.before(corner);  // how far the lines are from the corner
    const Vector2d off =
        std::abs(sine) < 1e-3
            ? Vector2d(0, 0)
            : Vector2d(da * b.normal.y() - db * a.normal.y(), db * a.normal.x() - da * b.normal.x()) / sine;
    if (off.norm() > 4 * tolerance_m) return loop;
    result.push_back(corner + off);
  }
  return result;
}

}  // namespace standpoint
