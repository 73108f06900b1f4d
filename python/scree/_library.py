"""The shared library through ctypes: where it is, its structs, its functions, statuses that become exceptions.

ctypes, because nothing has to be compiled for the Python that happens to be there, and a call costs about a microsecond.
"""
from __future__ import annotations

import ctypes
import os
import re
import shutil
import sys
from ctypes import (CFUNCTYPE, POINTER, Structure, byref, c_bool, c_char, c_char_p, c_double, c_int, c_int64,
                    c_long, c_size_t, c_uint32, c_uint64, c_void_p)
from pathlib import Path
from typing import Any, Optional, Union

import numpy

from ._errors import KINDS, CaseError, Problem, ScreeError

Folder = Union[str, "os.PathLike[str]"]


class Error(Structure):
    _fields_ = [("status", c_int), ("line", c_int), ("column", c_int), ("file", c_char * 256), ("field", c_char * 160),
                ("value", c_char * 160), ("accepted", c_char * 256), ("message", c_char * 1024)]


class View(Structure):
    _fields_ = [("data", c_void_p), ("count", c_size_t), ("components", c_int), ("type", c_int), ("stride", c_size_t),
                ("time", c_double), ("unit", c_char_p), ("meaning", c_char_p)]


class CaseOptions(Structure):
    _fields_ = [("overrides", POINTER(c_char_p)), ("override_count", c_size_t), ("quick", c_bool)]


class CaseSummaryStruct(Structure):
    _fields_ = [("name", c_char * 64), ("particles", c_uint64), ("step", c_double), ("critical_step", c_double),
                ("largest_step", c_uint64), ("phi", c_double), ("psi", c_double), ("inertial_number", c_double),
                ("mean_radius", c_double), ("thickness", c_double), ("reference_velocity", c_double),
                ("steps", c_double), ("seconds", c_double), ("stepping", c_double), ("output", c_double),
                ("figures", c_double), ("rate", c_double), ("memory", c_double), ("tabor", c_double),
                ("preparation", c_double), ("lists", c_double), ("sleeps", c_bool)]


class ContactPoint(Structure):
    _fields_ = [("first", c_uint32), ("second", c_uint32), ("partner", c_int), ("sliding", c_int),
                ("normal", c_double * 3), ("point", c_double * 3), ("branch", c_double * 3), ("force", c_double * 3),
                ("overlap", c_double), ("normal_force", c_double), ("slip", c_double), ("elastic_energy", c_double)]


class StructureStruct(Structure):
    _fields_ = [("contacts", c_size_t), ("coordination", c_double), ("coordination_without_rattlers", c_double),
                ("rattler_fraction", c_double), ("solid_fraction", c_double), ("fabric", c_double * 9),
                ("sliding_fraction", c_double), ("mean_slip", c_double), ("unbalanced_ratio", c_double)]


class EnergiesStruct(Structure):
    _fields_ = [(name, c_double) for name in ("kinetic", "kinetic_rotation", "elastic_normal", "elastic_tangential",
                                              "gravity", "outside", "residual", "relative_residual")]


OWN_FORCE = CFUNCTYPE(c_int, c_void_p, c_void_p, c_void_p)


class OwnForce(Structure):
    _fields_ = [("name", c_char_p), ("function", OWN_FORCE), ("user", c_void_p), ("largest_force", c_double),
                ("largest_torque", c_double)]


class BodyValues(Structure):
    _fields_ = [("count", c_size_t), ("id", c_void_p), ("position", c_void_p), ("velocity", c_void_p),
                ("spin", c_void_p), ("radius", c_void_p)]


MESSAGE = CFUNCTYPE(None, c_void_p, c_int, c_char_p)
LINE = CFUNCTYPE(None, c_void_p, c_char_p)
PROGRESS = CFUNCTYPE(None, c_void_p, c_void_p)
RESULT = CFUNCTYPE(None, c_void_p, c_char_p, c_char_p)
NAME = CFUNCTYPE(None, c_void_p, c_char_p, c_bool)
ATTRIBUTE = CFUNCTYPE(None, c_void_p, c_char_p, c_double, c_char_p)


class RunOptions(Structure):
    _fields_ = [("output", c_char_p), ("threads", c_int), ("balance_by_time", c_bool), ("force", c_bool),
                ("start", c_char_p), ("after", c_char_p), ("figures", c_bool), ("stop", POINTER(c_int)),
                ("progress", PROGRESS), ("message", MESSAGE), ("user", c_void_p)]


