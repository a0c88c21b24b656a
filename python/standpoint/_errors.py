# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes wrong, as exceptions."""


class Error(Exception):
    """A verb or a reader has refused. `message` says what is wrong and, where there is one, the remedy."""

    kind = "internal"

    def __init__(self, message: str, place: str = "") -> None:
        super().__init__(f"{place}: {message}" if place else message)
        self.message = message
        #: file and place, or the option: "house.ifc #1234", "recipe.json /seeds", "--budget"
        self.place = place

    def __reduce__(self) -> "tuple[type[Error], tuple[str, str]]":
        return type(self), (self.message, self.place)


class UsageError(Error, ValueError):
    """A wrong option or argument; exit code 2 of the command line."""

    kind = "usage"


class UnusableError(Error):
    """The input is not usable as it is; exit code 3."""

    kind = "unusable"


class FileSystemError(Error, OSError):
    """Cannot read, write or create, or the disk is full, or another has the project; exit code 4."""

    kind = "file_system"

    def __str__(self) -> str:
        return str(self.args[0])


class Cancelled(Error):
    """Somebody asked for it; exit code 130. Ctrl-C raises KeyboardInterrupt instead."""

    kind = "cancelled"


class InternalError(Error):
    """A defect of Standpoint or of a library."""

    kind = "internal"


_KINDS = {c.kind: c for c in (UsageError, UnusableError, FileSystemError, Cancelled, InternalError)}


def error_of(kind: str, message: bytes, place: bytes) -> Error:
    return _KINDS[kind](message.decode(errors="replace"), place.decode(errors="replace"))
