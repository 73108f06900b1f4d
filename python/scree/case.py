"""Cases: what is computed."""
from __future__ import annotations

import ctypes
import os
from ctypes import byref, c_char_p, c_size_t, c_void_p
from dataclasses import dataclass, fields
from typing import Any, Iterable, Mapping, Optional, Union

from ._library import (LINE, CaseSummaryStruct, Error, Folder, Interruption, MESSAGE, PROGRESS, RunOptions, call, check,
                       check_problems, encode, lib, text, to_text)

_libc = ctypes.CDLL(None)
_libc.open_memstream.restype = c_void_p
_libc.open_memstream.argtypes = [c_void_p, c_void_p]
_libc.fclose.argtypes = [c_void_p]
_libc.free.argtypes = [c_void_p]


def builtin_cases() -> "dict[str, str]":
    """Names of the built-in cases and what they are, as `scree list` has them."""
    return {text(lib.scree_template_name(k)): text(lib.scree_template_meaning(k))
            for k in range(lib.scree_template_count())}


@dataclass(frozen=True)
class CaseSummary:
    """What a case amounts to before it is run, as `scree check` has it; times in s, NaN where it is not known."""

    name: str
    particles: int
    step: float  #: s, the small one of a scheme that has two
    critical_step: float  #: s
    largest_step: int  #: in steps
    phi: float  #: quasistatic coefficient
    psi: float  #: size coefficient
    inertial_number: float
    mean_radius: float  #: m
    thickness: float  #: m
    reference_velocity: float  #: m/s
    steps: float  #: expected number of them
    seconds: float  #: s, processor time on one thread
    stepping: float
    output: float
    figures: float
    rate: float  #: particle-steps per second
    memory: float  #: bytes
    tabor: float  #: largest Tabor parameter of contacts of mean grains
    sleeps: bool  #: particles that are quiet may be left out of steps: the times are those with all of them awake


class CheckedCase:
    """The library's handle of a case that was checked; it lives as long as somebody uses it."""

    def __init__(self, handle: Optional[int]):
        self.handle = handle

    def __del__(self) -> None:
        if self.handle:
            lib.scree_case_free(self.handle)


