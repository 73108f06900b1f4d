"""Errors of the library as exceptions."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong. Empty texts and zeros mean "does not apply"."""

    status: int
    file: str  #: case file, or the file that input or output failed on
    line: int  #: from 1
    column: int  #: from 1
    key: str  #: path of the key, "stages.2.rate"
    value: str  #: what was given
    expected: str  #: type, unit, range, or the nearest valid name
    message: str  #: a sentence
    text: str  #: all of it: "file:line:column: key: message (accepted: ...)"


class ScreeError(Exception):
    """Something that the library says is wrong; `problems` has all of it, the attributes of the first one are those of
    the exception: status, file, line, column, key, value, expected, message."""

    def __init__(self, problems: Sequence[Problem]):
        super().__init__("\n".join(problem.text for problem in problems))
        self.problems = list(problems)
        first = self.problems[0]
        self.status, self.file, self.line, self.column = first.status, first.file, first.line, first.column
        self.key, self.value, self.expected, self.message = first.key, first.value, first.expected, first.message


class InputError(ScreeError, ValueError):
    """What was asked for is wrong (status 2)."""


class CaseError(InputError):
    """A case or a sweep is wrong: `problems` has every error that was found in it."""


class GuardError(ScreeError, RuntimeError):
    """A physics guard stopped the run (status 3)."""


class FileError(ScreeError):
    """Input or output failed, or memory ran out (status 4)."""


class Interrupted(ScreeError):
    """A run was stopped by a signal, after a checkpoint (status 130)."""


KINDS = {2: InputError, 3: GuardError, 4: FileError, 130: Interrupted}
