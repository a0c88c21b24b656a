// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/farthest.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr auto kNoFarthest = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kFarthestChunk = 2048;      // triangles that one task looks at
constexpr std::size_t kMostSearched = 200'000;    // triangles of both shapes
constexpr int kMostPieces = 1024, kDeepest = 12;  // of one triangle
constexpr double kSettled = 1.04 * 1.04;  // a piece that can only be 4 % further than what was found is not searched
constexpr double kTooSmall = 0.25;        // nor one that is half as large as that; its corners are looked at

// A convex piece of a triangle.
struct Region {
  std::array<Vector3d, 3 + kDeepest * 4> corners;  // each of four cuts on each level may add one
  int count = 0;

  Region() = default;
  explicit Region(const std::array<Vector3d, 3>& triangle) : count(3) {
    std::copy(triangle.begin(), triangle.end(), corners.begin());
  }
  void add(const Vector3d& p) {
    if (static_cast<std::size_t>(count) < corners.size()) corners[static_cast<std::size_t>(count++)] = p;
  }
  const Vector3d* begin() const { return corners.data(); }
  const Vector3d* end() const { return corners.data() + count; }
  Vector3d middle() const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& p : *this) sum += p;
    return sum / count;
  }
};

// What of the piece is before the plane through `point`, and what is behind.
std::pair<Region, Region> cut(const Region& piece, const Vector3d& normal, const Vector3d& point) {
  std::pair<Region, Region> sides;
  for (int k = 0; k < piece.count; ++k) {
    const Vector3d &a = piece.begin()[k], &b = piece.begin()[(k + 1) % piece.count];
    const double da = normal.dot(a - point), db = normal.dot(b - point);
    if (da >= 0) sides.first.add(a);
    if (da <= 0) sides.second.add(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const Vector3d between = a + (b - a) * (da / (da - db));
      sides.first.add(between);
      sides.second.add(between);
    }
  }
  return sides;
}

// Looks through triangles one after the other.
class Search {
 public:
  Search(const OneWaySurfaces& way, double known_squared, bool only_whether)
      : way_(way),
        only_whether_(only_whether),
        max_squared_(known_squared),
        rounding_squared_(std::pow(way.from.rounding(), 2)) {}

  double maxSquared() const { return max_squared_; }
  const Vector3d& place() const { return place_; }  // of the farthest, where one was further than what was known
  // `fresh`: of a dense mesh which corners (the lower three bits) and middles of edges are to be looked at.
  void lookThrough(std::uint32_t triangle, const std::uint8_t* fresh);

 private:
  struct Corner {
    std::uint32_t vertex = kNoFarthest, triangle = kNoFarthest;
    double squared = 0;
  };
  // No point of a piece that is no further than this matters.
  double settled() const { return std::max(only_whether_ ? max_squared_ : kSettled * max_squared_, rounding_squared_); }
  bool answers(std::uint32_t triangle, const Triangle& t);
  bool answers(std::uint32_t triangle, const Region& piece) const {
    return std::all_of(piece.begin(), piece.end(),
                       [&](const Vector3d& p) { return way_.squaredDistance(p, triangle) <= settled(); });
  }
  void search(const Region& piece, int deepest);
  void divide(const Region& piece, const Vector3d& middle, int deepest);
  void lookAt(const Vector3d& p);
  void lookAtMiddles(const std::array<Vector3d, 3>& t, std::uint8_t fresh);

  const OneWaySurfaces& way_;
  const bool only_whether_;
  void take(const Vector3d& p, double squared) {
    if (squared > max_squared_) max_squared_ = squared, place_ = p;
  }

  double max_squared_, rounding_squared_;
  Vector3d place_ = Vector3d::Zero();
  std::uint32_t lately_ = kNoFarthest;  // what was near enough for the piece before
  int pieces_ = 0;                      // of the triangle that is searched
  Corner before_[3];
};

