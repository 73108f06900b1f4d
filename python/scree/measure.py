"""Continuum averages of finished runs, as `scree measure` makes them (docs/output.md, "Measured averages")."""
from __future__ import annotations

from ctypes import byref, c_char_p
from pathlib import Path
from typing import Any, Optional, Sequence, Union

from ._library import LINE, Folder, MeasureOptions, call, encode, lib, text
from .case import Case
from .run import Run, Series


class Measured:
    """The folder that a measure wrote: `measured["cuts"]` is cuts.csv, and so on."""

    def __init__(self, folder: Path, lines: "list[str]"):
        self.folder = folder
        self.lines = lines  #: what was found, line by line

    def tables(self) -> "list[str]":
        """Names of the tables that are there."""
        return sorted(path.stem for path in self.folder.glob("*.csv"))

    def __getitem__(self, name: str) -> Series:
        return Series(self.folder / f"{name}.csv")


def runs(of: "Union[Folder, Run, Sequence[Union[Folder, Run]]]", *, fields: Optional[str] = None,
         cuts: Optional[str] = None, element: Optional[str] = None, grid: Optional[str] = None,
         kernel: Optional[str] = None, at: Optional[str] = None, start: Optional[str] = None,
         fit: Optional[str] = None, axis: Optional[str] = None, points: int = 0, threads: int = 0,
         output: Optional[Folder] = None, figures: bool = False, sizes: Optional[str] = None, mirror: bool = False,
         two_slopes: bool = False, case: Optional[Case] = None, contacts: Optional[Folder] = None,
         contact_columns: Optional[str] = None, length_unit: Optional[str] = None,
         time_unit: Optional[str] = None, force_unit: Optional[str] = None) -> Measured:
    """Measures runs: one, or several as an ensemble with means and bootstrap bands. Options are those of
    `scree measure --help`, texts with units: fields "stress,fabric", cuts "0,0.25,0.5", element "30 mm", grid "100x50",
    kernel "15 mm", at "end", "#12", "10 %" or the name of a stage; `start` is its --from, fit "ife,osl",
    sizes "5,10,20"; mirror, two_slopes: as there. Files of grains (dumps of LAMMPS, tables) need `case`, whose
    materials and law are theirs; contacts, contact_columns, length_unit "mm", time_unit, force_unit: as there.
    Raises InputError with the option as key, FileError."""
    several = of if isinstance(of, (list, tuple)) else [of]
    folders = [Path(one.folder if isinstance(one, Run) else one) for one in several]
    names = (c_char_p * len(folders))(*(encode(folder) for folder in folders))
    where = Path(output) if output is not None else (folders[0] if len(folders) == 1 and folders[0].is_dir() else Path()) / "measure"
    lines: "list[str]" = []
    tell: Any = LINE(lambda user, line: lines.append(text(line)))
    given = {"fields": fields, "cuts": cuts, "element": element, "grid": grid, "kernel": kernel, "at": at,
             "start": start, "fit": fit, "axis": axis, "sizes": sizes, "contact_columns": contact_columns,
             "length_unit": length_unit, "time_unit": time_unit, "force_unit": force_unit}
    checked = case.checked() if case is not None else None
    options = MeasureOptions(points=points, threads=threads, output=encode(where), no_figures=not figures, message=tell,
                             mirror=mirror, two_slopes=two_slopes,
                             sample_case=checked.handle if checked is not None else None,
                             contacts=encode(contacts) if contacts is not None else None,
                             **{key: value.encode() for key, value in given.items() if value is not None})
    call(lib.scree_measure, names, len(folders), byref(options))
    return Measured(where, lines)
