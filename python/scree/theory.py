"""Closed forms: what continuum and lattice theory say, without a run."""
from __future__ import annotations

from ctypes import POINTER, byref, c_double, c_void_p, cast
from math import inf, nan
from typing import Any, Iterator, Mapping, Tuple, Union

from ._library import Folder, LatticeOf, LayerOf, PileOf, TheoryValue, call, encode, lib, text


class Theory(Mapping[str, float]):
    """Values by name, in SI units; `about(name)` has unit and meaning, `write(folder)` makes tables and figures."""

    def __init__(self, function: Any, of: Any):
        handle, values = c_void_p(), c_void_p()
        self._handle = None
        call(function, byref(of), byref(handle))
        self._handle = handle.value
        count = lib.scree_theory_values(self._handle, byref(values))
        array = cast(values, POINTER(TheoryValue))
        self._values = {text(array[k].name): (array[k].value, text(array[k].unit), text(array[k].meaning))
                        for k in range(count)}

    def __getitem__(self, name: str) -> float:
        return self._values[name][0]

    def __iter__(self) -> "Iterator[str]":
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def about(self, name: str) -> "tuple[str, str]":
        """Unit and meaning of a value."""
        return self._values[name][1:]

    def write(self, folder: Folder) -> None:
        """values.csv and, where there are curves, their tables and figures (these need gnuplot)."""
        call(lib.scree_theory_write, self._handle, encode(folder))

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            lib.scree_theory_free(self._handle)


def lattice(kind: str = "hexagonal", *, radius: float = 1.0, length: float = 1.0, density: float = 1.0,
            normal_stiffness: float = 1.0, stiffness_ratio: float = 0.0, young_modulus: float = inf,
            poisson_ratio: float = 0.0, plane_stress: bool = False, corrected: bool = False) -> Theory:
    """Equal discs (of this length) or spheres on a lattice: row, square, hexagonal, simple_cubic, body_centred,
    face_centred. m, kg/m3, N/m, Pa; young_modulus inf: rigid. Limits, moduli, critical steps, waves
    (docs/theory/ddem-3d.md)."""
    return Theory(lib.scree_theory_lattice, LatticeOf(kind.encode(), radius, length, density, normal_stiffness,
                                                      stiffness_ratio, young_modulus, poisson_ratio, plane_stress,
                                                      corrected))


def pile(kind: str = "osl", slope: "Union[float, Tuple[float, float]]" = 30.0, *, height: float = 1.0,
         density: float = 1.0, gravity: float = 1.0, eta: float = nan, mu: float = nan, ratio: float = nan,
         tau: float = nan, friction: float = nan, passive: bool = False, axis: float = nan, core: float = nan) -> Theory:
    """Stress under a pile: ife, bcc, fpa, osl, wedge. Slope(s), tau, friction, axis, core in degrees as on the command
    line; what is NaN has not been given (docs/theory/piles.md). Without units of their own values are in units of
    density, gravity and height."""
    sides = slope if isinstance(slope, (tuple, list)) else (slope, slope)
    return Theory(lib.scree_theory_pile, PileOf(kind.encode(), (c_double * 2)(*sides), height, density, gravity, eta, mu,
                                                ratio, tau, friction, passive, axis, core))


def layer(base: str = "none", *, force: float = 1.0, thickness: float = 1.0, poisson_ratio: float = 0.3,
          plane_stress: bool = False) -> Theory:
    """A line load [N/m] on an elastic half-space (base "none", Flamant) or a layer on a smooth or a bonded base."""
    return Theory(lib.scree_theory_layer, LayerOf(base.encode(), force, thickness, poisson_ratio, plane_stress))
