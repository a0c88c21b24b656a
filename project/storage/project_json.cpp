// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/project_json.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "project/materials/materials_json.h"
#include "project/model/treatments.h"
#include "project/storage/project_files.h"
#include "project/survey/file_places.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

using nlohmann::json;

namespace {

json targetToJson(const Target& t) {
  return {{"name", t.name},
          {"kind", t.kind == TargetKind::sphere ? "sphere" : "checkerboard"},
          {"centre", toJson(t.centre)},
          {"normal", toJson(t.normal)},
          {"size_m", t.size_m}};
}

Target targetFrom(const json& t) {
  return {t.at("name"), t.at("kind") == "sphere" ? TargetKind::sphere : TargetKind::checkerboard,
          vectorFrom(t.at("centre")), vectorFrom(t.at("normal")), t.at("size_m")};
}

json targetsToJson(const std::vector<Target>& targets) {
  json rows = json::array();
  for (const auto& t : targets) rows.push_back(targetToJson(t));
  return rows;
}

std::vector<Target> targetsFrom(const json& rows) {
  std::vector<Target> targets;
  for (const auto& t : rows) targets.push_back(targetFrom(t));
  return targets;
}

json scanToJson(const Scan& s) {
  json row = {{"instrument", s.instrument},
              {"file", s.file},
              {"format", s.format},
              {"settings", s.settings},
              {"seed", s.seed},
              {"pulses", s.pulses},
              {"points", s.points},
              {"instrument_seconds", s.instrument_seconds}};
  if (s.along) row["along"] = *s.along;
  if (s.as_scanned)
    row["as_scanned"] = {{"station", poseToJson(s.as_scanned->station)},
                         {"targets", targetsToJson(s.as_scanned->targets)}};
  return row;
}

// What it was made along and as it was scanned came later.
Scan scanFrom(const json& j) {
  Scan s{j.at("instrument"), j.at("file"),   j.at("format"), j.at("settings"),
         j.at("seed"),       j.at("pulses"), j.at("points"), j.at("instrument_seconds")};
  if (const auto along = j.find("along"); along != j.end()) s.along = along->get<std::uint64_t>();
  if (const auto as = j.find("as_scanned"); as != j.end())
    s.as_scanned = AsScanned{poseFrom(as->at("station")), targetsFrom(as->at("targets"))};
  return s;
}

json waypointsToJson(const std::vector<Waypoint>& waypoints) {
  json list = json::array();
  for (const Waypoint& w : waypoints) {
    json& place = list.emplace_back(json{{"floor", toJson(w.floor_m)}});
    if (w.stop_s > 0) place["stop_s"] = w.stop_s;
    if (w.look_rad) place["look_rad"] = *w.look_rad;
  }
  return list;
}

std::vector<Waypoint> waypointsFrom(const json& of) {
  std::vector<Waypoint> waypoints;
  for (const auto& place : of.value("waypoints", json::array())) {
    Waypoint& w = waypoints.emplace_back(Waypoint{vectorFrom(place.at("floor")), place.value("stop_s", 0.0)});
    if (place.contains("look_rad")) w.look_rad = place.at("look_rad").get<double>();
  }
  return waypoints;
}

json trajectoryToJson(const CarriedTrajectory& t) {
  json row = {{"name", t.name}, {"carrier", t.carrier}, {"seed", t.seed}};
  if (t.file.empty()) {
    row["waypoints"] = waypointsToJson(t.waypoints);
    if (t.speed_mps > 0) row["speed_mps"] = t.speed_mps;
  } else {
    row["file"] = t.file;
    row["format"] = t.format;
  }
  if (t.height_m > 0) row["height_m"] = t.height_m;
  json& scans = row["scans"] = json::array();
  for (const auto& scan : t.scans) scans.push_back(scanToJson(scan));
  return row;
}

CarriedTrajectory trajectoryFrom(const json& j) {
  CarriedTrajectory t{.name = j.at("name"), .carrier = j.at("carrier")};
  t.seed = j.at("seed");
  t.waypoints = waypointsFrom(j);
  t.height_m = j.value("height_m", 0.0), t.speed_mps = j.value("speed_mps", 0.0);
  t.file = j.value("file", ""), t.format = j.value("format", "");
  for (const auto& scan : j.at("scans")) t.scans.push_back(scanFrom(scan));
  return t;
}

constexpr std::array<const char*, 5> kMoverKinds = {"person", "vehicle", "door", "turning", "sliding"};

json moverToJson(const Mover& m) {
  json row = {{"name", m.name},         {"kind", kMoverKinds[static_cast<std::size_t>(m.kind)]},
              {"speed", m.speed},       {"repeats", m.repeats},
              {"begins_s", m.begins_s}, {"seed", m.seed}};
  if (m.kind == MoverKind::person || m.kind == MoverKind::vehicle) {
    row["waypoints"] = waypointsToJson(m.waypoints);
    for (const auto& place : m.way_m)
      for (const double metres : place) row["way"].push_back(metres);
  } else {
    row["products"] = m.products;
    row["axis_at"] = toJson(m.axis_at_m), row["axis"] = toJson(m.axis);
    row["extent"] = m.extent;
  }
  return row;
}

// Of somebody in a crowd: x, y and z of one place after the other.
std::vector<Eigen::Vector3d> wayFrom(const json& j) {
  const auto metres = j.value("way", std::vector<double>{});
  if (metres.size() % 3 != 0) throw json::other_error::create(501, "a way is no list of x, y and z", nullptr);
  std::vector<Eigen::Vector3d> way;
  for (std::size_t i = 0; i < metres.size(); i += 3) way.emplace_back(metres[i], metres[i + 1], metres[i + 2]);
  return way;
}

Mover moverFrom(const json& j) {
  Mover m{.name = j.at("name")};
  const auto kind = std::find(kMoverKinds.begin(), kMoverKinds.end(), j.at("kind").get<std::string>());
  if (kind == kMoverKinds.end()) throw json::other_error::create(501, "unknown kind of mover", nullptr);
  m.kind = static_cast<MoverKind>(kind - kMoverKinds.begin());
  m.speed = j.at("speed"), m.repeats = j.at("repeats"), m.begins_s = j.at("begins_s"), m.seed = j.at("seed");
  m.waypoints = waypointsFrom(j);
  m.way_m = wayFrom(j);
  m.products = j.value("products", std::vector<std::string>{});
  if (j.contains("axis")) m.axis_at_m = vectorFrom(j.at("axis_at")), m.axis = vectorFrom(j.at("axis"));
  m.extent = j.value("extent", 0.0);
  return m;
}

json jobToJson(const Job& job) {
  json stations = json::array();
  for (const auto& s : job.stations) {
    json scans = json::array();
    for (const auto& scan : s.scans) scans.push_back(scanToJson(scan));
    json row = {{"name", s.name},
                {"instrument_height_m", s.instrument_height_m},
                {"true_pose", poseToJson(s.true_pose)},
                {"scans", std::move(scans)}};
    if (s.solved_pose) row["solved_pose"] = poseToJson(*s.solved_pose);
    stations.push_back(std::move(row));
  }
  json controls = json::array();
  for (const auto& c : job.control_points)
    controls.push_back({{"name", c.name}, {"position", toJson(c.position)}, {"sigma_m", c.sigma_m}});
  json part = {{"name", job.name},
               {"stations", stations},
               {"targets", targetsToJson(job.targets)},
               {"control_points", controls}};
  for (const auto& t : job.trajectories) part["trajectories"].push_back(trajectoryToJson(t));
  for (const auto& m : job.movers) part["movers"].push_back(moverToJson(m));
  return part;
}

Job jobFrom(const json& j) {
  Job job;
  job.name = j.at("name");
  for (const auto& s : j.at("stations")) {
    Station station{s.at("name"), s.at("instrument_height_m"), poseFrom(s.at("true_pose")), {}, {}};
    if (s.contains("solved_pose")) station.solved_pose = poseFrom(s.at("solved_pose"));
    for (const auto& scan : s.at("scans")) station.scans.push_back(scanFrom(scan));
    job.stations.push_back(std::move(station));
  }
  job.targets = targetsFrom(j.at("targets"));
  for (const auto& c : j.at("control_points"))
    job.control_points.push_back({c.at("name"), vectorFrom(c.at("position")), c.at("sigma_m")});
  for (const auto& t : j.value("trajectories", json::array())) job.trajectories.push_back(trajectoryFrom(t));
  for (const auto& m : j.value("movers", json::array())) job.movers.push_back(moverFrom(m));
  return job;
}

json scanningToJson(const ScanChoice& c) {
  const auto& w = c.weather;
  json part = {
      {"instrument", c.instrument},
      {"settings", c.settings},
      {"seed", c.seed},
      {"without", leftOut(c.effects)},
      {"weather",
       {{"rain_mm_h", w.rain_mm_h}, {"snow_mm_h", w.snow_mm_h}, {"fog_m", w.fog_mor_m}, {"dust_m", w.dust_mor_m}}},
      {"truth", c.truth},
      {"compensator", c.compensator},
      {"panorama", c.panorama}};
  if (std::isfinite(w.visibility_km)) part["weather"]["visibility_km"] = w.visibility_km;
  if (c.panorama_columns > 0) part["panorama_size"] = c.panorama_columns;
  if (c.quality != ScanQuality::standard) part["quality"] = FieldValue<ScanQuality>::write(c.quality);
  return part;
}

ScanChoice scanningFrom(const json& j) {
  const auto& w = j.at("weather");
  const auto without = j.at("without").get<std::string>();
  ScanChoice c{.instrument = j.at("instrument"),
               .settings = j.at("settings"),
               .seed = j.at("seed"),
               .effects = {},
               .weather = {w.value("visibility_km", kNoAir.visibility_km), w.at("rain_mm_h"), w.at("snow_mm_h"),
                           w.at("fog_m"), w.at("dust_m")},
               .truth = j.at("truth"),
               .compensator = j.at("compensator"),
               .panorama = j.at("panorama"),
               .panorama_columns = j.value("panorama_size", 0U),
               .quality = ScanQuality::standard};
  if (const auto quality = FieldValue<ScanQuality>::read(j.value("quality", json("default")))) c.quality = *quality;
  // A name that a later version knows is none of ours: all effects then.
  if (const auto effects = effectsWithout(without); !without.empty() && effects) c.effects = *effects;
  return c;
}

json lossToJson(const ProductLoss& l) {
  return {l.triangles_before, l.triangles_after, l.max_deviation_m, l.mean_deviation_m, l.mean_turn_rad};
}

// The turn of the normals came later.
ProductLoss lossFrom(const json& j) {
  return {j.at(0), j.at(1), j.at(2), j.at(3), j.size() > 4 ? j.at(4).get<double>() : 0};
}

json simplificationToJson(const SimplifiedModel& l) {
  json losses = json::array();
  for (const auto& loss : l.products) losses.push_back(lossToJson(loss));
  json part = {{"max_deviation_m", l.request.max_deviation_m},
               {"lod_rules", l.request.lod_rules.string()},
               {"surroundings", l.request.surroundings},
               {"all", lossToJson(l.all)},
               {"products", losses},
               {"levels", l.levels}};
  if (l.request.by_view) part["by_view"] = true;
  if (l.request.engine != SimplificationRequest().engine) part["engine"] = l.request.engine;
  if (l.request.budget) part["budget"] = *l.request.budget;
  return part;
}

json collisionToJson(const CollideResult& c) {
  json shapes = json::array();
  for (const auto& s : c.shapes) shapes.push_back({static_cast<int>(s.kind), s.product});
  json products = json::array();
  for (const auto& p : c.products) products.push_back({p.shapes, p.triangles, p.max_deviation_m});
  json doors = json::array();
  for (const auto& d : c.doors)
    doors.push_back({d.product, d.floor, d.passable, d.closed, d.clear_width_m, toJson(d.position), d.led_through});
  json rooms = json::array();
  for (const auto& r : c.rooms) {
    rooms.push_back({r.product, r.walkable_m2, r.reached, toJson(r.position)});
    if (const auto& low = r.tight_place)
      rooms.back().push_back({toJson(low->position), low->headroom_m, low->passes_height_m, low->passes_radius_m});
  }
  return {{"shapes", shapes},
          {"products", products},
          {"doors", doors},
          {"rooms", rooms},
          {"walkable_area_m2", c.walkable_area_m2}};
}

json propertiesToJson(const std::vector<Property>& properties) {
  json rows = json::array();
  for (const auto& q : properties) {
    rows.push_back({q.set, q.name, q.value});
    if (q.type != kNoPropertyType) rows.back().push_back(keywordOf(q.type));
  }
  return rows;
}

// A project written before storeys kept theirs has none; one written before values kept their types has no types.
std::vector<Property> propertiesFrom(const json& owner) {
  std::vector<Property> properties;
  if (owner.contains("properties"))
    for (const auto& q : owner.at("properties"))
      properties.push_back(
          {q.at(0), q.at(1), q.at(2), q.size() > 3 ? propertyTypeOf(q.at(3).get<std::string>()) : kNoPropertyType});
  return properties;
}

Severity severityFrom(const std::string& text) {
  return text == "loss" ? Severity::loss : text == "warning" ? Severity::warning : Severity::note;
}

}  // namespace

