// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/body.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <map>
#include <set>
#include <string>

#include <tbb/parallel_for.h>

#include "importers/ifc/model/entities.h"
#include "importers/ifc/opening.h"
#include "importers/ifc/product.h"
#include "importers/ifc/representation.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// What is known of a product before any geometry is computed.
struct Plan {
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
  std::vector<Part> parts;
  std::vector<Id> openings;
  bool all_cut_away = false;  // by its openings
};

// One representation's items: evaluated once, used by everybody who maps it.
struct Shared {
  Id representation = 0;
  bool cut = false;    // somebody needs its items for Booleans
  bool whole = false;  // somebody needs it as it is
  Items items;
  std::string lost;  // the first place where something is missing from them
  std::shared_ptr<const Body> body;
};

bool isSubtraction(const Entity& e) {
  return e.is("IFCOPENINGELEMENT") || e.is("IFCOPENINGSTANDARDCASE") || e.is("IFCVOIDINGFEATURE") ||
         e.is("IFCEARTHWORKSCUT") || e.typeName().ends_with("EDGEFEATURE");
}

// Its own openings, and those of the wholes it is a part of: a voided wall may be made of parts that carry the body.
std::vector<Id> openingsOf(const Entity& product, const Relations& relations, const StepFile& file) {
  std::vector<Id> all;
  Entity at = product;
  for (int steps = 0; at && steps < 16; ++steps) {
    const auto& own = relations.openingsOf(at);
    all.insert(all.end(), own.begin(), own.end());
    at = file.entity(relations.wholeOf(at));
  }
  return all;
}

class Builder {
 public:
  Builder(const std::vector<Entity>& products, const Relations& relations, const Model& model, Progress& progress)
      : products_(products), relations_(relations), model_(model), progress_(progress), placements_(model) {}

  Result<Bodies> run() {
    progress_.stage("Placements", 0.2, 0.25);
    for (const Entity& e : products_) plans_.push_back(plan(e));
    TRY(progress_.check());
    chooseShared();
    TRY(evaluate());
    TRY(cutOpenings());
    collect();
    return std::move(result_);
  }

 private:
  Plan plan(const Entity& e) {
    Plan p;
    Scope scope(model_);
    place(e, p, scope);
    auto parts = partsOf(e, scope);
    if (parts)
      p.parts = std::move(*parts);
    else
      result_.report.lose(e.place(), "has no geometry: " + describe(parts.error()));
    result_.report.append(scope.report);
    if (scope.unread)
      result_.report.lose(e.place(), nameOf(e) + " is incomplete or misplaced: " + describe(*scope.unread));
    if (!isSubtraction(e) && !p.parts.empty()) p.openings = openingsOf(e, relations_, model_.file);
    return p;
  }

  void place(const Entity& e, Plan& p, Scope& scope) {
    if (isType(e)) return;
    const Value stated = e[5];
    if (const Entity placement = e.follow(stated)) {
      p.placement = placements_.world(placement, result_.report);
      if (const Id lost = placements_.lost(placement))
        result_.report.lose(e.place(), nameOf(e) + " is not where it belongs: see placement #" + std::to_string(lost));
    } else if (stated.isReference()) {
      result_.report.lose(e.place(), nameOf(e) + " is not where it belongs: it is placed by " + notInFile(stated));
    }
    if (const Value shape = e[6]; shape.isReference() && !e.follow(shape))
      scope.misread(e, "its representation is " + notInFile(shape));
  }

  Result<std::vector<Part>> partsOf(const Entity& e, Scope& scope) {
    if (isType(e)) return partsOfType(e, scope);
    if (const Entity shape = e.ref(6)) return partsOfShape(shape, scope);
    if (!relations_.partsOf(e).empty() || !e.ref(5)) return std::vector<Part>();
    auto parts = partsOfType(model_.file.entity(relations_.typeOf(e)), scope);
    if (parts && !parts->empty()) result_.report.warn(e.place(), "has no representation; using that of its type");
    return parts;
  }

  Shared& shared(Id representation) {
    const auto [it, is_new] = index_.try_emplace(representation, shared_.size());
    if (is_new) shared_.push_back({representation});
    return shared_[it->second];
  }

