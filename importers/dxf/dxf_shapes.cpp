// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/dxf/dxf_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using Point3 = Eigen::Vector3d;

constexpr std::size_t kMostChords = 5'000'000;
constexpr int kClosed = 1, kClosedInN = 32, kMeshSmooth = 4, kPolygonMesh = 16, kLine3d = 8, kPolyface = 64;
constexpr const char* kFewCorners = "faces with fewer than three corners";
constexpr const char* kTooManyChords = "exceeds the limit of 5 000 000 chords of arcs";
constexpr const char* kWide = "polylines whose width varies or does not fit their corners, read without it";

void tally(DxfTallies& to, const std::string& what, std::size_t line) { to[what].add({1, line}); }

class FaceWriter {
 public:
  FaceWriter(DxfBlock& to, const DxfLook& look, std::size_t line, std::uint32_t entity = kLooseFaces)
      : to_(to), look_(look), line_(line), entity_(entity) {}

  std::uint32_t add(const Point3& p) const {
    to_.positions.push_back(p);
    return static_cast<std::uint32_t>(to_.positions.size() - 1);
  }
  // Of indices of positions.
  void face(std::span<const std::uint32_t> corners) const {
    const std::size_t index = to_.face_lines.size();
    auto& runs = to_.faces;
    if (runs.empty() || runs.back().entity != entity_ || !(runs.back().look == look_))
      runs.push_back({index, index, look_, entity_});
    runs.back().end = index + 1;
    to_.corners.insert(to_.corners.end(), corners.begin(), corners.end());
    to_.face_begins.push_back(to_.corners.size());
    to_.face_lines.push_back(line_);
  }
  void polygon(std::span<const Point3> corners) const {
    std::vector<std::uint32_t> indices;
    for (const Point3& p : corners) indices.push_back(add(p));
    face(indices);
  }

 private:
  DxfBlock& to_;
  const DxfLook& look_;
  std::size_t line_;
  std::uint32_t entity_;
};

std::uint32_t newEntity(DxfBlock& to, const DxfEntity& e) {
  to.entity_ids.push_back(e.id());
  return static_cast<std::uint32_t>(to.entity_ids.size() - 1);
}

// Without corners that repeat the one before; a face of fewer than three is none.
std::vector<Point3> withoutRepeats(std::initializer_list<Point3> corners) {
  std::vector<Point3> kept;
  for (const Point3& p : corners)
    if (kept.empty() || kept.back() != p) kept.push_back(p);
  while (kept.size() > 1 && kept.back() == kept.front()) kept.pop_back();
  return kept;
}

// Twice the area, positive where the ring turns counter-clockwise.
double turn(std::span<const Point3> ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

// The sides over a path, and where it is `capped` the two ends; those of a closed path face outward.
void extrude(std::vector<Point3> path, bool closed, bool capped, const Point3& by, const FaceWriter& to) {
  if (closed && turn(path) < 0) std::reverse(path.begin(), path.end());
  std::vector<std::uint32_t> low, high;
  for (const Point3& p : path) low.push_back(to.add(p)), high.push_back(to.add(p + by));
  if (by.z() < 0) std::swap(low, high);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < path.size(); ++i) {
    const std::size_t j = (i + 1) % path.size();
    to.face(std::array{low[i], low[j], high[j], high[i]});
  }
  if (!capped) return;
  to.face(high);
  std::reverse(low.begin(), low.end());
  to.face(low);
}

// Turns what was added after `from` into the world.
void toWorld(DxfBlock& block, std::size_t from, const Eigen::Matrix3d& world_from_object) {
  for (std::size_t i = from; i < block.positions.size(); ++i)
    block.positions[i] = world_from_object * block.positions[i];
}

Point3 leftOf(const Point3& direction) { return {-direction.y(), direction.x(), 0}; }

