"""The Python package against the library and the program: test_scree.py SOURCE_DIR SCRATCH_DIR."""
import ctypes
import gc
import math
import os
import re
import shutil
import subprocess
import sys
import unittest
import warnings
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: NumPy is not installed (python3-numpy)")
    sys.exit(77)
import scree
from scree import _library
from scree._library import find_program

SOURCE, SCRATCH = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
shutil.rmtree(SCRATCH, ignore_errors=True)
SCRATCH.mkdir(parents=True)

PAIR = """
materials: [{name: rubber, young_modulus: 100 kPa, density: 1000 kg/m3, friction: 0}]
particles: {material: rubber, count: 2, distribution: equal, radius: 1 mm}
integrator: {step: 1e-5 s}
walls: [{shape: plane, point: [0, -1 m], normal: [0, 1]}]
stages:
  - stage: prepare
    method: bodies
    bodies: [{position: [0, 0]}, {position: [10 mm, 0]}]
  - {stage: relax, duration: 0.05 s}
"""


def small(count=60):
    return scree.Case("biaxial", quick=True, set={"particles.count": count})


class Cases(unittest.TestCase):
    def test_sources(self):
        self.assertIn("biaxial", scree.builtin_cases())
        for case in (scree.Case(PAIR), scree.Case.parse(PAIR), scree.Case(SOURCE / "cases" / "biaxial.yaml"),
                     scree.Case.read(SOURCE / "cases" / "biaxial.yaml"), scree.Case.builtin("biaxial")):
            self.assertIn("particles", case.check().text())
        with self.assertRaises(scree.InputError) as caught:
            scree.Case("biaxal")
        self.assertIn("biaxial", caught.exception.expected + caught.exception.message)

    def test_keys(self):
        case = scree.Case("biaxial", quick=True)
        case["particles.count"] = np.int64(77)
        case.set("materials.0.friction", 0.25).set("output.figures", False)
        case["measure.windows"] = [[0.02, 0.05]]
        again = scree.Case.parse(case.text()).text()
        self.assertEqual(again, case.text())
        self.assertEqual(case.summary().particles, 77)
        self.assertGreater(case.summary().critical_step, 0)
        self.assertFalse(case.summary().sleeps)
        pile = scree.Case("pile-point", quick=True, set={"stages.pour.sleep_window": "5 ms"})
        self.assertTrue(pile.summary().sleeps)
        self.assertIsInstance(case.warnings(), list)

    def test_errors(self):
        wrong = PAIR.replace("count: 2", "cuont: 2").replace("1e-5 s", "1e-5 m")
        with self.assertRaises(scree.CaseError) as caught:
            scree.Case.parse(wrong, "my.yaml").check()
        first = caught.exception
        self.assertGreaterEqual(len(first.problems), 2)
        self.assertEqual([(p.file, p.line) for p in first.problems[:2]], [("my.yaml", 3), ("my.yaml", 4)])
        self.assertIn("cuont", first.key)
        self.assertGreater(first.column, 0)
        self.assertIn("count", first.expected + first.message)
        self.assertIn("my.yaml:3:", str(first))
        self.assertIsInstance(first, ValueError)


class Views(unittest.TestCase):
    def test_no_copy_and_read_only(self):
        simulation = scree.Simulation(small(), 1)
        self.assertEqual(simulation.view("position").shape, (0, 2))
        simulation.step(20)
        position = simulation.view("position")
        struct = scree._library.View()
        scree._library.call(scree._library.lib.scree_simulation_view, simulation._handle, b"position",
                            ctypes.byref(struct))
        self.assertEqual(position.ctypes.data, struct.data)
        self.assertIs(position, simulation["position"])
        self.assertEqual(position.dtype, np.float64)
        with self.assertRaises(ValueError):
            position[0, 0] = 1
        with self.assertRaises(ValueError):
            position.flags.writeable = True
        before = position.copy()
        simulation.step(2000)
        now = simulation.view("position")
        by_id = np.empty_like(now)
        by_id[simulation.view("id")] = now
        np.testing.assert_array_equal(by_id, simulation.positions())
        self.assertFalse(np.array_equal(before, now))
        self.assertEqual(simulation.about("radius")[0], "m")
        with self.assertRaises(scree.InputError) as caught:
            simulation.view("postion")
        self.assertEqual(caught.exception.expected, "position")

    def test_a_view_outlives_everything(self):
        simulation = scree.Simulation(small(), 1)
        simulation.step(500)
        kept = {name: (simulation.view(name), simulation.view(name).copy()) for name in simulation.fields()}
        self.assertGreater(len(kept), 20)
        piece = simulation.view("position")[3:7, 1]
        value = piece.copy()
        simulation.close()
        self.assertTrue(simulation.closed)
        for k in range(5):  # others take memory that was freed
            other = scree.Simulation(small(100 + k), 1)
            other.step(10)
        for name, (view, copy) in kept.items():
            if name.startswith(("contacts/", "position", "radius", "id")):
                np.testing.assert_array_equal(view, copy, name)
            view.sum()
        np.testing.assert_array_equal(piece, value)
        with self.assertRaises(ValueError):
            simulation.view("position")
        with self.assertRaises(ValueError):
            simulation.step()
        simulation.close()

    def test_old_views_stay_while_arrays_move(self):
        """Bodies come and go: views of each moment are held, and none may be without its memory."""
        simulation = scree.Simulation(scree.Case("pour-discs", quick=True), 1)
        held, places = [], set()
        while len(simulation) < 60:
            simulation.step(2000)
            held.append(simulation.view("position"))
            places.add(held[-1].ctypes.data)
        self.assertGreater(len(places), 2)
        del simulation
        gc.collect()
        self.assertTrue(all(np.isfinite(view).all() for view in held))


