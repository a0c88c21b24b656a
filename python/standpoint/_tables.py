# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of texts as structured arrays, so that a column of indices looks its labels up in one step."""
from typing import Any, Sequence

import numpy as np


def texts_of(rows: Sequence[bytes]) -> list[str]:
    return [text.decode(errors="replace") for text in rows]


def table_of(names: Sequence[str], rows: Sequence[tuple[Any, ...]]) -> "np.ndarray[Any, np.dtype[Any]]":
    """A structured array: texts as wide as the widest, truth values as they are."""
    plain = [tuple(v.decode(errors="replace") if isinstance(v, bytes) else v for v in row) for row in rows]
    kinds = []
    for i, name in enumerate(names):
        if plain and isinstance(plain[0][i], bool):
            kinds.append((name, "?"))
        else:
            kinds.append((name, f"U{max([1, *(len(row[i]) for row in plain)])}"))
    table = np.array(plain, dtype=kinds)
    table.setflags(write=False)
    return table
