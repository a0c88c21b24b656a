// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include "importers/geometry/arrangement.h"
#include "importers/geometry/boolean_ways.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

using Loop = std::vector<std::uint32_t>;

// Heights along the direction, plane coordinates across it. Along an axis the coordinates are taken as they are.
struct Frame {
  Eigen::Matrix3d rows;  // x, y, direction

  explicit Frame(const Eigen::Vector3d& direction) {
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis) * (direction[axis] < 0 ? -1 : 1);
    const bool straight = (direction - along).norm() < 1e-9;
    const Eigen::Vector3d z = straight ? along : direction;
    const Eigen::Vector3d x = straight ? Eigen::Vector3d(Eigen::Vector3d::Unit((axis + 1) % 3)) : z.unitOrthogonal();
    rows.row(0) = x, rows.row(1) = z.cross(x), rows.row(2) = z;
  }
};

struct Level {
  double height;
  std::uint32_t tag_up = 0, tag_down = 0;
  bool has_up = false, has_down = false;
};

struct CapFace {
  const PolyMesh* mesh;
  const Face* face;
  std::uint32_t operand;
  double height;
  bool up;
};

std::vector<CapFace> capsOf(const PolyMesh& mesh, std::uint32_t operand, const Frame& frame) {
  std::vector<CapFace> caps;
  const Eigen::Vector3d z = frame.rows.row(2);
  for (const Face& face : mesh.faces) {
    const Eigen::Vector3d v = areaVector(mesh.points, face.outer);
    if (std::abs(v.dot(z)) <= 0.5 * v.norm()) continue;
    caps.push_back({&mesh, &face, operand, z.dot(mesh.points[face.outer[0]]), v.dot(z) > 0});
  }
  return caps;
}

// Heights closer than the snapping distance are one level; the first operand's own value stands for it.
std::vector<Level> levelsOf(const std::vector<CapFace>& caps, bool within_first) {
  std::vector<std::pair<double, std::uint32_t>> heights;
  double bottom = INFINITY, top = -INFINITY;
  for (const CapFace& cap : caps) {
    heights.emplace_back(cap.height, cap.operand);
    if (cap.operand == 0 || !within_first) bottom = std::min(bottom, cap.height), top = std::max(top, cap.height);
  }
  std::sort(heights.begin(), heights.end(),
            [](const auto& a, const auto& b) { return std::tie(a.second, a.first) < std::tie(b.second, b.first); });
  std::vector<Level> levels;
  for (const auto& [height, operand] : heights) {
    if (height < bottom - kSnap_m || height > top + kSnap_m) continue;
    const bool known = std::any_of(levels.begin(), levels.end(), [&, h = height](const Level& level) {
      return std::abs(level.height - h) <= kSnap_m;
    });
    if (!known) levels.push_back({height});
  }
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.height < b.height; });
  return levels;
}

// The level at the height, the lowest for what begins below, levels.size() for what begins above.
std::size_t levelAt(const std::vector<Level>& levels, double height) {
  std::size_t k = 0;
  while (k < levels.size() && levels[k].height < height - kSnap_m) ++k;
  return k;
}

// Tags of walls by the cap edge they stand on; empty when all faces of the mesh share one tag.
using EdgeTags = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

EdgeTags wallTags(const PolyMesh& mesh, const Eigen::Vector3d& z) {
  EdgeTags tags;
  const bool uniform = std::all_of(mesh.faces.begin(), mesh.faces.end(),
                                   [&](const Face& face) { return face.tag == mesh.faces[0].tag; });
  if (uniform) return tags;
  for (const Face& face : mesh.faces) {
    const Eigen::Vector3d v = areaVector(mesh.points, face.outer);
    if (std::abs(v.dot(z)) > 0.5 * v.norm()) continue;
    for (std::size_t i = 0; i < face.outer.size(); ++i) {
      const std::uint32_t a = face.outer[i], b = face.outer[(i + 1) % face.outer.size()];
      tags.try_emplace({std::min(a, b), std::max(a, b)}, face.tag);
    }
  }
  return tags;
}

