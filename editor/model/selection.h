// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace standpoint {

// The chosen products, ascending, as a value that is replaced when it changes: the viewport compares pointers.
class Selection {
 public:
  const std::vector<std::uint32_t>& products() const { return *products_; }
  const std::shared_ptr<const std::vector<std::uint32_t>>& shared() const { return products_; }
  bool empty() const { return products_->empty(); }
  bool contains(std::uint32_t product) const;
  // The one that was chosen last; only when not empty.
  std::uint32_t primary() const { return primary_; }

  void clear();
  void set(std::uint32_t product);
  void set(std::vector<std::uint32_t> products);
  void toggle(std::uint32_t product);

 private:
  std::shared_ptr<const std::vector<std::uint32_t>> products_ = std::make_shared<const std::vector<std::uint32_t>>();
  std::uint32_t primary_ = 0;
};

}  // namespace standpoint