json documentToJson(const Document& d, const std::filesystem::path& folder) {
  json project = {{"version", kProjectVersion},
                  {"sources", d.sources},
                  {"georeference", georeferenceToJson(*d.georeference)},
                  {"job", jobToJson(withStoredPlaces(*d.job, folder))}};
  if (d.import_report) project["import_report"] = toJson(*d.import_report);
  if (d.simplified) project["lightening"] = simplificationToJson(*d.simplified);
  if (d.treatments) project["treatments"] = treatmentsToJson(*d.treatments);
  if (d.collision) project["collision"] = collisionToJson(*d.collision);
  if (d.materials) project["materials"] = materialsToJson(*d.materials);
  if (d.scanning) project["scanning"] = scanningToJson(*d.scanning);
  return project;
}

Document documentFrom(const json& project) {
  Document d;
  d.sources = project.at("sources").get<std::vector<std::string>>();
  d.job = std::make_shared<const Job>(jobFrom(project.at("job")));
  Report report;
  if (project.contains("import_report"))
    for (const auto& i : project.at("import_report"))
      report.issues.push_back({severityFrom(i.at("severity")), i.at("source"), i.at("message")});
  d.import_report = std::make_shared<const Report>(std::move(report));
  if (project.contains("treatments"))
    d.treatments = std::make_shared<const std::vector<Treatment>>(treatmentsFrom(project.at("treatments")));
  if (project.contains("materials"))
    d.materials = std::make_shared<const MaterialChoice>(materialsFrom(project.at("materials")));
  if (project.contains("scanning"))
    d.scanning = std::make_shared<const ScanChoice>(scanningFrom(project.at("scanning")));
  return d;
}

