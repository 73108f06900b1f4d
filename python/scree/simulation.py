"""A simulation in memory: step it, look at it, push it, change it, measure it, save it."""
from __future__ import annotations

import time
import weakref
from ctypes import byref, c_bool, c_char_p, c_double, c_size_t, c_void_p, string_at
from dataclasses import dataclass
from typing import Any, Callable, Iterator, Optional

import numpy as np

from ._library import (OWN_FORCE, BodyValues, ContactPoint, EnergiesStruct, Error, Folder, OwnForce, StructureStruct,
                       View, array_of, call, check, encode, lib, text)
from .case import Case, CheckedCase

#: Seconds after which a long advance looks whether Ctrl-C was pressed.
_PATIENCE = 0.2

#: A touching contact; `partner` is 0 for a body, 1 for an element of a wall of the case, 2 for a plate.
CONTACT = np.dtype(ContactPoint)


@dataclass(frozen=True)
class Structure:
    """What the sample is made of now; NaN where something is not defined (include/scree/simulation.h)."""

    contacts: int
    coordination: float  #: contacts a body
    coordination_without_rattlers: float
    rattler_fraction: float
    solid_fraction: float
    fabric: np.ndarray  #: 3 x 3, mean of normal x normal, trace 1
    sliding_fraction: float
    mean_slip: float  #: m/s
    unbalanced_ratio: float


@dataclass(frozen=True)
class Energies:
    """Energies now and the balance of all work since the bodies were placed [J]."""

    kinetic: float
    kinetic_rotation: float
    elastic_normal: float
    elastic_tangential: float
    gravity: float  #: work of gravity
    outside: float  #: work of own forces and of changes of bodies
    residual: float  #: of the balance
    relative_residual: float  #: over all energy that there is and was


class Loads:
    """Where an own force puts its forces. It is given to the function and ends with its call."""

    __slots__ = ("_handle",)

    def __init__(self, handle: Optional[int]):
        self._handle = handle

    def add(self, ids: Any, force: Any = None, torque: Any = None) -> None:
        """Adds forces [N] and torques [N m] to the bodies with these ids (n).

        force   n x 2 or n x 3, or one force for all
        torque  n (about z), or n x 3
        A value beyond the bound, or an id that no body has, stops the simulation behind this step.
        """
        if not self._handle:
            raise RuntimeError("loads are added while the own force is called")
        ids = np.ascontiguousarray(np.atleast_1d(ids), dtype=np.uint32)
        force = None if force is None else _vectors(force, len(ids), 0)
        torque = None if torque is None else _vectors(torque, len(ids), 2)
        lib.scree_loads_add_many(self._handle, len(ids), ids.ctypes.data, None if force is None else force.ctypes.data,
                                 None if torque is None else torque.ctypes.data)


def _vectors(values: Any, count: int, scalar: int) -> np.ndarray:
    """count x 3, of vectors with two or three components, or of numbers, which are component `scalar`."""
    values = np.asarray(values, dtype=np.float64)
    if values.shape in {(count, 3), (count, 2)} or (values.ndim == 1 and len(values) in (2, 3) and count != len(values)):
        whole = np.zeros((count, 3))
        whole[:, : values.shape[-1]] = values
        return whole
    if scalar == 2 and values.size in (1, count):
        whole = np.zeros((count, 3))
        whole[:, 2] = values.ravel()
        return whole
    raise ValueError(f"{count} bodies need values of shape ({count}, 2) or ({count}, 3), not {values.shape}")