// The points to the left and to the right of a path, half a width from its pieces, which meet at a mitre. Nothing where
// a piece is too short for the mitres at its ends, or goes back.
struct Edges {
  std::vector<Point3> left, right;
};
std::optional<Edges> edgesOf(const std::vector<Point3>& path, bool closed, double width) {
  constexpr double kSharpest = 0.1;  // of the cosine of half a turn: 169°
  const std::size_t n = path.size(), pieces = closed ? n : n - 1;
  std::vector<Point3> along(pieces);
  for (std::size_t i = 0; i < pieces; ++i) along[i] = (path[(i + 1) % n] - path[i]).normalized();
  Edges edges;
  for (std::size_t i = 0; i < n; ++i) {
    const Point3 &before = along[i == 0 ? (closed ? pieces - 1 : 0) : i - 1], &after = along[std::min(i, pieces - 1)];
    const Point3 mean = (leftOf(before) + leftOf(after)) / 2;  // as long as the cosine of half the turn
    if (!(mean.norm() > kSharpest)) return std::nullopt;
    const Point3 offset = mean * (width / 2 / mean.squaredNorm());
    edges.left.emplace_back(path[i] + offset);
    edges.right.emplace_back(path[i] - offset);
  }
  for (std::size_t i = 0; i < pieces; ++i)
    for (const auto* edge : {&edges.left, &edges.right})
      if (!(((*edge)[(i + 1) % n] - (*edge)[i]).dot(along[i]) > 0)) return std::nullopt;
  return edges;
}

// A body over the strip between the edges.
void raise(const Edges& edges, bool closed, const Point3& by, const FaceWriter& to) {
  std::array<std::vector<std::uint32_t>, 4> of;  // low left, low right, high left, high right
  for (std::size_t i = 0; i < edges.left.size(); ++i) {
    of[0].push_back(to.add(edges.left[i])), of[1].push_back(to.add(edges.right[i]));
    of[2].push_back(to.add(edges.left[i] + by)), of[3].push_back(to.add(edges.right[i] + by));
  }
  if (by.z() < 0) std::swap(of[0], of[2]), std::swap(of[1], of[3]);
  const auto& [low_left, low_right, high_left, high_right] = of;
  const std::size_t n = edges.left.size(), last = n - 1;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t j = (i + 1) % n;
    to.face(std::array{low_right[i], low_right[j], high_right[j], high_right[i]});
    to.face(std::array{low_left[j], low_left[i], high_left[i], high_left[j]});
    to.face(std::array{high_right[i], high_right[j], high_left[j], high_left[i]});
    to.face(std::array{low_left[i], low_left[j], low_right[j], low_right[i]});
  }
  if (closed) return;
  to.face(std::array{low_left[0], low_right[0], high_right[0], high_left[0]});
  to.face(std::array{low_right[last], low_left[last], high_left[last], high_right[last]});
}

}  // namespace

void DxfShapes::face3d(const DxfEntity& e, const DxfLook& look, DxfBlock& to) const {
  const auto corners = withoutRepeats({e.point(10), e.point(11), e.point(12), e.has(13) ? e.point(13) : e.point(12)});
  if (corners.size() < 3) return tally(to.lost, kFewCorners, e.line);
  FaceWriter(to, look, e.line).polygon(corners);
}

Result<void> DxfShapes::mesh(const DxfEntity& e, const DxfLook& look, const DxfGroups& groups, DxfBlock& to) const {
  if (!e.facesAreWhole()) return groups.fault(e.line, "the list of faces ends early");
  if (e.has(91) && e.number(91) > 0) tally(to.lost, "meshes with smoothness, read as their base mesh", e.line);
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  const auto entity = newEntity(to, e);
  to.positions.insert(to.positions.end(), e.points.begin(), e.points.end());
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0, at = 0; f < e.face_ends.size(); ++f) {
    corners.clear();
    for (; at < e.face_ends[f]; ++at) corners.push_back(base + e.face_corners[at]);
    if (corners.size() < 3)
      tally(to.lost, kFewCorners, e.face_lines[f]);
    else
      FaceWriter(to, look, e.face_lines[f], entity).face(corners);
  }
  return {};
}

void DxfShapes::solid(const DxfEntity& e, const DxfLook& look, DxfBlock& to) const {
  // The corners are those of a Z.
  const auto corners = withoutRepeats({e.point(10), e.point(11), e.has(13) ? e.point(13) : e.point(12), e.point(12)});
  if (corners.size() < 3) return tally(to.lost, kFewCorners, e.line);
  const std::size_t from = to.positions.size();
  const FaceWriter writer(to, look, e.line);
  if (const double thickness = e.number(39); thickness != 0)
    extrude(corners, true, true, {0, 0, thickness}, writer);
  else
    writer.polygon(corners);
  toWorld(to, from, worldFromObject(e.normal()));
}