class Steps(unittest.TestCase):
    def test_stages_and_same_bits(self):
        one, other = scree.Simulation(small(), 1), scree.Simulation(small(), 1)
        calls = []
        stop = one.every(700, lambda s: calls.append(s.steps))
        one.run_stage()
        self.assertEqual((one.stage, one.steps), ("prepare", 0))
        one.run_stage("confine")
        self.assertEqual(one.stage, "confine")
        self.assertEqual(calls, list(range(700, one.steps + 1, 700)))
        self.assertGreater(len(calls), 3)
        stop()
        other.step(one.steps)
        self.assertEqual(one.checksum(), other.checksum())
        pressure = -np.trace(one.stress()[:2, :2]) / 2
        self.assertLess(abs(pressure / 1e5 - 1), 0.02)  # the servo's 100 kPa, and its limit of one percent
        self.assertEqual(one.structure().contacts, len(one.contacts()))
        self.assertAlmostEqual(np.trace(one.structure().fabric), 1, 12)
        with self.assertRaises(ValueError):
            one.run_stage("prepare")

    def test_save_and_restore(self):
        simulation = scree.Simulation(small(), 1)
        simulation.step(300)
        simulation.save(SCRATCH / "state.h5")
        simulation.step(200)
        checksum = simulation.checksum()
        simulation.restore(SCRATCH / "state.h5")
        self.assertEqual(simulation.steps, 300)
        simulation.step(200)
        self.assertEqual(simulation.checksum(), checksum)

    def test_set(self):
        with scree.Simulation(scree.Case(PAIR), 1) as simulation:
            simulation.step(1)
            simulation.set([1], velocity=[[0.5, 0.25]])
            np.testing.assert_allclose(simulation.velocities(), [[0, 0], [0.5, 0.25]], rtol=1e-14)
            mass = simulation.view("mass")[0]
            self.assertAlmostEqual(simulation.energies().outside / (0.5 * mass * 0.3125), 1, 12)
            with self.assertRaises(scree.InputError):
                simulation.set([7], radius=[1e-3])


class Forces(unittest.TestCase):
    STIFFNESS, LENGTH = 0.2, 8e-3

    def spring(self, simulation, loads):
        position = np.empty((2, 2))
        position[simulation.view("id")] = simulation.view("position")
        pull = self.STIFFNESS * (position[1, 0] - position[0, 0] - self.LENGTH)
        loads.add([0, 1], [[pull, 0], [-pull, 0]])

    def test_oscillator(self):
        """Two discs on a spring: 2 mm cos(w t), w^2 = 2 k / m; the error of the scheme is (w h)^2 / 24 of the phase."""
        simulation = scree.Simulation(scree.Case(PAIR), 1)
        simulation.add_force(self.spring, largest_force=1e-2, name="spring")
        simulation.step(4000)
        x = simulation.positions()
        w = math.sqrt(2 * self.STIFFNESS / simulation.view("mass")[0])
        self.assertLess(abs(x[1, 0] - x[0, 0] - self.LENGTH - 2e-3 * math.cos(w * simulation.time)), 1e-5)
        self.assertLess(abs(simulation.energies().relative_residual), 1e-9)
        simulation.remove_force("spring")
        with self.assertRaises(scree.InputError):
            simulation.remove_force("spring")

    def test_torque(self):
        simulation = scree.Simulation(scree.Case(PAIR), 1)
        simulation.step(1)
        simulation.add_force(lambda s, loads: loads.add([1], torque=[1e-6]), 0.0 + 1e-9, 1e-5, "turn")
        simulation.step(100)
        spins = simulation.spins()
        self.assertEqual(spins[0], 0)
        self.assertGreater(spins[1], 0)

    def test_what_is_raised_comes_out(self):
        simulation = scree.Simulation(scree.Case(PAIR), 1)

        def fails(_, loads):
            raise KeyError("mine")

        simulation.add_force(fails, 1.0)
        with self.assertRaises(KeyError):
            simulation.step(10)
        with self.assertRaises(scree.ScreeError):  # it stays stopped
            simulation.step(10)
        beyond = scree.Simulation(scree.Case(PAIR), 1)
        beyond.add_force(lambda s, loads: loads.add([0], [[5.0, 0]]), 1.0, name="large")
        with self.assertRaises(scree.ScreeError) as caught:
            beyond.step(10)
        self.assertIn("large", str(caught.exception))
        closing = scree.Simulation(scree.Case(PAIR), 1)
        closing.add_force(lambda s, loads: s.close(), 1.0)
        with self.assertRaises(RuntimeError):
            closing.step(10)