class Simulation:
    """A case as it goes, without files. One thread at a time uses it; it computes with `threads` (0: as many as pay).

    The bodies are placed by the first step or the first `run_stage()`. Closing it, or leaving its `with` block, frees
    its memory, but for what views still show.
    """

    def __init__(self, case: Case, threads: int = 0):
        handle = c_void_p()
        checked = case.checked()
        call(lib.scree_simulation_create, checked.handle, threads, byref(handle))
        self._take(handle.value, checked)

    def _take(self, handle: Optional[int], checked: CheckedCase) -> None:
        self._handle: Optional[int] = handle
        self._case = checked  # must outlive the handle
        self._struct, self._error = View(), Error()
        self._view_reference, self._error_reference = byref(self._struct), byref(self._error)
        self._keeper = c_void_p()
        self._keeper_reference = byref(self._keeper)
        self._seen: "dict[str, tuple[bytes, Optional[int], int, np.ndarray]]" = {}
        self._forces: "dict[str, Any]" = {}
        self._callbacks: "list[tuple[int, Callable[[Simulation], Any]]]" = []
        self._raised: Optional[BaseException] = None
        self._inside = 0

    @classmethod
    def open_run(cls, folder: Folder) -> "Simulation":
        """The newest state in the folder of a run (a checkpoint, else a snapshot), without changing anything there."""
        case, handle = c_void_p(), c_void_p()
        call(lib.scree_simulation_open_run, encode(folder), byref(case), byref(handle))
        simulation = cls.__new__(cls)
        simulation._take(handle.value, CheckedCase(case.value))
        return simulation

    # ---- its life ------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Frees it. Arrays that `view` gave stay as they are."""
        if self._inside:
            raise RuntimeError("an own force may not close its simulation")
        handle, self._handle = getattr(self, "_handle", None), None
        if handle:
            self._seen.clear()
            lib.scree_simulation_free(handle)

    @property
    def closed(self) -> bool:
        return self._handle is None

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *unused: Any) -> None:
        self.close()

    def __del__(self) -> None:
        handle = getattr(self, "_handle", None)
        if handle:
            lib.scree_simulation_free(handle)

    def _open(self) -> int:
        if self._handle is None:
            raise ValueError("the simulation is closed")
        return self._handle

    # ---- time ----------------------------------------------------------------------------------------------------

    def step(self, steps: int = 1) -> bool:
        """Takes so many steps (force evaluations), through as many stages as that needs; returns whether the case has
        ended. Functions of `every` are called in between. Raises GuardError and others, which stop the simulation, and
        what an own force raised."""
        return self._advance(steps, lib.scree_simulation_advance)

    def run_stage(self, name: Optional[str] = None) -> None:
        """Goes to the end of the present stage, which stays the present one; after its end, of the next. With a name:
        through all stages up to the end of the one that is called so."""
        still = 0
        while still < 2:  # once: a stage that takes no steps; twice: the end of the case
            before = self.stage_index, self.steps
            self._advance(None, lib.scree_simulation_advance_within_stage)
            if name is None or self.stage == name:
                return
            still = still + 1 if before == (self.stage_index, self.steps) else 0
        raise ValueError(f"no stage '{name}' is left")

    def begin_stage(self, name: Optional[str] = None) -> None:
        """Goes on until the stage of this name has begun; None: the first one that takes steps. Functions of `every` are
        not called."""
        self._checked_call(lib.scree_simulation_begin_stage, self._open(), None if name is None else name.encode())

    def run(self) -> None:
        """To the end of the case."""
        while not self.step(1 << 40):
            pass

    def _advance(self, steps: Optional[int], function: Any) -> bool:
        """Pieces end where a function of `every` is due, and now and then, so that Ctrl-C is heard."""
        handle, error, ended = self._open(), Error(), c_bool(False)
        end = None if steps is None else self.steps + steps
        piece, now = 64, self.steps
        if steps is not None and steps <= 0:
            return self.stage is None
        while True:
            wanted = piece if end is None else min(piece, end - now)
            for every, _ in self._callbacks:
                wanted = min(wanted, every - now % every)
            begin = time.perf_counter()
            status = function(handle, wanted, byref(ended), byref(error))
            self._reraise()
            check(status, error)
            piece = 2 * piece if time.perf_counter() - begin < _PATIENCE / 2 else max(piece // 2, 1)
            before, now = now, lib.scree_simulation_steps(handle)
            for every, callback in list(self._callbacks) if now > before else ():
                if now % every == 0:
                    callback(self)
                    self._open()
            if ended or (end is not None and now >= end):
                return bool(ended)

    def _checked_call(self, function: Any, *arguments: Any) -> None:
        error = Error()
        status = function(*arguments, byref(error))
        self._reraise()
        check(status, error)

    def _reraise(self) -> None:
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised

    def every(self, steps: int, function: "Callable[[Simulation], Any]") -> "Callable[[], None]":
        """Calls `function(simulation)` behind every step whose number is a multiple of `steps`; between two steps it may
        do everything. Returns a function that ends this."""
        if steps < 1:
            raise ValueError("a function is called every 1, 2, ... steps")
        entry = (int(steps), function)
        self._callbacks.append(entry)
        return lambda: self._callbacks.remove(entry) if entry in self._callbacks else None

    @property
    def dimension(self) -> int:
        """2 or 3"""
        return lib.scree_simulation_dimension(self._open())

    @property
    def time(self) -> float:
        """s"""
        return lib.scree_simulation_time(self._open())

    @property
    def steps(self) -> int:
        """Taken since the begin."""
        return lib.scree_simulation_steps(self._open())

    @property
    def step_size(self) -> float:
        """s, of the last step; the first one, before it."""
        return lib.scree_simulation_step_size(self._open())

    @property
    def stage(self) -> Optional[str]:
        """Name of the present stage; None when the case has ended."""
        name = c_char_p()
        lib.scree_simulation_stage(self._open(), byref(name))
        return text(name.value) if name.value is not None else None

    @property
    def stage_index(self) -> int:
        """Of the present stage, from 0; the number of stages when the case has ended."""
        return lib.scree_simulation_stage(self._open(), None)

    @property
    def strain(self) -> float:
        """Strain that the present loading stage has imposed so far, compression positive; NaN in others."""
        return lib.scree_simulation_loading_strain(self._open())

    def __len__(self) -> int:
        """Number of bodies."""
        return lib.scree_simulation_bodies(self._open())

    def checksum(self) -> str:
        """What the state is, in one number, as `state_checksum` of a run (docs/architecture.md)."""
        return f"{lib.scree_simulation_checksum(self._open()):016x}"

    # ---- views ---------------------------------------------------------------------------------------------------

    def view(self, name: str) -> np.ndarray:
        """A field as it lies in the library: nothing is copied, and it cannot be written (`set` changes bodies).

        name  one of `fields()`: "position", "radius", "scheme_velocity", "id", "contacts/first", "ledger/outside"
        Shape: (n,) or (n, components), n bodies in the order of their rows (the view "id" says which is which, and rows
        change places while the simulation goes on), contacts, nodes, or 1.

        The array shows the present until the library moves the field, as it does when bodies come and after a restore;
        then an older array stays as it was: ask for a view again after steps. An array is never without its memory,
        also when the simulation was closed.
        """
        handle = self._handle
        if handle is None:
            raise ValueError("the simulation is closed")
        seen = self._seen.get(name)
        if seen is None:
            return self._new_view(handle, name, name.encode())
        if lib.scree_simulation_view(handle, seen[0], self._view_reference, self._error_reference):
            del self._seen[name]
            return self._new_view(handle, name, seen[0])
        struct = self._struct
        if struct.data == seen[1] and struct.count == seen[2]:
            return seen[3]
        return self._new_view(handle, name, seen[0])

    __getitem__ = view

    def __iter__(self) -> "Iterator[str]":
        return iter(self.fields())

    def _new_view(self, handle: int, name: str, encoded: bytes) -> np.ndarray:
        keeper = self._keeper
        status = lib.scree_simulation_keep_view(handle, encoded, self._view_reference, self._keeper_reference,
                                                self._error_reference)
        check(status, self._error)
        array = array_of(self._struct, keeper.value)
        self._seen[name] = (encoded, self._struct.data, self._struct.count, array)
        return array

    def about(self, name: str) -> "tuple[str, str, float]":
        """Unit and meaning of a field, and the time [s] that its values are of: velocities of a leapfrog scheme are half
        a step behind."""
        view = View()
        call(lib.scree_simulation_view, self._open(), name.encode(), byref(view))
        return text(view.unit), text(view.meaning), view.time

    def fields(self) -> "list[str]":
        """Names of all views."""
        handle, names = self._open(), []
        while True:
            name = lib.scree_simulation_view_name(handle, len(names))
            if name is None:
                return names
            names.append(text(name))

    def positions(self) -> np.ndarray:
        """Copy [m], n x dimension, in the order of ids."""
        return self._copy(0, self.dimension)

    def velocities(self) -> np.ndarray:
        """Copy at the present time [m/s], n x dimension, in the order of ids; relative to a periodic cell that
        deforms."""
        return self._copy(1, self.dimension)

    def spins(self) -> np.ndarray:
        """Copy at the present time [rad/s], in the order of ids: n in 2D, n x 3 in 3D."""
        return self._copy(2, 3 if self.dimension == 3 else 1)

    def _copy(self, which: int, components: int) -> np.ndarray:
        out = np.empty((len(self), components))
        places: "list[Optional[int]]" = [None, None, None]
        places[which] = out.ctypes.data
        lib.scree_simulation_copy(self._open(), *places)
        return out[:, 0] if components == 1 else out

    # ---- contacts and measures -----------------------------------------------------------------------------------

    def contacts(self) -> np.ndarray:
        """All touching contacts at this moment: a copy, a structured array with the members first, second, partner (0 a
        body, 1 a wall, 2 a plate), sliding, normal, point [m], branch [m], force [N], overlap [m], normal_force [N],
        slip [m/s], elastic_energy [J]; vectors have three components. By id of the first, then of the second."""
        points, count = c_void_p(), c_size_t()
        call(lib.scree_simulation_contacts, self._open(), byref(points), byref(count))
        if count.value == 0:
            return np.zeros(0, CONTACT)
        return np.frombuffer(bytearray(string_at(points.value, count.value * CONTACT.itemsize)), dtype=CONTACT)

    def _tensor(self, function: Any) -> np.ndarray:
        out = (c_double * 9)()
        call(function, self._open(), out)
        return np.array(out).reshape(3, 3)

    def stress(self) -> np.ndarray:
        """Average stress [Pa] of the contacts, 3 x 3, tension positive."""
        return self._tensor(lib.scree_simulation_stress)

    def boundary_stress(self) -> np.ndarray:
        """Stress [Pa] that the boundary applies, 3 x 3, tension positive."""
        return self._tensor(lib.scree_simulation_boundary_stress)

    def displacement_gradient(self) -> np.ndarray:
        """Of the Delaunay boundary or of the periodic cell since the begin, 3 x 3, extension positive."""
        out = (c_double * 9)()
        lib.scree_simulation_strain(self._open(), out)
        return np.array(out).reshape(3, 3)

    @property
    def volume(self) -> float:
        """Of the sample inside of its boundary [m3]."""
        return lib.scree_simulation_volume(self._open())

    def structure(self) -> Structure:
        """Coordination, rattlers, solid fraction, fabric, sliding."""
        out = StructureStruct()
        call(lib.scree_simulation_structure, self._open(), byref(out))
        values = {name: getattr(out, name) for name, _ in StructureStruct._fields_}
        values["fabric"] = np.array(out.fabric).reshape(3, 3)
        return Structure(**values)

    def energies(self) -> Energies:
        """Energies and their balance; single works are the views "ledger/..."."""
        out = EnergiesStruct()
        call(lib.scree_simulation_energies, self._open(), byref(out))
        return Energies(*(getattr(out, name) for name, _ in EnergiesStruct._fields_))

    def sample(self, column: str) -> float:
        """A column of series.csv in the last sample that was taken (docs/output.md)."""
        value = c_double()
        call(lib.scree_simulation_sample, self._open(), column.encode(), byref(value))
        return value.value

    # ---- own forces and changes ----------------------------------------------------------------------------------

    def add_force(self, function: "Callable[[Simulation, Loads], Any]", largest_force: float,
                  largest_torque: float = 0.0, name: Optional[str] = None) -> str:
        """From the next step on `function(simulation, loads)` is called once a step, behind the contact forces, and adds
        forces with `loads.add`. Returns the name by which `remove_force` ends it.

        largest_force   [N], bound of the magnitude of each force; forces are rounded to some 1e-15 of it
        largest_torque  [N m], the same of torques; 0: none

        The function may use views and time; positions are those at the end of the step. Its work is `energies().outside`.
        The step of the case has to be small enough for it. What it raises stops the simulation and comes out of `step`.
        """
        name = name or getattr(function, "__name__", "force")
        me = weakref.ref(self)

        def called(user: Any, handle: Any, loads_handle: Any) -> int:
            simulation, loads = me(), Loads(loads_handle)
            if simulation is None:
                return 1
            simulation._inside += 1
            try:
                function(simulation, loads)
                return 0
            except BaseException as raised:  # whatever it is has to pass through C
                simulation._raised = raised
                return 1
            finally:
                simulation._inside -= 1
                loads._handle = None

        trampoline = OWN_FORCE(called)
        force = OwnForce(name.encode(), trampoline, None, largest_force, largest_torque)
        call(lib.scree_simulation_add_force, self._open(), byref(force))
        self._forces[name] = trampoline
        return name

    def remove_force(self, name: str) -> None:
        """From the next step on."""
        call(lib.scree_simulation_remove_force, self._open(), name.encode())
        del self._forces[name]

    def set(self, ids: Any, *, position: Any = None, velocity: Any = None, spin: Any = None, radius: Any = None) -> None:
        """New values of the bodies with these ids (n, each once), between two steps.

        position, velocity  n x dimension [m, m/s]; spin  n, or n x 3 in 3D [rad/s]; radius  n [m]
        What belongs together is changed in one call. The energy that this takes is work from outside. Raises InputError
        where nothing can be changed (then nothing is), GuardError when bodies overlap beyond the limit.
        """
        ids = np.ascontiguousarray(np.atleast_1d(ids), dtype=np.uint32)
        n, dimension = len(ids), self.dimension
        shapes = {"position": (n, dimension), "velocity": (n, dimension), "spin": (n, 3) if dimension == 3 else (n,),
                  "radius": (n,)}
        given = {"position": position, "velocity": velocity, "spin": spin, "radius": radius}
        arrays = {key: np.array(np.broadcast_to(np.asarray(value, dtype=np.float64), shapes[key]), order="C")
                  for key, value in given.items() if value is not None}
        values = BodyValues(n, ids.ctypes.data, *(arrays[key].ctypes.data if key in arrays else None for key in given))
        call(lib.scree_simulation_set, self._open(), byref(values))

    def save(self, path: Folder) -> None:
        """The whole state, bit for bit, into a file."""
        call(lib.scree_simulation_save, self._open(), encode(path))

    def restore(self, path: Folder) -> None:
        """Goes back, or on, to what a simulation of the same case saved, with as many own forces."""
        if self._inside:
            raise RuntimeError("an own force may not restore its simulation")
        call(lib.scree_simulation_restore, self._open(), encode(path))
