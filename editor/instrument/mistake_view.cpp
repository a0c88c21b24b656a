// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/mistake_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMostOfAPlace = 3000000;  // points in memory, of each half

// Two exercises of the same key have the same solution.
std::string keyOf(const Exercise& exercise) {
  std::string key = exercise.hash;
  for (const auto& action : exercise.solution) key += toJson(action).dump();
  return key;
}

ProofLook lookAt(const ProofPlace& place) {
  ProofLook look{place.centre_m, place.normal, place.seen_from_m, place.radius_m, false};
  look.edge_on = place.normal && (place.kind == ProofKind::offset || place.kind == ProofKind::scatter);
  // Both the surface and where its points are.
  if (place.kind == ProofKind::offset) {
    look.centre += place.offset_m / 2 * place.normal.value_or(Eigen::Vector3d::Zero());
    look.radius_m = std::hypot(place.radius_m, std::abs(place.offset_m) / 2);
  }
  return look;
}

CropShape cropOf(const ProofLook& look) {
  constexpr double kAround = 4, kLeast_m = 1.5;
  CropShape crop{look.centre, std::max(kAround * look.radius_m, kLeast_m), std::nullopt, 0};
  if (look.edge_on) {
    crop.slice = alongSurface(look);
    crop.half_slice_m = std::clamp(0.6 * look.radius_m, 0.05, 0.4);
  }
  return crop;
}

}  // namespace

void MistakeView::show(const Rehearsal& rehearsal, const MarkedRule& rule, Editor& editor) {
  reading_yours_.reset();
  reading_good_.reset();
  yours_.reset();
  good_.reset();
  rule_ = rule.id;
  place_ = *rule.shown;
  rehearsal_ = &rehearsal;
  language_ = rehearsal.device().state().language;
  ShownProof proof;
  proof.look = lookAt(place_);
  proof.ring_centre = place_.centre_m;
  proof.ring_m = place_.radius_m;
  proof.points = !place_.scans.empty();
  proof.yours_text = proof.points ? tr("Reading your scan…") : placeText(place_, rehearsal, language_);
  crop_ = cropOf(proof.look);
  if (proof.points) reading_yours_ = read(place_, rehearsal, editor);
  editor.showProof(std::move(proof));
  if (!editor.proof->points) return;
  const auto& exercise = rehearsal.exercise();
  const auto key = keyOf(exercise);
  if (exercise.solution.empty()) {
    editor.proof->good_text = tr("No sample solution to compare with: an assigned exercise does not contain it.");
  } else if (const auto known = solved_.find(key); known != solved_.end()) {
    showSolution(known->second, editor);
  } else if (!solving_ || key_ != key) {
    key_ = key;
    solving_ = std::make_unique<Task<Solution>>(
        "Carry out the sample solution",
        [exercise](Progress& progress) -> Result<Solution> {
          TRY_ASSIGN(auto carried, carryOutSolution(exercise, {}, progress));
          return std::make_shared<const CarriedOutSolution>(std::move(carried));
        },
        editor.wake);
  }
}

std::unique_ptr<Task<MistakeView::Side>> MistakeView::read(const ProofPlace& place, const Rehearsal& rehearsal,
                                                           Editor& editor) {
  const auto scans = scansOf(place, rehearsal);
  return std::make_unique<Task<Side>>(
      "Read the place",
      [place, scans, crop = crop_, beside = Eigen::Vector3d(place_.centre_m - place.centre_m),
       shift_m = editor.shift_m()](Progress& progress) -> Result<Side> {
        if (!scans) return failure(scans.error());
        std::vector<PosedScan> posed;
        for (const auto& scan : *scans) {
          posed.push_back({scan.file, scan.local_from_scanner});
          posed.back().local_from_scanner->translation += beside;
        }
        TRY_ASSIGN(auto cloud, croppedCloud(posed, crop, shift_m, kMostOfAPlace, progress));
        TRY_ASSIGN(const auto figure, figureAt(place, *scans, progress));
        return Side{std::move(cloud), figure};
      },
      editor.wake);
}

void MistakeView::showSolution(const Solution& solution, Editor& editor) {
  auto same = samePlace(place_, *solution->rehearsal);
  if (same.scans.empty()) {
    editor.proof->good_text = tr("The sample solution makes no scan.");
    return;
  }
  reading_good_ = read(same, *solution->rehearsal, editor);
}

void MistakeView::takeSolution(Editor& editor) {
  if (!solving_) return;
  if (!solving_->done()) {
    if (editor.proof && editor.proof->points)
      editor.proof->good_text =
          trf("Carrying out the sample solution: {:.0f} %", 100 * solving_->progress().fraction());
    return;
  }
  auto solved = std::exchange(solving_, nullptr)->take();
  if (solved) solved_[key_] = *solved;
  if (!editor.proof || !editor.proof->points || rehearsal_ == nullptr || keyOf(rehearsal_->exercise()) != key_) return;
  if (solved)
    showSolution(*solved, editor);
  else
    editor.proof->good_text = trError(solved.error());
}

std::string MistakeView::captionOf(const std::string& whose, const Side& side) const {
  return fmt::format("{}\n{}", whose, figureText(place_, side.figure, *rehearsal_, language_));
}

void MistakeView::takeSides(Editor& editor) {
  bool news = false;
  for (auto* side : {&reading_yours_, &reading_good_}) {
    if (!*side || !(*side)->done()) continue;
    auto read = std::exchange(*side, nullptr)->take();
    auto& text = side == &reading_yours_ ? editor.proof->yours_text : editor.proof->good_text;
    if (!read) {
      text = trError(read.error());
      continue;
    }
    text = captionOf(side == &reading_yours_ ? tr("Your scan") : tr("Sample solution"), *read);
    (side == &reading_yours_ ? yours_ : good_) = std::make_unique<Side>(*std::move(read));
    news = true;
  }
  if (news) put(editor);
}

void MistakeView::put(Editor& editor) {
  if (yours_ && good_) colourAlike(yours_->cloud, good_->cloud);
  for (const auto* side : {&yours_, &good_}) {
    if (!*side) continue;
    if (place_.kind == ProofKind::stray) highlight((*side)->cloud, place_.flags);
    auto& shown = side == &yours_ ? editor.proof->yours : editor.proof->good;
    shown = std::make_shared<const Cloud>((*side)->cloud);
  }
}

void MistakeView::follow(Editor& editor) {
  if (!rule_.empty() && !editor.proof) rule_.clear();  // Esc
  takeSolution(editor);
  if (editor.proof && rehearsal_ != nullptr) takeSides(editor);
}

void MistakeView::cancelSolving(Editor& editor) {
  solving_.reset();
  if (editor.proof)
    editor.proof->good_text = tr("The sample solution was cancelled. Press Show the points again to carry it out.");
}

void MistakeView::end(Editor& editor) {
  reading_yours_.reset();
  reading_good_.reset();
  rule_.clear();
  rehearsal_ = nullptr;
  editor.endProof();
}

}  // namespace standpoint
