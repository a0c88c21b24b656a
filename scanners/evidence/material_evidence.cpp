// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/evidence/material_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "core/units.h"
#include "scanners/evidence/evidence_cells.h"

namespace standpoint {

namespace {

// What stands for a surface to which nothing is assigned: only its cosine counts.
constexpr double kUnassignedGrey = 0.3;
constexpr double kDbPerNeper = 4.342944819032518;  // of power: 10 / ln 10
// Below these the vendor's figure does not follow the law well enough to judge materials by it.
constexpr double kLeastExplained = 0.8, kLeastSpread_db = 0.7;
// The range's part is taken as compensated only where that explains clearly more.
constexpr double kClearlyMore = 0.05;
// The curve is taken over the logarithm of the figures only where that leaves clearly less.
constexpr double kClearlyLess = 0.8;
// Glass sends back what lies on it: dust has no figure that anybody measured.
constexpr double kBrighterThanDust_db = 6;
constexpr std::array kRanges_m = {0.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 1e6};
constexpr std::array kIncidences_deg = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0};

class Comparison {
 public:
  Comparison(const std::vector<MeasuredReturn>& returns, const std::vector<SurfaceGroup>& groups,
             const std::vector<PhysicalMaterial>& library, const Instrument& instrument, const EvidenceOptions& options)
      : returns_(returns), groups_(groups), instrument_(instrument), options_(options) {
    for (const auto& material : library) {
      optics_.push_back(opticsOf(material, instrument.wavelength_nm));
      known_.push_back(!isGap(material));
    }
    grey_.diffuse = kUnassignedGrey;
  }

  Result<MaterialComparison> run(Progress& progress) {
    cells_ = evidenceCells(returns_, options_, result_, is_used_);
    set_aside_.assign(groups_.size(), false);
    first_cell_.assign(groups_.size() + 1, 0);
    for (const auto& cell : cells_) ++first_cell_[cell.group + 1];
    for (std::size_t g = 0; g < groups_.size(); ++g) first_cell_[g + 1] += first_cell_[g];
    TRY(progress.check());
    progress.advance(0.4);
    if (!fitScale()) return std::move(result_);
    judgeGroups();
    findLevel();
    // What a wrong surface loses with the incidence is wrong, too: once more without those.
    if (setOddAside() && fitScale()) {
      judgeGroups();
      findLevel();
    }
    spread();
    TRY(progress.check());
    progress.advance(0.8);
    if (result_.no_verdict.empty()) propose();
    return std::move(result_);
  }

 private:
  // A material that nobody measured is as good as none.
  bool hasFigures(std::int32_t material) const { return material >= 0 && known_[static_cast<std::size_t>(material)]; }
  // σ of what one surface of the material is off by against another, in dB.
  double apartDb(std::int32_t material) const {
    return hasFigures(material)
               ? kDbPerNeper * static_cast<double>(optics_[static_cast<std::size_t>(material)].surface_spread)
               : 0;
  }
  const Optics& opticsOfGroup(std::uint32_t group) const {
    const auto material = groups_[group].material;
    return hasFigures(material) ? optics_[static_cast<std::size_t>(material)] : grey_;
  }
  double expectedDb(const EvidenceCell& cell, const Optics& optics) const {
    return wayDb(instrument_, cell.range_m, result_.scale.range_compensated) + surfaceDb(optics, cell.cosine);
  }
  double offDb(const EvidenceCell& cell, const Optics& optics) const {
    return result_.scale.dbAt(cell.measured) + result_.level_db - expectedDb(cell, optics);
  }
  // Of what a group is said to be; panes are no measure of anything.
  bool holdsScale(std::uint32_t group) const {
    return hasFigures(groups_[group].material) && !opticsOfGroup(group).transparent && !set_aside_[group];
  }
  bool setOddAside();

  std::vector<IntensityCell> scaleCells(bool range_compensated, bool by_material) const;
  bool fitScale();
  void judgeGroups();
  GroupEvidence judged(std::uint32_t group) const;
  void findLevel();
  void spread();
  void propose();
  std::vector<std::vector<GroupEvidence>> odd(const MaterialEvidence& evidence) const;
  std::optional<MaterialProposal> proposalFor(const MaterialEvidence& evidence,
                                              const std::vector<GroupEvidence>& groups) const;
  double misfit(const std::vector<const EvidenceCell*>& cells, const Optics& optics) const;

