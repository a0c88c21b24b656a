# SPDX-License-Identifier: GPL-3.0-or-later
"""A project that stays in memory."""
import os
from typing import Any

import numpy.typing as npt

from . import _native
from ._meshes import Mesh
from ._progress import Progress, watching
from ._tables import table_of, texts_of

_COLUMNS = ("id", "global_id", "ifc_class", "name", "storey", "in_scene")


class ProjectBase:
    """A project on disk, whose document and ray scene stay in memory between the calls.

    Every verb that takes a project is a method: `house.scan(…)` is `standpoint.scan(house, …)`. Each change is written
    to the folder as the command line writes it; where another has changed it meanwhile, it is read again. Threads may
    share a project: its verbs wait for each other.
    """

    def __init__(self, folder: "str | os.PathLike[str]", *, progress: Progress = None) -> None:
        self._folder = os.path.abspath(os.fspath(folder))
        self._open = _native.OpenProject(self._folder)
        with watching(progress) as watch:
            self._open.products(watch)

    def __fspath__(self) -> str:
        return self._folder

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._folder!r})"

    @property
    def folder(self) -> str:
        return self._folder

    @property
    def products(self) -> npt.NDArray[Any]:
        """A structured array with id, global_id, ifc_class, name, storey, and whether it is in_scene."""
        return table_of(_COLUMNS, self._open.products(None))

    def mesh(self, *, progress: Progress = None) -> Mesh:
        """The triangles of what is scanned: the optimised model where there is one."""
        with watching(progress) as watch:
            arrays = self._open.mesh(watch)
        return Mesh(arrays["vertices"], arrays["faces"], arrays["product"], arrays["material"],
                    table_of(_COLUMNS, arrays["products"]), texts_of(arrays["materials"]))


class Project(ProjectBase):
    __doc__ = ProjectBase.__doc__


def add_verbs(project: type[ProjectBase]) -> None:
    """Gives the class a method for each verb that takes a project."""
    from ._verbs import methods

    for method in methods(project.__module__, project.__qualname__):
        setattr(project, method.__name__, method)
