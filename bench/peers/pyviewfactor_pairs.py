"""Form factors by pyViewFactor and by `radiosity form-factors`: errors, and time per pair.

Three comparisons: pairs of polygons whose form factor is known exactly; the same with an occluder
in between, where pyViewFactor decides by one segment between centroids, so that plates are cut
into k x k squares; and all pairs of triangles of a closed box, whose rows sum to 1. Numba compiles
pyViewFactor's functions in a first call that is not counted, but given.
"""

import argparse
import csv
import json
import math
import statistics
import tempfile
from pathlib import Path

import numpy as np
import pyviewfactor as pvf
import pyvista as pv

import common

TOLERANCES = ("1e-3", "1e-6", "1e-9")
UNIT = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
PLATE = [(0.25, 0.25, 0.75), (0.75, 0.25, 0.75), (0.75, 0.75, 0.75), (0.25, 0.75, 0.75)]
PLATE_EXACT = 0.11562060213241502  # NISTIR 6925, Shapiro's test
CUTS = (1, 4, 8, 16)
BOX_CUTS = (2, 4, 8)


def facing(x, y, z):
    """The unit square, moved, turned to face the one at the origin."""
    return [(a + x, b + y, z) for a, b, _ in reversed(UNIT)]


def parallel(distance):
    """Directly opposed unit squares: Howell's catalogue, C-11."""
    x = 1 / distance
    root = math.sqrt(1 + x * x)
    terms = math.log((1 + x * x) / math.sqrt(1 + 2 * x * x))
    terms += 2 * x * root * math.atan(x / root) - 2 * x * math.atan(x)
    return 2 / (math.pi * x * x) * terms


def perpendicular(height):
    """The unit square and one of another height at its edge: Howell's catalogue, C-14."""
    h2 = height * height
    root = math.sqrt(h2 + 1)
    terms = math.atan(1) + height * math.atan(1 / height) - root * math.atan(1 / root)
    product = (h2 * (2 + h2) / (1 + h2) ** 2) ** h2
    return (terms + 0.25 * math.log(product)) / math.pi


def pairs():
    """Name, two polygons facing each other, exact form factor from the first to the second."""
    for distance in (0.1, 1, 10):
        yield f"parallel squares {distance} apart", UNIT, facing(0, 0, distance), parallel(distance)
    for height in (0.1, 1):
        wall = [(0, 0, 0), (0, 1, 0), (0, 1, height), (0, 0, height)]
        yield f"perpendicular, common edge, height {height}", UNIT, wall, perpendicular(height)
    yield "parallel squares, diagonally offset", UNIT, facing(1, 1, 1), 0.043327409574104682
    tilted = [(0, 0, 0), (0, 1, 0), (0.5, 1, math.sqrt(0.75)), (0.5, 0, math.sqrt(0.75))]
    yield "squares hinged at 60 degrees", UNIT, tilted, 0.37090532115005148
    first = [(0, 0, 0), (1, 0, 0), (0.3, 0.9, 0)]
    second = [(0.2, 0.1, 1.3), (0.1, 1.1, 0.7), (1.3, 0.4, 0.9)]
    yield "triangles in general position", first, second, 0.14310075227545979


def mesh(polygons):
    """Polygons as pyVista's mesh."""
    points = np.array([corner for polygon in polygons for corner in polygon], float)
    faces, start = [], 0
    for polygon in polygons:
        faces += [len(polygon), *range(start, start + len(polygon))]
        start += len(polygon)
    return pv.PolyData(points, faces=faces)


def write_obj(path, groups):
    """Groups of polygons as an OBJ file; names and polygons in order."""
    lines, count = ["g scene"], 0
    for name, polygons in groups:
        lines.append(f"g {name}")
        for polygon in polygons:
            lines += ["v " + " ".join(repr(float(x)) for x in corner) for corner in polygon]
            lines.append("f " + " ".join(str(count + i + 1) for i in range(len(polygon))))
            count += len(polygon)
    path.write_text("\n".join(lines) + "\n")


def ours(program, groups, tolerance, threads, between="groups", runs=5):
    """Form factors by name of pair, and the report with the least time of some runs."""
    with tempfile.TemporaryDirectory() as folder:
        scene, factors, report = (Path(folder) / name for name in ("s.obj", "F.csv", "r.json"))
        write_obj(scene, groups)
        best = None
        for _ in range(runs):
            common.run_program(
                program, "form-factors", scene, "-o", factors, "--report", report,
                "--tolerance", tolerance, "--between", between, "--threads", threads,
            )
            found = json.loads(report.read_text())
            if best is None or found["seconds"]["form_factors"] < best["seconds"]["form_factors"]:
                best = found
        with open(factors) as file:
            rows = {(row["i"], row["j"]): float(row["F"]) for row in csv.DictReader(file)}
    return rows, best


def least_time(call, runs=5):
    """What `call` returns, and the least wall seconds of some runs."""
    done = [common.timed(call) for _ in range(runs)]
    return done[0][0], min(seconds for _, seconds in done)