void DxfShapes::line(const DxfEntity& e, const DxfLook& look, DxfBlock& to) const {
  const double thickness = e.number(39);
  if (thickness == 0 || e.point(10) == e.point(11)) return tally(to.skipped, e.kind, e.line);
  const Point3 by = thickness * worldFromObject(e.normal()).col(2);
  extrude({e.point(10), e.point(11)}, false, false, by, FaceWriter(to, look, e.line));
}

Result<void> DxfShapes::circle(const DxfEntity& e, const DxfLook& look, const DxfGroups& groups, DxfBlock& to) {
  const Point3 centre = e.point(10);
  const double radius = e.number(40), from_rad = e.number(50) * std::numbers::pi / 180;
  const bool whole = e.kind == "CIRCLE";
  double sweep_rad = std::remainder(e.number(51) * std::numbers::pi / 180 - from_rad, 2 * std::numbers::pi);
  if (sweep_rad <= 0) sweep_rad += 2 * std::numbers::pi;
  if (whole) sweep_rad = 2 * std::numbers::pi;
  if (e.number(39) == 0 || !(radius > 0)) return tally(to.skipped, e.kind, e.line), Result<void>();
  const auto at = [&](double angle_rad) {
    return Point3(centre + radius * Point3(std::cos(angle_rad), std::sin(angle_rad), 0));
  };
  Path path;
  path.closed = whole;
  const double half = std::tan(sweep_rad / 8);  // of an arc in two pieces
  path.knots = {{at(from_rad), half}, {at(from_rad + sweep_rad / 2), half}};
  if (!whole) path.knots.push_back({at(from_rad + sweep_rad), 0});
  return extrudePath(e, path, look, groups, to);
}

Result<void> DxfShapes::lwPolyline(const DxfEntity& e, const DxfLook& look, const DxfGroups& groups, DxfBlock& to) {
  if (e.number(39) == 0 || e.points.size() < 2) return tally(to.skipped, e.kind, e.line), Result<void>();
  Path path;
  path.closed = (e.flags() & kClosed) != 0;
  const double all = e.number(43);
  for (std::size_t i = 0; i < e.points.size(); ++i)
    path.knots.push_back(
        {{e.points[i].x(), e.points[i].y(), e.number(38)}, e.bulges[i], all != 0 ? std::array{all, all} : e.widths[i]});
  return extrudePath(e, path, look, groups, to);
}

Result<void> DxfShapes::polyline(const DxfPolyline& p, const DxfGroups& groups, DxfBlock& to) {
  const DxfEntity& e = p.head;
  if ((e.flags() & kPolyface) != 0) return polyfaceMesh(p, to), Result<void>();
  if ((e.flags() & kPolygonMesh) != 0) {
    const bool smooth = (e.flags() & kMeshSmooth) != 0;
    const double m = e.number(smooth ? 73 : 71), n = e.number(smooth ? 74 : 72);
    if (!(m >= 2 && n >= 2 && m * n == static_cast<double>(p.vertices.size())))
      return groups.fault(e.line, "is a polygon mesh of " + std::to_string(static_cast<std::int64_t>(m)) + " by " +
                                      std::to_string(static_cast<std::int64_t>(n)) + " vertices, but has " +
                                      std::to_string(p.vertices.size()));
    return polygonMesh(p, static_cast<std::size_t>(m), static_cast<std::size_t>(n), to), Result<void>();
  }
  const bool flat = (e.flags() & kLine3d) == 0;
  if (!flat || e.number(39) == 0 || p.vertices.size() < 2) return tally(to.skipped, e.kind, e.line), Result<void>();
  Path path;
  path.closed = (e.flags() & kClosed) != 0;
  for (const auto& v : p.vertices) path.knots.push_back({{v.at.x(), v.at.y(), e.number(30)}, v.bulge, v.widths});
  return extrudePath(e, path, p.look, groups, to);
}

