// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/collapse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "optimizer/quadric.h"
#include "optimizer/triangle_tree.h"

namespace standpoint {

namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kMaxCorners = 400;       // of one vertex; bounds the time of a fan
constexpr double kCreaseCosine = 0.866;          // 30°
constexpr double kFeatureWeight = 0.3;           // of a constraint plane, times the squared length of its edge
constexpr double kShortestFirst = 1e-12;         // among equal costs: 1 m of edge weighs like 1 µm of deviation
constexpr double kLargestTurnCosine = 0.2;       // a triangle may turn by 78° in one step

using Eigen::Vector3d;

struct Candidate {
  double cost = 0;
  std::uint32_t a = 0, b = 0, age_a = 0, age_b = 0;
  bool operator<(const Candidate& o) const {  // std heaps keep the greatest on top; we want the cheapest
    return std::tie(o.cost, o.a, o.b, o.age_a, o.age_b) < std::tie(cost, a, b, age_a, age_b);
  }
};

// Triangles as an array, each corner a link in its vertex's list of corners (corner = 3 * triangle + k).
class Collapser {
 public:
  Collapser(const Shape& shape, const CollapseOptions& options);
  std::vector<Collapse> run(const Progress& progress);

 private:
  struct Effect {  // what a collapse would do
    std::uint32_t vanishing = 0, surviving = 0;
    bool flips = false;
    double longest_edge = 0;  // of the vanishing triangles
  };

  void linkCorners();
  void addPlanes();
  void addFeatures();
  void addFeature(std::uint32_t a, std::uint32_t b, const Vector3d& normal);
  void push(std::uint32_t a, std::uint32_t b);
  void pushAround(std::uint32_t v);
  Vector3d place(std::uint32_t a, std::uint32_t b, const Quadric& q) const;
  Effect effect(std::uint32_t a, std::uint32_t b, const Vector3d& p);
  void addEffect(std::uint32_t v, std::uint32_t other, bool first, const Vector3d& p, Effect& effect);
  double price(const Candidate& c, const Quadric& q, const Effect& e, double base) const;
  bool tooFar(std::uint32_t a, std::uint32_t b, const Vector3d& p, const Effect& e, double& deviation) const;
  void apply(std::uint32_t a, std::uint32_t b, const Vector3d& p);
  void vanish(std::vector<Collapse>& log) const;

  bool isFlat(const Vector3d& normal, const Vector3d& e1, const Vector3d& e2) const {
    return normal.squaredNorm() <= rounding_ * rounding_ * std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
  }
  bool dead(std::uint32_t triangle) const { return triangles_[triangle][0] == kNone; }

  template <class Visit>
  void forTriangles(std::uint32_t v, Visit visit) {  // drops the links of dead triangles on its way
    std::uint32_t* link = &first_corner_[v];
    std::uint32_t last = kNone;
    while (*link != kNone) {
      const std::uint32_t corner = *link;
      if (dead(corner / 3)) {
        *link = next_corner_[corner];
        --corner_count_[v];
        continue;
      }
      visit(corner / 3);
      last = corner;
      link = &next_corner_[corner];
    }
    last_corner_[v] = last;
  }