class Folders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        lines = []
        case = small()
        case["output.snapshots"] = 4
        case["stages.compress.strain"] = 0.01
        case["measure.windows"] = [[0.002, 0.01]]
        cls.run_ = case.run(SCRATCH / "run", threads=1, figures=False, message=lambda level, line: lines.append(line))
        assert lines

    def test_first_example(self):
        """What docs/python.md shows first runs as it stands, on fewer grains."""
        example = re.search(r"((?:    .*\n)*    run = case.run.*\n(?:    .*\n)*)", (SOURCE / "docs" / "python.md").read_text())
        lines = [line[4:] for line in example.group(1).splitlines()]
        lines.insert(next(k for k, line in enumerate(lines) if line.startswith("case = ")) + 1,
                     'case["particles.count"] = 60; case["stages.compress.strain"] = 0.01; case["measure.windows"] = []')
        script = SCRATCH / "example.py"
        script.write_text("\n".join(lines) + "\n")
        done = subprocess.run([sys.executable, str(script)], cwd=SCRATCH, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^\(60, 2\) \[\[")

    def test_results(self):
        run = self.run_
        by_program = subprocess.run([find_program(), "get", str(run.folder), "phi"], capture_output=True, text=True)
        self.assertEqual(run["phi"], float(by_program.stdout))
        self.assertEqual(run["particles"], 60)
        self.assertEqual(run.results["state_checksum"], run["state_checksum"])
        self.assertEqual(len(run["state_checksum"]), 16)
        with self.assertRaises(scree.InputError) as caught:
            run["peak_stres_ratio"]
        self.assertIn("peak_stress_ratio", caught.exception.expected)
        with self.assertRaises(scree.FileError):
            scree.Run(SCRATCH / "none")

    def test_dump_of_lammps(self):
        dump = self.run_.export_lammps()
        self.assertEqual(dump.read_text().count("ITEM: TIMESTEP"), len(self.run_.snapshots))
        with self.assertRaises(scree.InputError):
            self.run_.export_lammps(stage="none")

    def test_charts_scenes_and_movies(self):
        run = self.run_
        self.assertEqual(run.chart("p,q", x="axial_strain", stage="compress").suffix, ".svg")
        self.assertEqual(run.chart(["p", "q"]), run.chart("p,q"))
        self.assertTrue(run.scene("speed", at="start").is_file())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # where there is no ffmpeg
            self.assertTrue(run.movie("speed").exists())
        frames = sorted((run.folder / "figures" / "movie-speed").glob("frame-*.png"))
        self.assertEqual(len(frames), len(run.snapshots))
        with self.assertRaises(scree.InputError) as caught:
            run.movie("sped")
        self.assertIn("speed", str(caught.exception))

    def test_series(self):
        series = self.run_.series
        self.assertEqual(series.units["stress_axial_contacts"], "Pa")
        self.assertTrue((np.diff(series["time"]) >= 0).all())
        with self.assertRaises(KeyError):
            series["stres_ratio"]
        try:
            import pandas  # noqa: F401
        except ImportError:
            with self.assertRaises(ImportError):
                series.frame()
        else:
            self.assertEqual(list(series.frame().columns), list(series))

    def test_snapshots(self):
        snapshots = self.run_.snapshots
        self.assertGreaterEqual(len(snapshots), 4)
        last = self.run_.snapshot()
        self.assertEqual(last["position"].shape, (60, 2))
        self.assertEqual(last["id"].dtype, np.uint32)
        self.assertEqual(last.about("position")[0], "m")
        self.assertEqual(last.stage, "compress")
        self.assertTrue(0 < last.time <= self.run_["time"])
        force = last["contacts/normal_force"]
        np.testing.assert_array_equal(force, last.contacts["normal_force"])
        del snapshots, last
        gc.collect()
        self.assertTrue((force > 0).all())
        with self.assertRaisesRegex(KeyError, "did you mean 'position'"):
            self.run_.snapshot()["postion"]
        with self.assertRaisesRegex(IndexError, "no snapshot 77: .* has [0-9]+"):
            self.run_.snapshot(77)
        with scree.Simulation.open_run(self.run_.folder) as simulation:
            np.testing.assert_array_equal(simulation.positions(), self.run_.snapshot()["position"])

    def test_measure(self):
        measured = scree.measure.runs(self.run_, fields="stress", cuts="1", sizes="5,10", mirror=True, output=SCRATCH / "measured")
        self.assertEqual(list(measured["sizes"]["size"]), [5, 10])
        self.assertTrue(measured.lines)
        self.assertIn("cuts", measured.tables())
        self.assertGreater(len(measured["cuts"]), 3)
        last = self.run_.snapshot()
        volume, contacts = np.asarray(last["radius"]) ** 2, np.asarray(last["coordination"])
        factor = (volume * contacts).mean() / (volume.mean() * contacts.mean())
        self.assertNotAlmostEqual(factor, 1, delta=1e-3)
        self.assertAlmostEqual(measured["values"]["fabric_factor"][0], factor, delta=1e-8)
        with self.assertRaises(scree.InputError):
            scree.measure.runs(self.run_, fields="stres")

    def test_sweep(self):
        file = ("sweep: 1\nname: s\ncase: restitution\nvary:\n  - key: materials.0.friction\n"
                "    values: [0.2, 0.4]\nmeasures: [time]\n")
        sweep = scree.Sweep(file, set={"output.figures": "no"})
        self.assertEqual(len(sweep), 2)
        self.assertEqual(len(sweep.members), len(sweep.commands))
        done = sweep.run(SCRATCH / "sweep", jobs=1)
        self.assertEqual(list(done.members["status"]), ["done", "done"])
        self.assertEqual(len(done.runs), 2)
        self.assertIn("time", done.table)
        with self.assertRaises(scree.CaseError):
            scree.Sweep(file.replace("friction", "fricton"))

    def test_theory(self):
        theory = scree.theory.pile("osl", 28.0, eta=0.74)
        self.assertGreater(len(theory), 5)
        self.assertTrue(theory.about(next(iter(theory)))[1])
        # an unbounded half-space: 2 F / (pi z) below the load (Flamant)
        flamant = scree.theory.layer("none", force=1.0, thickness=1.0)
        self.assertTrue(any(abs(abs(value) - 2 / math.pi) < 1e-6 for value in flamant.values()), dict(flamant))
        self.assertGreater(len(scree.theory.lattice("square", stiffness_ratio=0.5)), 5)
        with self.assertRaises(scree.InputError):
            scree.theory.lattice("sqare")


class Structs(unittest.TestCase):
    def test_structs_are_those_of_the_headers(self):
        """Size of each struct, and place of each of its members, as a compiler finds them in the headers."""
        prints, expected = [], []
        for name, struct in vars(_library).items():
            if not (isinstance(struct, type) and issubclass(struct, ctypes.Structure)) or struct is ctypes.Structure:
                continue
            words = re.sub("(?<!^)(?=[A-Z])", "_", name.removesuffix("Struct")).lower()
            c_name = "scree_" + ("theory_" if words.endswith("_of") else "") + words
            prints.append(f'printf("{name} %zu\\n", sizeof({c_name}));')
            expected.append(f"{name} {ctypes.sizeof(struct)}")
            for member, _ in struct._fields_:
                c_member = {"start": "from"}.get(member, member)
                prints.append(f'printf("{name}.{member} %zu\\n", offsetof({c_name}, {c_member}));')
                expected.append(f"{name}.{member} {getattr(struct, member).offset}")
        self.assertGreater(len(expected), 100)
        program = SCRATCH / "structs"
        program.with_suffix(".c").write_text(
            "#include <scree/scree.h>\n#include <stddef.h>\n#include <stdio.h>\n"
            "int main(void)\n{\n" + "\n".join(prints) + "\n}\n")
        subprocess.run([os.environ.get("CC", "cc"), f"-I{SOURCE}/include", program.with_suffix(".c"), "-o", program],
                       check=True)
        found = subprocess.run([program], check=True, capture_output=True, text=True).stdout.split("\n")[:-1]
        self.assertEqual(found, expected)


if __name__ == "__main__":
    os.chdir(SCRATCH)
    unittest.main(argv=[sys.argv[0]], verbosity=1)