  const std::vector<MeasuredReturn>& returns_;
  const std::vector<SurfaceGroup>& groups_;
  const Instrument& instrument_;
  const EvidenceOptions& options_;
  std::vector<Optics> optics_;
  std::vector<bool> known_;
  Optics grey_;
  std::vector<EvidenceCell> cells_;
  std::vector<std::size_t> first_cell_;  // of each group, and the end
  std::vector<bool> is_used_;
  std::vector<bool> set_aside_;  // groups that the scale is not fitted to
  MaterialComparison result_;
};

std::vector<IntensityCell> Comparison::scaleCells(bool range_compensated, bool by_material) const {
  std::vector<IntensityCell> cells;
  for (const auto& cell : cells_) {
    if (!holdsScale(cell.group)) continue;
    const double db =
        wayDb(instrument_, cell.range_m, range_compensated) + surfaceDb(opticsOfGroup(cell.group), cell.cosine);
    const auto group = by_material ? static_cast<std::uint32_t>(groups_[cell.group].material) : cell.group;
    cells.push_back({cell.measured, db, group, cell.weight()});
  }
  return cells;
}

// On one plane the range and the cosine rise together, so whether the vendor takes the range out shows only where
// surfaces of one material stand at several distances: that is asked first, of whole materials.
bool Comparison::fitScale() {
  const bool positive = std::all_of(cells_.begin(), cells_.end(), [](const EvidenceCell& c) { return c.measured > 0; });
  const auto best = [&](bool range_compensated, bool by_material) {
    const auto cells = scaleCells(range_compensated, by_material);
    auto scale = fitIntensityScale(cells, false);
    if (positive)
      if (auto other = fitIntensityScale(cells, true); other.scatter_db < kClearlyLess * scale.scatter_db)
        scale = std::move(other);
    return scale;
  };
  const bool compensated = best(true, true).explained > best(false, true).explained + kClearlyMore;
  result_.scale = best(compensated, false);
  result_.scale.range_compensated = compensated;
  char text[200];
  if (result_.scale.db.empty()) {
    result_.no_verdict = "too few points on surfaces with a material, or all intensities are equal";
    return false;
  }
  if (result_.scale.spread_db < kLeastSpread_db) {
    std::snprintf(text, sizeof text,
                  "ranges and incidences vary too little to derive the vendor's intensity scale (%.1f dB)",
                  result_.scale.spread_db);
    result_.no_verdict = text;
  } else if (result_.scale.explained < kLeastExplained) {
    std::snprintf(text, sizeof text,
                  "intensities do not follow range and incidence: %.0f %% explained, %.1f dB scatter",
                  result_.scale.explained * 100, result_.scale.scatter_db);
    result_.no_verdict = text;
  }
  return true;
}

GroupEvidence Comparison::judged(std::uint32_t group) const {
  GroupEvidence e;
  e.group = group;
  std::vector<Weighted> off, about, figures;
  Eigen::VectorXd fraction = Eigen::VectorXd::Zero(result_.scale.step_covariance.rows());
  double weights = 0;
  for (std::size_t c = first_cell_[group]; c < first_cell_[group + 1]; ++c) {
    const auto& cell = cells_[c];
    e.points += cell.points;
    off.push_back({offDb(cell, opticsOfGroup(group)), cell.weight()});
    figures.push_back({cell.measured, cell.weight()});
    fraction += cell.weight() * result_.scale.stepsAt(cell.measured);
    weights += cell.weight();
  }
  if (off.empty()) return e;
  e.off_db = weightedMedian(off);
  for (const auto& o : off) about.push_back({std::abs(o.value - e.off_db), o.weight});
  const double scatter = std::max(1.4826 * weightedMedian(about), result_.scale.scatter_db);
  fraction /= weights;
  // Against the middle of the curve: all that is common goes into the level.
  Eigen::VectorXd middle = Eigen::VectorXd::Zero(fraction.size());
  middle.head(fraction.size() / 2).setOnes();
  const double curve = (fraction - middle).dot(result_.scale.step_covariance * (fraction - middle));
  e.sigma_db = std::sqrt(scatter * scatter / static_cast<double>(off.size()) + std::max(0.0, curve));
  e.supported = e.points >= options_.fewest_points && off.size() >= options_.fewest_cells &&
                e.sigma_db < options_.agree_db && result_.scale.covers(weightedMedian(figures));
  return e;
}

bool Comparison::setOddAside() {
  if (!result_.no_verdict.empty()) return false;
  bool any = false;
  for (const auto& m : result_.materials)
    for (const auto& g : m.groups)
      if (g.supported && !g.agrees && holdsScale(g.group)) any = set_aside_[g.group] = true;
  return any;
}

void Comparison::judgeGroups() {
  result_.materials.clear();
  result_.level_db = 0;
  std::map<std::int32_t, MaterialEvidence> by_material;
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    if (first_cell_[g] == first_cell_[g + 1]) continue;
    auto& evidence = by_material[groups_[g].material];
    evidence.material = groups_[g].material;
    evidence.groups.push_back(judged(g));
    evidence.supported = evidence.supported || evidence.groups.back().supported;
  }
  for (auto& [material, evidence] : by_material) result_.materials.push_back(std::move(evidence));
}

