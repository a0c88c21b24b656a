// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/geometry/arrangement.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

constexpr std::size_t kMaxSegments = 20000;
constexpr std::size_t kMaxWindings = 20'000'000;
constexpr int kMaxRounds = 12;
constexpr std::size_t kMaxMeetings = 5'000'000;  // of pieces in each other's boxes: edges that all lie on one another

// Finds or adds the point within the snapping distance. Looked up only, so that the hash order does not show.
class Points {
 public:
  Points(double snap_m, std::vector<Eigen::Vector2d>& points) : snap_(snap_m), cell_(64 * snap_m), points_(points) {}

  std::uint32_t add(const Eigen::Vector2d& p) {
    const std::int64_t x0 = index(p.x() - snap_), x1 = index(p.x() + snap_);
    const std::int64_t y0 = index(p.y() - snap_), y1 = index(p.y() + snap_);
    for (std::int64_t x = x0; x <= x1; ++x) {
      for (std::int64_t y = y0; y <= y1; ++y) {
        const auto found = head_.find(key(x, y));
        if (found == head_.end()) continue;
        for (std::uint32_t i = found->second; i != kNone; i = next_[i]) {
          if ((points_[i] - p).squaredNorm() <= snap_ * snap_) return i;
        }
      }
    }
    const auto id = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    next_.resize(points_.size(), kNone);
    const auto [at, fresh] = head_.try_emplace(key(index(p.x()), index(p.y())), id);
    if (!fresh) next_[id] = std::exchange(at->second, id);
    return id;
  }
  void keepPlace(const Eigen::Vector2d& p) {  // a point that another stands for: holds its index, is never found
    points_.push_back(p);
    next_.resize(points_.size(), kNone);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::int64_t index(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ull ^
           static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Full;
  }
  double snap_, cell_;
  std::vector<Eigen::Vector2d>& points_;
  std::vector<std::uint32_t> next_;
  std::unordered_map<std::uint64_t, std::uint32_t> head_;
};

struct Piece {
  std::uint32_t a, b, source;
};

class Splitter {
 public:
  Splitter(std::vector<Eigen::Vector2d>& points, Points& finder, double snap_m)
      : points_(points), finder_(finder), snap_(snap_m) {}

  // Of all rounds so far more pieces lay in each other's boxes than it is worth.
  bool exhausted() const { return meetings_ > kMaxMeetings; }

  // One round: every piece is cut where another one meets it. True when something was cut.
  bool round(std::vector<Piece>& pieces) {
    cuts_.assign(pieces.size(), {});
    std::vector<std::uint32_t> order(pieces.size());
    std::vector<std::array<double, 4>> box(pieces.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      order[i] = i;
      const Eigen::Vector2d &a = points_[pieces[i].a], &b = points_[pieces[i].b];
      box[i] = {std::min(a.x(), b.x()) - snap_, std::max(a.x(), b.x()) + snap_, std::min(a.y(), b.y()) - snap_,
                std::max(a.y(), b.y()) + snap_};
    }
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t i, std::uint32_t j) { return box[i][0] != box[j][0] ? box[i][0] < box[j][0] : i < j; });
    for (std::size_t i = 0; i < order.size() && !exhausted(); ++i) {
      const std::uint32_t s = order[i];
      for (std::size_t j = i + 1; j < order.size() && box[order[j]][0] <= box[s][1]; ++j) {
        const std::uint32_t t = order[j];
        if (box[s][2] <= box[t][3] && box[t][2] <= box[s][3]) ++meetings_, meet(pieces, s, t);
      }
    }
    return cutAll(pieces);
  }

 private:
  bool touches(const Piece& s, std::uint32_t p, std::uint32_t index) {
    if (p == s.a || p == s.b) return false;
    const Eigen::Vector2d &a = points_[s.a], d = points_[s.b] - a, to_p = points_[p] - a;
    const double along = d.dot(to_p), length2 = d.squaredNorm();
    if (along <= 0 || along >= length2) return false;
    if (std::abs(cross(d, to_p)) > snap_ * std::sqrt(length2)) return false;
    cuts_[index].push_back(p);
    return true;
  }

  void meet(const std::vector<Piece>& pieces, std::uint32_t s, std::uint32_t t) {
    const Piece ps = pieces[s], pt = pieces[t];
    bool touched = touches(ps, pt.a, s);
    touched = touches(ps, pt.b, s) || touched;
    touched = touches(pt, ps.a, t) || touched;
    touched = touches(pt, ps.b, t) || touched;
    if (touched || ps.a == pt.a || ps.a == pt.b || ps.b == pt.a || ps.b == pt.b) return;
    const Eigen::Vector2d a = points_[ps.a], b = points_[ps.b], c = points_[pt.a], d = points_[pt.b];
    const double c_side = cross(a, b, c), d_side = cross(a, b, d), a_side = cross(c, d, a), b_side = cross(c, d, b);
    if ((c_side > 0) == (d_side > 0) || (a_side > 0) == (b_side > 0)) return;
    const std::uint32_t x = finder_.add(a + (b - a) * (a_side / (a_side - b_side)));
    if (x != ps.a && x != ps.b) cuts_[s].push_back(x);
    if (x != pt.a && x != pt.b) cuts_[t].push_back(x);
  }

  bool cutAll(std::vector<Piece>& pieces) {
    std::vector<Piece> result;
    result.reserve(pieces.size());
    bool any = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      std::vector<std::uint32_t>& cuts = cuts_[i];
      if (cuts.empty()) {
        result.push_back(pieces[i]);
        continue;
      }
      any = true;
      const Eigen::Vector2d a = points_[pieces[i].a], d = points_[pieces[i].b] - a;
      std::sort(cuts.begin(), cuts.end(), [&](std::uint32_t p, std::uint32_t q) {
        const double along_p = d.dot(points_[p] - a), along_q = d.dot(points_[q] - a);
        return along_p != along_q ? along_p < along_q : p < q;
      });
      cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
      std::uint32_t from = pieces[i].a;
      for (std::uint32_t cut : cuts) {
        result.push_back({from, cut, pieces[i].source});
        from = cut;
      }
      result.push_back({from, pieces[i].b, pieces[i].source});
    }
    pieces = std::move(result);
    return any;
  }

  std::vector<Eigen::Vector2d>& points_;
  Points& finder_;
  std::size_t meetings_ = 0;
  double snap_;
  std::vector<std::vector<std::uint32_t>> cuts_;
};

