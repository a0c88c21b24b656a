# SPDX-License-Identifier: GPL-3.0-or-later
"""Point clouds as arrays."""
import enum
import os
from functools import cached_property
from typing import Any, Iterator, Optional, Union, overload
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from . import _native
from ._answers import Issue, issues_of, warn_of_loss
from ._progress import Progress, watching
from ._tables import table_of, texts_of

#: How a point came about: bits of the column "flags". None set: one surface, seen directly.
PointFlag = enum.IntFlag("PointFlag", _native.point_flags())  # type: ignore[misc]


class Scan:
    """The points of one scan: `scan["intensity"]` is a column, `scan.columns` has all that there are.

    A column views memory of C++ and is read-only; it stays as long as any array of it. Columns, by name:
    x_m, y_m, z_m (in the scanner's own frame), intensity, row, column, red, green, blue, product and material (indices
    into `products` and `materials`), time_s (since acquisition_start_gps_s), channel, return_number, return_count; of
    a simulated scan true_x_m, true_y_m, true_z_m (scanner's frame), true_range_m, incidence_rad, received_db, flags
    (PointFlag).
    """

    def __init__(self, scan: "_native.Scan") -> None:
        self._scan = scan
        header = scan.header()
        text = {key: value.decode(errors="replace") for key, value in header.items() if isinstance(value, bytes)}
        self.name: str = text["name"]
        self.guid: str = text["guid"]
        self.description: str = text["description"]
        self.sensor_vendor: str = text["sensor_vendor"]
        self.sensor_model: str = text["sensor_model"]
        self.sensor_serial: str = text["sensor_serial"]
        #: the coordinate reference system, as OGC WKT or "EPSG:n"; or empty
        self.coordinate_metadata: str = text["coordinate_metadata"]
        #: of the scan grid; 0 where there is none
        self.grid: tuple[int, int] = (header["rows"], header["columns"])
        #: the smallest and the largest that the sensor can give
        self.intensity_limits: tuple[float, float] = (header["intensity_min"], header["intensity_max"])
        #: seconds since 1980-01-06
        self.acquisition_start_gps_s: float = header["acquisition_start_gps_s"]
        self.acquisition_seconds: float = header["acquisition_seconds"]
        #: 4 x 4: takes a point of the scanner's frame into the file's, as its crew believed that it stood
        self.file_from_scanner: npt.NDArray[np.float64] = header["file_from_scanner"]
        #: 4 x 4: where it truly stood
        self.true_file_from_scanner: npt.NDArray[np.float64] = header["true_file_from_scanner"]
        #: what the column "material" counts
        self.materials: list[str] = texts_of(header["materials"])
        self.columns: dict[str, npt.NDArray[Any]] = scan.columns()

    def __len__(self) -> int:
        return len(self._scan)

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        if name not in self.columns:
            raise KeyError(f"the scan has no column {name!r}; it has {', '.join(self.columns)}")
        return self.columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __repr__(self) -> str:
        return f"<Scan {self.name!r}: {len(self):,} points; {', '.join(self.columns)}>"

    @cached_property
    def xyz(self) -> npt.NDArray[np.float64]:
        """(n, 3): the points in the frame of the file, metres; computed once."""
        return self._scan.places()

    @cached_property
    def true_xyz(self) -> Optional[npt.NDArray[np.float64]]:
        """(n, 3): where on a surface each point's light came from, in the frame of the file; None without truth."""
        return self._scan.true_places()

    @cached_property
    def products(self) -> npt.NDArray[Any]:
        """What the column "product" counts: a structured array with id, global_id, ifc_class, name."""
        return table_of(("id", "global_id", "ifc_class", "name"), self._scan.products())


class Cloud(Sequence[Scan]):
    """The scans of a file, in its order."""

    def __init__(self, file: str, scans: list[Scan], issues: list[Issue]) -> None:
        self.file = file
        self._scans = scans
        #: what the reader lost or guessed
        self.issues = issues

    @overload
    def __getitem__(self, index: int) -> Scan: ...

    @overload
    def __getitem__(self, index: slice) -> list[Scan]: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Scan, list[Scan]]:
        return self._scans[index]

    def __len__(self) -> int:
        return len(self._scans)

    def __repr__(self) -> str:
        return f"<Cloud {self.file!r}: {len(self)} scans, {sum(map(len, self)):,} points>"

    @property
    def losses(self) -> list[Issue]:
        return [issue for issue in self.issues if issue.severity == "loss"]


def read_cloud(file: "str | os.PathLike[str]", *, allow_loss: bool = False, progress: Progress = None) -> Cloud:
    """Reads all points of a cloud of any format that Standpoint reads: E57, LAS, PTX, PLY, PCD, PTS, XYZ, CSV.

    It needs 20 to 80 bytes a point. What the file has and Standpoint does not read is in `issues`, and a LossWarning
    says so unless `allow_loss`. `progress` is as of the verbs.
    """
    path = os.fspath(file)
    with watching(progress) as watch:
        scans, rows = _native.read_cloud(path, watch)
    issues = issues_of(rows)
    if not allow_loss:
        warn_of_loss(issues, 2, path)
    return Cloud(path, [Scan(scan) for scan in scans], issues)