void Search::lookThrough(std::uint32_t triangle, const std::uint8_t* fresh) {
  const auto& t = way_.from.triangles[triangle];
  const auto own = triangle < way_.counterpart.size() ? way_.counterpart[triangle] : kNoFarthest;
  if (lately_ != kNoFarthest && answers(lately_, t)) return;
  if (own != kNoFarthest && own != lately_ && answers(own, t)) {
    lately_ = own;
    return;
  }
  const std::array<Vector3d, 3> corners{way_.from.positions[t[0]], way_.from.positions[t[1]],
                                        way_.from.positions[t[2]]};
  if (fresh != nullptr) return lookAtMiddles(corners, *fresh);
  pieces_ = 0;
  for (const auto& p : corners) lookAt(p);
  search(Region(corners), kDeepest);
}

// Whether no point of the triangle is further from that other one: the distance from a convex set is greatest at a
// corner. It mostly shares two corners with the one that was asked for before.
bool Search::answers(std::uint32_t triangle, const Triangle& t) {
  Corner now[3];
  for (int k = 0; k < 3; ++k) {
    now[k] = {t[k], triangle, -1};
    for (const auto& corner : before_)
      if (corner.vertex == t[k] && corner.triangle == triangle) now[k].squared = corner.squared;
  }
  for (auto& corner : now) {
    if (corner.squared < 0) corner.squared = way_.squaredDistance(way_.from.positions[corner.vertex], triangle);
    if (corner.squared > std::max(max_squared_, rounding_squared_)) return false;
  }
  std::copy(now, now + 3, before_);
  return true;
}

// Branch and bound, until one triangle of the other surface answers for all of a piece.
void Search::search(const Region& piece, int deepest) {
  if (piece.count < 3 || ++pieces_ > kMostPieces || (lately_ != kNoFarthest && answers(lately_, piece))) return;
  const Vector3d middle = piece.middle();
  auto near = way_.tree.nearestTriangle(
      middle, lately_ != kNoFarthest ? way_.squaredDistance(middle, lately_) : std::numeric_limits<double>::infinity());
  if (near.triangle != kNoFarthest) lately_ = near.triangle;
  if (lately_ == kNoFarthest) return;
  take(middle, near.squared);
  double radius = 0;
  for (const auto& p : piece) radius = std::max(radius, (p - middle).norm());
  const double furthest =
      std::sqrt(near.squared) + radius;  // no two points' distances differ by more than they are apart
  if (furthest * furthest <= settled() || answers(lately_, piece)) return;
  if (deepest == 0 || 4 * radius * radius <= kTooSmall * max_squared_) {
    for (const auto& p : piece) lookAt(p);
    return;
  }
  divide(piece, middle, deepest - 1);
}

// What lies above the nearest triangle is as far as its corners are; what lies beside it is searched on its own. So two
// tilings of one plane are through when each tile was met. Where the nearest triangle is not below, or too far, the
// piece is halved.
void Search::divide(const Region& piece, const Vector3d& middle, int deepest) {
  const auto& t = way_.to.triangles[lately_];
  const std::array<Vector3d, 3> corners{way_.to.positions[t[0]], way_.to.positions[t[1]], way_.to.positions[t[2]]};
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  std::array<Vector3d, 3> outward;
  bool above = true;
  for (std::size_t k = 0; k < 3; ++k) {
    outward[k] = (corners[(k + 1) % 3] - corners[k]).cross(normal);
    above = above && outward[k].dot(middle - corners[k]) < 0;
  }
  Region rest = piece;
  if (above) {
    std::array<Region, 3> beside;
    for (std::size_t k = 0; k < 3; ++k) std::tie(beside[k], rest) = cut(rest, outward[k], corners[k]);
    const auto own = lately_;
    for (const auto& part : beside) search(part, deepest);
    if (answers(own, rest)) return;
  }
  const Vector3d centre = rest.middle();
  Vector3d along = Vector3d::Zero();
  for (const auto& p : rest)
    if ((p - centre).squaredNorm() > along.squaredNorm()) along = p - centre;
  const auto halves = cut(rest, along, centre);
  search(halves.first, deepest);
  search(halves.second, deepest);
}

void Search::lookAt(const Vector3d& p) {
  const double known =
      lately_ != kNoFarthest ? way_.squaredDistance(p, lately_) : std::numeric_limits<double>::infinity();
  if (known <= max_squared_) return;
  const auto near = way_.tree.nearestTriangle(p, known, max_squared_);
  if (near.triangle != kNoFarthest) lately_ = near.triangle;
  take(p, near.squared);
}

