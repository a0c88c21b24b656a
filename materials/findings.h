// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "materials/materials.h"

namespace standpoint {

// Gathers findings that have the same kind and subject into one: the first product stands for all, the rest are
// counted.
class FindingCollector {
 public:
  // `what` reads on with the product: "no rule fits surface 'X' of" … "IfcWall 'W1'", then `then`.
  struct Cause {
    std::string kind;
    bool warning = false;
    std::string subject;  // tells findings of one kind apart, in every run alike
    std::string what, then;
    // The same with ids for the labels of materials: what an acceptance is kept by. Empty: as `what` and `then`.
    std::string what_by_id, then_by_id;
    std::string why;
    std::vector<Remedy> remedies;
  };
  struct Extent {
    Cause cause;
    std::string source;
    std::vector<std::uint32_t> products;
    double area_m2 = 0;
  };
  // The finding of this kind and subject, which stays where it is; `add` then tells of each surface that it is about.
  Extent& of(Cause cause);
  static void add(Extent& extent, std::uint32_t product, double area_m2);
  // One that no product stands for: it is about what the user said.
  void addAbout(Cause cause, std::string source);
  std::vector<MaterialFinding> findings(const Environment& environment,
                                        const std::vector<AcceptedFinding>& accepted) const;

 private:
  std::map<std::pair<std::string, std::string>, Extent> extents_;  // by kind and subject
};

// Those that nobody accepted first; of them warnings first, then by falling area.
void putInOrder(std::vector<MaterialFinding>& findings);

}  // namespace standpoint