void DxfShapes::polygonMesh(const DxfPolyline& p, std::size_t m, std::size_t n, DxfBlock& to) const {
  const auto base = to.positions.size();
  for (const auto& v : p.vertices) to.positions.push_back(v.at);
  const FaceWriter writer(to, p.look, p.head.line, newEntity(to, p.head));
  const bool around_m = (p.head.flags() & kClosed) != 0, around_n = (p.head.flags() & kClosedInN) != 0;
  const auto corner = [&](std::size_t i, std::size_t j) {
    return static_cast<std::uint32_t>(base + i % m * n + j % n);
  };
  for (std::size_t i = 0; i + (around_m ? 0 : 1) < m; ++i)
    for (std::size_t j = 0; j + (around_n ? 0 : 1) < n; ++j)
      writer.face(std::array{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
}

void DxfShapes::polyfaceMesh(const DxfPolyline& p, DxfBlock& to) const {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  for (const auto& v : p.vertices) to.positions.push_back(v.at);
  const auto entity = newEntity(to, p.head);
  for (const auto& face : p.faces) {
    if (face.count < 3) {
      tally(to.lost, kFewCorners, face.line);
      continue;
    }
    auto corners = face.corners;
    for (auto& c : corners) c += base;
    FaceWriter(to, face.look, face.line, entity).face(std::span(corners).first(face.count));
  }
}

// A bulge is the tangent of a quarter of the arc's angle, positive where it turns counter-clockwise.
Result<std::vector<Point3>> DxfShapes::flattened(const Path& path, std::size_t line, const DxfGroups& groups) {
  std::vector<Point3> points;
  const auto& knots = path.knots;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    points.push_back(knots[i].at);
    const double k = knots[i].bulge;
    const bool last = i + 1 == knots.size();
    const Point3 &a = knots[i].at, &b = knots[last ? 0 : i + 1].at;
    if (k == 0 || (last && !path.closed) || a == b) continue;
    const Point3 left(-(b - a).y(), (b - a).x(), 0);
    const Point3 centre = (a + b) / 2 + left * ((1 - k * k) / (4 * k)), spoke = a - centre;
    const double sweep_rad = 4 * std::atan(k);
    const int pieces = geometry::segmentCount(spoke.norm() * metres_per_unit_, std::abs(sweep_rad), tessellation_);
    if ((chords_ += static_cast<std::size_t>(pieces)) > kMostChords) return groups.fault(line, kTooManyChords);
    for (int j = 1; j < pieces; ++j) {
      const double angle_rad = sweep_rad * j / pieces, c = std::cos(angle_rad), s = std::sin(angle_rad);
      points.push_back(centre + Point3(c * spoke.x() - s * spoke.y(), s * spoke.x() + c * spoke.y(), 0));
    }
  }
  return points;
}

// That of all pieces; nothing where they differ.
std::optional<double> DxfShapes::widthOf(const Path& path) {
  const double width = path.knots.front().widths[0];
  for (std::size_t i = 0; i + (path.closed ? 0 : 1) < path.knots.size(); ++i)
    for (const double w : path.knots[i].widths)
      if (w != width) return std::nullopt;
  return width >= 0 ? std::optional(width) : std::nullopt;
}

// A circle is a solid then, a polyline with a width a wall, and a closed one without width has neither ceiling nor
// floor.
Result<void> DxfShapes::extrudePath(const DxfEntity& e, const Path& path, const DxfLook& look, const DxfGroups& groups,
                                    DxfBlock& to) {
  TRY_ASSIGN(auto points, flattened(path, e.line, groups));
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (path.closed && points.size() > 1 && points.back() == points.front()) points.pop_back();
  if (points.size() < (path.closed ? 3 : 2)) return tally(to.skipped, e.kind, e.line), Result<void>();
  const std::size_t from = to.positions.size();
  const FaceWriter writer(to, look, e.line, newEntity(to, e));
  const Point3 by(0, 0, e.number(39));
  const auto width = widthOf(path);
  const auto edges = width.value_or(0) > 0 ? edgesOf(points, path.closed, *width) : std::nullopt;
  if (!width || (*width > 0 && !edges)) tally(to.lost, kWide, e.line);
  if (edges && (chords_ += 3 * points.size()) > kMostChords)  // four faces to each
    return groups.fault(e.line, kTooManyChords);
  if (edges)
    raise(*edges, path.closed, by, writer);
  else
    extrude(std::move(points), path.closed, e.kind == "CIRCLE", by, writer);
  toWorld(to, from, worldFromObject(e.normal()));
  return {};
}

}  // namespace standpoint
