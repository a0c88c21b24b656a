// SPDX-License-Identifier: GPL-3.0-or-later
// Parameterised profiles: an outline of corners, some of them rounded, as IFC4 ADD2 TC1 clause 8.15.3 draws them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"

namespace standpoint::ifc {
namespace {

struct Corner {
  double x, y;
  double radius = 0;  // of the fillet or the rounded edge here
};

// A corner with a radius becomes an arc that touches both of its sides; too large a radius is cut to what fits.
void appendCorner(geometry::Loop2& loop, const Eigen::Vector2d& before, const Corner& corner,
                  const Eigen::Vector2d& after, const Scope& scope) {
  const Eigen::Vector2d c(corner.x, corner.y);
  const Eigen::Vector2d u = (before - c).normalized(), v = (after - c).normalized();
  const double half = std::acos(std::clamp(u.dot(v), -1.0, 1.0)) / 2;
  if (corner.radius <= 0 || half < 1e-3 || half > std::numbers::pi / 2 - 1e-3) return loop.push_back(c);
  const double room = std::min((before - c).norm(), (after - c).norm());
  const double reach = std::min(corner.radius / std::tan(half), room);
  const double radius = reach * std::tan(half);
  const Eigen::Vector2d centre = c + (u + v).normalized() * (radius / std::sin(half));
  const Eigen::Vector2d from = c + u * reach - centre, to = c + v * reach - centre;
  double sweep = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  const int n = geometry::segmentCount(radius, std::abs(sweep), scope.tessellation);
  for (int i = 0; i <= n; ++i) {
    const double a = sweep * i / n;
    const Eigen::Vector2d p(from.x() * std::cos(a) - from.y() * std::sin(a),
                            from.x() * std::sin(a) + from.y() * std::cos(a));
    loop.push_back(centre + p);
  }
}

geometry::Loop2 rounded(const std::vector<Corner>& corners, const Scope& scope) {
  geometry::Loop2 loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &a = corners[(i + corners.size() - 1) % corners.size()], &b = corners[(i + 1) % corners.size()];
    appendCorner(loop, {a.x, a.y}, corners[i], {b.x, b.y}, scope);
  }
  return loop;
}

void place(geometry::Loop2& loop, const Entity& entity, Scope& scope) {
  const Eigen::Isometry3d t = axisPlacement(entity.ref(2), scope);
  for (auto& p : loop) p = (t * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
}

Result<Regions> placed(const Entity& entity, geometry::Loop2 outer, std::vector<geometry::Loop2> holes, Scope& scope) {
  geometry::Region2 region{std::move(outer), std::move(holes)};
  place(region.outer, entity, scope);
  for (auto& hole : region.holes) place(hole, entity, scope);
  geometry::normalise(region);
  if (region.outer.size() < 3) return fail(entity, "the profile has no area");
  return Regions{std::move(region)};
}

Result<Regions> placed(const Entity& entity, const std::vector<Corner>& corners, Scope& scope) {
  return placed(entity, rounded(corners, scope), {}, scope);
}

geometry::Loop2 ring(double a, double b, const Scope& scope) {
  return loop2(arc(Conic{Eigen::Isometry3d::Identity(), a, b}, 0, 2 * std::numbers::pi, scope));
}

std::vector<Corner> rectangle(double x, double y, double radius) {
  return {{-x, -y, radius}, {x, -y, radius}, {x, y, radius}, {-x, y, radius}};
}

// A measure of the profile in metres; 0 where the file has none.
double m(const Entity& entity, std::size_t index, const Scope& scope) { return scope.metres(entity[index].number(0)); }

tl::unexpected<Error> notPositive(const Entity& entity) {
  return fail(entity, "a dimension of the profile is missing or not positive");
}

}  // namespace

Result<Regions> rectangleProfile(const Entity& e, Scope& s) {
  const double x = m(e, 3, s) / 2, y = m(e, 4, s) / 2;
  if (!(x > 0 && y > 0)) return notPositive(e);
  return placed(e, rectangle(x, y, 0), s);
}

Result<Regions> roundedRectangleProfile(const Entity& e, Scope& s) {
  const double x = m(e, 3, s) / 2, y = m(e, 4, s) / 2;
  if (!(x > 0 && y > 0)) return notPositive(e);
  return placed(e, rectangle(x, y, std::min({m(e, 5, s), x, y})), s);
}

Result<Regions> rectangleHollowProfile(const Entity& e, Scope& s) {
  const double x = m(e, 3, s) / 2, y = m(e, 4, s) / 2, wall = m(e, 5, s);
  if (!(x > 0 && y > 0)) return notPositive(e);
  std::vector<geometry::Loop2> holes;
  if (wall > 0 && wall < std::min(x, y)) holes.push_back(rounded(rectangle(x - wall, y - wall, m(e, 6, s)), s));
  return placed(e, rounded(rectangle(x, y, m(e, 7, s)), s), std::move(holes), s);
}

Result<Regions> trapeziumProfile(const Entity& e, Scope& s) {
  const double bottom = m(e, 3, s), top = m(e, 4, s), y = m(e, 5, s) / 2, offset = m(e, 6, s);
  if (!(bottom > 0 && y > 0)) return notPositive(e);
  // The box around the bottom is centred; the top begins at `offset` from its left (8.15.3.16).
  const double left = -bottom / 2;
  return placed(e, {{left, -y}, {left + bottom, -y}, {left + offset + top, y}, {left + offset, y}}, s);
}

Result<Regions> circleProfile(const Entity& e, Scope& s) {
  const double r = m(e, 3, s);
  if (!(r > 0)) return notPositive(e);
  return placed(e, ring(r, r, s), {}, s);
}

Result<Regions> circleHollowProfile(const Entity& e, Scope& s) {
  const double r = m(e, 3, s), inner = r - m(e, 4, s);
  if (!(r > 0)) return notPositive(e);
  std::vector<geometry::Loop2> holes;
  if (inner > 0 && inner < r) holes.push_back(ring(inner, inner, s));
  return placed(e, ring(r, r, s), std::move(holes), s);
}

Result<Regions> ellipseProfile(const Entity& e, Scope& s) {
  const double a = m(e, 3, s), b = m(e, 4, s);
  if (!(a > 0 && b > 0)) return notPositive(e);
  return placed(e, ring(a, b, s), {}, s);
}

namespace {

struct Flange {
  double half_width, thickness, fillet, edge, slope;
};

// Half of an I outline is the mirror of the other; corners counter-clockwise from the lower left.
std::vector<Corner> iOutline(double depth, double web, const Flange& low, const Flange& high) {
  const double y = depth / 2, w = web / 2;
  // The thickness is stated in the middle between web and edge; a sloped flange is thinner outside, thicker inside.
  const auto inside = [&](const Flange& f) { return f.thickness + std::tan(f.slope) * (f.half_width - w) / 2; };
  const auto outside = [&](const Flange& f) {
    return std::max(f.thickness - std::tan(f.slope) * (f.half_width - w) / 2, 0.0);
  };
  return {{-low.half_width, -y},
          {low.half_width, -y},
          {low.half_width, -y + outside(low), low.edge},
          {w, -y + inside(low), low.fillet},
          {w, y - inside(high), high.fillet},
          {high.half_width, y - outside(high), high.edge},
          {high.half_width, y},
          {-high.half_width, y},
          {-high.half_width, y - outside(high), high.edge},
          {-w, y - inside(high), high.fillet},
          {-w, -y + inside(low), low.fillet},
          {-low.half_width, -y + outside(low), low.edge}};
}

double slope(const Entity& e, std::size_t index, const Scope& s) {
  return e[index].number(0) * s.model.units.angle_rad;
}

}  // namespace

Result<Regions> iShapeProfile(const Entity& e, Scope& s) {
  const double depth = m(e, 4, s), web = m(e, 5, s);
  const Flange flange{m(e, 3, s) / 2, m(e, 6, s), m(e, 7, s), m(e, 8, s), slope(e, 9, s)};
  if (!(depth > 0 && web > 0 && flange.half_width > 0 && flange.thickness > 0)) return notPositive(e);
  return placed(e, iOutline(depth, web, flange, flange), s);
}

Result<Regions> asymmetricIShapeProfile(const Entity& e, Scope& s) {
  const double depth = m(e, 4, s), web = m(e, 5, s);
  const bool old = s.model.file.schema().starts_with("IFC2X");  // there positions 11 … are the centre of gravity
  const Flange low{m(e, 3, s) / 2, m(e, 6, s), m(e, 7, s), old ? 0 : m(e, 11, s), old ? 0 : slope(e, 12, s)};
  Flange high{m(e, 8, s) / 2, m(e, 9, s), m(e, 10, s), old ? 0 : m(e, 13, s), old ? 0 : slope(e, 14, s)};
  if (!(high.thickness > 0)) high.thickness = low.thickness;
  if (!(depth > 0 && web > 0 && low.half_width > 0 && low.thickness > 0 && high.half_width > 0)) return notPositive(e);
  return placed(e, iOutline(depth, web, low, high), s);
}

Result<Regions> lShapeProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, t = m(e, 5, s), fillet = m(e, 6, s), edge = m(e, 7, s);
  const double x = e[4].present() ? m(e, 4, s) / 2 : y;
  if (!(x > 0 && y > 0 && t > 0)) return notPositive(e);
  const double rise = std::tan(slope(e, 8, s));
  const double dx = rise * (2 * x - t) / 2, dy = rise * (2 * y - t) / 2;
  return placed(e,
                {{-x, -y},
                 {x, -y},
                 {x, -y + std::max(t - dx, 0.0), edge},
                 {-x + t + dy, -y + t + dx, fillet},
                 {-x + std::max(t - dy, 0.0), y, edge},
                 {-x, y}},
                s);
}

