# SPDX-License-Identifier: GPL-3.0-or-later
"""Standpoint from Python: every verb of its command line as a function, and its points and meshes as NumPy arrays.

    import standpoint as sp

    sp.import_("house.ifc", output="house")
    house = sp.Project("house")
    house.materials()
    house.station(add="S1", on=(4.3, 1.6))
    house.scan(instrument="leica-rtc360", set={"resolution": "12mm"}, truth=True, output="house.e57")
    scan = sp.read_cloud("house.e57")[0]
    scan.xyz, scan["intensity"], scan.products["ifc_class"][scan["product"]]

The functions, their keywords and their help are made from the table of verbs when this package is imported: a verb with
a dash or a word of Python has an underscore (`import_`, `max_deviation`, `in_`). They give back an Answer, raise an
Error with its place, and can be interrupted by Ctrl-C.
"""
from pathlib import Path

from . import _native

for _folder in Path(__file__).absolute().parents:  # share/standpoint of the tree that the package is installed in
    if (_folder / "share/standpoint/materials/schema.json").is_file():
        _native.use_data(_folder / "share/standpoint")
        break

from . import _project, _verbs  # noqa: E402  the data comes first
from ._answers import Answer, Issue, LossWarning  # noqa: E402
from ._clouds import Cloud, PointFlag, Scan, read_cloud  # noqa: E402
from ._errors import Cancelled, Error, FileSystemError, InternalError, UnusableError, UsageError  # noqa: E402
from ._meshes import Mesh  # noqa: E402
from ._project import Project  # noqa: E402

__version__ = _native.version()
__all__ = ["Answer", "Cancelled", "Cloud", "Error", "FileSystemError", "InternalError", "Issue", "LossWarning", "Mesh",
           "PointFlag", "Project", "Scan", "UnusableError", "UsageError", "read_cloud", "samples_folder"]


def samples_folder() -> Path:
    """Where the sample models are: house.ifc, street.ifc, corridor.ifc, turbine.ifc."""
    return Path(_native.samples_folder())


for _function in _verbs.functions(__name__):
    globals()[_function.__name__] = _function
    __all__.append(_function.__name__)
_project.add_verbs(Project)
