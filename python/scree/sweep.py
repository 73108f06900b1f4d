"""Sweeps: many runs of one case, their means and intervals."""
from __future__ import annotations

import ctypes
import os
import tempfile
from ctypes import byref, c_void_p, create_string_buffer
from pathlib import Path
from typing import Any, Mapping, Optional

from ._library import (MESSAGE, PROGRESS, Folder, Interruption, SweepOptions, SweepReadOptions, call, check_problems,
                       encode, find_program, lib, overrides, text)
from .run import Run, Series


def builtin_sweeps() -> "dict[str, str]":
    """The sweeps that repeat published experiments, and what they are."""
    return {text(lib.scree_sweep_builtin_name(k)): text(lib.scree_sweep_builtin_meaning(k))
            for k in range(lib.scree_sweep_builtin_count())}


class SweepResults:
    """The folder of a sweep."""

    def __init__(self, folder: Folder):
        self.folder = Path(folder)

    @property
    def members(self) -> Series:
        """members.csv: one row a member: parameters, seed, status, wall time, measures. `.frame()` for pandas."""
        return Series(self.folder / "members.csv")

    @property
    def table(self) -> Series:
        """table.csv: one row a point: of each measure mean, deviation, interval, number of values."""
        return Series(self.folder / "table.csv")

    @property
    def curves(self) -> "dict[str, Series]":
        """Averaged curves by their names, "Y-over-X"."""
        return {path.stem: Series(path) for path in sorted((self.folder / "curves").glob("*.csv"))}

    @property
    def runs(self) -> "list[Run]":
        """The runs that are finished, in the order of members."""
        return [Run(path.parent) for path in sorted((self.folder / "members").glob("*/summary.json"))]


class Sweep:
    """A sweep: a file, a text in the language of docs/sweeps.md, or the name of a built-in one; checked at once, with
    the case of every point (CaseError).

    set           keys that all members get, after everything else
    quick         as `quick: yes` in the file
    realisations  0: as the file says
    """

    def __init__(self, source: Folder, *, set: Optional[Mapping[str, Any]] = None, quick: bool = False,
                 realisations: int = 0):
        self._handle: Optional[int] = None
        texts, count = overrides(dict(set or {}))
        options = SweepReadOptions(texts, count, quick, realisations)
        if isinstance(source, str) and "\n" in source and not os.path.exists(source):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "sweep.yaml"
                path.write_text(source, encoding="utf-8")
                self._read(path, options)
        else:
            self._read(source, options)

    def _read(self, source: Folder, options: SweepReadOptions) -> None:
        handle, problems = c_void_p(), c_void_p()
        check_problems(lib.scree_sweep_read(encode(source), byref(options), byref(handle), byref(problems)), problems)
        self._handle = handle.value

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            lib.scree_sweep_free(self._handle)

    def __len__(self) -> int:
        """Number of members."""
        return lib.scree_sweep_member_count(self._handle)

    @property
    def members(self) -> "list[str]":
        """Folders of the members, below members/."""
        return [text(lib.scree_sweep_member_folder(self._handle, k)) for k in range(len(self))]

    @property
    def commands(self) -> "list[str]":
        """What each member sets, as a command line."""
        buffer, found = create_string_buffer(8192), []
        for k in range(len(self)):
            lib.scree_sweep_member_command(self._handle, k, buffer, len(buffer))
            found.append(text(buffer.value))
        return found

    @property
    def lacks(self) -> Optional[str]:
        """The program that it needs and that is not installed."""
        return text(lib.scree_sweep_lacks(self._handle)) or None

    def run(self, output: Folder, *, jobs: int = 0, threads: int = 0, retry: bool = False, force: bool = False,
            figures: bool = False, program: Optional[str] = None, message: Any = None) -> SweepResults:
        """Runs what is missing, each member as a process of its own, then makes tables, curves and, with `figures`,
        figures. Ctrl-C stops members after a checkpoint. Raises GuardError when members failed (the others are there:
        `SweepResults(output)`)."""
        self._do(lib.scree_sweep_run, output, jobs, threads, retry, force, figures, program, message)
        return SweepResults(output)

    def collect(self, output: Folder, *, figures: bool = False, message: Any = None) -> SweepResults:
        """Tables, curves and figures from the members that are there."""
        self._do(lib.scree_sweep_collect, output, 0, 0, False, False, figures, None, message)
        return SweepResults(output)

    def _do(self, function: Any, output: Folder, jobs: int, threads: int, retry: bool, force: bool, figures: bool,
            program: Optional[str], message: Any) -> None:
        tell = MESSAGE(lambda user, level, line: message(level, text(line))) if message else MESSAGE()
        with Interruption() as interruption:
            options = SweepOptions(program=encode(program or find_program()), output=encode(output), jobs=jobs,
                                   threads=threads, retry=retry, force=force, figures=figures,
                                   stop=ctypes.pointer(interruption.stop), progress=PROGRESS(), message=tell)
            call(function, self._handle, byref(options))
