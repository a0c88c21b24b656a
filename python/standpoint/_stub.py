# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m standpoint._stub FILE: the types of the package for editors and type checkers, from the table of verbs."""
import inspect
import sys
import textwrap
from typing import Any

import standpoint
from standpoint import _verbs

_HEAD = '''\
# Written by python3 -m standpoint._stub from the table of verbs.
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ._answers import Answer as Answer, Issue as Issue, LossWarning as LossWarning
from ._clouds import Cloud as Cloud, PointFlag as PointFlag, Scan as Scan, read_cloud as read_cloud
from ._errors import (
    Cancelled as Cancelled,
    Error as Error,
    FileSystemError as FileSystemError,
    InternalError as InternalError,
    UnusableError as UnusableError,
    UsageError as UsageError,
)
from ._meshes import Mesh as Mesh
from ._progress import Progress
from ._project import ProjectBase

Words = str | Sequence[str]
Text = str | os.PathLike[str]
Texts = Text | Sequence[Text]
Place = Sequence[float] | npt.NDArray[np.floating[Any]]
Settings = Mapping[str, object] | Sequence[str]

__version__: str

def samples_folder() -> Path: ...
'''


def _spelled(parameter: inspect.Parameter) -> str:
    left_out = "" if parameter.default is inspect.Parameter.empty else " = ..."
    return f"{parameter.name}: {parameter.annotation}{left_out}"


def _declaration(verb: dict[str, Any], method: bool) -> str:
    parameters = _verbs.parameters_of(verb)
    words = []
    for i, parameter in enumerate(parameters):
        if parameter.kind is inspect.Parameter.KEYWORD_ONLY and (
                i == 0 or parameters[i - 1].kind is not inspect.Parameter.KEYWORD_ONLY):
            words.append("*")
        words.append("self" if method and i == 0 else _spelled(parameter))
    text = f"def {_verbs.spelled(verb['name'])}(\n" + "".join(f"    {word},\n" for word in words) + ") -> Answer:\n"
    help_text = _verbs.help_of(verb, method).replace("\\", "\\\\").replace('"""', '\\"""')
    return text + textwrap.indent(f'"""{help_text}"""\n', "    ", lambda line: bool(line.strip()))


def stub() -> str:
    functions = [_declaration(verb, False) for verb in _verbs.TABLE]
    methods = [textwrap.indent(_declaration(verb, True), "    ", lambda line: bool(line.strip()))
               for verb in _verbs.TABLE if _verbs.takes_project(verb)]
    return "\n".join([_HEAD, *functions, "class Project(ProjectBase):", *methods])


if __name__ == "__main__":
    assert standpoint.__version__
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(stub())