json recordsToJson(const Environment& environment) {
  json products = json::array();
  for (const auto& p : environment.products) {
    json layers = json::array();
    for (const auto& l : p.layers) layers.push_back({l.name, l.thickness_m});
    products.push_back({{"id", p.id},
                        {"global_id", p.global_id},
                        {"class", p.ifc_class},
                        {"predefined_type", p.predefined_type},
                        {"name", p.name},
                        {"type_name", p.type_name},
                        {"storey", p.storey},
                        {"container", p.container},
                        {"whole", p.whole},
                        {"tangible", p.tangible},
                        {"excluded", p.excluded},
                        {"materials", p.materials},
                        {"groups", p.groups},
                        {"layers", std::move(layers)},
                        {"properties", propertiesToJson(p.properties)}});
  }
  json spatial = json::array();
  for (const auto& n : environment.spatial)
    spatial.push_back({{"id", n.id},
                       {"class", n.ifc_class},
                       {"name", n.name},
                       {"global_id", n.global_id},
                       {"parent", n.parent},
                       {"elevation_m", n.elevation_m},
                       {"properties", propertiesToJson(n.properties)}});
  return {{"products", std::move(products)}, {"spatial", std::move(spatial)}};
}

Environment recordsFrom(const json& records) {
  Environment e;
  for (const auto& j : records.at("products")) {
    Product p;
    p.id = j.at("id");
    p.global_id = j.at("global_id");
    p.ifc_class = j.at("class");
    p.predefined_type = j.at("predefined_type");
    p.name = j.at("name");
    p.type_name = j.value("type_name", "");
    p.storey = j.at("storey");
    p.container = j.at("container");
    p.whole = j.at("whole");
    p.tangible = j.at("tangible");
    p.excluded = j.value("excluded", false);
    p.materials = j.at("materials");
    p.groups = j.value("groups", std::vector<std::string>{});
    for (const auto& l : j.at("layers")) p.layers.push_back({l.at(0), l.at(1)});
    p.properties = propertiesFrom(j);
    e.products.push_back(std::move(p));
  }
  for (const auto& n : records.at("spatial"))
    e.spatial.push_back({n.at("id"), n.at("class"), n.at("name"), n.at("global_id"), n.at("parent"),
                         n.at("elevation_m"), propertiesFrom(n)});
  return e;
}