// A section of the solid just above a height is what its caps up to there began and ended: down-facing caps begin
// material, up-facing ones end it, so every cap's outline counts backwards from its level on.
struct Outlines {
  std::vector<Eigen::Vector2d> points;
  std::vector<Segment> segments;

  void add(const CapFace& cap, const Frame& frame, const EdgeTags& tags, std::uint32_t first, std::uint32_t last) {
    const Eigen::Vector3d outer_area = areaVector(cap.mesh->points, cap.face->outer);
    add(cap, cap.face->outer, false, frame, tags, first, last);
    for (const Loop& hole : cap.face->holes) {
      add(cap, hole, areaVector(cap.mesh->points, hole).dot(outer_area) > 0, frame, tags, first, last);
    }
  }

 private:
  void add(const CapFace& cap, const Loop& loop, bool reversed, const Frame& frame, const EdgeTags& tags,
           std::uint32_t first, std::uint32_t last) {
    const auto base = static_cast<std::uint32_t>(points.size()), n = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      points.push_back((frame.rows * cap.mesh->points[loop[i]]).head<2>());
      const std::uint32_t a = loop[i], b = loop[(i + 1) % n];
      const auto tag = tags.find({std::min(a, b), std::max(a, b)});
      segments.push_back({base + i, base + (i + 1) % n, first, last, reversed ? 1 : -1,
                          tag == tags.end() ? cap.face->tag : tag->second});
    }
  }
};

class Stack {
 public:
  Stack(const Arrangement& arrangement, std::vector<Level> levels, Operation operation)
      : arrangement_(arrangement), levels_(std::move(levels)), operation_(operation) {
    for (std::size_t s = 0; s + 1 < levels_.size(); ++s) slabs_.push_back(s);
    slab_count_ = slabs_.size();
    mergeEqualSlabs();
    findCorners();
  }

  bool build(const Frame& frame, PolyMesh& mesh) { return addCaps(frame, mesh) && addWalls(frame, mesh); }

 private:
  bool inside(std::span<const int> winding, std::size_t slab) const {
    const bool a = winding[slab] > 0, b = winding[slab_count_ + slab] > 0;
    switch (operation_) {
      case Operation::difference: return a && !b;
      case Operation::intersection: return a && b;
      case Operation::unite: return a || b;
    }
    return false;
  }

