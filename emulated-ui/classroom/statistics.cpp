// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace standpoint {

namespace {

using Numbers = std::vector<double>;

constexpr double kGroup = 0.27;  // of a class, its best and its worst (Kelley 1939)
constexpr double kWilson = 1.96;

double mean(const Numbers& x) {
  return x.empty() ? 0 : std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double variance(const Numbers& x) {
  const double m = mean(x);
  double sum = 0;
  for (const double one : x) sum += (one - m) * (one - m);
  return x.size() < 2 ? 0 : sum / static_cast<double>(x.size() - 1);
}

// Nothing where one of them is always the same.
std::optional<double> correlation(const Numbers& x, const Numbers& y) {
  const double spread = std::sqrt(variance(x) * variance(y));
  if (spread <= 0) return std::nullopt;
  const double mx = mean(x), my = mean(y);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - mx) * (y[i] - my);
  return sum / static_cast<double>(x.size() - 1) / spread;
}

struct Criterion {
  CriterionStatistics row;
  Numbers points;  // of each result
  double of = 0;
};

template <class Marked>
Criterion criterionOf(const Marked& m, bool rule) {
  Criterion c;
  c.row.id = m.id;
  c.row.text = m.text;
  c.row.rule = rule;
  if constexpr (std::is_same_v<Marked, MarkedRule>) c.row.must = m.must;
  c.of = m.of;
  return c;
}

void addWilson(CriterionStatistics& row) {
  const auto n = static_cast<double>(row.of), p = static_cast<double>(row.met) / n, z2 = kWilson * kWilson;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kWilson / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  row.facility_low = std::max(0.0, centre - half);
  row.facility_high = std::min(1.0, centre + half);
}

}  // namespace

ClassStatistics statisticsOf(const std::vector<const Marks*>& marks) {
  ClassStatistics all;
  all.results = marks.size();
  if (marks.empty()) return all;
  std::vector<Criterion> criteria;
  for (const auto& s : marks.front()->steps) criteria.push_back(criterionOf(s, false));
  for (const auto& r : marks.front()->rules) criteria.push_back(criterionOf(r, true));
  Numbers totals, scores;
  for (const auto* m : marks) {
    std::size_t i = 0;
    const auto add = [&](double points, bool held) {
      criteria[i].points.push_back(points);
      criteria[i++].row.met += held ? 1 : 0;
    };
    for (const auto& s : m->steps) add(s.points, s.done);
    for (const auto& r : m->rules) add(r.points, r.held);
    totals.push_back(m->points);
    scores.push_back(m->score);
    all.passed += m->passed ? 1 : 0;
  }
  all.mean = mean(scores);
  std::vector<std::size_t> by_total(totals.size());
  std::iota(by_total.begin(), by_total.end(), 0U);
  std::stable_sort(by_total.begin(), by_total.end(), [&](auto a, auto b) { return totals[a] > totals[b]; });
  const auto group = static_cast<std::size_t>(std::round(kGroup * static_cast<double>(totals.size())));
  const bool enough = marks.size() >= kEnoughResults;
  double variances = 0;
  std::size_t marked = 0;  // that are worth points
  for (auto& c : criteria) {
    c.row.of = marks.size();
    c.row.facility = c.of > 0 ? mean(c.points) / c.of : static_cast<double>(c.row.met) / static_cast<double>(c.row.of);
    addWilson(c.row);
    variances += variance(c.points);
    marked += c.of > 0 ? 1 : 0;
    if (enough && c.of > 0) {
      Numbers rest(totals);
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= c.points[i];
      c.row.correlation = correlation(c.points, rest);
      double best = 0, worst = 0;
      for (std::size_t i = 0; i < group; ++i)
        best += c.points[by_total[i]], worst += c.points[by_total[by_total.size() - 1 - i]];
      c.row.discrimination = (best - worst) / (c.of * static_cast<double>(group));
    }
    all.criteria.push_back(std::move(c.row));
  }
  const auto k = static_cast<double>(marked);
  if (enough && marked > 1 && variance(totals) > 0) all.alpha = k / (k - 1) * (1 - variances / variance(totals));
  return all;
}

std::vector<std::string> mistakesOf(const Marks& marks) {
  std::vector<std::string> found;
  const auto add = [&](const std::string& one) {
    if (std::find(found.begin(), found.end(), one) == found.end()) found.push_back(one);
  };
  for (const bool must : {true, false})
    for (const auto& r : marks.rules)
      if (!r.held && r.must == must && r.mistake) add(*r.mistake);
  for (const auto& s : marks.steps)
    if (!s.done) {
      add("step " + s.id);
      break;
    }
  for (const auto& r : marks.rules)
    if (!r.held && !r.mistake) add(r.id);
  return found;
}

}  // namespace standpoint