  CollapseOptions options_;
  double rounding_;
  Vector3d half_size_;
  double diagonal_;
  std::vector<Vector3d> positions_;
  std::vector<Triangle> triangles_;
  const std::vector<std::uint32_t>& surfaces_;
  std::vector<std::uint32_t> first_corner_, last_corner_, next_corner_, corner_count_, age_, mark_;
  std::vector<Quadric> quadrics_;
  std::vector<Quadric> features_;     // lossless only: unweighted, so that its root bounds the distance to each
  std::vector<float> deviation_m_;    // of what was gathered at a vertex, from the surface that it has now
  std::vector<Candidate> heap_;
  std::vector<std::array<Vector3d, 3>> before_, after_;  // the triangles around a candidate
  std::uint32_t epoch_ = 0;
};

Collapser::Collapser(const Shape& shape, const CollapseOptions& options)
    : options_(options), rounding_(shape.rounding()), half_size_(shape.half_size), diagonal_(shape.diagonal()),
      positions_(shape.positions), triangles_(shape.triangles), surfaces_(shape.surface_of_triangle),
      first_corner_(positions_.size(), kNone), last_corner_(positions_.size(), kNone), next_corner_(3 * triangles_.size(), kNone),
      corner_count_(positions_.size(), 0), age_(positions_.size(), 0), mark_(positions_.size(), 0), quadrics_(positions_.size()),
      features_(options.lossless ? positions_.size() : 0), deviation_m_(positions_.size(), 0) {
  linkCorners();
  addPlanes();
  addFeatures();
}

void Collapser::linkCorners() {
  for (std::uint32_t corner = 0; corner < next_corner_.size(); ++corner) {
    const auto v = triangles_[corner / 3][corner % 3];
    if (first_corner_[v] == kNone) first_corner_[v] = corner;
    else next_corner_[last_corner_[v]] = corner;
    last_corner_[v] = corner;
    ++corner_count_[v];
  }
}

void Collapser::addPlanes() {
  for (const auto& t : triangles_) {
    const Vector3d e1 = positions_[t[1]] - positions_[t[0]], e2 = positions_[t[2]] - positions_[t[0]];
    const Vector3d normal = e1.cross(e2);
    if (isFlat(normal, e1, e2)) continue;
    const double length = normal.norm();
    for (const auto v : t) quadrics_[v].addPlane(normal / length, positions_[t[0]], length / 6);
  }
}

// A plane through the edge, upright on its triangle: it holds the edge where its triangles' own planes do not (borders of
// the mesh and between surfaces), and the rim of thin parts, whose side has too little area to speak for itself.
void Collapser::addFeature(std::uint32_t a, std::uint32_t b, const Vector3d& normal) {
  const Vector3d edge = positions_[b] - positions_[a];
  const Vector3d upright = edge.cross(normal);
  const double length = upright.norm();
  if (!(length > 0)) return;
  for (const auto v : {a, b}) {
    quadrics_[v].addPlane(upright / length, positions_[a], kFeatureWeight * edge.squaredNorm());
    if (options_.lossless) features_[v].addPlane(upright / length, positions_[a], 1);
  }
}

void Collapser::addFeatures() {
  struct Edge {
    std::uint64_t key;
    std::uint32_t triangle;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangles_.size());
  std::vector<Vector3d> normals(triangles_.size(), Vector3d::Zero());
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const auto& t = triangles_[i];
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b) << 32U | std::max(a, b), i});
    }
    const Vector3d e1 = positions_[t[1]] - positions_[t[0]], e2 = positions_[t[2]] - positions_[t[0]];
    const Vector3d normal = e1.cross(e2);
    // A needle's normal is noise: it must not make a crease of the plane that it lies in.
    if (normal.norm() > 100 * rounding_ * std::max({e1.norm(), e2.norm(), (e2 - e1).norm()})) normals[i] = normal.normalized();
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return std::tie(x.key, x.triangle) < std::tie(y.key, y.triangle); });
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j].key == edges[i].key) ++j;
    bool feature = j - i == 1;
    const Vector3d* reference = nullptr;
    for (std::size_t k = i; k < j; ++k) {
      const auto& normal = normals[edges[k].triangle];
      feature |= surfaces_[edges[k].triangle] != surfaces_[edges[i].triangle];
      if (normal.isZero()) continue;
      feature |= reference != nullptr && reference->dot(normal) < kCreaseCosine;
      if (reference == nullptr) reference = &normal;
    }
    const auto a = static_cast<std::uint32_t>(edges[i].key >> 32U), b = static_cast<std::uint32_t>(edges[i].key);
    for (std::size_t k = i; feature && k < j; ++k) addFeature(a, b, normals[edges[k].triangle]);
  }
  for (std::size_t i = 0; i < edges.size(); ++i)  // only now are the quadrics whole
    if (i == 0 || edges[i].key != edges[i - 1].key)
      push(static_cast<std::uint32_t>(edges[i].key >> 32U), static_cast<std::uint32_t>(edges[i].key));
}

Vector3d Collapser::place(std::uint32_t a, std::uint32_t b, const Quadric& q) const {
  const Vector3d &pa = positions_[a], &pb = positions_[b], middle = 0.5 * (pa + pb);
  const double cost_a = q(pa), cost_b = q(pb);
  const Vector3d& end = cost_a <= cost_b ? pa : pb;
  const double cost_end = std::min(cost_a, cost_b);
  // An end that is as good up to rounding keeps its exact position, so that planes stay planes.
  if (options_.lossless || cost_end <= q.weight * rounding_ * rounding_) return end;
  Vector3d best = q.minimum(middle).cwiseMax(-half_size_).cwiseMin(half_size_);
  if (!((best - middle).squaredNorm() <= 4 * (pb - pa).squaredNorm())) best = middle;  // ill-conditioned, or not finite
  return q(best) < cost_end ? best : end;
}

