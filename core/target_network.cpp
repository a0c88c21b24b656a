// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/target_network.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/decompositions.h"
#include "core/rigid_fit.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using Index = Eigen::Index;

constexpr int kMostIterations = 30;
constexpr double kSettled = 1e-10;  // metres and radians

Eigen::Matrix3d cross(const Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

struct Chain {
  std::vector<std::optional<Pose>> pose;
  std::vector<std::optional<Vector3d>> target;
};

void spread(const TargetNetwork& network, std::size_t station, Chain& chain) {
  for (const auto& s : network.sightings)
    if (s.station == station && !chain.target[s.target]) chain.target[s.target] = *chain.pose[station] * s.place_m;
}

Result<RigidFit> tie(const TargetNetwork& network, const Chain& chain, std::size_t station, std::size_t& shared) {
  std::vector<Vector3d> from, to;
  for (const auto& s : network.sightings)
    if (s.station == station && chain.target[s.target])
      from.push_back(s.place_m), to.push_back(*chain.target[s.target]);
  shared = from.size();
  return fitRigid(from, to);
}

// The station that shares most targets with those that are placed comes next.
Result<Chain> chained(const TargetNetwork& network, NetworkProblem* problem) {
  Chain chain{std::vector<std::optional<Pose>>(network.stations),
              std::vector<std::optional<Vector3d>>(network.targets)};
  for (const auto& k : network.known) chain.target[k.target] = k.place_m;
  std::size_t placed = 0;
  if (network.held) {
    chain.pose[network.held->first] = network.held->second;
    spread(network, network.held->first, chain);
    ++placed;
  }
  for (; placed < network.stations; ++placed) {
    std::optional<std::pair<std::size_t, Pose>> best;
    std::size_t most = 0;
    NetworkProblem worst;
    for (std::size_t i = 0; i < network.stations; ++i) {
      if (chain.pose[i]) continue;
      std::size_t shared = 0;
      const auto fit = tie(network, chain, i, shared);
      if (fit && shared > most) best = {i, fit->to_from}, most = shared;
      if (!fit && (!worst.station || shared > worst.shared)) worst = {i, shared, shared >= 3};
    }
    if (!best) {
      if (problem != nullptr) *problem = worst;
      return failure(ErrorKind::unusable,
                     "station " + std::to_string(worst.station.value_or(0) + 1) + " shares " +
                         std::to_string(worst.shared) + " targets with the others" +
                         (worst.on_one_line ? ", which are collinear" : ", but three are required"));
    }
    chain.pose[best->first] = best->second;
    spread(network, best->first, chain);
  }
  return chain;
}

// Where each unknown stands in the normal equations; -1: it is none.
struct Unknowns {
  std::vector<Index> station, target;
  Index count = 0;
};

Unknowns unknownsOf(const TargetNetwork& network, const Chain& chain) {
  Unknowns u;
  for (std::size_t i = 0; i < network.stations; ++i) {
    const bool held = network.held && network.held->first == i;
    u.station.push_back(held ? -1 : u.count);
    if (!held) u.count += 6;
  }
  for (std::size_t i = 0; i < network.targets; ++i) {
    u.target.push_back(chain.target[i] ? u.count : -1);
    if (chain.target[i]) u.count += 3;
  }
  return u;
}

struct NetworkEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  double squares = 0;  // weighted
  int observations = 0;
};

NetworkEquations equationsOf(const TargetNetwork& network, const Chain& now, const Unknowns& u) {
  NetworkEquations e{Eigen::MatrixXd::Zero(u.count, u.count), Eigen::VectorXd::Zero(u.count), 0, 0};
  for (const auto& s : network.sightings) {
    const double weight = 1 / (s.sigma_m * s.sigma_m);
    const Vector3d arm = now.pose[s.station]->rotation * s.place_m;
    const Vector3d off = arm + now.pose[s.station]->translation - *now.target[s.target];
    e.squares += weight * off.squaredNorm(), e.observations += 3;
    const Index t = u.target[s.target], p = u.station[s.station];
    e.normal.block<3, 3>(t, t) += weight * Eigen::Matrix3d::Identity();
    e.right.segment<3>(t) += weight * off;
    if (p < 0) continue;
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << Eigen::Matrix3d::Identity(), -cross(arm);
    e.normal.block<6, 6>(p, p) += weight * by_pose.transpose() * by_pose;
    e.normal.block<6, 3>(p, t) -= weight * by_pose.transpose();
    e.normal.block<3, 6>(t, p) -= weight * by_pose;
    e.right.segment<6>(p) -= weight * by_pose.transpose() * off;
  }
  for (const auto& k : network.known) {
    const Index t = u.target[k.target];
    const double weight = 1 / (k.sigma_m * k.sigma_m);
    const Vector3d off = *now.target[k.target] - k.place_m;
    e.squares += weight * off.squaredNorm(), e.observations += 3;
    e.normal.block<3, 3>(t, t) += weight * Eigen::Matrix3d::Identity();
    e.right.segment<3>(t) -= weight * off;
  }
  return e;
}

