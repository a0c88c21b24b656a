// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/guide.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/number_text.h"
#include "editor/model/model.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/materials/material_findings.h"
#include "project/survey/assess_verb.h"

namespace standpoint {

namespace {

using State = GuideStep::State;

// More than this is worth a budget: what a notebook draws and walks in without effort.
constexpr std::uint64_t kLightModel_triangles = 100'000;

GuideStep environmentStep(const Model& model) {
  GuideStep step{Workspace::environment, "Environment", State::open, "No model",
                 "Import a model",       "inspector",   "import"};
  const auto& document = model.session.document();
  if (!document.imported) return step;
  step.state = State::done;
  step.advice = step.command = "";
  if (!document.hasModel()) {
    step.status = trn("{} point cloud, no model", "{} point clouds, no model", document.underlays.size(),
                      document.underlays.size());
    return step;
  }
  step.status = trf("{} products, {} triangles", groupedDigits(document.imported->products.size()),
                    groupedDigits(sceneTriangleCount(*document.imported)));
  const auto losses = document.import_report
                          ? std::count_if(document.import_report->issues.begin(), document.import_report->issues.end(),
                                          [](const Issue& i) { return i.severity == Severity::loss; })
                          : 0;
  if (losses > 0) {
    step.state = State::attention;
    step.status += trf("; {} lost on import", losses);
    step.advice = "Read the log";
    step.tab = "log";
  }
  return step;
}

// Of a project of point clouds alone.
GuideStep needsModel(GuideStep step) {
  step.state = State::optional;
  step.status = "Needs a model";
  step.advice = step.command = "";
  return step;
}

GuideStep optimiseStep(const Model& model) {
  GuideStep step{Workspace::optimise, "Optimise", State::optional, "", "Choose a budget", "optimise", "choose-budget"};
  const auto& document = model.session.document();
  if (!document.imported) return step;
  if (!document.hasModel()) return needsModel(std::move(step));
  const auto triangles = sceneTriangleCount(*document.imported);
  if (document.simplified) {
    step.state = State::done;
    step.status = trf("{} of {} triangles", groupedDigits(sceneTriangleCount(*document.simplified->environment)),
                      groupedDigits(triangles));
    step.advice = step.command = "";
  } else if (triangles > kLightModel_triangles) {
    step.state = State::attention;
    step.status = trf("{} triangles, no budget", groupedDigits(triangles));
  } else {
    step.status = trf("{} triangles, light already; a budget makes it lighter", groupedDigits(triangles));
    step.advice = step.command = "";
  }
  return step;
}

GuideStep materialStep(const Model& model) {
  GuideStep step{Workspace::materials, "Materials", State::open,      "Not assigned",
                 "Assign materials",   "material",  "assign-by-rules"};
  if (const auto& d = model.session.document(); d.imported && !d.hasModel()) return needsModel(std::move(step));
  const auto& document = model.session.document();
  if (!document.materials) return step;
  const auto findings = materialFindings(document);
  const auto open = std::count_if(findings.begin(), findings.end(), [](const MaterialFinding& f) {
    return f.because.empty() && f.severity == "warning";
  });
  step.state = open > 0 ? State::attention : State::done;
  step.status =
      open > 0 ? trn("{} open warning", "{} open warnings", static_cast<std::size_t>(open), open) : tr("Assigned");
  step.advice = open > 0 ? "Review open findings" : "";
  step.tab = open > 0 ? "findings" : step.tab;
  step.command = "";
  return step;
}

GuideStep georeferenceStep(const Model& model) {
  GuideStep step{Workspace::georeference, "Georeference",        State::optional,
                 "Local coordinates",     "Place it on the map", "georeference"};
  const auto& georeference = model.session.document().georeference;
  if (!georeference || georeference->crs.empty()) return step;
  step.state = State::done;
  step.status = georeference->crs;
  step.advice = "";
  return step;
}

GuideStep surveyStep(const Model& model) {
  GuideStep step{Workspace::survey, "Survey", State::open, "No stations", "Add a station", "scan", "add-station"};
  if (const auto& d = model.session.document(); d.imported && !d.hasModel()) return needsModel(std::move(step));
  const auto& job = model.session.document().job;
  if (!job || job->stations.empty()) return step;
  const auto unscanned =
      std::count_if(job->stations.begin(), job->stations.end(), [](const Station& s) { return s.scans.empty(); });
  step.status = trn("{} station", "{} stations", job->stations.size(), job->stations.size());
  step.state = unscanned > 0 ? State::open : State::done;
  step.advice = unscanned > 0 ? "Scan…" : "";
  step.command = unscanned > 0 ? "scan" : "";
  if (unscanned > 0) step.status += trf(", {} not scanned", unscanned);
  return step;
}

GuideStep instrumentStep(const Model&) {
  return {Workspace::instrument,  "Instrument",         State::optional,
          "Rehearse on a device", "Choose an exercise", "instrument"};
}

GuideStep inspectStep(const Model& model) {
  GuideStep step{Workspace::inspect, "Inspect", State::open, "Not assessed", "Assess the survey", "quality", "assess"};
  if (const auto& d = model.session.document(); d.imported && !d.hasModel()) {
    step = {Workspace::inspect, "Inspect", State::optional, "Colour, measure and cut the points", "", "points"};
    return step;
  }
  const auto* last = model.session.lastOf("assess");
  const auto* answer = last == nullptr ? nullptr : answerAs<AssessAnswer>(last->answer);
  if (answer == nullptr) return step;
  if (model.session.isOutOfDate(*last)) {
    step.status = "Assessment is out of date";
    return step;
  }
  const bool good = answer->bad == 0 && answer->warn == 0;
  step.state = good ? State::done : State::attention;
  step.status = trSentence(verdictText(*answer));
  step.advice = good ? "" : "Look at the worst places";
  step.command = good ? "" : "worst-place";
  return step;
}

}  // namespace

std::array<GuideStep, kWorkspaces> guideSteps(const Model& model) {
  return {environmentStep(model), optimiseStep(model),   materialStep(model), georeferenceStep(model),
          surveyStep(model),      instrumentStep(model), inspectStep(model)};
}

const Guide::Steps& Guide::of(const Model& model) const {
  const auto* assessed = model.session.lastOf("assess");
  const std::string now = fmt::format("{} {} {}", spoken(), model.session.revision(),
                                      assessed == nullptr ? "" : assessed->time + assessed->text);
  if (now != made_for_) {
    made_for_ = now;
    steps_ = guideSteps(model);
  }
  return steps_;
}

std::optional<std::size_t> nextStep(const std::array<GuideStep, kWorkspaces>& steps) {
  for (const auto state : {State::open, State::attention})
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (steps[i].state == state) return i;
  return std::nullopt;
}

}  // namespace standpoint