// Pieces between the same two points become one edge; what each layer gains in crossing it from right to left is
// summed.
std::vector<int> mergePieces(Arrangement& result, std::vector<Piece> pieces, std::span<const Segment> segments) {
  std::vector<int> gains;
  std::sort(pieces.begin(), pieces.end(), [](const Piece& p, const Piece& q) {
    return std::tuple(std::min(p.a, p.b), std::max(p.a, p.b), p.source) <
           std::tuple(std::min(q.a, q.b), std::max(q.a, q.b), q.source);
  });
  std::vector<int> gain(result.layers);
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    const std::uint32_t low = std::min(pieces[begin].a, pieces[begin].b),
                        high = std::max(pieces[begin].a, pieces[begin].b);
    std::fill(gain.begin(), gain.end(), 0);
    for (; end < pieces.size() && std::min(pieces[end].a, pieces[end].b) == low &&
           std::max(pieces[end].a, pieces[end].b) == high;
         ++end) {
      const Segment& segment = segments[pieces[end].source];
      const int by = pieces[end].a == low ? segment.weight : -segment.weight;
      for (std::uint32_t l = segment.first_layer; l < segment.last_layer; ++l) gain[l] += by;
    }
    if (std::all_of(gain.begin(), gain.end(), [](int g) { return g == 0; })) continue;
    result.edges.push_back({low, high, segments[pieces[begin].source].tag});
    gains.insert(gains.end(), gain.begin(), gain.end());
  }
  return gains;
}

// A ray from the middle of each edge, along x or y, whichever the edge is further from.
void wind(Arrangement& result, const std::vector<int>& gains) {
  const std::size_t layers = result.layers;
  result.left.assign(gains.size(), 0);
  result.right.assign(gains.size(), 0);
  for (std::size_t e = 0; e < result.edges.size(); ++e) {
    const Eigen::Vector2d a = result.points[result.edges[e].a], b = result.points[result.edges[e].b];
    const Eigen::Vector2d middle = 0.5 * (a + b), along = (b - a).cwiseAbs();
    const int u = along.y() >= along.x() ? 0 : 1, v = 1 - u;  // the ray runs along +u
    int* beyond = result.right.data() + e * layers;           // the side of the edge that the ray leaves to
    for (std::size_t f = 0; f < result.edges.size(); ++f) {
      const Eigen::Vector2d &c = result.points[result.edges[f].a], &d = result.points[result.edges[f].b];
      if (f == e || (c[v] > middle[v]) == (d[v] > middle[v])) continue;
      if (c[u] + (middle[v] - c[v]) * (d[u] - c[u]) / (d[v] - c[v]) <= middle[u]) continue;
      const int sign = (d[v] > c[v]) == (u == 0) ? 1 : -1;
      for (std::size_t l = 0; l < layers; ++l) beyond[l] += sign * gains[f * layers + l];
    }
    const bool beyond_is_right = u == 0 ? b.y() > a.y() : b.x() < a.x();
    for (std::size_t l = 0; l < layers; ++l) {
      const int here = beyond[l], gain = gains[e * layers + l];
      result.left[e * layers + l] = beyond_is_right ? here + gain : here;
      result.right[e * layers + l] = beyond_is_right ? here : here - gain;
    }
  }
}

struct Arrow {
  std::uint32_t from, to, edge;
  bool used = false;
};