double materialOff(const MaterialEvidence& evidence) {
  std::vector<Weighted> off;
  for (const auto& g : evidence.groups)
    if (g.supported) off.push_back({g.off_db, std::sqrt(static_cast<double>(g.points))});
  return weightedMedian(off);
}

// The constant on which most materials agree. A large one counts for more, but hardly: it is wrong as easily.
void Comparison::findLevel() {
  std::vector<Weighted> off;
  for (const auto& m : result_.materials)
    if (m.supported && hasFigures(m.material) && !optics_[static_cast<std::size_t>(m.material)].transparent) {
      double points = 0;
      for (const auto& g : m.groups) points += g.supported ? static_cast<double>(g.points) : 0;
      off.push_back({materialOff(m), std::pow(points, 0.25)});
    }
  double most = 0, all = 0;
  std::vector<Weighted> agreeing;
  for (const auto& o : off) {
    all += o.weight;
    std::vector<Weighted> near;
    double weight = 0;
    for (const auto& other : off)
      if (std::abs(other.value - o.value) <= options_.agree_db) near.push_back(other), weight += other.weight;
    if (weight > most) most = weight, agreeing = std::move(near);
  }
  const double level = weightedMedian(agreeing);
  result_.level_db = -level;
  for (auto& m : result_.materials) {
    for (auto& g : m.groups) {
      g.off_db -= level;
      const double apart = apartDb(m.material);
      g.agrees = std::abs(g.off_db) <= options_.agree_db + 2 * std::sqrt(g.sigma_db * g.sigma_db + apart * apart);
    }
    const auto judged = std::count_if(m.groups.begin(), m.groups.end(), [](const auto& g) { return g.supported; });
    m.agrees = m.supported && std::abs(materialOff(m)) <=
                                  options_.agree_db + 2 * apartDb(m.material) / std::sqrt(static_cast<double>(judged));
  }
  if (!result_.no_verdict.empty()) return;
  if (agreeing.size() < 2 || most < all / 2)
    result_.no_verdict = off.size() < 2 ? "points on at least two materials are required to identify the wrong one"
                                        : "materials do not agree on the intensity scale, so the wrong ones cannot be "
                                          "identified: check the instrument and the cloud position";
}

void Comparison::spread() {
  std::map<std::int32_t, std::size_t> row;
  for (std::size_t i = 0; i < result_.materials.size(); ++i) row[result_.materials[i].material] = i;
  struct Bins {
    std::vector<float> all;
    std::array<std::vector<float>, kRanges_m.size() - 1> range;
    std::array<std::vector<float>, kIncidences_deg.size() - 1> incidence;
  };
  std::vector<Bins> bins(result_.materials.size());
  const auto binOf = [](const auto& edges, double value) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), value) - edges.begin();
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(edges.size()) - 2));
  };
  for (std::size_t i = 0; i < returns_.size(); ++i) {
    const auto found = is_used_[i] ? row.find(groups_[returns_[i].group].material) : row.end();
    if (found == row.end()) continue;
    const auto& r = returns_[i];
    const EvidenceCell alone{r.group, 1, static_cast<double>(r.intensity), static_cast<double>(r.range_m),
                             static_cast<double>(r.cosine)};
    const auto off = static_cast<float>(offDb(alone, opticsOfGroup(r.group)));
    auto& b = bins[found->second];
    b.all.push_back(off);
    b.range[binOf(kRanges_m, alone.range_m)].push_back(off);
    b.incidence[binOf(kIncidences_deg, std::acos(std::min(1.0, alone.cosine)) / kRadPerDeg)].push_back(off);
  }
  for (std::size_t i = 0; i < bins.size(); ++i) {
    auto& m = result_.materials[i];
    m.off_db = spreadOf(bins[i].all);
    m.points = m.off_db.points;
    for (std::size_t k = 0; k < bins[i].range.size(); ++k)
      if (!bins[i].range[k].empty()) m.by_range.push_back({kRanges_m[k], kRanges_m[k + 1], spreadOf(bins[i].range[k])});
    for (std::size_t k = 0; k < bins[i].incidence.size(); ++k)
      if (!bins[i].incidence[k].empty())
        m.by_incidence.push_back({kIncidences_deg[k], kIncidences_deg[k + 1], spreadOf(bins[i].incidence[k])});
  }
}

