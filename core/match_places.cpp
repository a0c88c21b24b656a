// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/match_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "core/rigid_fit.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using Places = std::span<const Vector3d>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

// Each place to its nearest, each of those once.
Pairs together(Places from, Places to, const Pose& motion, double tolerance_m) {
  struct Near {
    double distance;
    std::size_t from, to;
  };
  std::vector<Near> all;
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t k = 0; k < to.size(); ++k)
      if (const double d = (motion * from[i] - to[k]).norm(); d <= tolerance_m) all.push_back({d, i, k});
  std::sort(all.begin(), all.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  std::vector<bool> from_used(from.size()), to_used(to.size());
  Pairs pairs;
  for (const auto& n : all) {
    if (from_used[n.from] || to_used[n.to]) continue;
    from_used[n.from] = to_used[n.to] = true;
    pairs.emplace_back(n.from, n.to);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::optional<PlaceMatch> matchBy(Places from, Places to, const Pairs& pairs) {
  std::vector<Vector3d> a, b;
  for (const auto& [i, k] : pairs) a.push_back(from[i]), b.push_back(to[k]);
  const auto fit = fitRigid(a, b);
  if (!fit) return std::nullopt;
  return PlaceMatch{pairs, fit->to_from, fit->rms_m};
}

class Search {
 public:
  Search(Places from, Places to, double tolerance_m) : from_(from), to_(to), tolerance_m_(tolerance_m) {}

  void run() {
    for (std::size_t i = 0; i < from_.size(); ++i)
      for (std::size_t k = i + 1; k < from_.size(); ++k)
        for (std::size_t m = k + 1; m < from_.size(); ++m) triple(i, k, m);
  }
  std::vector<PlaceMatch> best;  // all assignments that bring together most

 private:
  bool same(std::size_t i, std::size_t k, std::size_t a, std::size_t b) const {
    return std::abs((from_[i] - from_[k]).norm() - (to_[a] - to_[b]).norm()) <= 2 * tolerance_m_;
  }
  void triple(std::size_t i, std::size_t k, std::size_t m) {
    for (std::size_t a = 0; a < to_.size(); ++a)
      for (std::size_t b = 0; b < to_.size(); ++b) {
        if (a == b || !same(i, k, a, b)) continue;
        for (std::size_t c = 0; c < to_.size(); ++c)
          if (c != a && c != b && same(i, m, a, c) && same(k, m, b, c)) propose({{i, a}, {k, b}, {m, c}});
      }
  }
  void propose(const Pairs& three) {
    const auto start = matchBy(from_, to_, three);
    if (!start) return;
    const Pairs pairs = together(from_, to_, start->to_from, 2 * tolerance_m_);
    if (pairs.size() < 3 || (!best.empty() && pairs.size() < best.front().pairs.size()) || !tried_.insert(pairs).second)
      return;
    const auto match = matchBy(from_, to_, pairs);
    if (!match || match->rms_m > tolerance_m_) return;
    if (!best.empty() && pairs.size() > best.front().pairs.size()) best.clear();
    best.push_back(*match);
  }

  Places from_, to_;
  double tolerance_m_;
  std::set<Pairs> tried_;
};

}  // namespace

Result<PlaceMatch> matchPlaces(Places from, Places to, double tolerance_m) {
  if (std::max(from.size(), to.size()) > kMostPlacesToMatch)
    return failure(ErrorKind::unusable,
                   "more than " + std::to_string(kMostPlacesToMatch) + " positions: match them by name");
  Search search(from, to, tolerance_m);
  search.run();
  if (search.best.empty())
    return failure(ErrorKind::unusable, "no three non-collinear positions have matching distances");
  if (search.best.size() > 1)
    return failure(ErrorKind::unusable,
                   "the arrangement is symmetric: " + std::to_string(search.best.size()) + " assignments of " +
                       std::to_string(search.best.front().pairs.size()) +
                       " positions fit equally well; add a target that breaks the symmetry, or match by name");
  return search.best.front();
}

}  // namespace standpoint