  // An opening has a body of its own, which no beam meets, and is evaluated in the host's frame for whom it cuts.
  void chooseShared() {
    for (std::size_t i = 0; i < plans_.size(); ++i) {
      for (const Part& part : plans_[i].parts)
        (plans_[i].openings.empty() ? shared(part.representation).whole : shared(part.representation).cut) = true;
      for (const Id id : plans_[i].openings) {
        const auto [tool, is_new] = tools_.try_emplace(id);
        if (is_new)
          if (const Entity opening = model_.file.entity(id)) tool->second = plan(opening);
        for (const Part& part : tool->second.parts) shared(part.representation).cut = true;
      }
    }
  }

  // In parallel, each into its own slot; reports are joined in the order of the slots.
  Result<void> evaluate() {
    progress_.stage("Geometry", 0.25, 0.8);
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, shared_.size(), [&](std::size_t i) {
      if (progress_.cancelled()) return;
      Shared& s = shared_[i];
      s.items = itemsOf(model_.file.entity(s.representation), model_);
      if (s.whole) s.body = triangulated(s.items.meshes, s.items.report, s.representation);
      if (!s.cut) s.items.meshes = {};
      progress_.advance(static_cast<double>(++done) / static_cast<double>(shared_.size()));
    });
    for (Shared& s : shared_) {
      result_.report.append(s.items.report);
      const auto& issues = s.items.report.issues;
      const auto loss =
          std::find_if(issues.begin(), issues.end(), [](const Issue& i) { return i.severity == Severity::loss; });
      if (loss != issues.end()) s.lost = loss->source;
    }
    return progress_.check();
  }

  std::shared_ptr<const Body> triangulated(const std::vector<geometry::PolyMesh>& meshes, Report& report,
                                           Id place) const;

  std::vector<geometry::PolyMesh> toolsFor(const Plan& host) {
    std::vector<geometry::PolyMesh> tools;
    const Eigen::Affine3d to_host(host.placement.inverse());
    for (const Id id : host.openings) {
      const Plan& tool = tools_.at(id);
      for (const Part& part : tool.parts)
        for (geometry::PolyMesh mesh : shared_[index_.at(part.representation)].items.meshes) {
          geometry::transform(mesh, to_host * Eigen::Affine3d(tool.placement) * part.product_from_items);
          tools.push_back(std::move(mesh));
        }
    }
    return tools;
  }

  void cutOne(std::size_t i, Report& report) {
    const Plan& host = plans_[i];
    const std::vector<geometry::PolyMesh> tools = toolsFor(host);
    const auto hasFaces = [](const geometry::PolyMesh& mesh) { return !mesh.faces.empty(); };
    bool had = false, has = false;
    for (const Part& part : host.parts) {
      std::vector<geometry::PolyMesh> meshes = shared_[index_.at(part.representation)].items.meshes;
      for (auto& mesh : meshes) {
        had = had || hasFaces(mesh);
        geometry::transform(mesh, part.product_from_items);
        cutAway(mesh, tools, products_[i], report);
        has = has || hasFaces(mesh);
      }
      if (auto body = triangulated(meshes, report, products_[i].id()))
        cut_[i].push_back({std::move(body), Eigen::Affine3d(host.placement), part.style});
    }
    plans_[i].all_cut_away = had && !has;
  }

  Result<void> cutOpenings() {
    progress_.stage("Openings", 0.8, 0.95);
    cut_.resize(products_.size());
    std::vector<std::size_t> hosts;
    for (std::size_t i = 0; i < plans_.size(); ++i)
      if (!plans_[i].openings.empty()) hosts.push_back(i);
    std::vector<Report> reports(hosts.size());
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, hosts.size(), [&](std::size_t k) {
      if (progress_.cancelled()) return;
      try {
        cutOne(hosts[k], reports[k]);
      } catch (const std::exception& problem) {
        reports[k].lose(products_[hosts[k]].place(), std::string("has no geometry: ") + problem.what());
      }
      progress_.advance(static_cast<double>(++done) / static_cast<double>(hosts.size()));
    });
    for (const Report& r : reports) result_.report.append(r);
    return progress_.check();
  }

  void collect() {
    result_.of_product.resize(products_.size());
    for (std::size_t i = 0; i < plans_.size(); ++i) {
      auto& bodies = result_.of_product[i];
      result_.any = result_.any || !plans_[i].parts.empty();
      if (!plans_[i].openings.empty())
        bodies = std::move(cut_[i]);
      else
        for (const Part& part : plans_[i].parts)
          if (const auto& body = shared_[index_.at(part.representation)].body)
            bodies.push_back({body, Eigen::Affine3d(plans_[i].placement) * part.product_from_items, part.style});
      dropFar(i, bodies);
    }
    const std::set<Id> wholes = wholesOfBodies();
    for (std::size_t i = 0; i < plans_.size(); ++i)
      if (result_.of_product[i].empty())
        tellMissing(i, wholes.contains(products_[i].id()));
      else
        tellIncomplete(i);
    tellRepairs();
  }

  void dropFar(std::size_t i, std::vector<PlacedBody>& bodies) {
    const auto far = std::remove_if(bodies.begin(), bodies.end(), [](const PlacedBody& b) {
      return !b.file_from_items.matrix().allFinite() || !isNear(b.file_from_items.translation());
    });
    if (far == bodies.end()) return;
    bodies.erase(far, bodies.end());
    result_.report.lose(products_[i].place(), nameOf(products_[i]) + " is scaled or moved beyond 1e15 m: left out");
  }

  // What has no body of its own is not lost where its parts have one.
  std::set<Id> wholesOfBodies() const {
    std::set<Id> wholes;
    for (std::size_t i = 0; i < plans_.size(); ++i) {
      if (result_.of_product[i].empty()) continue;
      for (Id whole = relations_.wholeOf(products_[i]); whole && wholes.insert(whole).second;)
        whole = relations_.wholeOf(model_.file.entity(whole));
    }
    return wholes;
  }

  void tellRepairs() {
    struct Kind {
      std::size_t Repairs::*count;
      const char* what;
    };
    constexpr std::array kKinds{Kind{&Repairs::inverted, "inverted shells corrected"},
                                Kind{&Repairs::disagreeing, "shells with inconsistent face orientation corrected"},
                                Kind{&Repairs::degenerate, "zero-area faces removed"},
                                Kind{&Repairs::duplicate, "duplicate faces removed"},
                                Kind{&Repairs::open, "shells declared closed but open; left open"},
                                Kind{&Repairs::branching, "non-manifold edges (more than two faces); kept"}};
    for (const Kind& kind : kKinds)
      for (std::size_t i = 0; i < plans_.size(); ++i) {
        std::size_t count = 0;
        for (const Part& part : plans_[i].parts)
          if (const auto it = index_.find(part.representation); it != index_.end())
            count += shared_[it->second].items.repairs.*kind.count;
        if (count > 0) result_.report.note(products_[i].place(), std::string(kind.what) + ": " + std::to_string(count));
      }
  }

  void tellMissing(std::size_t i, bool has_parts) {
    const Entity& e = products_[i];
    const Plan& p = plans_[i];
    if (!e.ref(6) && p.parts.empty() && !isType(e)) return;
    const EntityName* name = entityName(e.typeName());
    const EntityKind kind = name ? name->kind : EntityKind::product;
    if (kind == EntityKind::space || (kind == EntityKind::intangible && !isSubtraction(e))) return;
    if (p.all_cut_away) return result_.report.warn(e.place(), nameOf(e) + " is removed entirely by its openings");
    if (!p.parts.empty()) return result_.report.lose(e.place(), nameOf(e) + " produced no geometry");
    std::string what = nameOf(e) + " has a representation but none with a body";
    const std::string unread = unreadBodyOf(e.ref(6), model_);
    if (!unread.empty()) what += ": " + unread + " is not supported";
    // A place is no body: what is drawn of it, such as a building's outline, is none either.
    const bool whole = has_parts || kind == EntityKind::spatial;
    if (whole && unread.empty())
      result_.report.warn(e.place(), what);
    else
      result_.report.lose(e.place(), what);
  }

  void tellIncomplete(std::size_t i) {
    for (const Part& part : plans_[i].parts)
      if (const std::string& lost = shared_[index_.at(part.representation)].lost; !lost.empty())
        return result_.report.lose(products_[i].place(), nameOf(products_[i]) + " is incomplete: see " + lost);
  }

  const std::vector<Entity>& products_;
  const Relations& relations_;
  const Model& model_;
  Progress& progress_;
  Placements placements_;
  std::vector<Plan> plans_;
  std::map<Id, std::size_t> index_;  // representation → place in shared_
  std::vector<Shared> shared_;
  std::map<Id, Plan> tools_;  // openings
  std::vector<std::vector<PlacedBody>> cut_;
  Bodies result_;
};

