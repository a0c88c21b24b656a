# SPDX-License-Identifier: GPL-3.0-or-later
"""The model of a project as arrays."""
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True, repr=False)
class Mesh:
    """The triangles of what is scanned, each product where it stands. The arrays view memory of C++, read-only."""

    vertices: npt.NDArray[np.float64]  #: (n, 3), in the model's file frame, metres
    faces: npt.NDArray[np.uint32]  #: (m, 3) vertices, counter-clockwise seen from outside
    product: npt.NDArray[np.uint32]  #: (m,) rows of `products`
    material: npt.NDArray[np.int32]  #: (m,) places in `materials`; -1: none is assigned
    products: npt.NDArray[Any]  #: structured: as Project.products
    materials: list[str]  #: ids

    def __repr__(self) -> str:
        return f"<Mesh: {len(self.vertices):,} vertices, {len(self.faces):,} faces, {len(self.materials)} materials>"
