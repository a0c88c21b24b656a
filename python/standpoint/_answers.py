# SPDX-License-Identifier: GPL-3.0-or-later
"""What a verb gives back."""
import json
import warnings
from typing import Any, Iterable, NamedTuple, Optional


class Issue(NamedTuple):
    """A line of a report: what was lost, guessed or is worth knowing."""

    severity: str  #: "note", "warning" or "loss"
    source: str  #: where: "#1234", "/meshes/3", "line 7"
    message: str


class LossWarning(UserWarning):
    """Something of the input is not in the result; `allow_loss=True` says that this is known."""


class Answer(dict[str, Any]):
    """What `--json` prints, as a dict, with what is told beside it."""

    def __init__(self, values: dict[str, Any], description: str, text: str, issues: list[Issue]) -> None:
        super().__init__(values)
        #: one line on what was done, as the editor's history has it
        self.description = description
        #: what the command line prints for people, where figures alone do not say enough
        self.text = text
        #: the report
        self.issues = issues

    @property
    def losses(self) -> list[Issue]:
        return [issue for issue in self.issues if issue.severity == "loss"]


def issues_of(rows: Iterable[tuple[str, bytes, bytes]]) -> list[Issue]:
    return [Issue(severity, source.decode(errors="replace"), message.decode(errors="replace"))
            for severity, source, message in rows]


def answer_of(answer: bytes, description: bytes, text: bytes, issues: Iterable[tuple[str, bytes, bytes]]) -> Answer:
    return Answer(json.loads(answer), description.decode(errors="replace"), text.decode(errors="replace"),
                  issues_of(issues))


def warn_of_loss(issues: list[Issue], stack: int, done: Optional[str] = None) -> None:
    """A LossWarning, whose place is `stack` calls above, where something was lost."""
    losses = [issue for issue in issues if issue.severity == "loss"]
    if losses:
        more = f" (and {len(losses) - 1} more in .losses)" if len(losses) > 1 else ""
        first = ": ".join(part for part in (done, losses[0].source, losses[0].message) if part)
        warnings.warn(first + more, LossWarning, stacklevel=stack + 1)
