"""Reads what `squirmers flow --vtk` wrote by VTK itself, and checks it. Arguments: the folder, the radii of both spheres.

Needs the packages vtk and numpy. Ends with status 1 and a line for each thing that is wrong.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

folder = Path(sys.argv[1])
radii = [float(radius) for radius in sys.argv[2:4]]
wrong = []


def check(holds, what):
    if not holds:
        wrong.append(what)


def read(path, reader):
    reader.SetFileName(str(path))
    reader.Update()
    check(reader.GetErrorCode() == 0, f"{path.name}: VTK error {reader.GetErrorCode()}")
    return reader.GetOutput()


def arrays(data):
    points = data.GetPointData()
    names = [points.GetArrayName(k) for k in range(points.GetNumberOfArrays())]
    return vtk_to_numpy(data.GetPoints().GetData()), {name: vtk_to_numpy(points.GetArray(name)) for name in names}


def surface(path, radius):
    grid = read(path, vtk.vtkXMLUnstructuredGridReader())
    points, data = arrays(grid)
    count = len(points)
    check(grid.GetNumberOfCells() == 2 * count - 4, f"{path.name}: its triangles do not close a sphere")
    check(all(len(values) == count for values in data.values()), f"{path.name}: arrays of other lengths than the points")
    for name in ["slip", "surface_velocity", "velocity", "traction"]:
        check(name in data and data[name].shape == (count, 3), f"{path.name}: no vectors '{name}'")
    # The centre by least squares: |x|^2 - 2 x.c = r^2 - |c|^2.
    middle = points.mean(axis=0)
    about = points - middle
    solved = np.linalg.lstsq(np.c_[2 * about, np.ones(count)], (about**2).sum(axis=1), rcond=None)[0]
    centre = solved[:3] + middle
    found = np.linalg.norm(points - centre, axis=1)
    check(np.abs(found - radius).max() < 1e-9, f"{path.name}: radius {found.min()} to {found.max()}, not {radius}")
    normals = (points - centre) / radius
    check(np.abs((data["slip"] * normals).sum(axis=1)).max() < 1e-9, f"{path.name}: the slip is not tangential")
    # What is left of the surface velocity is U + omega x (radius n).
    rigid = data["surface_velocity"] - data["slip"]
    zero = np.zeros(count)
    x, y, z = radius * normals.T
    rows = [np.stack([one, zero, zero, *turn], axis=1) for one, turn in [
        (zero + 1, (zero, z, -y)),
        (zero + 1, (-z, zero, x)),
        (zero + 1, (y, -x, zero)),
    ]]
    for k, row in enumerate(rows):
        row[:, :3] = 0
        row[:, k] = 1
    system = np.concatenate(rows)
    right = rigid.T.reshape(-1)
    motion = np.linalg.lstsq(system, right, rcond=None)[0]
    check(np.abs(system @ motion - right).max() < 1e-9, f"{path.name}: the surface velocity is no rigid motion and slip")
    off = np.linalg.norm(data["velocity"] - data["surface_velocity"], axis=1).max()
    size = np.linalg.norm(data["surface_velocity"], axis=1).max()
    check(off <= TOLERANCE * max(size, 1e-300), f"{path.name}: the fluid's velocity is {off} off that of the surface")
    return centre


def plane(path, centres):
    grid = read(path, vtk.vtkXMLStructuredGridReader())
    points, data = arrays(grid)
    side = int(np.sqrt(len(points)))
    dimensions = [0, 0, 0]
    grid.GetDimensions(dimensions)
    check(side * side == len(points) and dimensions == [side, side, 1], f"{path.name}: no square grid")
    rows = folder / (path.stem + ".csv")
    lines = np.genfromtxt(rows, delimiter=",", names=True, dtype=None, encoding="utf-8")
    check(len(lines) == len(points), f"{path.name}: {len(points)} points, {len(lines)} rows")
    for k, name in enumerate("xyz"):
        check(np.array_equal(points[:, k], lines[name]), f"{path.name}: {name} differs from the rows")
        same = np.array_equal(data["velocity"][:, k], lines[f"u_{name}"], equal_nan=True)
        check(same, f"{path.name}: velocity along {name} differs from the rows")
    for name in ["speed", "pressure"]:
        check(np.array_equal(data[name], lines[name], equal_nan=True), f"{path.name}: {name} differs from the rows")
    for k in [0, 1]:
        within = np.linalg.norm(points - centres[k], axis=1) < radii[k]
        check(np.array_equal(within, data["inside"] == k + 1), f"{path.name}: points within squirmer {k + 1}")
    check(np.array_equal(np.isnan(data["speed"]), data["inside"] > 0), f"{path.name}: velocities within spheres")
    return float(lines["t"][0])


# A flow meets the velocity of the surfaces within this share of the largest.
TOLERANCE = float(sys.argv[4]) if len(sys.argv) > 4 else 2e-2

parts = ElementTree.parse(folder / "flow.pvd").getroot().find("Collection").findall("DataSet")
by_time = {}
for part in parts:
    by_time.setdefault(float(part.get("timestep")), {})[int(part.get("part"))] = folder / part.get("file")
check(len(by_time) > 0, "flow.pvd: no times")
for time, files in sorted(by_time.items()):
    check(sorted(files) == [0, 1, 2], f"flow.pvd: parts {sorted(files)} at {time}")
    centres = [surface(files[k + 1], radii[k]) for k in [0, 1]]
    check(plane(files[0], centres) == time, f"{files[0].name}: not of the time {time}")

print("\n".join(wrong) if wrong else f"{len(by_time)} instants are read by VTK {vtk.VTK_VERSION} as they were written")
sys.exit(1 if wrong else 0)