double angleOf(const Arrangement& arrangement, std::uint32_t from, std::uint32_t to) {
  const Eigen::Vector2d d = arrangement.points[to] - arrangement.points[from];
  return std::atan2(d.y(), d.x());
}

// The first free arrow out of a point, clockwise from where we came: it bounds the same piece of the inside.
Arrow* leave(const Arrangement& arrangement, std::vector<Arrow>& arrows, std::uint32_t from, std::uint32_t came_from) {
  auto it =
      std::lower_bound(arrows.begin(), arrows.end(), from, [](const Arrow& a, std::uint32_t p) { return a.from < p; });
  Arrow* best = nullptr;
  double best_turn = 0;
  const bool alone = it != arrows.end() && it->from == from && (it + 1 == arrows.end() || (it + 1)->from != from);
  if (alone) return it->used ? nullptr : &*it;
  const double back = angleOf(arrangement, from, came_from);
  for (; it != arrows.end() && it->from == from; ++it) {
    if (it->used) continue;
    double turn = back - angleOf(arrangement, from, it->to);
    if (turn <= 0) turn += 2 * M_PI;
    if (!best || turn < best_turn) best = &*it, best_turn = turn;
  }
  return best;
}

// A walk that meets a point again is cut there into loops of their own.
void cutAtRepeats(const std::vector<const Arrow*>& walk, const Arrangement& arrangement,
                  std::vector<BoundaryLoop>& loops) {
  std::vector<const Arrow*> open;
  std::unordered_map<std::uint32_t, std::size_t> position;  // looked up only
  for (const Arrow* arrow : walk) {
    position[arrow->from] = open.size();
    open.push_back(arrow);
    const auto again = position.find(arrow->to);
    if (again == position.end()) continue;
    BoundaryLoop loop;
    for (std::size_t i = again->second; i < open.size(); ++i) {
      loop.points.push_back(open[i]->from);
      loop.edges.push_back(open[i]->edge);
    }
    loop.tag = arrangement.edges[loop.edges[0]].tag;
    const std::size_t keep = again->second;
    for (std::size_t i = keep; i < open.size(); ++i) position.erase(open[i]->from);
    open.resize(keep);
    loops.push_back(std::move(loop));
  }
}

}  // namespace

std::optional<Arrangement> arrange(std::span<const Eigen::Vector2d> points, std::span<const Segment> segments,
                                   std::size_t layers, double snap_m) {
  if (segments.size() > kMaxSegments) return std::nullopt;
  Arrangement result;
  result.layers = layers;
  Points finder(snap_m, result.points);
  for (const Eigen::Vector2d& p : points) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e7) return std::nullopt;
    const auto before = static_cast<std::uint32_t>(result.points.size());
    const std::uint32_t id = finder.add(p);
    if (id != before) finder.keepPlace(p);
    result.point_of_input.push_back(id);
  }
  std::vector<Piece> pieces;
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const std::uint32_t a = result.point_of_input[segments[s].a], b = result.point_of_input[segments[s].b];
    if (a != b) pieces.push_back({a, b, s});
  }
  Splitter splitter(result.points, finder, snap_m);
  int rounds = 0;
  while (splitter.round(pieces)) {
    if (++rounds > kMaxRounds || splitter.exhausted() || pieces.size() > 4 * kMaxSegments) return std::nullopt;
  }
  if (splitter.exhausted()) return std::nullopt;
  const std::vector<int> gains = mergePieces(result, std::move(pieces), segments);
  if (gains.size() > kMaxWindings || result.edges.size() > kMaxSegments) return std::nullopt;
  wind(result, gains);
  return result;
}

std::optional<std::vector<BoundaryLoop>> boundary(const Arrangement& arrangement,
                                                  const std::function<bool(std::span<const int>)>& inside) {
  std::vector<Arrow> arrows;
  for (std::uint32_t e = 0; e < arrangement.edges.size(); ++e) {
    const bool left = inside(arrangement.leftOf(e)), right = inside(arrangement.rightOf(e));
    if (left == right) continue;
    const auto [a, b, tag] = arrangement.edges[e];
    arrows.push_back(left ? Arrow{a, b, e} : Arrow{b, a, e});
  }
  std::sort(arrows.begin(), arrows.end(),
            [](const Arrow& p, const Arrow& q) { return std::tie(p.from, p.to) < std::tie(q.from, q.to); });
  std::vector<BoundaryLoop> loops;
  for (Arrow& start : arrows) {
    if (start.used) continue;
    std::vector<const Arrow*> walk;
    for (Arrow* current = &start; current;) {
      current->used = true;
      walk.push_back(current);
      if (current->to == start.from) break;
      current = leave(arrangement, arrows, current->to, current->from);
      if (!current) return std::nullopt;
    }
    cutAtRepeats(walk, arrangement, loops);
  }
  return loops;
}

}  // namespace standpoint::geometry
