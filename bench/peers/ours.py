"""Lights the scene with `radiosity solve` on a ladder of stated errors or of element counts.

The time of a run is `seconds.occluder` + `seconds.solve` of its report: meshes, shooting and, with
`--method error`, the statement of the error. Reading and writing are not counted, as for the peers.
"""

import json
from pathlib import Path

import common

LADDERS = {"error": "8%,4%,2%,1%,0.5%", "fixed": "250,1000,4000,16000,64000"}


def settings(method, effort):
    """The flags of `solve` for a place on the ladder."""
    if method == "error":
        return ["--error", effort]
    return ["--elements", effort, "--converge", "0.1%", "--no-statement"]


def main():
    parser = common.light_arguments(__doc__, None)
    parser.add_argument("--program", type=Path, default=common.PROGRAM)
    parser.add_argument("--method", choices=LADDERS, default="error")
    args = parser.parse_args()

    points = []
    for effort in (args.ladder or LADDERS[args.method]).split(","):
        place = common.point(effort)
        for run in range(args.runs):
            solution = common.solution_path(args.work, effort, run)
            report = solution.with_suffix(".json")
            common.run_program(
                args.program, "solve", args.scene, "-o", solution, "--report", report,
                "--threads", args.threads, *settings(args.method, effort),
            )
            seconds = json.loads(report.read_text())["seconds"]
            common.add_run(place, seconds["occluder"] + seconds["solve"], solution)
        points.append(place)
    version = common.run_program(args.program, "--version").split()[-1]
    common.write_json(args.out, {"version": version, "points": points})


if __name__ == "__main__":
    main()