class Case:
    """A case that is being made: a built-in one, a file or a text, and keys that overrule it.

    source  name of a built-in case (`builtin_cases()`), path of a file, or a text (something with a line break or a
            colon that is no file); `Case.builtin`, `Case.read` and `Case.parse` say it outright
    quick   apply the `quick` section of the case
    set     keys and values, as `case[key] = value` sets them

    Everything is checked together, when the case is used or by `check()`; what is wrong is a CaseError with all problems.
    """

    def __init__(self, source: Union[str, "os.PathLike[str]"], *, quick: bool = False,
                 set: Optional[Mapping[str, Any]] = None):
        self._draft: Optional[int] = None
        self._checked: Optional[CheckedCase] = None
        if isinstance(source, str) and source in builtin_cases():
            self._begin(lib.scree_draft_builtin, source.encode())
        elif isinstance(source, str) and not os.path.exists(source) and ("\n" in source or ": " in source):
            content = source.encode()
            self._begin(lib.scree_draft_parse, content, len(content), b"text")
        elif isinstance(source, os.PathLike) or os.path.exists(source) or os.sep in source or source.endswith(".yaml"):
            self._begin(lib.scree_draft_read, encode(source))
        else:
            self._begin(lib.scree_draft_builtin, source.encode())
        self._options(quick, set)

    @classmethod
    def builtin(cls, name: str, **options: Any) -> "Case":
        """A built-in case. Options as of `Case`."""
        return cls._made(options, lib.scree_draft_builtin, name.encode())

    @classmethod
    def read(cls, path: Folder, **options: Any) -> "Case":
        """A case file."""
        return cls._made(options, lib.scree_draft_read, encode(path))

    @classmethod
    def parse(cls, content: str, name: str = "text", **options: Any) -> "Case":
        """A text; `name` stands for the file in messages."""
        raw = content.encode()
        return cls._made(options, lib.scree_draft_parse, raw, len(raw), name.encode())

    @classmethod
    def _made(cls, options: "dict[str, Any]", begin: Any, *arguments: Any) -> "Case":
        case = cls.__new__(cls)
        case._draft = case._checked = None
        case._begin(begin, *arguments)
        case._options(**options)
        return case

    def _options(self, quick: bool = False, set: Optional[Mapping[str, Any]] = None) -> None:
        if quick:
            lib.scree_draft_set_quick(self._draft, True)
        for key, value in (set or {}).items():
            self[key] = value

    def _begin(self, function: Any, *arguments: Any) -> None:
        draft = c_void_p()
        call(function, *arguments, byref(draft))
        self._draft = draft.value

    def __del__(self) -> None:
        if getattr(self, "_draft", None):
            lib.scree_draft_free(self._draft)

    def __setitem__(self, key: str, value: Any) -> None:
        """Sets a key, `case["stages.compress.rate"] = "1e-2 1/s"`: a text as in a case file, a number in SI units, yes
        or no, a list. The last value counts."""
        self._checked = None
        call(lib.scree_draft_set, self._draft, key.encode(), to_text(value).encode())

    def set(self, key: str, value: Any) -> "Case":
        """The same; returns the case."""
        self[key] = value
        return self

    def check(self) -> "Case":
        """Checks it now. Raises CaseError with everything that is wrong: each of `problems` has file, line, column, key,
        value, expected, message."""
        self.checked()
        return self

    def checked(self) -> CheckedCase:
        """The library's handle of what the case is now."""
        if self._checked is None:
            handle, problems = c_void_p(), c_void_p()
            check_problems(lib.scree_draft_check(self._draft, byref(handle), byref(problems)), problems)
            self._checked = CheckedCase(handle.value)
        return self._checked

    def text(self) -> str:
        """The resolved case: every default written out, units kept, without its `quick` section."""
        content, size = c_char_p(), c_size_t()
        file = _libc.open_memstream(byref(content), byref(size))
        if not file:
            raise MemoryError
        error = Error()
        try:
            status = lib.scree_case_write(self.checked().handle, file, byref(error))
        finally:
            _libc.fclose(file)
        written = ctypes.string_at(content, size.value).decode()
        _libc.free(content)
        check(status, error)
        return written

    def write(self, path: Folder) -> None:
        """Writes `text()` into a file."""
        content = self.text()
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)

    def summary(self) -> CaseSummary:
        """Takes some tenths of a second: the case is set going for a moment."""
        struct = CaseSummaryStruct()
        call(lib.scree_case_summarise, self.checked().handle, byref(struct))
        values = {field.name: getattr(struct, field.name) for field in fields(CaseSummary)}
        values["name"] = text(values["name"])
        return CaseSummary(**values)

    def warnings(self) -> "list[str]":
        """A sentence for each stage that means to be quasistatic and will not be."""
        lines: "list[str]" = []
        visit = LINE(lambda user, line: lines.append(text(line)))
        call(lib.scree_case_warn, self.checked().handle, visit, None)
        return lines

    def run(self, output: Folder, *, threads: int = 0, force: bool = False, figures: bool = True,
            after: Optional[Folder] = None, message: Any = None) -> Any:
        """Runs the case into a new folder, as `scree run` does, and returns it as a `Run`.

        threads  at most; 0: as many as pay
        force    write into a folder that holds another run
        after    folder of a run whose first stages are those of the case: it goes on behind them
        message  function of a level (0 information, 1 warning, 2 error) and a line of the log

        Ctrl-C stops after a checkpoint (Interrupted); `Run(output).restart()` goes on from it. Raises GuardError,
        FileError, InputError.
        """
        from .run import Run
        checked = self.checked()
        with Interruption() as interruption:
            options, held = run_options(output, threads, force, figures, message, interruption)
            if after is not None:
                options.after = encode(after)
            call(lib.scree_run, checked.handle, byref(options))
        del held
        return Run(output)


def run_options(output: Folder, threads: int, force: bool, figures: bool, message: Any,
                interruption: Interruption) -> "tuple[RunOptions, Iterable[Any]]":
    tell = MESSAGE(lambda user, level, line: message(level, text(line))) if message else MESSAGE()
    options = RunOptions(output=encode(output), threads=threads, force=force, figures=figures,
                         stop=ctypes.pointer(interruption.stop), progress=PROGRESS(), message=tell)
    return options, (tell,)
