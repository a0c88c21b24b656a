// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include "pointclouds/point_filter.h"
#include "project/file_verbs.h"
#include "project/import_verb.h"
#include "project/model_verbs.h"
#include "project/optimize_verb.h"
#include "project/registration.h"
#include "project/survey_verbs.h"
#include "project/treatments.h"
#include "project/underlays.h"
#include "project/verb.h"
#include "project/verification.h"
#include "scanners/effects.h"

namespace standpoint {

namespace {

using K = ParameterKind;
using S = VerbScope;

const char* effectHelp() {
  static const std::string help = "effects to leave out: " + effectList();
  return help.c_str();
}

const char* filterHelp() {
  static const std::string help = "in this order, NAME or NAME:KEY=VALUE,…, in metres and degrees: " + filterList();
  return help.c_str();
}

// The table: a new verb is a typed function in this folder and one entry here. Command line, help, job files and the
// editor's forms follow from it.
const std::vector<Verb>& table() {
  static const std::vector<Verb> verbs = {
      {"import", "Reads models (IFC, glTF, OBJ, PLY, STL) into a new project, or changed ones into their own (--update)", S::creates,
       {{.name = "files", .kind = K::list, .help = "the model files", .positional = true, .required = true},
        {.name = "output", .kind = K::path, .help = "folder of the new project"},
        {.name = "replace", .kind = K::flag, .help = "replace what is in that folder"},
        {.name = "update", .kind = K::flag, .help = "take in a changed model: keeps stations, targets and materials, and answers what changed"},
        {.name = "shift", .kind = K::text, .help = "global shift: auto, none, or E,N,H", .unit = "m", .standard = "auto"},
        {.name = "crs", .kind = K::text, .help = "coordinate reference system, as EPSG:n"},
        {.name = "up", .kind = K::choice, .help = "which axis of the file points up (default: as the format says)", .choices = {"y", "z"}},
        {.name = "unit", .kind = K::choice, .help = "unit of the file's coordinates (default: as the format says)", .choices = {"m", "cm", "mm", "in", "ft"}}},
       runImport},
      {"add", "Adds models to the environment beside what is in it", S::changes,
       {{.name = "files", .kind = K::list, .help = "the model files", .positional = true, .required = true},
        {.name = "shift", .kind = K::text, .help = "global shift of what is added: auto, none, or E,N,H", .unit = "m", .standard = "auto"},
        {.name = "crs", .kind = K::text, .help = "coordinate reference system of the files, as EPSG:n"},
        {.name = "up", .kind = K::choice, .help = "which axis of the files points up (default: as the format says)", .choices = {"y", "z"}},
        {.name = "unit", .kind = K::choice, .help = "unit of the files' coordinates (default: as the format says)", .choices = {"m", "cm", "mm", "in", "ft"}}},
       runAdd},
      {"optimize", "Brings the model to a polygon budget and measures what that costs", S::changes,
       {{.name = "budget", .kind = K::integer, .help = "placed triangles in all; 0 merges planar regions only", .minimum = 0, .maximum = 1e12},
        {.name = "max-deviation", .kind = K::number, .help = "no surface may move further, where --lod does not say how far", .unit = "m", .standard = 0.015, .minimum = 0, .maximum = 1000},
        {.name = "by-view", .kind = K::flag, .help = "what is seen from the walkable surface weighs more, what nobody sees less; after `collide`"},
        {.name = "lod", .kind = K::path, .help = "file of level-of-detail rules, or `default` for LoD 300 with surroundings of LoD 200"},
        {.name = "surroundings", .kind = K::list, .help = "selectors of what stands around the main model: #id, class:…, name:…, storey:…"}},
       runOptimize},
      {"treat", "Says how single products are treated, or lists it: left out of the scene, kept as they are, simplified within own limits", S::changes,
       {{.name = "products", .kind = K::list, .help = "#id, a GlobalId, class:IfcFurniture, name:*chair*, storey:…", .positional = true},
        {.name = "as", .kind = K::choice, .help = "`excluded` is not in the scene, `kept` is never simplified, `rules` takes back what was said", .choices = {"excluded", "kept", "simplified", "rules"}},
        {.name = "max-deviation", .kind = K::number, .help = "with simplified: its surface may not move further", .unit = "m", .minimum = 0, .maximum = 1000},
        {.name = "weight", .kind = K::number, .help = "with simplified: its error counts this many times", .minimum = 0.001, .maximum = 1000}},
       runTreat},
      {"collide", "Makes collision shapes, the walkable surface, and checks the doors and rooms", S::changes,
       {{.name = "agent-radius", .kind = K::number, .help = "of whoever walks", .unit = "m", .standard = 0.3, .minimum = 0.05, .maximum = 2},
        {.name = "agent-height", .kind = K::number, .help = "of whoever walks", .unit = "m", .standard = 1.8, .minimum = 0.3, .maximum = 5},
        {.name = "doors", .kind = K::choice, .help = "how they stand; as-set: those closed that were last, or that --closed names", .standard = "open", .choices = {"open", "closed", "as-set"}},
        {.name = "closed", .kind = K::list, .help = "selectors of the doors that stand closed, with --doors as-set: #id, name:…, storey:…"}},
       runCollide},
      {"materials", "Gives every surface a physical material, and lists what is doubtful until it is mended or accepted", S::changes,
       {{.name = "rules", .kind = K::path, .help = "file of own assignment rules, or `default`; kept in the project"},
        {.name = "library", .kind = K::list, .help = "files of own materials; kept in the project"},
        {.name = "forget", .kind = K::list, .help = "ids of own materials to take out again"},
        {.name = "assign", .kind = K::pairs, .help = "SELECTOR=MATERIAL, or =rules to take it back; a selector is #id, a GlobalId, or conditions joined by &: class:IfcWall, type:…, name:*glass*, storey:…, group:…, layer:…, material:…, colour:red; @0,0,1 behind it: only faces that look that way; @0,0,1@X,Y,Z: of them only the one at this point of the model's own frame"},
        {.name = "where", .kind = K::text, .help = "id of a material: answers where it is used"},
        {.name = "accept", .kind = K::list, .help = "ids of findings that may stand, with --because"},
        {.name = "because", .kind = K::text, .help = "why they may stand; kept in the project until their cause changes"},
        {.name = "reopen", .kind = K::list, .help = "ids of findings that shall be open again"},
        {.name = "instrument", .kind = K::text, .help = "id of the instrument at whose wavelength there must be figures (default: those that scanned)"},
        {.name = "report", .kind = K::path, .help = "printable report to write (.html, .csv)"}},
       runMaterials},
      {"georeference", "Shows or sets where on Earth the model stands", S::changes,
       {{.name = "crs", .kind = K::text, .help = "coordinate reference system, as EPSG:n"},
        {.name = "origin", .kind = K::triple, .help = "map coordinates E,N,H of the model's origin", .unit = "m"},
        {.name = "rotation-deg", .kind = K::number, .help = "from the map's east to the model's X axis, counter-clockwise", .unit = "deg", .minimum = -360, .maximum = 360}},
       runGeoreference},
      {"station", "Adds, moves, removes or lists stations; without --at or --on at the place that adds most to what is seen", S::changes,
       {{.name = "add", .kind = K::text, .help = "name of a new station"},
        {.name = "move", .kind = K::text, .help = "name of the station to move"},
        {.name = "remove", .kind = K::text, .help = "name of the station to remove"},
        {.name = "at", .kind = K::triple, .help = "X,Y,Z of the instrument's centre, in the file's frame", .unit = "m"},
        {.name = "on", .kind = K::triple, .help = "X,Y[,Z] of the floor, to which the tripod adds its height; without Z the lowest floor with room", .unit = "m"},
        {.name = "height", .kind = K::number, .help = "of the instrument's centre above the floor (default: the instrument's, else 1.6)", .unit = "m", .minimum = 0.1, .maximum = 10},
        {.name = "instrument", .kind = K::text, .help = "id of the instrument that will stand there: its heights"},
        {.name = "stand", .kind = K::choice, .help = "free: it hangs or is held, and only its clearance is checked", .standard = "tripod", .choices = {"tripod", "free"}},
        {.name = "tilt-deg", .kind = K::number, .help = "so far its axis leans out of the plumb line", .unit = "deg", .minimum = 0, .maximum = 60},
        {.name = "tilt-towards-deg", .kind = K::number, .help = "where it leans to, counter-clockwise from the file's X", .unit = "deg", .standard = 0, .minimum = -360, .maximum = 360},
        {.name = "levelling-error-deg", .kind = K::number, .help = "instead of a stated tilt: one drawn by seed and name, up to this", .unit = "deg", .minimum = 0, .maximum = 60},
        {.name = "seed", .kind = K::integer, .help = "of that tilt", .standard = 1, .minimum = 0, .maximum = 9007199254740991.0},
        {.name = "yaw-deg", .kind = K::number, .help = "of the instrument's X axis, counter-clockwise from the file's X", .unit = "deg", .standard = 0, .minimum = -360, .maximum = 360}},
       runStation},
      {"target", "Adds, removes or lists targets, and tells which stations can measure them", S::changes,
       {{.name = "add", .kind = K::text, .help = "name of a new target"},
        {.name = "remove", .kind = K::text, .help = "name of the target to remove"},
        {.name = "at", .kind = K::triple, .help = "X,Y,Z of its centre, in the file's frame", .unit = "m"},
        {.name = "on", .kind = K::triple, .help = "X,Y[,Z] of the floor that its tripod or pole stands on; without Z the lowest with room", .unit = "m"},
        {.name = "height", .kind = K::number, .help = "of its centre above that floor", .unit = "m", .standard = 1.5, .minimum = 0.05, .maximum = 5},
        {.name = "on-surface", .kind = K::triple, .help = "X,Y,Z near a wall, column or ceiling that it sticks to", .unit = "m"},
        {.name = "stand-off", .kind = K::number, .help = "of a magnetic base or a bracket between surface and target", .unit = "m", .standard = 0, .minimum = 0, .maximum = 1},
        {.name = "type", .kind = K::text, .help = "article of scanners/targets/kinds.json: sphere-145, sphere-200, sphere-139, paper-150, bw-114, bw-152"},
        {.name = "kind", .kind = K::choice, .help = "what it is, where no article is named", .choices = {"sphere", "checkerboard"}},
        {.name = "size", .kind = K::number, .help = "diameter or side (default: the article's)", .unit = "m", .minimum = 0.01, .maximum = 2},
        {.name = "normal", .kind = K::triple, .help = "where a checkerboard faces (default on a tripod: to the nearest station)"},
        {.name = "sight", .kind = K::flag, .help = "list how each station sees each target"},
        {.name = "instrument", .kind = K::text, .help = "id of the instrument that shall measure them (default: those that scanned)"},
        {.name = "set", .kind = K::pairs, .help = "its settings, as of scan"}},
       runTarget},
      {"underlay", "Lays point clouds under the model, or lists those that do; the points stay in their files", S::changes,
       {{.name = "add", .kind = K::path, .help = "cloud file (.e57, .las, .ply, .ptx, .pts, .xyz)"},
        {.name = "name", .kind = K::text, .help = "of what is added (default: the file's)"},
        {.name = "move", .kind = K::text, .help = "name of the underlay to move"},
        {.name = "register", .kind = K::text, .help = "name of the underlay to register to the model, by --pairs, --icp, or both in this order"},
        {.name = "pairs", .kind = K::pairs, .help = "three or more x,y,z=X,Y,Z: a place as the cloud's file has it, and as the model's"},
        {.name = "icp", .kind = K::flag, .help = "fit the cloud to the model's surface, from where it lies"},
        {.name = "reach", .kind = K::number, .help = "of --icp: no point looks further for its surface", .unit = "m", .standard = 0.5, .minimum = 0.01, .maximum = 100},
        {.name = "remove", .kind = K::text, .help = "name of the underlay to remove"},
        {.name = "show", .kind = K::text, .help = "name of the underlay to show"},
        {.name = "hide", .kind = K::text, .help = "name of the underlay to hide"},
        {.name = "at", .kind = K::triple, .help = "X,Y,Z of the cloud's origin in the file's frame (default: by the map conversion, else as the cloud is)", .unit = "m"},
        {.name = "yaw-deg", .kind = K::number, .help = "from the file's X axis to the cloud's, counter-clockwise", .unit = "deg", .minimum = -360, .maximum = 360}},
       runUnderlay},
      {"verify", "Holds the assigned materials against the intensities of a measured cloud that lies under the model", S::changes,
       {{.name = "underlay", .kind = K::text, .help = "its name (default: the only one there is)", .positional = true},
        {.name = "instrument", .kind = K::text, .help = "id of the instrument that measured, for its wavelength (default: as the cloud says)"},
        {.name = "from", .kind = K::triple, .help = "X,Y,Z of the station in the model's file frame, where the cloud does not say it", .unit = "m"},
        {.name = "tolerance", .kind = K::number, .help = "points further off their surface are not compared", .unit = "m", .standard = 0.03, .minimum = 0.001, .maximum = 0.2},
        {.name = "points", .kind = K::integer, .help = "most that are drawn from the cloud, evenly", .standard = 2000000, .minimum = 1000, .maximum = 20000000}},
       runVerify},
      {"plan", "Tells before a scan what its stations would see: coverage, overlap, points, time, holes, the next place", S::reads,
       {{.name = "stations", .kind = K::text, .help = "all, or names separated by commas", .standard = "all"},
        {.name = "instrument", .kind = K::text, .help = "id of the instrument, such as leica-rtc360", .required = true},
        {.name = "set", .kind = K::pairs, .help = "settings in the device's own words, such as resolution=12mm"},
        {.name = "spacing", .kind = K::number, .help = "seen is what gets a point for each square of this side at least", .unit = "m", .minimum = 0.0001, .maximum = 100},
        {.name = "max-incidence-deg", .kind = K::number, .help = "seen is what is met no flatter than this off its normal", .unit = "deg", .minimum = 1, .maximum = 90},
        {.name = "max-range", .kind = K::number, .help = "seen is what is no farther than this", .unit = "m", .minimum = 0.1, .maximum = 10000},
        {.name = "samples", .kind = K::integer, .help = "places on the surfaces that are asked", .standard = 40000, .minimum = 100, .maximum = 5000000},
        {.name = "seed", .kind = K::integer, .help = "of those places", .standard = 1, .minimum = 0, .maximum = 9007199254740991.0}},
       runPlan},
      {"scan", "Scans from the stations with an instrument into point-cloud files", S::changes,
       {{.name = "stations", .kind = K::text, .help = "all, or names separated by commas", .standard = "all"},
        {.name = "instrument", .kind = K::text, .help = "id of the instrument, such as leica-rtc360", .required = true},
        {.name = "set", .kind = K::pairs, .help = "settings in the device's own words, such as resolution=12mm"},
        {.name = "seed", .kind = K::integer, .help = "of the noise", .standard = 1, .minimum = 0, .maximum = 9007199254740991.0},
        {.name = "ideal", .kind = K::flag, .help = "without any effect: the first surface on the axis of each pulse, exactly"},
        {.name = "without", .kind = K::text, .help = effectHelp()},
        {.name = "weather", .kind = K::text, .help = "visibility=KM rain=MM/H snow=MM/H fog=M dust=M, separated by spaces or commas"},
        {.name = "sun", .kind = K::text, .help = "AZIMUTH,ELEVATION[,W/m2] in degrees, clockwise from the file's Y; lux too: 135,40,80000lux"},
        {.name = "interference", .kind = K::number, .help = "chance that a pulse takes another instrument's light for its own", .standard = 0, .minimum = 0, .maximum = 1},
        {.name = "mishap", .kind = K::pairs, .help = "what went wrong in the field: until=SHARE of the columns, push=SHARE after "
                                                          "which the tripod stands elsewhere, noise=FACTOR, "
                                                          "walk=SHARE of the turn where somebody passes, "
                                                          "stand=SHARE where who scans stays"},
        {.name = "note", .kind = K::pairs, .help = "key=text for the file's record of each scan, such as operator=NAME"},
        {.name = "panorama", .kind = K::flag, .help = "a picture all around from each station, and the points coloured from it"},
        {.name = "panorama-size", .kind = K::integer, .help = "of --panorama: its width, twice its height (default: as the instrument's camera delivers it)", .unit = "pixels", .minimum = 256, .maximum = 32768},
        {.name = "compensator", .kind = K::choice, .help = "off: a station out of level gives tilted points", .standard = "on", .choices = {"on", "off"}},
        {.name = "truth", .kind = K::flag, .help = "with what is known of each point: time, return, true place, range, incidence, power, how it came about"},
        {.name = "as", .kind = K::choice, .help = "an E57 of integers of 0.1 mm, or of range and angles; a PCD as a list of points instead of a grid; a LAS of point format 8", .choices = {"scaled", "spherical", "points", "pdrf8"}},
        {.name = "threads", .kind = K::integer, .help = "0 = all; the result is the same", .standard = 0, .minimum = 0, .maximum = 1024},
        {.name = "resume", .kind = K::flag, .help = "go on with a run that was cancelled or crashed: its finished stations are taken as they are"},
        {.name = "shard", .kind = K::text, .help = "i/n: only every n-th station from the i-th, for a batch on several machines"},
        {.name = "output", .kind = K::path, .help = "a folder, or a file (.e57, .ptx, .las, .pcd, …); an E57, PTX or LAS holds all stations", .required = true}},
       runScan},
      {"register", "Solves the stations' poses from their scans, by targets or cloud to cloud, and tells residuals and true errors", S::changes,
       {{.name = "files", .kind = K::list, .help = "the scans (E57, PTX), one of each station", .positional = true, .required = true},
        {.name = "fix", .kind = K::text, .help = "station that is held where it is (default: the first)"},
        {.name = "by", .kind = K::choice, .help = "how targets find their partners: their names, or the distances between them", .standard = "names", .choices = {"names", "geometry"}},
        {.name = "control", .kind = K::path, .help = "text file of known targets, that hold all stations: name X Y Z [sigma in mm]"},
        {.name = "cloud", .kind = K::flag, .help = "cloud to cloud instead of by targets"},
        {.name = "output", .kind = K::path, .help = "a folder for copies of the scans with their solved poses, or a file where there is one scan file"},
        {.name = "reach", .kind = K::number, .help = "of --cloud: no point looks further for its surface", .unit = "m", .standard = 0.5, .minimum = 0.01, .maximum = 100},
        {.name = "laid", .kind = K::text, .help = "x,y,turn of --cloud: how far, in m and degrees, from where the eye lays it each scan is laid before the fit"},
        {.name = "click", .kind = K::number, .help = "how far the operator's click is from a target at most; where it is measured starts there", .unit = "m", .standard = 0.2, .minimum = 0, .maximum = 0.5},
        {.name = "seed", .kind = K::integer, .help = "of the operator's hand", .standard = 1, .minimum = 0, .maximum = 9007199254740991.0}},
       runRegister},
      {"export", "Writes the model as glTF, as OBJ, or as a scene for HELIOS++", S::reads,
       {{.name = "output", .kind = K::path, .help = "file to write (.glb, .gltf, .obj; .xml for HELIOS++)", .required = true},
        {.name = "physical", .kind = K::flag, .help = "the materials of the .obj are the physical ones, not the looks"},
        {.name = "levels", .kind = K::list, .help = "triangles of simpler levels of detail, from fine to coarse, as MSFT_lod: 10000 2000"},
        {.name = "collision", .kind = K::choice, .help = "with the collision shapes, named as engines read them", .choices = {"unreal", "godot", "physics"}}},
       runExport},
      {"convert", "Converts a point cloud, to another format or to a labelled set", S::files,
       {{.name = "in", .kind = K::path, .help = "cloud to read", .positional = true, .required = true},
        {.name = "out", .kind = K::path, .help = "cloud to write", .positional = true, .required = true},
        {.name = "as", .kind = K::choice, .help = "an E57 of integers of 0.1 mm, or of range and angles; a PCD as a list of points instead of a grid; a LAS of point format 8", .choices = {"scaled", "spherical", "points", "pdrf8"}},
        {.name = "dataset", .kind = K::choice, .help = "OUT is the new folder of a set to train on; the scans must have labels", .choices = {"s3dis", "semantic3d", "semantickitti", "custom3d"}},
        {.name = "classes", .kind = K::path, .help = "of --dataset: JSON file that says which of its classes an IFC class is (default: pointclouds/classes)"}},
       runConvert},
      {"clean", "Filters a point cloud, and tells what each filter took of the truth where the file has it", S::files,
       {{.name = "in", .kind = K::path, .help = "cloud to read", .positional = true, .required = true},
        {.name = "output", .kind = K::path, .help = "cloud to write", .required = true},
        {.name = "filters", .kind = K::list, .help = filterHelp(), .required = true},
        {.name = "report", .kind = K::path, .help = "file for the figures of each filter (.json, .csv)"}},
       runClean},
      {"info", "Tells what is in a point cloud, a model or a project", S::files,
       {{.name = "file", .kind = K::path, .help = "the file, or the folder of a project", .positional = true, .required = true}}, runInfo},
      {"compare", "Compares two point clouds: noise on planes, roughness, intensity, coverage", S::files,
       {{.name = "a", .kind = K::path, .help = "first cloud", .positional = true, .required = true},
        {.name = "b", .kind = K::path, .help = "second cloud", .positional = true, .required = true}},
       runCompare},
      {"instruments", "Lists the instruments and where their files lie, or copies one to edit it", S::files,
       {{.name = "copy", .kind = K::text, .help = "id of the instrument to copy into the folder of own ones"},
        {.name = "as", .kind = K::text, .help = "id of the copy"}},
       runInstruments},
      {"run", "Replays a job: a list of verbs with their options", S::files,
       {{.name = "job", .kind = K::path, .help = "JSON file: [{\"verb\": …, option: value, …}, …]", .positional = true, .required = true}},
       runJob},
  };
  return verbs;
}

}  // namespace

std::span<const Verb> verbs() { return table(); }

std::filesystem::path dataFolder() {
  if (const char* folder = std::getenv("STANDPOINT_DATA")) return folder;
  return STANDPOINT_SOURCE_FOLDER;
}

}  // namespace standpoint