def measure_pairs(args):
    """Errors on the exact pairs, and the time of one call of pyViewFactor."""
    rows = []
    for name, first, second, exact in pairs():
        receiver, source = mesh([second]), mesh([first])
        call = lambda: pvf.compute_viewfactor(receiver, source)
        times = []
        for _ in range(20):
            factor, seconds = common.timed(call)
            times.append(seconds)
        row = {
            "name": name, "exact": exact, "pyviewfactor_error": abs(factor - exact),
            "pyviewfactor_seconds": statistics.median(times), "ours_error": {},
        }
        groups = [("first", [first]), ("second", [second])]
        for tolerance in TOLERANCES:
            found, _ = ours(args.program, groups, tolerance, args.threads, runs=1)
            row["ours_error"][tolerance] = abs(found["first", "second"] - exact)
        rows.append(row)
    return rows


def cut(square, count):
    """A square cut into count x count squares, wound as it is."""
    a, b, _, d = (np.array(corner, float) for corner in square)
    u, v = (b - a) / count, (d - a) / count
    places = [a + i * u + j * v for i in range(count) for j in range(count)]
    return [[place, place + u, place + u + v, place + v] for place in places]


def measure_occluded(args):
    """Unit squares with a plate in between: error against time for both."""
    top = facing(0, 0, 1)
    obstacle = mesh([PLATE]).triangulate()
    rows = []
    for count in CUTS:
        below, above = cut(UNIT, count), cut(top, count)
        faces = mesh(below + above)
        call = lambda: pvf.compute_viewfactor_matrix(faces, obstacles=obstacle)
        matrix, seconds = least_time(call, 3)
        factor = matrix[len(below) :, : len(below)].sum() / len(below)
        rows.append(occluded_row("pyViewFactor", f"{count} x {count}", factor, seconds))
    groups = [("first", [UNIT]), ("second", [top]), ("plate", [PLATE])]
    for tolerance in ("1e-2", "1e-3", "1e-4", "1e-5"):
        found, report = ours(args.program, groups, tolerance, args.threads)
        seconds = report["seconds"]["form_factors"]
        rows.append(occluded_row("radiosity", tolerance, found["first", "second"], seconds))
    return rows


def occluded_row(who, effort, factor, seconds):
    """A row of the comparison with an occluder."""
    return {"who": who, "effort": effort, "error": abs(factor - PLATE_EXACT), "seconds": seconds}


def box(count):
    """Triangles of a unit cube's inside, each face cut into count x count squares of two."""
    triangles = []
    for axis in range(3):
        for side in (0.0, 1.0):
            square = [np.roll((side, u, v), axis) for u, v in [(0, 0), (1, 0), (1, 1), (0, 1)]]
            square = square if side == 0.0 else square[::-1]
            for a, b, c, d in cut(square, count):
                triangles += [[a, b, c], [a, c, d]]
    return triangles


def measure_box(args):
    """All pairs of a closed box: time per pair, and how far the worst row is from a sum of 1."""
    rows = []
    for count in BOX_CUTS:
        triangles = box(count)
        number = len(triangles)
        all_pairs = number * (number - 1) // 2
        faces = mesh(triangles)
        matrix, seconds = least_time(lambda: pvf.compute_viewfactor_matrix(faces), 3)
        defect = float(np.abs(matrix.sum(axis=0) - 1).max())
        rows.append(box_row(number, "pyViewFactor", "", seconds / all_pairs, defect))
        for tolerance in TOLERANCES:
            groups = [("box", triangles)]
            _, report = ours(args.program, groups, tolerance, args.threads, "triangles", 3)
            seconds = report["seconds"]["form_factors"]
            defect = report["raw"]["closure_defect"]
            rows.append(box_row(number, "radiosity", tolerance, seconds / all_pairs, defect))
    return rows


def box_row(triangles, who, effort, seconds, defect):
    """A row of the comparison in a box."""
    return {
        "triangles": triangles, "who": who, "effort": effort,
        "seconds_per_pair": seconds, "row_defect": defect,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=common.PROGRAM)
    parser.add_argument("--threads", type=int, default=0, help="0 for all cores [0]")
    parser.add_argument("--out", type=Path, required=True, help="JSON file for the results")
    args = parser.parse_args()
    if args.threads:
        import numba

        numba.set_num_threads(args.threads)

    pair = mesh([facing(0, 0, 1)]), mesh([UNIT])
    _, first_pair = common.timed(lambda: pvf.compute_viewfactor(*pair))
    both, obstacle = mesh([UNIT, facing(0, 0, 1)]), mesh([PLATE]).triangulate()
    _, first_matrix = common.timed(lambda: pvf.compute_viewfactor_matrix(both, obstacles=obstacle))
    common.write_json(args.out, {
        "version": pvf.__version__,
        "first_seconds": {"pair": first_pair, "matrix": first_matrix},
        "pairs": measure_pairs(args),
        "occluded": measure_occluded(args),
        "box": measure_box(args),
    })


if __name__ == "__main__":
    main()
