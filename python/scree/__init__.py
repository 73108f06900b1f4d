"""Scree: a discrete-element laboratory for granular matter.

    import scree
    case = scree.Case("biaxial", quick=True)
    case["materials.0.friction"] = 0.3
    with scree.Simulation(case) as simulation:
        simulation.run_stage("confine")
        print(simulation.stress()[0, 0], simulation.view("position").shape)

`Case` says what is computed, `Simulation` computes it in memory, `case.run(folder)` into a folder of files, which `Run`
reads; `Sweep` makes many runs; `measure` averages finished ones; `theory` has closed forms. All values are SI, angles in
radians, tensors 3 x 3 with tension positive. docs/python.md explains the package, docs/notebooks/ shows it at work.
"""
from . import measure, theory
from ._errors import CaseError, FileError, GuardError, InputError, Interrupted, Problem, ScreeError
from ._library import commit, library_path, version
from .case import Case, CaseSummary, builtin_cases
from .run import Run, Series, Snapshot
from .simulation import Energies, Loads, Simulation, Structure
from .sweep import Sweep, SweepResults, builtin_sweeps

__version__ = version().split()[0]
__all__ = [
    "Case", "CaseError", "CaseSummary", "Energies", "FileError", "GuardError", "InputError", "Interrupted", "Loads",
    "Problem", "Run", "ScreeError", "Series", "Simulation", "Snapshot", "Structure", "Sweep", "SweepResults",
    "builtin_cases", "builtin_sweeps", "commit", "library_path", "measure", "theory", "version",
]