class SweepReadOptions(Structure):
    _fields_ = [("overrides", POINTER(c_char_p)), ("override_count", c_size_t), ("quick", c_bool),
                ("realisations", c_size_t)]


class SweepOptions(Structure):
    _fields_ = [("program", c_char_p), ("output", c_char_p), ("jobs", c_int), ("threads", c_int), ("ranks", c_int),
                ("retry", c_bool), ("force", c_bool), ("figures", c_bool), ("stop", POINTER(c_int)), ("progress", PROGRESS),
                ("message", MESSAGE), ("user", c_void_p)]


class MeasureOptions(Structure):
    _fields_ = [("fields", c_char_p), ("cuts", c_char_p), ("element", c_char_p), ("grid", c_char_p),
                ("kernel", c_char_p), ("sizes", c_char_p), ("at", c_char_p), ("start", c_char_p), ("fit", c_char_p),
                ("axis", c_char_p), ("points", c_long), ("threads", c_int), ("two_slopes", c_bool), ("mirror", c_bool),
                ("output", c_char_p), ("no_figures", c_bool), ("sample_case", c_void_p), ("contacts", c_char_p),
                ("contact_columns", c_char_p), ("length_unit", c_char_p), ("time_unit", c_char_p),
                ("force_unit", c_char_p), ("message", LINE), ("user", c_void_p)]


class PlotColumns(Structure):
    _fields_ = [("x", c_char_p), ("y", c_char_p), ("stage", c_char_p)]


class PlotScene(Structure):
    _fields_ = [("field", c_char_p), ("at", c_char_p), ("section", c_bool)]


class TheoryValue(Structure):
    _fields_ = [("name", c_char_p), ("value", c_double), ("unit", c_char_p), ("meaning", c_char_p)]


class LatticeOf(Structure):
    _fields_ = [("kind", c_char_p), ("radius", c_double), ("length", c_double), ("density", c_double),
                ("normal_stiffness", c_double), ("stiffness_ratio", c_double), ("young_modulus", c_double),
                ("poisson_ratio", c_double), ("plane_stress", c_bool), ("corrected", c_bool)]


class PileOf(Structure):
    _fields_ = [("kind", c_char_p), ("slope", c_double * 2), ("height", c_double), ("density", c_double),
                ("gravity", c_double), ("eta", c_double), ("mu", c_double), ("ratio", c_double), ("tau", c_double),
                ("friction", c_double), ("passive", c_bool), ("axis", c_double), ("core", c_double)]


class LayerOf(Structure):
    _fields_ = [("base", c_char_p), ("force", c_double), ("thickness", c_double), ("poisson_ratio", c_double),
                ("plane_stress", c_bool)]


