# SPDX-License-Identifier: GPL-3.0-or-later
"""The verbs as functions, from the table that command line, job files and the editor's forms use."""
import inspect
import json
import keyword
import operator
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Callable, Literal, Union  # noqa: F401  Literal is of annotations

import numpy.typing as npt

from . import _native
from ._answers import Answer, answer_of, warn_of_loss
from ._errors import UsageError
from ._progress import Progress, watching  # noqa: F401
from ._project import ProjectBase

#: of the verbs, as C++ has it
TABLE: list[dict[str, Any]] = json.loads(_native.verb_table())

# What a keyword takes, by the names that annotations and the stub have.
Words = Union[str, Sequence[str]]  # of several, what commas separate on the command line
Text = Union[str, "os.PathLike[str]"]
Texts = Union[Text, Sequence[Text]]
Place = Union[Sequence[float], npt.NDArray[Any]]
Settings = Union[Mapping[str, object], Sequence[str]]

_KINDS = {  # of an option: its type, and what its help says
    "text": ("Words", "str or list of str"),
    "number": ("float", "float"),
    "integer": ("int", "int"),
    "flag": ("bool", "bool"),
    "path": ("Text", "path"),
    "triple": ("Place", "numbers"),
    "pairs": ("Settings", "dict or list of str"),
    "list": ("Texts", "str, path or list of them"),
}


def spelled(name: str) -> str:
    """As Python can spell it: "max-deviation" is max_deviation, "in" is in_."""
    name = name.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def takes_project(verb: dict[str, Any]) -> bool:
    return verb["scope"] in ("changes", "reads")


def _is_switch(option: dict[str, Any]) -> bool:
    return set(option["choices"]) == {"on", "off"}


def _type_of(option: dict[str, Any]) -> str:
    if option["kind"] != "choice":
        return _KINDS[option["kind"]][0]
    return f"Literal[{', '.join(json.dumps(c) for c in option['choices'])}]{' | bool' if _is_switch(option) else ''}"


def _kind_of(option: dict[str, Any]) -> str:
    """For its help."""
    if option["kind"] != "choice":
        return _KINDS[option["kind"]][1]
    return "bool" if _is_switch(option) else "str"


def default_of(option: dict[str, Any]) -> Any:
    return False if option["kind"] == "flag" else option["default"]


def parameters_of(verb: dict[str, Any]) -> list[inspect.Parameter]:
    """Of its function: the project, what has its place, and keywords."""
    by_place, by_name = inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY
    placed: list[inspect.Parameter] = []
    named: list[inspect.Parameter] = []
    if takes_project(verb):
        placed.append(inspect.Parameter("project", by_place, annotation="ProjectBase | Text"))
    for option in verb["parameters"]:
        default = inspect.Parameter.empty if option["required"] else default_of(option)
        kind = _type_of(option)
        if default is None:
            kind += " | None"
        # After what may be left out, nothing can be required by its place.
        by_its_place = option["positional"] and not (option["required"] and placed and
                                                     placed[-1].default is not inspect.Parameter.empty)
        (placed if by_its_place else named).append(
            inspect.Parameter(spelled(option["name"]), by_place if by_its_place else by_name, default=default,
                              annotation=kind))
    named.append(inspect.Parameter("allow_loss", by_name, default=False, annotation="bool"))
    named.append(inspect.Parameter("progress", by_name, default=None, annotation="Progress"))
    return placed + named


def help_of(verb: dict[str, Any], method: bool = False) -> str:
    lines = [verb["summary"] + ".", "", "Parameters", "----------"]
    if takes_project(verb) and not method:
        lines += ["project : Project or path", "    the project, or its folder"]
    for option in verb["parameters"]:
        default = default_of(option)
        more = [] if option["kind"] == "flag" else [option["domain"]]
        if not option["required"] and option["kind"] != "flag" and default is not None:
            more.append(f"default {default}")
        lines += [f"{spelled(option['name'])} : {_kind_of(option)}{'' if option['required'] else ', optional'}",
                  f"    {option['help']}" + (f" ({'; '.join(more)})" if more else "")]
    lines += ["allow_loss : bool, optional", "    do not warn of data that was lost",
              "progress : callable or bool, optional",
              "    called with the fraction done and the name of the stage, ten times a second at most; True draws a",
              "    bar, False none; a notebook has one unless it is False",
              "", "Returns", "-------", "Answer", "    a dict with " + ", ".join([*verb["answer"], "issues", "seconds"])]
    return "\n".join(lines) + "\n"


def _listed(value: Any) -> list[str]:
    return [os.fspath(value)] if isinstance(value, (str, os.PathLike)) else [os.fspath(v) for v in value]


def _word(value: object) -> str:
    return {True: "on", False: "off"}[value] if isinstance(value, bool) else str(value)


_PLAIN: dict[str, Callable[[Any], Any]] = {
    "text": lambda value: value if isinstance(value, str) else ",".join(value),
    "number": float,
    "integer": operator.index,
    "flag": bool,
    "choice": _word,
    "path": os.fspath,
    "triple": lambda value: [float(v) for v in value],
    "pairs": lambda value: [f"{k}={_word(v)}" for k, v in value.items()] if isinstance(value, Mapping)
    else _listed(value),
    "list": _listed,
}


def _options_of(verb: dict[str, Any], said: Mapping[str, Any]) -> dict[str, Any]:
    """As a job file has them."""
    options = {}
    for option in verb["parameters"]:
        value = said.get(spelled(option["name"]))
        if value is None:
            continue
        try:
            options[option["name"]] = _PLAIN[option["kind"]](value)
        except (TypeError, ValueError) as error:
            raise UsageError(f"must be {option['domain']}, not {value!r}", spelled(option["name"])) from error
    return options


def _function_of(verb: dict[str, Any], module: str, owner: str = "") -> Callable[..., Answer]:
    name = spelled(verb["name"])
    parameters = parameters_of(verb)
    if owner:
        parameters[0] = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    signature = inspect.Signature(parameters, return_annotation="Answer")

    def function(*values: Any, **named: Any) -> Answer:
        try:
            bound = signature.bind(*values, **named)
        except TypeError as error:
            raise TypeError(f"{name}() {error}") from None
        said = bound.arguments
        options = _options_of(verb, said)
        project = said.get("self" if owner else "project") if takes_project(verb) else None
        kept = project._open if isinstance(project, ProjectBase) else None
        if project is not None and kept is None:
            options["project"] = os.fspath(project)
        try:
            text = json.dumps(options, allow_nan=False)
        except ValueError:
            raise UsageError("numbers must be finite", name) from None
        with watching(said.get("progress")) as watch:
            answer = answer_of(*_native.run(verb["name"], text, watch, kept))
        if not said.get("allow_loss", False):
            warn_of_loss(answer.issues, 2)
        return answer

    function.__name__ = name
    function.__qualname__ = f"{owner}.{name}" if owner else name
    function.__module__ = module
    function.__doc__ = help_of(verb, bool(owner))
    function.__signature__ = signature  # type: ignore[attr-defined]
    function.__annotations__ = {p.name: p.annotation for p in parameters if p.name != "self"} | {"return": "Answer"}
    return function


def functions(module: str) -> Iterator[Callable[..., Answer]]:
    for verb in TABLE:
        yield _function_of(verb, module)


def methods(module: str, owner: str) -> Iterator[Callable[..., Answer]]:
    for verb in TABLE:
        if takes_project(verb):
            yield _function_of(verb, module, owner)
