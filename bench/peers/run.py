"""Runs every peer and ourselves, measures errors, and writes results as JSON and markdown.

Needs Python 3.11 alone; each peer runs in its own virtual environment, made by `setup.sh`.
"""

import argparse
import datetime
import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

import common
import tables

LIGHT = [
    ("radiosity, --error", None, "ours.py", ["--method", "error"]),
    ("radiosity, fixed meshes", None, "ours.py", ["--method", "fixed"]),
    ("Blender Cycles, bake", "blender", "blender_bake.py", []),
    ("Mitsuba, rays, llvm", "mitsuba", "mitsuba_gather.py", ["--method", "rays"]),
    ("Mitsuba, meters, llvm", "mitsuba", "mitsuba_gather.py", ["--method", "meters"]),
    (
        "Mitsuba, meters, scalar", "mitsuba", "mitsuba_gather.py",
        ["--method", "meters", "--variant", "scalar_rgb"],
    ),
]


def interpreter(venvs, peer):
    """The Python that runs a peer's script; None where the peer is missing."""
    if peer is None:
        return Path(sys.executable)
    python = venvs / peer / "bin" / "python"
    return python if python.exists() else None


def environment(venvs, work):
    """Where Mitsuba finds LLVM, and an empty folder for what it compiles."""
    found = dict(os.environ, DRJIT_CACHE_DIR=str(work))
    library = next(iter(sorted(venvs.glob("llvm/usr/lib/*/libLLVM.so.*"))), None)
    if library:
        found.setdefault("DRJIT_LIBLLVM_PATH", str(library))
    return found


def run_script(name, python, script, extra, env, work):
    """The JSON that a script writes, or None, with a line that says why."""
    work.mkdir()
    out, log = work / "out.json", work / "log.txt"
    print(f"{name}: running", flush=True)
    command = [str(x) for x in [python, common.HERE / script, "--out", out, *extra]]
    with open(log, "w") as file:
        code = subprocess.run(command, env=env, stdout=file, stderr=file).returncode
    if code:
        print(f"{name}: failed with exit code {code}")
        print("\n".join(log.read_text().splitlines()[-5:]))
        return None
    return json.loads(out.read_text())


def missing(name, peer, python, extra, env):
    """Whether a peer cannot run, with a line that says so."""
    needs_llvm = peer == "mitsuba" and "scalar_rgb" not in extra
    if python is None:
        print(f"{name}: skipped, no virtual environment {peer}; see setup.sh")
    elif needs_llvm and "DRJIT_LIBLLVM_PATH" not in env:
        print(f"{name}: skipped, no libLLVM; see setup.sh or set DRJIT_LIBLLVM_PATH")
    else:
        return False
    return True


def measure_light(args, work):
    """Ladders of all who light the scene, with errors; the reference's standard error."""
    rows, floor = [], None
    for number, (name, peer, script, extra) in enumerate(LIGHT):
        python, place = interpreter(args.venvs, peer), work / f"light{number}"
        env = environment(args.venvs, work / f"kernels{number}")
        if not chosen(args, name) or missing(name, peer, python, extra, env):
            continue
        (work / f"kernels{number}").mkdir()
        options = [*extra, "--scene", args.scene, "--runs", args.runs, "--threads", args.threads]
        options += ["--work", place] + (["--program", args.program] if peer is None else [])
        found = run_script(name, python, script, options, env, place)
        if found is None:
            continue
        for point in found["points"]:
            solutions = point.pop("solutions")
            errors = [common.compare(args.program, s, args.reference) for s in solutions]
            point["e1"] = [e1 for e1, _ in errors]
            floor = errors[0][1]
        found["slope"] = tables.slope(found["points"], floor or 0.0)
        rows.append({"name": name, **found})
        print(f"{name}: {tables.summary(found['points'])}")
    return rows, floor


def measure_form_factors(args, work):
    """The comparison with pyViewFactor, or None."""
    name = "pyViewFactor"
    python = interpreter(args.venvs, "pyviewfactor")
    if not chosen(args, name) or missing(name, "pyviewfactor", python, [], os.environ):
        return None
    options = ["--program", args.program, "--threads", args.threads]
    env = dict(os.environ)
    return run_script(name, python, "pyviewfactor_pairs.py", options, env, work / "pairs")


def chosen(args, name):
    """Whether a name holds one of the words asked for."""
    return not args.only or any(word.lower() in name.lower() for word in args.only.split(","))


def machine():
    """What it ran on."""
    processor = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        lines = [x for x in info.read_text().splitlines() if x.startswith("model name")]
        processor = lines[0].split(":")[1].strip() if lines else processor
    return {"processor": processor, "cores": os.cpu_count(), "system": platform.platform()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=common.HERE / "results.json")
    parser.add_argument("--program", type=Path, default=common.PROGRAM)
    parser.add_argument("--scene", type=Path, default=common.default_scene())
    parser.add_argument("--reference", type=Path, default=common.REFERENCE)
    parser.add_argument("--venvs", type=Path, default=common.HERE / ".venvs")
    parser.add_argument("--runs", type=int, default=3, help="runs of each effort [3]")
    parser.add_argument("--threads", type=int, default=0, help="0 for all cores [0]")
    parser.add_argument("--only", help="words of names to run, comma-separated, as mitsuba,pyview")
    args = parser.parse_args()
    if not args.program.exists():
        raise SystemExit(f"{args.program}: not there; cargo build --release")
    results = {"date": datetime.date.today().isoformat(), "machine": machine()}

    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        light, floor = [], None
        if args.reference.exists():
            light, floor = measure_light(args, work)
        else:
            print(f"light: skipped, no reference {args.reference}")
        results.update({
            "scene": args.scene.name, "reference": args.reference.name,
            "reference_standard_error": floor, "light": light,
            "form_factors": measure_form_factors(args, work),
        })
    common.write_json(args.out, results)
    args.out.with_suffix(".md").write_text(tables.markdown(results))
    print(f"written: {args.out}, {args.out.with_suffix('.md')}")


if __name__ == "__main__":
    main()
