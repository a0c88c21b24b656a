// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include "project/dataset/dataset_verb.h"
#include "project/dataset/score_verb.h"
#include "project/fields.h"
#include "project/materials/materials_verb.h"
#include "project/materials/verification.h"
#include "project/model/bookmarks.h"
#include "project/model/import_verb.h"
#include "project/model/model_verbs.h"
#include "project/model/optimize_verb.h"
#include "project/model/treatments.h"
#include "project/survey/assess_verb.h"
#include "project/survey/coverage_verb.h"
#include "project/survey/locate_verb.h"
#include "project/survey/measure_verb.h"
#include "project/survey/register_verb.h"
#include "project/survey/survey_verbs.h"
#include "project/survey/underlays.h"
#include "project/survey/waveform_verb.h"
#include "project/verb.h"
#include "project/verbs/file_verbs.h"

namespace standpoint {

namespace {

using S = VerbScope;

Verb carriedOver(Verb verb, Document (*how)(const Document&, const Document&, const Document&)) {
  verb.carry_over = how;
  return verb;
}

Verb withoutModel(Verb verb) {
  verb.without_model = true;
  return verb;
}

// The table: a new verb is a typed function in its room with a table of its fields, and one entry here. Command
// line, help, job files and the editor's forms follow from it.
const std::vector<Verb>& table() {
  static const std::vector<Verb> verbs = {
      verbOf("import",
             "Import models (IFC, glTF, CityJSON, CityGML, OBJ, PLY, STL, DXF) or point clouds as a new project, or "
             "update it from a changed model",
             S::creates, importFields(), runImport),
      withoutModel(verbOf("add", "Add models to the environment", S::changes, addFields(), runAdd)),
      verbOf("optimize", "Optimise the model to a triangle budget and measure the deviation", S::changes,
             optimizeFields(), runOptimize),
      verbOf("treat", "Set or list the treatment of single products: excluded, kept, or simplified within own limits",
             S::changes, treatFields(), runTreat),
      verbOf("collide", "Make collision shapes and the walkable surface, and check doors and rooms", S::changes,
             collideFields(), runCollide),
      verbOf("materials", "Assign materials by rule and review open findings", S::changes, materialsFields(),
             runMaterials),
      withoutModel(verbOf("georeference", "Show or set the model's position on Earth", S::changes, georeferenceFields(),
                          runGeoreference)),
      verbOf("station",
             "Add, move, remove or list stations; without --at or --on at the place that adds most to what is seen",
             S::changes, stationFields(), runStation),
      verbOf("target", "Add, remove or list targets, and list the stations that can measure them", S::changes,
             targetFields(), runTarget),
      withoutModel(verbOf("bookmark", "Add, rename, remove or list named views of the model", S::changes,
                          bookmarkFields(), runBookmark)),
      withoutModel(verbOf("underlay",
                          "Add point clouds as underlays of the model, or list them; the points stay in their files",
                          S::changes, underlayFields(), runUnderlay)),
      withoutModel(verbOf("locate", "List the scan and cloud files of a project, or point it at the new place of some",
                          S::changes, locateFields(), runLocate)),
      withoutModel(verbOf(
          "measure", "Measure distances, heights, angles, areas and planes between points, or list the measurements",
          S::changes, measureFields(), runMeasure)),
      verbOf("verify", "Compare the assigned materials with the intensities of an underlay", S::changes, verifyFields(),
             runVerify),
      verbOf("plan", "Forecast what the stations would see: coverage, overlap, points, time, holes, the next place",
             S::reads, planFields(), runPlan),
      carriedOver(verbOf("scan", "Scan from the stations with an instrument into point-cloud files", S::changes,
                         scanFields(), runScan),
                  scansCarriedOver),
      verbOf("coverage", "Compare what is covered along trajectories, predicted or measured, and why the rest is blind",
             S::reads, coverageFields(), runCoverage),
      verbOf("trajectory",
             "Add, import, change, rename, remove, write or list the trajectories along which scanners are carried",
             S::changes, trajectoryFields(), runTrajectory),
      verbOf("mover",
             "Add, remove or list what moves while it is scanned: people, vehicles, doors, what turns or slides",
             S::changes, moverFields(), runMover),
      verbOf("waveform", "Write what the receiver gets of one pulse, bin by bin, to a CSV file", S::reads,
             waveformFields(), runWaveform),
      verbOf("register",
             "Solve the stations' poses from their scans, by targets or cloud to cloud, with residuals and true errors",
             S::changes, registerFields(), runRegister),
      verbOf(
          "assess",
          "Assess the scans of a project: coverage, overlap, density, incidence, noise, stray points, poses, targets; "
          "each against a limit, with the worst place",
          S::reads, assessFields(), runAssess),
      verbOf("export", "Write the model as IFC, as glTF, as OBJ, or as a scene for HELIOS++", S::reads, exportFields(),
             runExport),
      verbOf("convert", "Convert a point cloud to another format or to a labelled set", S::files, convertFields(),
             runConvert),
      verbOf("clean",
             "Filter a point cloud, and count what each filter removed by its true cause where the file has it",
             S::files, cleanFields(), runClean),
      verbOf("info", "List the contents of a point cloud, a model or a project", S::files, infoFields(), runInfo),
      verbOf("compare", "Compare two point clouds: distances, noise on planes, roughness, intensity, coverage",
             S::files, compareFields(), runCompare),
      verbOf("instruments", "List the instruments and their files, or copy one to edit it", S::files,
             instrumentsFields(), runInstruments),
      verbOf("dataset", "Make a set of labelled scans from a recipe, forecast it, verify it, describe it", S::files,
             datasetFields(), runDataset),
      verbOf("score",
             "Score labels of points, or what somebody's cleaning removed, against the truth: IoU, precision, recall",
             S::files, scoreFields(), runScore),
      verbOf("run", "Replay a job: a list of verbs with their options", S::files, jobFields(), runJob),
  };
  return verbs;
}

}  // namespace

std::span<const Verb> verbs() { return table(); }

}  // namespace standpoint