void Collapser::push(std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  Quadric q = quadrics_[a];
  q += quadrics_[b];
  const Vector3d p = place(a, b, q);
  const double cost = q(p);
  if (cost > 4 * q.weight * options_.max_deviation_m * options_.max_deviation_m) return;
  if (options_.lossless) {
    Quadric f = features_[a];
    f += features_[b];
    if (f(p) > 4 * options_.max_deviation_m * options_.max_deviation_m) return;
  }
  heap_.push_back({cost + kShortestFirst * q.weight * (positions_[a] - positions_[b]).squaredNorm(), a, b, age_[a], age_[b]});
}

void Collapser::addEffect(std::uint32_t v, std::uint32_t other, bool first, const Vector3d& p, Effect& e) {
  forTriangles(v, [&](std::uint32_t i) {
    const auto& t = triangles_[i];
    const bool shared = t[0] == other || t[1] == other || t[2] == other;
    if (shared && !first) return;
    std::array<Vector3d, 3> old{positions_[t[0]], positions_[t[1]], positions_[t[2]]};
    before_.push_back(old);
    if (shared) {
      ++e.vanishing;
      for (int k = 0; k < 3; ++k) e.longest_edge = std::max(e.longest_edge, (old[k] - old[(k + 1) % 3]).norm());
      return;
    }
    ++e.surviving;
    auto now = old;
    for (int k = 0; k < 3; ++k)
      if (t[k] == v) now[k] = p;
    after_.push_back(now);
    const Vector3d e1 = old[1] - old[0], e2 = old[2] - old[0], f1 = now[1] - now[0], f2 = now[2] - now[0];
    const Vector3d n = e1.cross(e2), m = f1.cross(f2);
    const bool flat_now = isFlat(m, f1, f2);
    e.flips |= isFlat(n, e1, e2) ? !flat_now : flat_now || n.dot(m) < kLargestTurnCosine * n.norm() * m.norm();
  });
}

Collapser::Effect Collapser::effect(std::uint32_t a, std::uint32_t b, const Vector3d& p) {
  Effect e;
  before_.clear();
  after_.clear();
  addEffect(a, b, true, p, e);
  addEffect(b, a, false, p, e);
  return e;
}

// What a candidate really costs. Folding a triangle over costs as if its whole neighbourhood moved by the edge's length;
// a part that vanishes costs its area times its squared size. Both keep a shape able to reach any count, last of all.
double Collapser::price(const Candidate& c, const Quadric& q, const Effect& e, double base) const {
  if (e.surviving == 0) return std::max(base, q.weight * e.longest_edge * e.longest_edge / 4);
  if (e.flips) return std::max(base, q.weight * (positions_[c.a] - positions_[c.b]).squaredNorm());
  return base;
}

bool Collapser::tooFar(std::uint32_t a, std::uint32_t b, const Vector3d& p, const Effect& e, double& deviation) const {
  const double before = std::max(deviation_m_[a], deviation_m_[b]);
  deviation = before;
  if (options_.max_deviation_m >= diagonal_) return false;
  const auto distance = [](const Vector3d& from, const std::vector<std::array<Vector3d, 3>>& star) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : star) best = std::min(best, (closestPoint(from, t[0], t[1], t[2]) - from).squaredNorm());
    return std::sqrt(best);
  };
  const double here = e.surviving == 0 ? e.longest_edge / 2
                                       : std::max({distance(positions_[a], after_), distance(positions_[b], after_), distance(p, before_)});
  deviation = before + here;
  return deviation > options_.max_deviation_m;
}

void Collapser::apply(std::uint32_t a, std::uint32_t b, const Vector3d& p) {
  for (std::uint32_t corner = first_corner_[b]; corner != kNone; corner = next_corner_[corner]) {
    auto& t = triangles_[corner / 3];
    if (t[0] == kNone) continue;
    if (t[0] == a || t[1] == a || t[2] == a) t = {kNone, kNone, kNone};
    else t[corner % 3] = a;
  }
  if (first_corner_[a] == kNone) first_corner_[a] = first_corner_[b];
  else next_corner_[last_corner_[a]] = first_corner_[b];
  if (first_corner_[b] != kNone) last_corner_[a] = last_corner_[b];
  corner_count_[a] += corner_count_[b];
  first_corner_[b] = kNone;
  positions_[a] = p;
  quadrics_[a] += quadrics_[b];
  if (options_.lossless) features_[a] += features_[b];
  ++age_[a];
  ++age_[b];
}