std::shared_ptr<const SimplifiedModel> simplificationFrom(const json& part,
                                                          std::shared_ptr<const Environment> environment) {
  SimplifiedModel l;
  l.environment = std::move(environment);
  if (part.contains("budget")) l.request.budget = part.at("budget").get<std::uint64_t>();
  l.request.max_deviation_m = part.at("max_deviation_m");
  l.request.by_view = part.value("by_view", false);
  l.request.engine = part.value("engine", SimplificationRequest().engine);
  l.request.lod_rules = part.value("lod_rules", "");
  l.request.surroundings = part.value("surroundings", std::vector<std::string>{});
  l.levels = part.value("levels", std::vector<std::string>{});  // not in the projects of the first version
  l.all = lossFrom(part.at("all"));
  for (const auto& loss : part.at("products")) l.products.push_back(lossFrom(loss));
  return std::make_shared<const SimplifiedModel>(std::move(l));
}

Environment collisionEnvironment(const CollideResult& collision) {
  Environment e;
  e.surfaces.resize(1);
  e.products.resize(collision.products.size());
  for (const auto& s : collision.shapes) {
    e.instances.push_back({static_cast<std::uint32_t>(e.meshes.size()), s.product, Eigen::Affine3d::Identity()});
    e.meshes.push_back(std::make_shared<const Mesh>(s.mesh));
  }
  e.meshes.push_back(std::make_shared<const Mesh>(collision.walkable));
  return e;
}