# What each function takes, in letters (below) as in the headers, and what it gives: "S" a status, "V" nothing.
_LETTERS = {
    "p": c_void_p, "s": c_char_p, "z": c_size_t, "i": c_int, "b": c_bool, "d": c_double, "u": c_uint64, "l": c_int64,
    "S": c_int, "V": None, "I": c_uint32,
}
_FUNCTIONS = {
    "scree_version": ":s", "scree_commit": ":s", "scree_error_format": "psz:z",
    "scree_problems_count": "p:z", "scree_problems_get": "pz:p", "scree_problems_free": "p:V",
    "scree_draft_builtin": "spp:S", "scree_draft_read": "spp:S", "scree_draft_parse": "szspp:S",
    "scree_draft_free": "p:V", "scree_draft_set": "pssp:S", "scree_draft_set_number": "psdp:S",
    "scree_draft_set_quick": "pb:V", "scree_draft_check": "ppp:S", "scree_case_free": "p:V",
    "scree_case_write": "ppp:S", "scree_case_summarise": "ppp:S", "scree_case_warn": "pppp:S",
    "scree_template_count": ":z", "scree_template_name": "z:s", "scree_template_meaning": "z:s",
    "scree_simulation_create": "pipp:S", "scree_simulation_free": "p:V", "scree_simulation_advance": "pupp:S",
    "scree_simulation_advance_within_stage": "pupp:S", "scree_simulation_begin_stage": "psp:S",
    "scree_simulation_dimension": "p:i", "scree_simulation_time": "p:d", "scree_simulation_steps": "p:u",
    "scree_simulation_step_size": "p:d", "scree_simulation_bodies": "p:z", "scree_simulation_stage": "pp:l",
    "scree_simulation_loading_strain": "p:d", "scree_simulation_checksum": "p:u",
    "scree_simulation_view": "pspp:S", "scree_simulation_keep_view": "psppp:S", "scree_keeper_free": "p:V",
    "scree_simulation_view_name": "pz:s", "scree_simulation_copy": "pppp:V", "scree_simulation_contacts": "pppp:S",
    "scree_simulation_stress": "ppp:S", "scree_simulation_boundary_stress": "ppp:S",
    "scree_simulation_strain": "pp:V", "scree_simulation_volume": "p:d", "scree_simulation_structure": "ppp:S",
    "scree_simulation_energies": "ppp:S", "scree_simulation_sample": "pspp:S", "scree_simulation_add_force": "ppp:S",
    "scree_simulation_remove_force": "psp:S", "scree_loads_add_many": "pzppp:V", "scree_simulation_set": "ppp:S",
    "scree_simulation_save": "psp:S", "scree_simulation_restore": "psp:S", "scree_simulation_open_run": "sppp:S",
    "scree_run": "ppp:S", "scree_restart": "spp:S", "scree_result_get": "sspzp:S", "scree_result_visit": "sppp:S",
    "scree_export_lammps": "ssspp:S", "scree_export_contacts": "ssspp:S", "scree_plot_only": "ssppp:S", "scree_plot_chart": "spppp:S", "scree_plot_field": "spppp:S",
    "scree_plot_movie": "spppp:S", "scree_run_data_visit": "ssppp:S", "scree_run_data_read": "ssppp:S",
    "scree_run_data_attributes": "ssppp:S",
    "scree_sweep_read": "sppp:S", "scree_sweep_free": "p:V", "scree_sweep_builtin_count": ":z",
    "scree_sweep_builtin_name": "z:s", "scree_sweep_builtin_meaning": "z:s", "scree_sweep_lacks": "p:s",
    "scree_sweep_member_count": "p:z", "scree_sweep_member_folder": "pz:s", "scree_sweep_member_command": "pzpz:V",
    "scree_sweep_run": "ppp:S", "scree_sweep_collect": "ppp:S", "scree_measure": "pzpp:S",
    "scree_theory_lattice": "ppp:S", "scree_theory_pile": "ppp:S", "scree_theory_layer": "ppp:S",
    "scree_theory_values": "pp:z", "scree_theory_write": "psp:S", "scree_theory_free": "p:V",
}


def _places() -> "dict[str, str]":
    """What the build or the installation wrote beside this file: paths relative to it."""
    try:
        from . import _where
    except ImportError:  # the sources themselves: a build folder beside them
        return {"library": "../../build/libscree.so", "program": "../../build/scree"}
    return {"library": _where.LIBRARY, "program": _where.PROGRAM}


def _resolve(place: str) -> Path:
    return Path(os.path.normpath(Path(__file__).resolve().parent / place))


def _find_library() -> str:
    chosen = os.environ.get("SCREE_LIBRARY")
    if chosen:
        return chosen
    path = Path(os.path.normpath(Path(__file__).parent / _places()["library"]))
    if not path.exists():
        path = _resolve(_places()["library"])
    return str(path) if path.exists() else "libscree.so.0"


def find_program() -> str:
    """The program `scree` that belongs to this library (SCREE_PROGRAM overrules it)."""
    chosen = os.environ.get("SCREE_PROGRAM")
    if chosen:
        return chosen
    for path in (Path(os.path.normpath(Path(__file__).parent / _places()["program"])), _resolve(_places()["program"])):
        if path.exists():
            return str(path)
    found = shutil.which("scree")
    if not found:
        raise FileNotFoundError("the program scree is not beside its library and not in PATH: set SCREE_PROGRAM")
    return found


library_path: str = _find_library()
try:
    _shared = ctypes.CDLL(library_path)
except OSError as problem:
    raise ImportError(
        f"the library of Scree cannot be loaded ({problem}): build or install it, or set SCREE_LIBRARY to libscree.so"
    ) from None


def _bind() -> None:
    for name, signature in _FUNCTIONS.items():
        takes, gives = signature.split(":")
        function = getattr(_shared, name)
        function.argtypes = [_LETTERS[letter] for letter in takes]
        function.restype = _LETTERS[gives]


_bind()
lib: Any = _shared


def version() -> str:
    """Version of the library, with the compiler and the instruction set that the kernels use on this machine."""
    return lib.scree_version().decode()