Result<Regions> tShapeProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, x = m(e, 4, s) / 2, web = m(e, 5, s) / 2, flange = m(e, 6, s);
  const double fillet = m(e, 7, s), flange_edge = m(e, 8, s), web_edge = m(e, 9, s);
  if (!(x > 0 && y > 0 && web > 0 && flange > 0)) return notPositive(e);
  const double dw = std::tan(slope(e, 10, s)) * (2 * y - flange) / 2, df = std::tan(slope(e, 11, s)) * (x - web) / 2;
  return placed(e,
                {{-x, y},
                 {-x, y - flange + df, flange_edge},
                 {-web - dw, y - flange - df, fillet},
                 {-web + dw, -y, web_edge},
                 {web - dw, -y, web_edge},
                 {web + dw, y - flange - df, fillet},
                 {x, y - flange + df, flange_edge},
                 {x, y}},
                s);
}

Result<Regions> uShapeProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, x = m(e, 4, s) / 2, web = m(e, 5, s), flange = m(e, 6, s), fillet = m(e, 7, s),
               edge = m(e, 8, s);
  if (!(x > 0 && y > 0 && web > 0 && flange > 0)) return notPositive(e);
  const double d = std::tan(slope(e, 9, s)) * (2 * x - web) / 2;
  return placed(e,
                {{-x, -y},
                 {x, -y},
                 {x, -y + flange - d, edge},
                 {-x + web, -y + flange + d, fillet},
                 {-x + web, y - flange - d, fillet},
                 {x, y - flange + d, edge},
                 {x, y},
                 {-x, y}},
                s);
}

