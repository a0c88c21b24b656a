// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/surface_fit.h"
#include "project/answers.h"
#include "project/fields.h"

namespace standpoint {

// Compares the intensities of an underlay with what its surfaces' materials should send back. A verb of its own and no
// option of `materials`, which assigns: this one assigns nothing, and its options mean nothing to an assignment.
struct VerifyOptions {
  std::string underlay;                 // its name; empty: the only one
  std::string instrument;               // id; empty: as the cloud says
  std::optional<Eigen::Vector3d> from;  // the station in the model's file frame, m
  double tolerance_m = 0.03;
  std::size_t points = 2000000;  // maximum drawn from the cloud
};
const Fields<VerifyOptions>& verifyFields();

struct VerifySpread {  // of measured less expected, dB
  std::uint64_t points = 0;
  double p5 = 0, q1 = 0, median = 0, q3 = 0, p95 = 0;
};
const AnswerFields<VerifySpread>& answerFields(const VerifySpread*);
struct VerifyRangeBin : VerifySpread {
  double from_m = 0, to_m = 0;
};
const AnswerFields<VerifyRangeBin>& answerFields(const VerifyRangeBin*);
struct VerifyIncidenceBin : VerifySpread {
  double from_deg = 0, to_deg = 0;
};
const AnswerFields<VerifyIncidenceBin>& answerFields(const VerifyIncidenceBin*);
struct VerifyOutlier {  // a product that does not agree
  std::string product, name;
  std::uint64_t points = 0;
  double off_db = 0, sigma_db = 0;
};
const AnswerFields<VerifyOutlier>& answerFields(const VerifyOutlier*);
struct VerifyMaterial {
  std::optional<std::string> material;  // id; nothing: of what has none
  std::uint64_t points = 0;
  double area_m2 = 0;
  bool judged = false, agrees = false;
  VerifySpread off_db;
  std::vector<VerifyRangeBin> by_range;
  std::vector<VerifyIncidenceBin> by_incidence;
  std::vector<std::string> products;  // ids
  std::vector<VerifyOutlier> outlying;
};
const AnswerFields<VerifyMaterial>& answerFields(const VerifyMaterial*);
struct VerifyProposal {
  std::optional<std::string> material;  // as assigned
  std::string behaves_like;
  std::vector<std::string> alike;  // that explain it as well
  bool whole_material = false;
  std::vector<std::string> products;  // ids
  std::uint64_t points = 0;
  double off_db = 0, misfit_db = 0, misfit_instead_db = 0;
  std::vector<double> range_m, incidence_deg;  // from, to
  std::string evidence;
  std::vector<std::string> assign;  // what `materials --assign` takes
};
const AnswerFields<VerifyProposal>& answerFields(const VerifyProposal*);
struct VerifyScale {
  std::optional<std::string> reads;
  bool range_compensated = false;
  double explained = 0;  // 0..1
  std::optional<double> scatter_db;
  double learned_from_db = 0;
  std::vector<std::vector<double>> measured_to_db;  // knots
};
const AnswerFields<VerifyScale>& answerFields(const VerifyScale*);
struct VerifyPoints {
  std::uint64_t met = 0, near = 0, in_front = 0, behind = 0, behind_pane = 0, edge = 0, shared = 0;
  std::uint64_t without_station = 0, not_a_number = 0;
  double median_off_m = 0;
};
const AnswerFields<VerifyPoints>& answerFields(const VerifyPoints*);
struct VerifyPassed : ProductIdentity {  // a product that beams mostly pass
  std::uint64_t points_behind = 0, points_on = 0;
};
const AnswerFields<VerifyPassed>& answerFields(const VerifyPassed*);

struct VerifyAnswer {
  std::string underlay, instrument;
  double wavelength_nm = 0;
  VerifyPoints points;
  std::uint64_t compared = 0, grazing = 0, saturated = 0;
  std::optional<SurfaceFit> placement;  // where a fit to the surface would put the cloud
  VerifyScale scale;
  std::string no_verdict;  // empty where there is one
  std::vector<VerifyMaterial> materials;
  std::vector<VerifyProposal> proposals;
  std::vector<VerifyPassed> passed;
};
const AnswerFields<VerifyAnswer>& answerFields(const VerifyAnswer*);
Result<Answered<VerifyAnswer>> runVerify(const Document& document, const VerifyOptions& options, Progress& progress);

// What came of holding the assigned materials against a measured cloud.
struct Verification {
  std::uint64_t basis = 0;  // of what it was found with: see isCurrent
  std::uint64_t rest = 0;   // of the same without what it proposes to change: see hasStandingProposals
  VerifyAnswer answer;      // docs/explanation/verification.md
};

// Whether cloud, placement and assignment are still those that it was found with.
bool isCurrent(const Verification& verification, const Document& document);

// Whether the proposals hold that nobody has followed: all is as it was but for surfaces that a proposal means. Who
// follows one of three keeps the other two.
bool hasStandingProposals(const Verification& verification, const Document& document);
// The surfaces that a proposal means, by product and surface, as (product, surface).
std::vector<std::pair<std::uint32_t, std::uint32_t>> surfacesOf(const VerifyProposal& proposal,
                                                                const Document& document);

// With the basis of the document as it is.
Verification verificationOf(const Document& document, VerifyAnswer answer);

}  // namespace standpoint
