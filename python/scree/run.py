"""Finished runs, and those that go on: what is in their folders."""
from __future__ import annotations

import csv
import difflib
import re
import warnings
from ctypes import byref, c_size_t, c_void_p, create_string_buffer
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np

from ._library import (ATTRIBUTE, LINE, NAME, RESULT, Folder, Interruption, PlotColumns, PlotScene, View, array_of, call,
                       encode, from_text, lib, text)
from .case import Case, run_options


def read_table(path: Folder) -> "tuple[dict[str, np.ndarray], dict[str, str]]":
    """Columns and units of a table of Scree, whose head has "name [unit]". Columns of texts are arrays of objects."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns: "dict[str, np.ndarray]" = {}
    units: "dict[str, str]" = {}
    for k, head in enumerate(rows[0]):
        match = re.fullmatch(r"(.*?)(?: \[(.*)\])?", head)
        name, unit = (match.group(1), match.group(2)) if match else (head, None)
        values = [row[k] for row in rows[1:] if len(row) == len(rows[0])]
        try:
            columns[name] = np.array([float(value) if value else np.nan for value in values])
        except ValueError:
            columns[name] = np.array(values, dtype=object)
        units[name] = unit or ""
    return columns, units


def to_frame(columns: Mapping[str, np.ndarray]) -> Any:
    """As a pandas.DataFrame; ImportError where pandas is not installed."""
    import pandas
    return pandas.DataFrame(dict(columns))


def nearest(name: str, names: "Iterable[str]") -> str:
    """The end of a message about a name that is none; empty where none of `names` is near."""
    near = difflib.get_close_matches(name, list(names), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


class Series(Mapping[str, np.ndarray]):
    """Columns of a table as NumPy arrays by name: `series["stress_ratio"]`."""

    def __init__(self, path: Folder):
        self._columns, self.units = read_table(path)

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"there is no column '{name}'" + nearest(name, self._columns)) from None

    def __iter__(self) -> "Iterator[str]":
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def frame(self) -> Any:
        """As a pandas.DataFrame; `series.units` has the units."""
        return to_frame(self._columns)


class Group(Mapping[str, Any]):
    """A group of run.h5: datasets are NumPy arrays, read when they are asked for; groups are groups."""

    def __init__(self, folder: Path, path: str):
        self._folder, self._path = folder, path

    def _names(self) -> "dict[str, bool]":
        found: "dict[str, bool]" = {}
        visit = NAME(lambda user, name, is_group: found.__setitem__(text(name), bool(is_group)))
        call(lib.scree_run_data_visit, encode(self._folder), self._path.encode(), visit, None)
        return found

    def _read(self, name: str) -> "tuple[np.ndarray, str, str]":
        view, keeper = View(), c_void_p()
        call(lib.scree_run_data_read, encode(self._folder), f"{self._path}/{name}".encode(), byref(view), byref(keeper))
        unit, meaning = text(view.unit), text(view.meaning)
        return array_of(view, keeper.value), unit, meaning

    def __getitem__(self, name: str) -> Any:
        names, first = self._names(), name.split("/")[0]
        if first not in names:
            raise KeyError(f"{self._path} has no '{name}'{nearest(first, names)} (it has {', '.join(sorted(names))})")
        if "/" in name:
            return self[first][name[len(first) + 1:]]
        return Group(self._folder, f"{self._path}/{name}") if names[first] else self._read(name)[0]

    def __iter__(self) -> "Iterator[str]":
        return iter(self._names())

    def __len__(self) -> int:
        return len(self._names())

    def about(self, name: str) -> "tuple[str, str]":
        """Unit and meaning of a dataset."""
        return self._read(name)[1:]

    @property
    def attributes(self) -> "dict[str, Any]":
        """Numbers and texts of the group."""
        found: "dict[str, Any]" = {}
        visit = ATTRIBUTE(lambda user, name, number, words: found.__setitem__(
            text(name), number if words is None else text(words)))
        call(lib.scree_run_data_attributes, encode(self._folder), self._path.encode(), visit, None)
        return found


class Snapshot(Group):
    """A snapshot (docs/output.md, "run.h5"): `snapshot["position"]` (n x dimension, in the order of ids),
    `snapshot["radius"]`, `snapshot["contacts/normal_force"]`."""

    def __init__(self, folder: Path, index: int):
        super().__init__(folder, f"snapshots/{index:06d}")
        self.index = index

    @property
    def time(self) -> float:
        """s"""
        return float(self.attributes["time"])

    @property
    def stage(self) -> str:
        """Name of its stage."""
        return str(self.attributes.get("stage_name", self.attributes["stage"]))

    @property
    def contacts(self) -> Group:
        """Its contacts: `snapshot.contacts["normal_force"]`."""
        return self["contacts"]


class Run:
    """The folder of a run, also while it goes on. Nothing is read before it is asked for, and nothing is changed."""

    def __init__(self, folder: Folder):
        self.folder = Path(folder)
        self["case"]  # a folder of no run is told at once

    def __getitem__(self, name: str) -> Any:
        """A result of summary.json, as `scree get`: a number or a text. A name that is none is an InputError with the
        nearest."""
        value = create_string_buffer(4096)
        call(lib.scree_result_get, encode(self.folder), name.encode(), value, len(value))
        return from_text(text(value.value)) if name not in ("state_checksum", "commit") else text(value.value)

    @property
    def results(self) -> "dict[str, Any]":
        """All results of summary.json; what does not exist is NaN."""
        found: "dict[str, Any]" = {}

        def visit(user: Any, name: bytes, value: bytes) -> None:
            found[text(name)] = from_text(text(value)) if text(name) not in ("state_checksum", "commit") else text(value)

        call(lib.scree_result_visit, encode(self.folder), RESULT(visit), None)
        return found

    @property
    def series(self) -> Series:
        """series.csv: columns by name, `.units`, `.frame()` for pandas."""
        return Series(self.folder / "series.csv")

    @property
    def case(self) -> Case:
        """The resolved case."""
        return Case.read(self.folder / "case.yaml")

    @property
    def snapshots(self) -> "list[Snapshot]":
        """All of them, in their order."""
        return [Snapshot(self.folder, int(name)) for name in sorted(Group(self.folder, "snapshots"))]

    def snapshot(self, index: int = -1) -> Snapshot:
        """One of them by its place; -1 is the last. IndexError where there are fewer."""
        snapshots = self.snapshots
        if not -len(snapshots) <= index < len(snapshots):
            raise IndexError(f"there is no snapshot {index}: '{self.folder}' has {len(snapshots)}")
        return snapshots[index]

    def h5(self) -> Any:
        """run.h5 as a h5py.File, for all that the library does not show; ImportError where h5py is not installed."""
        import h5py
        return h5py.File(self.folder / "run.h5", "r")

    def restart(self, *, start: Optional[str] = None, threads: int = 0, figures: bool = True,
                message: Any = None) -> "Run":
        """Continues from the newest checkpoint, or from the snapshot `start` ("12", "latest"), bit for bit."""
        with Interruption() as interruption:
            options, held = run_options(self.folder, threads, False, figures, message, interruption)
            options.start = start.encode() if start is not None else None
            call(lib.scree_restart, encode(self.folder), byref(options))
        del held
        return self

    def plot(self, *names: str) -> "list[Path]":
        """Draws the usual figures, all ("all"), or those of these names, into figures/; returns their paths."""
        paths: "list[Path]" = []
        tell = LINE(lambda user, path: paths.append(Path(text(path))))
        call(lib.scree_plot_only, encode(self.folder), ",".join(names).encode() if names else None, tell, None)
        return paths

    def export_lammps(self, path: Optional[Folder] = None, *, stage: Optional[str] = None,
                      contacts: Optional[Folder] = None) -> Path:
        """Writes the snapshots, those of a stage or all, as a dump of LAMMPS, for OVITO, and their contacts as a local
        dump into the file `contacts`; path of the dump."""
        file = Path(path) if path is not None else self.folder / "snapshots.lammpstrj"
        frames, name = c_size_t(), stage.encode() if stage else None
        call(lib.scree_export_lammps, encode(self.folder), name, encode(file), byref(frames))
        if contacts is not None:
            call(lib.scree_export_contacts, encode(self.folder), name, encode(contacts), byref(frames))
        return file

    def chart(self, y: "Union[str, Sequence[str]]", *, x: Optional[str] = None, stage: Optional[str] = None) -> Path:
        """Draws columns of the series, "p,q" or ["p", "q"], over another one (time), of rows of these stages; its path."""
        names = y if isinstance(y, str) else ",".join(y)
        asked = PlotColumns(x=x.encode() if x else None, y=names.encode(), stage=stage.encode() if stage else None)
        return self._draw(lib.scree_plot_chart, asked)[0]

    def scene(self, field: str, *, at: Optional[str] = None, section: bool = False) -> Path:
        """Draws the bodies at "end", "start", "#12", "5 %", "0.1 s" or the end of a stage, coloured by a field; its
        path."""
        asked = PlotScene(field=field.encode(), at=at.encode() if at else None, section=section)
        return self._draw(lib.scree_plot_field, asked)[0]

    def movie(self, field: str, *, section: bool = False) -> Path:
        """Draws the scenes of all snapshots in one frame. The path of the mp4, or, with a warning, of the folder of the
        frames where there is no ffmpeg."""
        said = str(self._draw(lib.scree_plot_movie, PlotScene(field=field.encode(), section=section))[0])
        if not said.startswith("warning: "):
            return Path(said)
        warnings.warn(said[len("warning: "):], stacklevel=2)
        return self.folder / "figures" / f"movie-{field}{'-section' if section else ''}"

    def _draw(self, function: Any, asked: Any) -> "list[Path]":
        paths: "list[Path]" = []
        tell = LINE(lambda user, path: paths.append(Path(text(path))))
        call(function, encode(self.folder), byref(asked), tell, None)
        return paths
