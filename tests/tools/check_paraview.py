#!/usr/bin/env python3
"""Opens the files of a run directory with VTK's own reader and with h5py, as a user would.

Usage: check_paraview.py DIRECTORY. Every snapshot that run.h5 holds must be in paraview/ with the same numbers, every
dataset must carry unit and description, every vector must have three components. Works on a run that goes on and on one
that has ended. Exit status: 0 right, 1 wrong, 77 skipped because a module is missing.
"""
import os
import sys
import xml.etree.ElementTree as tree

try:
    import h5py
    import numpy
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

WALL = 0xFFFFFFF0


def require(condition, text):
    if not condition:
        print(f"wrong: {text}")
        sys.exit(1)


def read(path):
    """The PolyData of a file; the reader must not complain."""
    reader = vtk.vtkXMLPolyDataReader()
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append(path))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append(path))
    reader.SetFileName(path)
    reader.Update()
    require(not complaints and reader.GetErrorCode() == 0, f"VTK cannot read {path}")
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


def collection(folder, kind):
    """Times and files of a .pvd."""
    root = tree.parse(os.path.join(folder, kind + ".pvd")).getroot()
    return [(float(e.get("timestep")), os.path.join(folder, e.get("file"))) for e in root.iter("DataSet")]


def plane(array):
    require(array.shape[1] == 3 and not array[:, 2].any(), "a vector in the plane has no third component 0")
    return array[:, :2]


def single(stored):
    """As ParaView files have it."""
    stored = stored[...]
    return stored.astype(numpy.float32) if stored.dtype == numpy.float64 else stored


def same(name, mine, theirs):
    mine = plane(mine) if mine.ndim == 2 else mine
    require(mine.dtype != numpy.float64, f"'{name}' is not in single precision")
    require(numpy.array_equal(mine, single(theirs)), f"'{name}' differs between ParaView and HDF5")


def check_discs(path, group, time):
    discs = read(path)
    count = group["position"].shape[0]
    require(discs.GetNumberOfPoints() == discs.GetNumberOfVerts() == count, f"{path}: number of discs")
    require(arrays(discs.GetFieldData())["TimeValue"][0] == time == group.attrs["time"], f"{path}: time")
    data = arrays(discs.GetPointData())
    same("position", vtk_to_numpy(discs.GetPoints().GetData()), group["position"])
    names = {name for name in group if isinstance(group[name], h5py.Dataset)}
    require(set(data) == names, f"{path}: fields {sorted(set(data) ^ names)}")
    for name in names:
        same(name, data[name], group[name])
        unit = group[name].attrs["unit"].decode()
        label = discs.GetPointData().GetArray(name).GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL())
        require((label or "1") == unit, f"{path}: unit of '{name}'")
    require(numpy.array_equal(data["id"], numpy.arange(count)), f"{path}: order of ids")


def check_contacts(path, group):
    lines = read(path)
    contacts = group["contacts"]
    data = arrays(lines.GetCellData())
    require(lines.GetNumberOfLines() == contacts["first"].shape[0], f"{path}: number of contacts")
    for name in contacts:
        same(name, data[name], contacts[name])
    points = plane(vtk_to_numpy(lines.GetPoints().GetData())) if lines.GetNumberOfPoints() else numpy.zeros((0, 2))
    position = single(group["position"])
    first, second = contacts["first"][...], contacts["second"][...]
    walls = second >= WALL
    require(numpy.array_equal(points[0::2], position[first]), f"{path}: where lines begin")
    require(numpy.array_equal(points[1::2][~walls], position[second[~walls]]), f"{path}: where lines end")
    require(numpy.array_equal(points[1::2][walls], single(contacts["point"])[walls]), f"{path}: where walls are touched")
    force = numpy.hypot(*plane(data["force"]).T) if len(first) else numpy.zeros(0)
    expected = numpy.hypot(contacts["normal_force"][...], contacts["tangential_force"][...])
    require(numpy.allclose(force, expected, rtol=1e-6), f"{path}: force")  # single precision


def check_boundary(path, group):
    boundary = read(path)
    loop = group["boundary/id"][...]
    require(boundary.GetNumberOfLines() == boundary.GetNumberOfPoints() == len(loop), f"{path}: edges")
    same("loaded", arrays(boundary.GetCellData())["loaded"], group["boundary/loaded"])
    for k in range(len(loop)):
        ends = boundary.GetCell(k).GetPointIds()
        require((ends.GetId(0), ends.GetId(1)) == (k, (k + 1) % len(loop)), f"{path}: edge {k} is not closed")
    if len(loop):
        same("boundary", vtk_to_numpy(boundary.GetPoints().GetData()), group["position"][...][loop])


def check_plates(path, group):
    plates = read(path)
    active = group["walls/active"][...] == 1
    require(plates.GetNumberOfLines() == active.sum(), f"{path}: number of plates")
    same("force", arrays(plates.GetCellData())["force"], group["walls/force"][...][active])
    for k, (normal, position) in enumerate(zip(group["walls/normal"][...][active], group["walls/position"][...][active])):
        for e in range(2):
            point = plates.GetCell(k).GetPoints().GetPoint(e)[:2]
            # lengths up to 1 m in single precision
            require(abs(numpy.dot(normal[:2], point) - position) < 1e-7, f"{path}: plate {k} lies elsewhere")


def check_all(folder, scenes, count):
    """The one collection of everything: each file of the others is a block of its snapshot."""
    entries = collection(folder, "all")
    require(len(entries) == count, f"all.pvd has {len(entries)} entries")
    for k, (time, path) in enumerate(entries):
        require(time == scenes["discs"][k][0], f"{path}: time")
        reader = vtk.vtkXMLMultiBlockDataReader()
        reader.SetFileName(path)
        reader.Update()
        blocks = reader.GetOutput()
        names = [blocks.GetMetaData(b).Get(vtk.vtkCompositeDataSet.NAME()) for b in range(blocks.GetNumberOfBlocks())]
        require(set(scenes) <= set(names), f"{path}: blocks {names}")
        discs = blocks.GetBlock(names.index("discs"))
        require(discs.GetNumberOfPoints() == read(scenes["discs"][k][1]).GetNumberOfPoints(), f"{path}: discs")


def check_attributes(name, item):
    if isinstance(item, h5py.Dataset):
        require(item.attrs["unit"] and item.attrs["description"], f"'{name}' has no unit or description")


def main(directory):
    folder = os.path.join(directory, "paraview")
    scenes = {kind: collection(folder, kind) for kind in ("discs", "contacts", "boundary", "plates")}
    with h5py.File(os.path.join(directory, "run.h5"), "r") as run:
        for name in ("program", "case", "conventions"):
            require(run.attrs[name], f"run.h5 has no attribute '{name}'")
        snapshots = sorted(run["snapshots"])
        for kind, entries in scenes.items():
            require(len(entries) == len(snapshots), f"{kind}.pvd has {len(entries)} entries, run.h5 {len(snapshots)}")
        for k, number in enumerate(snapshots):
            group = run["snapshots"][number]
            group.visititems(check_attributes)
            check_discs(scenes["discs"][k][1], group, scenes["discs"][k][0])
            check_contacts(scenes["contacts"][k][1], group)
            check_boundary(scenes["boundary"][k][1], group)
            check_plates(scenes["plates"][k][1], group)
        check_all(folder, scenes, len(snapshots))
        for number in run["checkpoints"]:
            run["checkpoints"][number].visititems(check_attributes)
    print(f"{len(snapshots)} snapshots: run.h5 and paraview/ agree")


main(sys.argv[1])