// The groups that are not what they are said to be, those together that are off by about the same.
std::vector<std::vector<GroupEvidence>> Comparison::odd(const MaterialEvidence& evidence) const {
  std::vector<GroupEvidence> odd;
  const bool pane = hasFigures(evidence.material) && optics_[static_cast<std::size_t>(evidence.material)].transparent;
  for (const auto& g : evidence.groups)
    if (g.supported && (!hasFigures(evidence.material) || (pane ? g.off_db > kBrighterThanDust_db : !g.agrees)))
      odd.push_back(g);
  std::stable_sort(odd.begin(), odd.end(), [](const auto& a, const auto& b) { return a.off_db < b.off_db; });
  std::vector<std::vector<GroupEvidence>> together;
  for (const auto& g : odd) {
    if (together.empty() || g.off_db - together.back().back().off_db > options_.agree_db) together.emplace_back();
    together.back().push_back(g);
  }
  return together;
}

double Comparison::misfit(const std::vector<const EvidenceCell*>& cells, const Optics& optics) const {
  std::vector<Weighted> off;
  for (const auto* cell : cells) off.push_back({std::abs(offDb(*cell, optics)), cell->weight()});
  return weightedMedian(off);
}

std::optional<MaterialProposal> Comparison::proposalFor(const MaterialEvidence& evidence,
                                                        const std::vector<GroupEvidence>& groups) const {
  MaterialProposal p;
  p.material = evidence.material;
  std::vector<const EvidenceCell*> cells;
  std::vector<Weighted> off;
  p.range_from_m = 1e9, p.incidence_from_deg = 90;
  for (const auto& g : groups) {
    p.groups.push_back(g.group);
    p.points += g.points;
    off.push_back({g.off_db, std::sqrt(static_cast<double>(g.points))});
    for (std::size_t c = first_cell_[g.group]; c < first_cell_[g.group + 1]; ++c) {
      const double degrees = std::acos(std::min(1.0, cells_[c].cosine)) / kRadPerDeg;
      p.range_from_m = std::min(p.range_from_m, cells_[c].range_m),
      p.range_to_m = std::max(p.range_to_m, cells_[c].range_m);
      p.incidence_from_deg = std::min(p.incidence_from_deg, degrees),
      p.incidence_to_deg = std::max(p.incidence_to_deg, degrees);
      cells.push_back(&cells_[c]);
    }
  }
  std::sort(p.groups.begin(), p.groups.end());
  p.off_db = weightedMedian(off);
  p.misfit_db = misfit(cells, opticsOfGroup(groups.front().group));
  std::vector<Weighted> candidates;  // weight: index
  for (std::size_t m = 0; m < optics_.size(); ++m)
    if (known_[m] && !optics_[m].transparent && static_cast<std::int32_t>(m) != p.material)
      candidates.push_back({misfit(cells, optics_[m]), static_cast<double>(m)});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  if (candidates.empty()) return std::nullopt;
  // Not explained by anything, or not clearly better than what is assigned: no proposal.
  const double best = candidates.front().value;
  const double noise = std::max(result_.scale.scatter_db, 0.1);
  if (best > std::max(options_.agree_db, 2 * noise)) return std::nullopt;
  if (hasFigures(evidence.material) && (best > p.misfit_db / 2 || p.misfit_db - best < options_.agree_db * 0.75))
    return std::nullopt;
  // What explains it as well: of those, one that the building has anyway is named first.
  std::set<std::int32_t> in_use;
  for (const auto& m : result_.materials)
    if (m.agrees) in_use.insert(m.material);
  for (const auto& c : candidates)
    if (c.value <= best + std::max(0.15, noise / 2)) p.alike.push_back(static_cast<std::int32_t>(c.weight));
  std::stable_partition(p.alike.begin(), p.alike.end(), [&](std::int32_t m) { return in_use.contains(m); });
  p.instead = p.alike.front();
  p.alike.erase(p.alike.begin());
  p.misfit_instead_db = misfit(cells, optics_[static_cast<std::size_t>(p.instead)]);
  const auto judgeable =
      std::count_if(evidence.groups.begin(), evidence.groups.end(), [](const auto& g) { return g.supported; });
  p.whole_material = static_cast<std::size_t>(judgeable) == groups.size();
  return p;
}

void Comparison::propose() {
  for (const auto& m : result_.materials)
    for (const auto& groups : odd(m))
      if (auto p = proposalFor(m, groups)) result_.proposals.push_back(*std::move(p));
  std::stable_sort(result_.proposals.begin(), result_.proposals.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.off_db) > std::abs(b.off_db); });
}

}  // namespace

Result<MaterialComparison> compareMaterials(const std::vector<MeasuredReturn>& returns,
                                            const std::vector<SurfaceGroup>& groups,
                                            const std::vector<PhysicalMaterial>& library, const Instrument& instrument,
                                            const EvidenceOptions& options, Progress& progress) {
  return Comparison(returns, groups, library, instrument, options).run(progress);
}

}  // namespace standpoint
