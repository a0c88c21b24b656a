// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/bspline.h"

#include <algorithm>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {

std::size_t KnotVector::spanOf(double t) const {
  const auto begin = knots.begin() + degree, end = knots.end() - degree;
  const auto after = std::upper_bound(begin, end, t);
  auto span = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - knots.begin() - 1, degree));
  const std::size_t last = knots.size() - static_cast<std::size_t>(degree) - 2;
  span = std::min(span, last);
  while (span > static_cast<std::size_t>(degree) && knots[span] == knots[span + 1]) --span;
  return span;
}

std::vector<double> KnotVector::breaks() const {
  std::vector<double> b;
  for (double k : knots)
    if (k >= from() && k <= to() && (b.empty() || k > b.back())) b.push_back(k);
  return b;
}

namespace {

KnotVector clamped(int degree, std::size_t n) {
  KnotVector k{degree, {}};
  const auto spans = static_cast<int>(n) - degree;
  for (int i = 0; i < degree; ++i) k.knots.push_back(0);
  for (int i = 0; i <= spans; ++i) k.knots.push_back(i);
  for (int i = 0; i < degree; ++i) k.knots.push_back(spans);
  return k;
}

}  // namespace

KnotVector bezierKnots(int degree, std::size_t n) {
  KnotVector k{degree, {}};
  const int spans = (static_cast<int>(n) - 1) / degree;
  k.knots.push_back(0);
  for (int i = 0; i <= spans; ++i)
    for (int j = 0; j < degree; ++j) k.knots.push_back(i);
  k.knots.push_back(spans);
  return k;
}

KnotVector knotVector(int degree, std::size_t n, const Value& multiplicities, const Value& knots) {
  if (degree < 1 || degree > 30 || n < static_cast<std::size_t>(degree) + 1) return {};
  KnotVector k{degree, {}};
  const std::size_t need = n + static_cast<std::size_t>(degree) + 1;
  auto times = multiplicities.begin();
  for (const Value v : knots) {
    const auto count = times != multiplicities.end() ? (*times).integer(1) : 0;
    for (std::int64_t i = 0; i < count && k.knots.size() <= need; ++i) k.knots.push_back(v.number(0));
    if (times != multiplicities.end()) ++times;
  }
  const bool usable = k.knots.size() == need && std::is_sorted(k.knots.begin(), k.knots.end()) && k.from() < k.to();
  return usable ? k : clamped(degree, n);
}

Eigen::Vector4d evaluate(const KnotVector& k, const std::vector<Eigen::Vector4d>& control, double t) {
  t = std::clamp(t, k.from(), k.to());
  const std::size_t span = k.spanOf(t);
  const auto p = static_cast<std::size_t>(k.degree);
  std::array<Eigen::Vector4d, 31> d;
  for (std::size_t j = 0; j <= p; ++j) d[j] = control[j + span - p];
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double a = k.knots[j + span - p], b = k.knots[j + 1 + span - r];
      const double s = b > a ? (t - a) / (b - a) : 0;
      d[j] = (1 - s) * d[j - 1] + s * d[j];
    }
  return d[p];
}

Eigen::Vector3d SplineSurface::at(double s, double t) const {
  std::vector<Eigen::Vector4d> row(control.size());
  for (std::size_t i = 0; i < control.size(); ++i) row[i] = evaluate(v, control[i], t);
  const Eigen::Vector4d h = evaluate(u, row, s);
  return h.head<3>() / h.w();
}

Result<Path> bSplineCurve(const Entity& entity, Scope& scope) {
  const int degree = static_cast<int>(std::clamp<std::int64_t>(entity[0].integer(1), 0, 100));
  std::vector<Eigen::Vector4d> control;
  for (const Entity& p : entity.refs(1)) {
    const Eigen::Vector3d q = cartesianPoint(p, scope);
    control.emplace_back(q.x(), q.y(), q.z(), 1);
  }
  const std::string_view name = entity.typeName();
  const bool bezier = name.find("BEZIER") != std::string_view::npos;
  if (name.starts_with("IFCRATIONAL")) {
    std::size_t i = 0;
    const Value weights = entity[bezier ? 5 : 8];
    for (const Value w : weights)
      if (const double x = w.number(1); i < control.size() && x > 0) control[i++] *= x;
  }
  if (degree < 1 || degree > 30 || control.size() < static_cast<std::size_t>(degree) + 1)
    return fail(entity, "the degree does not match the number of control points");
  const KnotVector knots = bezier && (control.size() - 1) % static_cast<std::size_t>(degree) == 0
                               ? bezierKnots(degree, control.size())
                               : knotVector(degree, control.size(), entity[5], entity[6]);
  if (!scope.spend(control.size() * 16)) return fail(entity, "too many points");
  Path path;
  const auto breaks = knots.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const auto at = [&](double t) {
      const Eigen::Vector4d h = evaluate(knots, control, t);
      return Eigen::Vector3d(h.head<3>() / h.w());
    };
    for (const auto& p : sample(at, breaks[i], breaks[i + 1], degree > 1 ? 2 : 1, scope).points) appendPoint(path, p);
  }
  if (path.points.size() < 2) return fail(entity, "the curve has no length");
  close(path);
  return path;
}

}  // namespace standpoint::ifc