void Search::lookAtMiddles(const std::array<Vector3d, 3>& t, std::uint8_t fresh) {
  lookAt((t[0] + t[1] + t[2]) / 3);
  if (lately_ != kNoFarthest && answers(lately_, Region(t))) return;
  for (unsigned k = 0; k < 3; ++k) {
    if ((fresh & 1U << k) != 0) lookAt(t[k]);
    if ((fresh & 8U << k) != 0) lookAt((t[k] + t[(k + 1) % 3]) / 2);
  }
}

// Of each triangle which corners (the lower three bits) and which edges no triangle before it has.
std::vector<std::uint8_t> freshPoints(const Shape& shape) {
  std::vector<std::uint8_t> fresh(shape.triangles.size(), 0);
  std::vector<bool> seen(shape.positions.size(), false);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> edges(3 *
                                                             fresh.size());  // its vertices, the corner it begins at
  for (std::uint32_t corner = 0; corner < edges.size(); ++corner) {
    const auto& t = shape.triangles[corner / 3];
    const auto v = t[corner % 3];
    if (!seen[v]) fresh[corner / 3] |= static_cast<std::uint8_t>(1U << corner % 3);
    seen[v] = true;
    const auto [a, b] = std::minmax(v, t[(corner + 1) % 3]);
    edges[corner] = {std::uint64_t{a} << 32U | b, corner};
  }
  tbb::parallel_sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (i == 0 || edges[i].first != edges[i - 1].first)
      fresh[edges[i].second / 3] |= static_cast<std::uint8_t>(8U << edges[i].second % 3);
  return fresh;
}

double searched(const OneWaySurfaces& way, double known_squared, bool only_whether) {
  const auto triangles = way.from.triangles.size();
  // Of the denser one most triangles are settled as a whole, so that sorting its edges would cost more than it saves.
  std::vector<std::uint8_t> fresh;
  if (triangles + way.to.triangles.size() > kMostSearched)
    fresh = triangles < way.to.triangles.size() ? freshPoints(way.from) : std::vector<std::uint8_t>(triangles, 63);
  std::vector<double> parts((triangles + kFarthestChunk - 1) / kFarthestChunk, known_squared);
  std::atomic<bool> found{false};  // for "whether" only, where it does not matter what else there is
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    Search search(way, known_squared, only_whether);
    for (auto i = part * kFarthestChunk; i < std::min(triangles, (part + 1) * kFarthestChunk) && !found; ++i) {
      search.lookThrough(static_cast<std::uint32_t>(i), fresh.empty() ? nullptr : &fresh[i]);
      if (only_whether && search.maxSquared() > known_squared) found = true;
    }
    parts[part] = search.maxSquared();
  });
  return parts.empty() ? known_squared : *std::max_element(parts.begin(), parts.end());
}

}  // namespace

double OneWaySurfaces::squaredDistance(const Vector3d& p, std::uint32_t triangle) const {
  const auto& t = to.triangles[triangle];
  return (closestPoint(p, to.positions[t[0]], to.positions[t[1]], to.positions[t[2]]) - p).squaredNorm();
}

double farthestSquared(const OneWaySurfaces& way, double known_squared) { return searched(way, known_squared, false); }

std::vector<SurfacePoint> placesFurther(const OneWaySurfaces& way, double squared) {
  const auto triangles = way.from.triangles.size();
  if (triangles + way.to.triangles.size() > kMostSearched) return {};
  std::vector<std::vector<SurfacePoint>> parts((triangles + kFarthestChunk - 1) / kFarthestChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    for (auto i = part * kFarthestChunk; i < std::min(triangles, (part + 1) * kFarthestChunk); ++i) {
      Search search(way, squared, false);
      search.lookThrough(static_cast<std::uint32_t>(i), nullptr);
      if (search.maxSquared() > squared) parts[part].push_back({static_cast<std::uint32_t>(i), search.place()});
    }
  });
  std::vector<SurfacePoint> places;
  for (const auto& part : parts) places.insert(places.end(), part.begin(), part.end());
  return places;
}

bool isAnyFurther(const OneWaySurfaces& way, double squared) { return searched(way, squared, true) > squared; }

}  // namespace standpoint
