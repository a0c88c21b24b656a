// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace standpoint {

struct Model;

// Keeps the view as it is, on foot or not, under a name that is free.
void addBookmark(Model& model);
// The view of that index; the one before comes back with Alt+Left.
void goToBookmark(Model& model, std::size_t bookmark);

}  // namespace standpoint