// A float has a step of 8 µm at 100 m: beyond that the mesh gets an origin of its own.
Eigen::Vector3d localOrigin(const Bounds& bounds) {
  constexpr double kNear_m = 100;
  const double far = std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
  if (far <= kNear_m) return Eigen::Vector3d::Zero();
  return ((bounds.min + bounds.max) / 2).array().round().matrix();
}

struct Problems {
  std::size_t fanned = 0, infinite = 0;
};

// An outline that crosses itself has no inside; a fan over it keeps something there for a beam to meet.
void fan(const geometry::Face& face, std::vector<Triangle>& triangles) {
  for (std::size_t i = 1; i + 1 < face.outer.size(); ++i)
    triangles.push_back({face.outer[0], face.outer[i], face.outer[i + 1]});
}

void appendMesh(Body& body, const geometry::PolyMesh& mesh, Problems& problems) {
  std::vector<std::uint32_t> place(mesh.points.size(), UINT32_MAX);  // only points that a triangle has are kept
  const auto position = [&](std::uint32_t i) {
    if (place[i] == UINT32_MAX) {
      place[i] = static_cast<std::uint32_t>(body.positions.size());
      body.positions.push_back((mesh.points[i] - body.origin).cast<float>());
    }
    return place[i];
  };
  std::vector<Triangle> triangles;
  for (const geometry::Face& face : mesh.faces) {
    triangles.clear();
    const auto usable = [&](const std::vector<std::uint32_t>& loop) {
      return std::all_of(loop.begin(), loop.end(), [&](std::uint32_t i) { return isNear(mesh.points[i]); });
    };
    const bool finite = usable(face.outer) && std::all_of(face.holes.begin(), face.holes.end(), usable);
    if (!finite) {
      ++problems.infinite;
      continue;
    }
    if (face.outer.size() == 3 && face.holes.empty())
      triangles.push_back({face.outer[0], face.outer[1], face.outer[2]});
    else if (!geometry::triangulate(mesh.points, face, triangles))
      ++problems.fanned, triangles.clear(), fan(face, triangles);
    for (const Triangle& t : triangles) {
      body.triangles.push_back({position(t[0]), position(t[1]), position(t[2])});
      body.tags.push_back(face.tag);
    }
  }
}

std::shared_ptr<const Body> Builder::triangulated(const std::vector<geometry::PolyMesh>& meshes, Report& report,
                                                  Id place) const {
  auto body = std::make_shared<Body>();
  for (const auto& mesh : meshes)
    for (const auto& face : mesh.faces)
      for (const std::uint32_t i : face.outer)
        if (isNear(mesh.points[i])) body->bounds.extend(mesh.points[i]);
  if (!body->bounds.empty()) body->origin = localOrigin(body->bounds);
  Problems problems;
  for (const auto& mesh : meshes) appendMesh(*body, mesh, problems);
  const std::string where = "#" + std::to_string(place);
  if (problems.fanned > 0)
    report.warn(where, std::to_string(problems.fanned) + " self-intersecting faces triangulated as fans");
  if (problems.infinite > 0)
    report.lose(where, std::to_string(problems.infinite) + " faces have non-finite coordinates");
  return body->triangles.empty() ? nullptr : body;
}

}  // namespace

Result<Bodies> buildBodies(const std::vector<Entity>& products, const Relations& relations, const Model& model,
                           Progress& progress) {
  return Builder(products, relations, model, progress).run();
}

}  // namespace standpoint::ifc