std::shared_ptr<const CollideResult> collisionFrom(const json& part, const Environment& shapes) {
  CollideResult c;
  const auto& rows = part.at("shapes");
  for (std::size_t i = 0; i < rows.size() && i < shapes.meshes.size(); ++i)
    c.shapes.push_back({static_cast<CollisionShapeKind>(rows[i].at(0).get<int>()), rows[i].at(1), *shapes.meshes[i]});
  if (shapes.meshes.size() == rows.size() + 1) c.walkable = *shapes.meshes.back();
  for (const auto& p : part.at("products")) c.products.push_back({p.at(0), p.at(1), p.at(2)});
  for (const auto& d : part.at("doors")) {
    c.doors.push_back({d.at(0), d.at(1), d.at(2)});
    if (d.size() < 6) continue;  // a project of before doors could be closed
    c.doors.back().closed = d.at(3);
    c.doors.back().clear_width_m = d.at(4);
    c.doors.back().position = vectorFrom(d.at(5));
    c.doors.back().led_through =
        d.size() > 6 ? d.at(6).get<bool>() : c.doors.back().passable;  // before it was looked for
  }
  for (const auto& r : part.value("rooms", json::array())) {
    c.rooms.push_back({r.at(0), r.at(1), r.at(2), vectorFrom(r.at(3)), {}});
    if (r.size() > 4)
      c.rooms.back().tight_place = TightPlace{vectorFrom(r[4].at(0)), r[4].at(1), r[4].at(2), r[4].at(3)};
  }
  c.walkable_area_m2 = part.at("walkable_area_m2");
  return std::make_shared<const CollideResult>(std::move(c));
}

std::string inconsistency(const Document& d) {
  const auto products = d.imported->products.size();
  const auto surfaces = d.imported->surfaces.size();
  if (d.simplified && d.simplified->products.size() != products)
    return "the simplified model has a different number of products";
  if (d.collision) {
    if (d.collision->products.size() != products) return "/collision: product count does not match";
    for (const auto& s : d.collision->shapes)
      if (s.product >= products) return "/collision: unknown product";
    for (const auto& door : d.collision->doors)
      if (door.product >= products) return "/collision/doors: unknown product";
    for (const auto& room : d.collision->rooms)
      if (room.product >= products) return "/collision/rooms: unknown product";
  }
  if (d.materials) {
    for (const auto& f : d.materials->result.assignment.faces)
      if (f.product >= products || f.surface >= surfaces || f.material < 0 ||
          f.material >= static_cast<std::int32_t>(d.materials->result.assignment.materials.size()))
        return "/materials/faces: index out of range";
    for (const auto& f : d.materials->result.report.findings)
      for (const auto p : f.products)
        if (p >= products) return "/materials/report/findings: unknown product";
    const auto count = static_cast<std::int32_t>(d.materials->result.assignment.materials.size());
    for (const auto& s : d.materials->result.assignment.surfaces)
      if (s.product >= products || s.surface >= surfaces || s.material >= count || s.material < -1)
        return "/materials/surfaces: index out of range";
    for (const auto& use : d.materials->result.report.uses)
      for (const auto p : use.products)
        if (p >= products) return "/materials/report: unknown product";
  }
  return {};
}

}  // namespace standpoint