  void mergeEqualSlabs() {
    std::vector<std::size_t> kept;
    std::vector<Level> levels;
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      bool same = s > 0;
      for (std::size_t e = 0; e < arrangement_.edges.size() && same; ++e) {
        same = inside(arrangement_.leftOf(e), s) == inside(arrangement_.leftOf(e), s - 1) &&
               inside(arrangement_.rightOf(e), s) == inside(arrangement_.rightOf(e), s - 1);
      }
      if (same) continue;
      kept.push_back(s);
      levels.push_back(levels_[s]);
    }
    levels.push_back(levels_.back());
    slabs_ = std::move(kept);
    levels_ = std::move(levels);
  }

  // +1: inside on the left of the edge, -1: on its right, 0: no wall there.
  int wall(std::size_t edge, std::size_t slab) const {
    return static_cast<int>(inside(arrangement_.leftOf(edge), slabs_[slab])) -
           static_cast<int>(inside(arrangement_.rightOf(edge), slabs_[slab]));
  }

  // A point between two walls in line is no corner of anything.
  void findCorners() {
    std::vector<std::vector<std::uint32_t>> at(arrangement_.points.size());
    for (std::uint32_t e = 0; e < arrangement_.edges.size(); ++e) {
      bool used = false;
      for (std::size_t s = 0; s < slabs_.size() && !used; ++s) used = wall(e, s) != 0;
      if (!used) continue;
      at[arrangement_.edges[e].a].push_back(e);
      at[arrangement_.edges[e].b].push_back(e);
    }
    is_corner_.assign(at.size(), true);
    for (std::uint32_t p = 0; p < at.size(); ++p) {
      if (at[p].size() != 2) continue;
      const auto &e = arrangement_.edges[at[p][0]], &f = arrangement_.edges[at[p][1]];
      const Eigen::Vector2d a = arrangement_.points[e.a == p ? e.b : e.a],
                            b = arrangement_.points[f.a == p ? f.b : f.a];
      const double off = std::abs(cross(a, arrangement_.points[p], b));
      const bool between = (arrangement_.points[p] - a).dot(b - arrangement_.points[p]) > 0;
      is_corner_[p] = e.tag != f.tag || !between || off > 1e-9 * (b - a).norm();
    }
  }

  std::uint32_t point(const Frame& frame, PolyMesh& mesh, std::uint32_t p, std::size_t level) {
    const auto [at, fresh] = points_.try_emplace({p, level}, static_cast<std::uint32_t>(mesh.points.size()));
    if (fresh) {
      const Eigen::Vector2d& flat = arrangement_.points[p];
      mesh.points.push_back(frame.rows.transpose() * Eigen::Vector3d(flat.x(), flat.y(), levels_[level].height));
    }
    return at->second;
  }

  bool addCaps(const Frame& frame, PolyMesh& mesh) {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      for (const bool up : {false, true}) {
        const auto filled = [&](std::span<const int> w, bool above) {
          if (above ? level >= slabs_.size() : level == 0) return false;
          return inside(w, slabs_[above ? level : level - 1]);
        };
        const auto loops =
            boundary(arrangement_, [&](std::span<const int> w) { return filled(w, !up) && !filled(w, up); });
        if (!loops) return false;
        addCap(frame, mesh, *loops, level, up);
      }
    }
    return true;
  }

  void addCap(const Frame& frame, PolyMesh& mesh, const std::vector<BoundaryLoop>& loops, std::size_t level, bool up) {
    std::vector<Loop2> flat;
    std::vector<Loop> kept;
    for (const BoundaryLoop& loop : loops) {
      Loop2 coordinates;
      Loop indices;
      for (std::uint32_t p : loop.points) {
        if (!is_corner_[p]) continue;
        coordinates.push_back(arrangement_.points[p]);
        indices.push_back(point(frame, mesh, p, level));
        capped_.insert({p, level});
      }
      if (!up) std::reverse(indices.begin(), indices.end());
      flat.push_back(std::move(coordinates));
      kept.push_back(std::move(indices));
    }
    const Nesting nesting = nest(flat);
    for (std::size_t o = 0; o < nesting.outers.size(); ++o) {
      Face face{kept[nesting.outers[o]], {}, up ? levels_[level].tag_up : levels_[level].tag_down};
      for (std::size_t h : nesting.holes[o]) face.holes.push_back(kept[h]);
      mesh.faces.push_back(std::move(face));
    }
  }

  struct Wall {
    std::uint32_t from, to, tag;
    bool operator<(const Wall& o) const { return std::tie(from, to, tag) < std::tie(o.from, o.to, o.tag); }
  };

  // The straight walls of one slab from corner to corner.
  std::vector<Wall> wallsOf(std::size_t slab, bool& good) const {
    std::vector<Wall> walls;
    const auto loops = boundary(arrangement_, [&](std::span<const int> w) { return inside(w, slabs_[slab]); });
    good = good && loops;
    if (!loops) return walls;
    for (const BoundaryLoop& loop : *loops) {
      std::vector<std::size_t> corners;
      for (std::size_t i = 0; i < loop.points.size(); ++i) {
        if (is_corner_[loop.points[i]]) corners.push_back(i);
      }
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::size_t i = corners[c], j = corners[(c + 1) % corners.size()];
        walls.push_back({loop.points[i], loop.points[j], arrangement_.edges[loop.edges[i]].tag});
      }
    }
    return walls;
  }

  // A wall runs on through the slabs until it ends; where a cap meets its sides it gets a point there.
  bool addWalls(const Frame& frame, PolyMesh& mesh) {
    std::map<Wall, std::size_t> open;  // wall → the level where it began
    bool good = true;
    for (std::size_t s = 0; s <= slabs_.size(); ++s) {
      std::vector<Wall> walls = s < slabs_.size() ? wallsOf(s, good) : std::vector<Wall>{};
      const std::set<Wall> here(walls.begin(), walls.end());
      for (auto it = open.begin(); it != open.end();) {
        if (here.count(it->first)) {
          ++it;
          continue;
        }
        addWall(frame, mesh, it->first, it->second, s);
        it = open.erase(it);
      }
      for (const Wall& wall : here) open.try_emplace(wall, s);
    }
    return good;
  }

  void addWall(const Frame& frame, PolyMesh& mesh, const Wall& wall, std::size_t bottom, std::size_t top) {
    Face face{{}, {}, wall.tag};
    face.outer.push_back(point(frame, mesh, wall.from, bottom));
    for (std::size_t level = bottom; level <= top; ++level) {
      if (level == bottom || level == top || capped_.count({wall.to, level})) {
        face.outer.push_back(point(frame, mesh, wall.to, level));
      }
    }
    for (std::size_t level = top; level > bottom; --level) {
      if (level == top || capped_.count({wall.from, level})) face.outer.push_back(point(frame, mesh, wall.from, level));
    }
    mesh.faces.push_back(std::move(face));
  }

  const Arrangement& arrangement_;
  std::vector<Level> levels_;
  Operation operation_;
  std::vector<std::size_t> slabs_;  // the layers that differ from the one below
  std::size_t slab_count_ = 0;
  std::vector<bool> is_corner_;
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> points_;
  std::set<std::pair<std::uint32_t, std::size_t>> capped_;
};

