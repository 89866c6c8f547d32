"""What the scripts here share: scenes, solutions, arguments, and asking `radiosity`.

Standard library only, so that it runs in each peer's virtual environment.
"""

import argparse
import json
import math
import subprocess
import time
from collections import namedtuple
from pathlib import Path

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parent.parent
SHARED = REPOSITORY.parent / "shared"
REFERENCE = SHARED / "reference" / "cornell.csv"
PROGRAM = REPOSITORY / "target" / "release" / "radiosity"

Triangle = namedtuple("Triangle", "corners area reflectance radiance")
"""An input triangle: three corners, its area, Kd, and Ke (a radiance)."""


def default_scene():
    """The Cornell box of the reference data, else the bundled one."""
    shared = SHARED / "scenes" / "cornell.obj"
    return shared if shared.exists() else REPOSITORY / "scenes" / "cornell.obj"


def read_obj(path):
    """The triangles of an OBJ file in input order, polygons cut into fans."""
    path = Path(path)
    materials, material = {}, None
    vertices, triangles = [], []
    for key, *values in _records(path):
        if key == "v":
            vertices.append(tuple(float(x) for x in values[:3]))
        elif key == "mtllib":
            materials.update(_read_mtl(path.parent / " ".join(values)))
        elif key == "usemtl":
            material = materials[" ".join(values)]
        elif key == "f":
            indices = [int(x.split("/")[0]) for x in values]
            polygon = [vertices[i - 1 if i > 0 else i] for i in indices]
            for b, c in zip(polygon[1:], polygon[2:]):
                corners = (polygon[0], b, c)
                triangles.append(Triangle(corners, area(corners), material["Kd"], material["Ke"]))
    return triangles


def _read_mtl(path):
    materials, current = {}, None
    for key, *values in _records(path):
        if key == "newmtl":
            current = {"Kd": (0.0, 0.0, 0.0), "Ke": (0.0, 0.0, 0.0)}
            materials[" ".join(values)] = current
        elif key in ("Kd", "Ke"):
            current[key] = tuple(float(x) for x in values[:3])
    return materials


def _records(path):
    for line in path.read_text().splitlines():
        words = line.split("#")[0].split()
        if words:
            yield words


def area(corners):
    """Area of a triangle."""
    a, b, c = corners
    u = [q - p for p, q in zip(a, b)]
    v = [q - p for p, q in zip(a, c)]
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return 0.5 * math.hypot(*cross)


def write_solution(path, triangles, reflected):
    """Writes exitance per input triangle: own emission plus what is reflected, per channel."""
    with open(path, "w") as file:
        file.write("triangle,area,B_r,B_g,B_b\n")
        for number, (triangle, light) in enumerate(zip(triangles, reflected)):
            exitance = [math.pi * l + float(r) for l, r in zip(triangle.radiance, light)]
            file.write(",".join(repr(x) for x in [number, triangle.area, *exitance]) + "\n")


def run_program(*command):
    """Standard output of a command of `radiosity`, run to its end."""
    done = subprocess.run([str(x) for x in command], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{command[1]}: {done.stderr.strip()}")
    return done.stdout


def compare(program, solution, reference):
    """E1 of the worst channel and the reference's standard error, by `radiosity compare`."""
    worst = {}
    for line in run_program(program, "compare", solution, reference).splitlines():
        for measure in ("E1", "ref. se"):
            if line.startswith(measure):
                worst[measure] = float(line.split()[-1])
    return worst["E1"], worst.get("ref. se")


def timed(call):
    """What `call` returns, and the wall seconds it took."""
    start = time.perf_counter()
    result = call()
    return result, time.perf_counter() - start


def light_arguments(doc, ladder):
    """The arguments of a script that lights the scene on a ladder of efforts."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("--scene", type=Path, default=default_scene(), help="OBJ file")
    parser.add_argument("--ladder", default=ladder, help=f"efforts [{ladder}]")
    parser.add_argument("--runs", type=int, default=3, help="runs of each effort [3]")
    parser.add_argument("--threads", type=int, default=0, help="0 for all cores [0]")
    parser.add_argument("--work", type=Path, required=True, help="folder for solutions")
    parser.add_argument("--out", type=Path, required=True, help="JSON file for the points")
    return parser


def point(effort, samples=None, first_seconds=None):
    """A place on a ladder, to which `add_run` adds times and solutions."""
    return {
        "effort": str(effort),
        "samples": samples,
        "first_seconds": first_seconds,
        "seconds": [],
        "solutions": [],
    }


def solution_path(work, effort, run):
    """Where a run's solution goes."""
    name = str(effort).replace("%", "").replace(":", "x")
    return work / f"{name}-{run}.csv"


def add_run(place, seconds, solution):
    """Adds a run to a point of a ladder."""
    place["seconds"].append(seconds)
    place["solutions"].append(str(solution))


def write_json(path, value):
    """Writes a value as indented JSON."""
    Path(path).write_text(json.dumps(value, indent=1) + "\n")
