"""Lights the scene by Mitsuba 3: gathers light at every input triangle with its path integrator.

`--method meters` gives each triangle an irradiancemeter, all rendered as one batch; then B = E +
reflectance times irradiance. `--method rays` looks at uniform points of each triangle from just in
front, so that the integrator samples the lamps there too; then B = E + pi times radiance. The time
of a run is that of rendering and fetching the result. Every effort is run once before, which
compiles its kernel in the llvm variants; that run's time is kept apart.

The scene is scaled to an extent of 10: Mitsuba computes in f32, and meters start their rays at a
fixed distance of 9e-5 in front of the surface, which f32 loses in a scene of several hundred units.
"""

import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

import common

EXTENT = 10.0
LIFT = 4e-5 * EXTENT
LADDERS = {"rays": "16,64,256,1024,4096,16384,65536", "meters": "256,1024,4096,16384,65536,262144"}


def scaled_corners(triangles):
    """Corners of all triangles, scaled."""
    corners = np.array([triangle.corners for triangle in triangles])
    return corners * (EXTENT / np.ptp(corners.reshape(-1, 3), axis=0).max())


def load(triangles, corners, folder, meters):
    """The scene, a shape for each triangle; Mitsuba's diffuse surfaces and lamps are one-sided."""
    scene = {"type": "scene"}
    for number, (triangle, places) in enumerate(zip(triangles, corners)):
        file = Path(folder) / f"{number}.obj"
        vertices = "".join("v %r %r %r\n" % tuple(float(x) for x in place) for place in places)
        file.write_text(vertices + "f 1 2 3\n")
        shape = {
            "type": "obj",
            "filename": str(file),
            "face_normals": True,
            "bsdf": {"type": "diffuse", "reflectance": rgb(triangle.reflectance)},
        }
        if any(triangle.radiance):
            shape["emitter"] = {"type": "area", "radiance": rgb(triangle.radiance)}
        if meters:
            shape["sensor"] = {"type": "irradiancemeter", "film": film(1)}
        scene[f"triangle{number:06}"] = shape
    # Merging equal parts would give the meters of several triangles to one.
    return mi.load_dict(scene, optimize=not meters)


def rgb(value):
    """A colour."""
    return {"type": "rgb", "value": list(value)}


def film(width):
    """A film of one row of f32 colours."""
    return {
        "type": "hdrfilm", "width": width, "height": 1, "pixel_format": "rgb",
        "component_format": "float32", "rfilter": {"type": "box"},
    }


def with_meters(triangles, corners, folder, integrator):
    """A function that gathers with irradiance meters."""
    scene = load(triangles, corners, folder, True)
    meters = {f"meter{i:06}": meter for i, meter in enumerate(scene.sensors())}
    batch = mi.load_dict({"type": "batch", "film": film(len(triangles)), **meters})
    reflectance = np.array([triangle.reflectance for triangle in triangles])

    def gather(samples, seed):
        image = mi.render(scene, sensor=batch, integrator=integrator, spp=samples, seed=seed)
        return np.array(image).reshape(-1, 3) * reflectance

    return gather


def with_rays(triangles, corners, folder, integrator):
    """A function that gathers with rays onto the surfaces, stratified on each triangle."""
    import drjit as dr

    scene = load(triangles, corners, folder, False)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    a, b, c = (mi.Point3f(corners[:, k].T) for k in range(3))
    up = mi.Vector3f(normals.T)
    emitted = np.pi * np.array([triangle.radiance for triangle in triangles])

    def gather(samples, seed):
        sampler = mi.load_dict({"type": "multijitter", "sample_count": samples})
        sampler.set_samples_per_wavefront(samples)
        count = samples * len(triangles)
        sampler.seed(seed, count)
        which = dr.arange(mi.UInt32, count) // samples
        uv = mi.warp.square_to_uniform_triangle(sampler.next_2d())
        a_, b_, c_ = (dr.gather(mi.Point3f, corner, which) for corner in (a, b, c))
        normal = dr.gather(mi.Vector3f, up, which)
        place = a_ + (b_ - a_) * uv.x + (c_ - a_) * uv.y
        ray = mi.RayDifferential3f(mi.Ray3f(place + normal * LIFT, -normal))
        radiance, _, _ = integrator.sample(scene, sampler, ray)
        sums = [np.array(dr.block_sum(channel, samples)) for channel in radiance]
        return np.stack(sums, axis=1) * (np.pi / samples) - emitted

    return gather


def main():
    parser = common.light_arguments(__doc__, None)
    parser.add_argument("--method", choices=LADDERS, default="rays")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="scalar_rgb: meters only")
    args = parser.parse_args()
    triangles = common.read_obj(args.scene)

    with tempfile.TemporaryDirectory() as folder:
        mi.set_variant(args.variant)
        if args.threads:
            import drjit as dr

            dr.set_thread_count(args.threads)
        integrator = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 5})
        method = with_rays if args.method == "rays" else with_meters
        gather = method(triangles, scaled_corners(triangles), folder, integrator)

        points = []
        for effort in (args.ladder or LADDERS[args.method]).split(","):
            samples = int(effort)
            _, first = common.timed(lambda: gather(samples, args.runs))
            place = common.point(effort, samples * len(triangles), first)
            for run in range(args.runs):
                reflected, seconds = common.timed(lambda: gather(samples, run))
                solution = common.solution_path(args.work, effort, run)
                common.write_solution(solution, triangles, reflected)
                common.add_run(place, seconds, solution)
            points.append(place)
    common.write_json(args.out, {"version": mi.__version__, "points": points})


if __name__ == "__main__":
    main()