void Collapser::pushAround(std::uint32_t v) {
  ++epoch_;
  mark_[v] = epoch_;
  forTriangles(v, [&](std::uint32_t i) {
    for (const auto n : triangles_[i]) {
      if (mark_[n] == epoch_) continue;
      mark_[n] = epoch_;
      const auto size = heap_.size();
      push(v, n);
      if (heap_.size() > size) std::push_heap(heap_.begin(), heap_.end());
    }
  });
}

// The last step of all: whatever is left goes at once.
void Collapser::vanish(std::vector<Collapse>& log) const {
  const auto count = std::count_if(triangles_.begin(), triangles_.end(), [](const Triangle& t) { return t[0] != kNone; });
  if (count > 0) log.push_back({0, 0, static_cast<std::uint32_t>(count), Vector3d::Zero()});
}

std::vector<Collapse> Collapser::run(const Progress& progress) {
  std::vector<Collapse> log;
  std::make_heap(heap_.begin(), heap_.end());
  for (std::size_t round = 0; !heap_.empty(); ++round) {
    if (round % 1024 == 0 && progress.cancelled()) return log;
    std::pop_heap(heap_.begin(), heap_.end());
    Candidate c = heap_.back();
    heap_.pop_back();
    if (c.age_a != age_[c.a] || c.age_b != age_[c.b] || corner_count_[c.a] + corner_count_[c.b] > kMaxCorners) continue;
    Quadric q = quadrics_[c.a];
    q += quadrics_[c.b];
    const Vector3d p = place(c.a, c.b, q);
    const Effect e = effect(c.a, c.b, p);
    if (e.vanishing == 0 || (options_.lossless && (e.flips || e.surviving == 0))) continue;
    const double cost = price(c, q, e, c.cost);
    double deviation = 0;
    if (tooFar(c.a, c.b, p, e, deviation)) continue;
    if (cost > c.cost) {
      c.cost = cost;
      heap_.push_back(c);
      std::push_heap(heap_.begin(), heap_.end());
      continue;
    }
    apply(c.a, c.b, p);
    deviation_m_[c.a] = static_cast<float>(deviation);
    log.push_back({c.a, c.b, e.vanishing, p});
    pushAround(c.a);
  }
  if (!options_.lossless && options_.max_deviation_m >= diagonal_ / 2) vanish(log);
  return log;
}

}  // namespace

std::vector<Collapse> recordCollapses(const Shape& shape, const CollapseOptions& options, const Progress& progress) {
  if (shape.triangles.empty()) return {};
  CollapseOptions limited = options;
  if (options.lossless) limited.max_deviation_m = 2 * shape.rounding();
  return Collapser(shape, limited).run(progress);
}

Shape replay(const Shape& shape, const std::vector<Collapse>& log, std::size_t steps, std::vector<std::uint32_t>* image) {
  Shape result;
  result.centre = shape.centre;
  result.half_size = shape.half_size;
  result.positions = shape.positions;
  std::vector<std::uint32_t> joined(shape.positions.size());
  std::iota(joined.begin(), joined.end(), 0U);
  if (image) image->assign(shape.triangles.size(), kNone);
  if (steps > 0 && log[steps - 1].kept == log[steps - 1].removed) return result;
  for (std::size_t i = 0; i < steps; ++i) {
    joined[log[i].removed] = log[i].kept;
    result.positions[log[i].kept] = log[i].position;
  }
  const auto root = [&](std::uint32_t v) {
    while (joined[v] != v) v = joined[v] = joined[joined[v]];
    return v;
  };
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const auto& t = shape.triangles[i];
    const Triangle now{root(t[0]), root(t[1]), root(t[2])};
    if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
    if (image) (*image)[i] = static_cast<std::uint32_t>(result.triangles.size());
    result.triangles.push_back(now);
    result.surface_of_triangle.push_back(shape.surface_of_triangle[i]);
  }
  return result;
}

}  // namespace standpoint