void tagLevels(std::vector<Level>& levels, const std::vector<CapFace>& caps) {
  for (const CapFace& cap : caps) {  // the first operand comes first; a tool's cap shows its other side
    const std::size_t k = levelAt(levels, cap.height);
    if (k >= levels.size() || std::abs(levels[k].height - cap.height) > kSnap_m) continue;
    Level& level = levels[k];
    const bool up = cap.operand == 0 ? cap.up : !cap.up;
    if (up && !level.has_up) level.tag_up = cap.face->tag, level.has_up = true;
    if (!up && !level.has_down) level.tag_down = cap.face->tag, level.has_down = true;
  }
}

}  // namespace

Result<PolyMesh> combinePrisms(const PolyMesh& a, std::span<const PolyMesh> b, const Eigen::Vector3d& direction,
                               Operation operation) {
  const Frame frame(direction);
  std::vector<CapFace> caps = capsOf(a, 0, frame);
  std::vector<std::pair<const PolyMesh*, std::size_t>> meshes{{&a, caps.size()}};
  for (const PolyMesh& tool : b) {
    const std::vector<CapFace> own = capsOf(tool, 1, frame);
    caps.insert(caps.end(), own.begin(), own.end());
    meshes.emplace_back(&tool, caps.size());
  }
  std::vector<Level> levels = levelsOf(caps, operation != Operation::unite);
  if (levels.size() < 2) return failure(ErrorKind::unusable, "in the plane: a body without thickness");
  tagLevels(levels, caps);
  const auto slabs = static_cast<std::uint32_t>(levels.size() - 1);
  Outlines outlines;
  std::size_t next = 0;
  for (const auto& [mesh, end] : meshes) {
    const EdgeTags tags = wallTags(*mesh, frame.rows.row(2));
    for (; next < end; ++next) {
      const auto level = static_cast<std::uint32_t>(levelAt(levels, caps[next].height));
      if (level >= slabs) continue;
      const std::uint32_t base = caps[next].operand * slabs;
      outlines.add(caps[next], frame, tags, base + level, base + slabs);
    }
  }
  const auto arrangement = arrange(outlines.points, outlines.segments, std::size_t{2} * slabs, kSnap_m);
  if (!arrangement) return failure(ErrorKind::unusable, "in the plane: too many outlines, or no convergence");
  PolyMesh result;
  if (!Stack(*arrangement, std::move(levels), operation).build(frame, result)) {
    return failure(ErrorKind::unusable, "in the plane: open outline");
  }
  return result;
}

}  // namespace standpoint::geometry