Result<Regions> cShapeProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, x = m(e, 4, s) / 2, t = m(e, 5, s), girth = m(e, 6, s), in = m(e, 7, s);
  if (!(x > 0 && y > 0 && t > 0)) return notPositive(e);
  const double out = in > 0 ? in + t : 0;
  const double lip = std::clamp(girth, t, y);
  return placed(e,
                {{-x, -y, out},
                 {x, -y, out},
                 {x, -y + lip},
                 {x - t, -y + lip},
                 {x - t, -y + t, in},
                 {-x + t, -y + t, in},
                 {-x + t, y - t, in},
                 {x - t, y - t, in},
                 {x - t, y - lip},
                 {x, y - lip},
                 {x, y, out},
                 {-x, y, out}},
                s);
}

Result<Regions> zShapeProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, width = m(e, 4, s), web = m(e, 5, s) / 2, flange = m(e, 6, s), fillet = m(e, 7, s),
               edge = m(e, 8, s);
  if (!(width > 0 && y > 0 && web > 0 && flange > 0)) return notPositive(e);
  const double out = width - web;  // each flange is `width` long, measured from the web's far face
  return placed(e,
                {{-web, -y},
                 {out, -y},
                 {out, -y + flange, edge},
                 {web, -y + flange, fillet},
                 {web, y},
                 {-out, y},
                 {-out, y - flange, edge},
                 {-web, y - flange, fillet}},
                s);
}

// Crane rails (IFC2X3), DIN 536: from the foot's middle up to the head, its right half; the left mirrors it. The foot
// is thinner outwards (f1 at the web, f2, f3 at its edge), the head deeper at the web (h2) than at its side (h3).
namespace {

Result<Regions> craneRail(const Entity& e, const std::vector<Corner>& right, Scope& s) {
  std::vector<Corner> all = right;
  for (auto it = right.rbegin(); it != right.rend(); ++it) all.push_back({-it->x, it->y, it->radius});
  return placed(e, all, s);
}

}  // namespace

Result<Regions> craneRailAProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, foot = m(e, 4, s) / 2, head = m(e, 6, s) / 2, h2 = m(e, 7, s), h3 = m(e, 8, s),
               web = m(e, 9, s) / 2;
  const double knee = m(e, 10, s) / 2, f1 = m(e, 11, s), f2 = m(e, 12, s), f3 = m(e, 13, s);
  if (!(y > 0 && foot > 0 && head > 0 && web > 0 && h2 > 0 && h3 > 0 && f1 > 0)) return notPositive(e);
  return craneRail(e,
                   {{foot, -y},
                    {foot, -y + f3},
                    {knee, -y + f2},
                    {web, -y + f1},
                    {web, y - h2},
                    {head, y - h3},
                    {head, y, m(e, 5, s)}},
                   s);
}

Result<Regions> craneRailFProfile(const Entity& e, Scope& s) {
  const double y = m(e, 3, s) / 2, head = m(e, 4, s) / 2, h2 = m(e, 6, s), h3 = m(e, 7, s), web = m(e, 8, s) / 2,
               f1 = m(e, 9, s), f2 = m(e, 10, s);
  if (!(y > 0 && head > 0 && web > 0 && h2 > 0 && h3 > 0 && f1 > 0)) return notPositive(e);
  return craneRail(
      e, {{head, -y}, {head, -y + f2}, {web, -y + f1}, {web, y - h2}, {head, y - h3}, {head, y, m(e, 5, s)}}, s);
}

}  // namespace standpoint::ifc