void move(Chain& chain, const Unknowns& u, const Eigen::VectorXd& step) {
  for (std::size_t i = 0; i < chain.pose.size(); ++i) {
    if (u.station[i] < 0) continue;
    Pose& pose = *chain.pose[i];
    pose.translation += step.segment<3>(u.station[i]);
    const Vector3d turn = step.segment<3>(u.station[i] + 3);
    if (const double angle = turn.norm(); angle > 0)
      pose.rotation = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * pose.rotation).normalized();
    if (pose.rotation.w() < 0) pose.rotation.coeffs() *= -1;
  }
  for (std::size_t i = 0; i < chain.target.size(); ++i)
    if (u.target[i] >= 0) *chain.target[i] += step.segment<3>(u.target[i]);
}

bool sound(const TargetNetwork& n) {
  const auto in = [&](std::size_t target, const Vector3d& p, double sigma) {
    return target < n.targets && p.allFinite() && sigma > 0;
  };
  return (!n.held || n.held->first < n.stations) &&
         std::all_of(n.sightings.begin(), n.sightings.end(),
                     [&](const Sighting& s) { return s.station < n.stations && in(s.target, s.place_m, s.sigma_m); }) &&
         std::all_of(n.known.begin(), n.known.end(),
                     [&](const KnownPlace& k) { return in(k.target, k.place_m, k.sigma_m); });
}

}  // namespace

Result<NetworkFit> fitNetwork(const TargetNetwork& network, NetworkProblem* problem) {
  if (!sound(network))
    return failure(ErrorKind::usage, "a sighting is not finite, has no σ, or refers to an unknown target");
  if (!network.held && network.known.size() < 3)
    return failure(ErrorKind::usage, "the network is not fixed: hold one station, or provide three known positions");
  TRY_ASSIGN(auto chain, chained(network, problem));
  const Unknowns unknowns = unknownsOf(network, chain);
  NetworkFit fit;
  NetworkEquations e = equationsOf(network, chain, unknowns);
  while (fit.iterations++ < kMostIterations) {
    const Eigen::VectorXd step = solveNormal(e.normal, e.right);
    if (!step.allFinite()) return failure(ErrorKind::unusable, "the targets do not determine the station poses");
    move(chain, unknowns, step);
    e = equationsOf(network, chain, unknowns);
    if (step.cwiseAbs().maxCoeff() < kSettled) break;
  }
  fit.redundancy = e.observations - static_cast<int>(unknowns.count);
  fit.sigma_factor = fit.redundancy > 0 ? std::sqrt(e.squares / fit.redundancy) : 0;
  const Eigen::VectorXd sigma = fit.sigma_factor * inverseOfNormal(e.normal).diagonal().cwiseMax(0).cwiseSqrt();
  for (std::size_t i = 0; i < network.stations; ++i) {
    const Index at = unknowns.station[i];
    fit.pose.push_back(*chain.pose[i]);
    fit.sigma_shift_m.push_back(at < 0 ? Vector3d::Zero() : Vector3d(sigma.segment<3>(at)));
    fit.sigma_turn_rad.push_back(at < 0 ? Vector3d::Zero() : Vector3d(sigma.segment<3>(at + 3)));
  }
  fit.target = chain.target;
  for (const auto& s : network.sightings)
    fit.residual_m.push_back(fit.pose[s.station] * s.place_m - *fit.target[s.target]);
  return fit;
}

std::vector<NetworkLink> linksOf(const TargetNetwork& network, const NetworkFit& fit) {
  std::vector<NetworkLink> links;
  for (std::size_t a = 0; a < network.stations; ++a)
    for (std::size_t b = a + 1; b < network.stations; ++b) {
      NetworkLink link{a, b, {}, 0, 0, {}};
      for (const auto& from : network.sightings)
        for (const auto& to : network.sightings)
          if (from.station == a && to.station == b && from.target == to.target)
            link.rows.push_back({from.target, fit.pose[a] * from.place_m - fit.pose[b] * to.place_m});
      if (link.rows.empty()) continue;
      const auto n = static_cast<double>(link.rows.size());
      for (const auto& row : link.rows)
        link.rms_m += row.difference_m.squaredNorm() / n, link.mean_m += row.difference_m.norm() / n;
      link.rms_m = std::sqrt(link.rms_m);
      if (link.rows.size() > 2) link.unbiased_m = link.rms_m * std::sqrt(3 * n / (3 * n - 6));
      links.push_back(std::move(link));
    }
  return links;
}

}  // namespace standpoint
