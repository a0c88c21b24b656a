// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"

namespace standpoint::bench {

// A closed, organic surface as a scanner of objects gives it, about 2 m across: bumps, folds and relief of every size
// down to a few edge lengths, and noise. 20 * frequency² triangles of about equal size.
Mesh scanLike(int frequency = 231);  // 1 067 220 triangles

// A façade of 800 bays of 3 m: open relief panels, rusticated blocks, fluted columns, dentils; on 529 edges a fin
// stands on a panel, so that three faces meet. About 1.89 million triangles.
Mesh facade();

// A restaurant full of furniture, as an architect's program exports it: 9.4 million placed triangles of some 1500
// products, of which 3 % differ. Each piece is written out in its own place, turned, so that no two meshes share a
// byte.
Environment restaurant();

}  // namespace standpoint::bench