def commit() -> str:
    """The commit that was built, "+" behind it where files differed; empty when the sources were no checkout."""
    return lib.scree_commit().decode()


def text(value: Optional[bytes]) -> str:
    return value.decode("utf-8", "replace") if value else ""


def _problem(error: Error, status: int = 0) -> Problem:
    buffer = ctypes.create_string_buffer(2048)
    lib.scree_error_format(byref(error), buffer, len(buffer))
    return Problem(error.status or status, text(error.file), error.line, error.column, text(error.field),
                   text(error.value), text(error.accepted), text(error.message), text(buffer.value))


def check(status: int, error: Error) -> None:
    """Raises what a status and its error mean."""
    if status:
        raise KINDS.get(status, ScreeError)([_problem(error, status)])


def check_problems(status: int, problems: c_void_p) -> None:
    """The same of a case or a sweep, with all its problems; frees them."""
    if not status:
        return
    count = lib.scree_problems_count(problems) if problems else 0
    found = [_problem(Error.from_address(lib.scree_problems_get(problems, k)), status) for k in range(count)]
    lib.scree_problems_free(problems)
    if not found:
        found = [Problem(status, "", 0, 0, "", "", "", "memory ran out", "memory ran out")]
    raise (CaseError if status == 2 else KINDS.get(status, ScreeError))(found)


def call(function: Any, *arguments: Any) -> None:
    """Calls a function whose last argument is an error."""
    error = Error()
    check(function(*arguments, byref(error)), error)


def encode(path: Folder) -> bytes:
    return os.fsencode(path)


def to_text(value: Any) -> str:
    """A value as a case file has it; numbers are SI."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_text(part) for part in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {to_text(part)}" for key, part in value.items()) + "}"
    return str(value)


def overrides(values: "Optional[dict[str, Any]]") -> Any:
    """ "key=value" texts as a C array, and how many."""
    texts = [f"{key}={to_text(value)}".encode() for key, value in (values or {}).items()]
    return (c_char_p * max(len(texts), 1))(*texts), len(texts)


NUMBER = re.compile(r"[-+]?(\d+\.?\d*([eE][-+]?\d+)?|\.\d+([eE][-+]?\d+)?|nan|inf)$")


def from_text(value: str) -> Any:
    """A result as int, float or text."""
    if re.fullmatch(r"-?\d+", value) and len(value) < 20:
        return int(value)
    return float(value) if NUMBER.match(value) else value


class Interruption:
    """Ctrl-C while the library runs: a run that is asked to stop writes a checkpoint and ends in order."""

    def __init__(self) -> None:
        self.stop = c_int(0)
        self._before: Any = None

    def __enter__(self) -> "Interruption":
        import signal
        import threading
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGINT, lambda number, frame: setattr(self.stop, "value", number))
        return self

    def __exit__(self, *unused: Any) -> None:
        import signal
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)


#: Of a component, as NumPy writes it, and its bytes: scree_field_type.
TYPES = tuple(("|" if size == 1 else "<" if sys.byteorder == "little" else ">") + kind + str(size) for kind, size in (
    ("f", 8), ("i", 8), ("u", 8), ("f", 4), ("i", 4), ("u", 4), ("u", 1)))
SIZES = (8, 8, 8, 4, 4, 4, 1)


class Block:
    """Memory of the library as NumPy sees it, read only. An array of it holds it, and it holds the memory, whatever
    becomes of the simulation or the run that it comes from."""

    __slots__ = ("__array_interface__", "_keeper", "__weakref__")

    def __init__(self, view: View, keeper: Optional[int]):
        self._keeper = keeper
        count, components, stride, kind = view.count, view.components, view.stride, view.type
        single = components == 1
        self.__array_interface__ = {
            "version": 3, "typestr": TYPES[kind], "shape": (count,) if single else (count, components),
            "strides": (stride,) if single else (stride, SIZES[kind]), "data": (view.data, True),
        }

    def __del__(self) -> None:
        if self._keeper:
            lib.scree_keeper_free(self._keeper)


def array_of(view: View, keeper: Optional[int]) -> Any:
    if not view.data or view.count == 0:
        shape = (0,) if view.components == 1 else (0, view.components)
        empty = numpy.zeros(shape, TYPES[view.type])
        empty.flags.writeable = False
        return empty
    return numpy.asarray(Block(view, keeper))


__all__ = ["Folder", "lib", "version", "commit", "library_path"]
