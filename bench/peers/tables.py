"""Turns the results into markdown tables, and reads times at equal error off the ladders."""

import math
import statistics

TARGETS = (0.05, 0.02, 0.01, 0.005)


def time_to(points, target):
    """Seconds to an E1: ("=", s) between two points, ("<=", s) at the first, else None.

    Straight on logarithmic axes between the last point that is worse and the next; nothing is
    extrapolated.
    """
    points = sorted(points, key=seconds)
    worse = [i for i, p in enumerate(points) if error(p) > target]
    if not worse:
        return "<=", seconds(points[0])
    before = worse[-1]
    if before + 1 == len(points):
        return None
    a, b = points[before], points[before + 1]
    share = math.log(error(a) / target) / math.log(error(a) / error(b))
    return "=", seconds(a) * (seconds(b) / seconds(a)) ** share


def seconds(point):
    """Median seconds of a point's runs."""
    return statistics.median(point["seconds"])


def error(point):
    """Mean E1 of a point's runs."""
    return statistics.fmean(point["e1"])


def slope(points, floor):
    """Slope of log E1 over log samples, by least squares where E1 is twice the floor or more.

    None where efforts are not samples. Noise alone gives -0.5.
    """
    used = [p for p in points if p["samples"] and error(p) >= 2 * floor]
    if len(used) < 2:
        return None
    x = [math.log(p["samples"]) for p in used]
    y = [math.log(error(p)) for p in used]
    return statistics.linear_regression(x, y).slope


def light(results):
    """Time at equal error, then every ladder."""
    yield "## Time at equal error"
    yield ""
    yield f"Seconds to E1 against {results['reference']}, whose standard error is " + (
        f"{percent(results['reference_standard_error'])}."
    )
    yield ""
    yield from table(
        ["", *(percent(t) for t in TARGETS), "slope over samples", "compiling"],
        [
            [
                peer["name"],
                *(target_cell(time_to(peer["points"], t)) for t in TARGETS),
                "" if peer["slope"] is None else f"{peer['slope']:.2f}",
                first_runs(peer["points"]),
            ]
            for peer in results["light"]
        ],
    )
    for peer in results["light"]:
        yield f"### {peer['name']}"
        yield ""
        yield from table(
            ["effort", "samples", "seconds (least–most)", "E1 (least–most)"],
            [
                [
                    p["effort"],
                    f"{p['samples']:,}" if p["samples"] else "",
                    spread(seconds(p), p["seconds"], short),
                    spread(error(p), p["e1"], percent),
                ]
                for p in peer["points"]
            ],
        )


def form_factors(found):
    """The three comparisons with pyViewFactor."""
    yield "## Form factors"
    yield ""
    tolerances = list(found["pairs"][0]["ours_error"])
    yield "Absolute error of a pair."
    yield ""
    yield from table(
        ["", "exact", "pyViewFactor", "its time a call", *(f"radiosity, {t}" for t in tolerances)],
        [
            [
                row["name"], f"{row['exact']:.6g}", f"{row['pyviewfactor_error']:.1e}",
                time(row["pyviewfactor_seconds"]),
                *(f"{e:.1e}" for e in row["ours_error"].values()),
            ]
            for row in found["pairs"]
        ],
    )
    yield "All pairs of a closed box; defect is the largest |row sum − 1|."
    yield ""
    yield from table(
        ["triangles", "", "tolerance", "time a pair", "defect"],
        [
            [
                str(row["triangles"]), row["who"], row["effort"],
                time(row["seconds_per_pair"]), f"{row['row_defect']:.1e}",
            ]
            for row in found["box"]
        ],
    )
    yield "Unit squares 1 apart with a plate in between (Shapiro's test)."
    yield ""
    yield from table(
        ["", "squares a side, or tolerance", "time", "absolute error"],
        [
            [row["who"], row["effort"], time(row["seconds"]), f"{row['error']:.1e}"]
            for row in found["occluded"]
        ],
    )


def table(head, rows):
    """Lines of a markdown table, and an empty one."""
    for row in [head, ["---"] * len(head), *rows]:
        yield "| " + " | ".join(row) + " |"
    yield ""


def target_cell(found):
    """A time at equal error as text."""
    if found is None:
        return "—"
    return ("≤ " if found[0] == "<=" else "") + f"{short(found[1])} s"


def summary(points):
    """All times at equal error, in a line."""
    return ", ".join(f"{percent(t)} {target_cell(time_to(points, t))}" for t in TARGETS)


def first_runs(points):
    """What the first run of the least effort took longer than later ones: compiling."""
    if points[0]["first_seconds"] is None:
        return ""
    return f"+{max(0.0, points[0]['first_seconds'] - seconds(points[0])):.2f} s"


def spread(value, all_values, text):
    """A value, and the least and most of it where they differ."""
    if len(set(all_values)) == 1:
        return text(value)
    return f"{text(value)} ({text(min(all_values))}–{text(max(all_values))})"


def percent(share):
    """A share in percent."""
    return f"{100 * share:.2g} %"


def short(value):
    """Three digits."""
    return f"{value:.3g}"


def time(value):
    """Seconds in a fitting unit."""
    for unit, factor in (("s", 1), ("ms", 1e3), ("µs", 1e6)):
        if value * factor >= 1:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"


def markdown(results):
    """The whole page."""
    machine = results["machine"]
    lines = [
        "# Peers, measured",
        "",
        f"{machine['cores']} cores, {machine['processor']}, {results['date']}; by `run.py`.",
        "",
    ]
    if results["light"]:
        lines += light(results)
    if results["form_factors"]:
        lines += form_factors(results["form_factors"])
    return "\n".join(lines).rstrip() + "\n"
