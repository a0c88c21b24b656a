// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

std::uint64_t mixed(std::uint64_t x);  // a hash of one number (splitmix64's finisher)

using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
Cell cellAt(const Eigen::Vector3d& point, double cell_m);
std::uint64_t hashOf(const Cell& cell);

// The distinct cells that points fell into, in bounded memory: when there are too many, only those whose hash has so
// many leading zeros are kept, which is a fair sample of them (adaptive sampling, Flajolet 1990).
class Coverage {
 public:
  explicit Coverage(std::size_t max_cells = std::size_t{1} << 22) : max_cells_(max_cells) {}
  void add(std::uint64_t cell_hash);
  void settle();  // before the members below
  std::uint64_t cells() const { return static_cast<std::uint64_t>(hashes_.size()) << halvings_; }
  // The share of this one's cells that `other` has too.
  double sharedWith(const Coverage& other) const;

 private:
  void compact();
  bool sampled(std::uint64_t hash, unsigned halvings) const { return halvings == 0 || hash >> (64 - halvings) == 0; }
  std::size_t max_cells_;
  unsigned halvings_ = 0;
  std::uint64_t last_ = 0;             // neighbours in a scan mostly share a cell
  std::vector<std::uint64_t> hashes_;  // sorted and distinct after settle()
};

}  // namespace standpoint
