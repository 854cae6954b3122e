#!/usr/bin/env python3
"""Runs the tank of hapflow's case `buoyancy` in SPlisHSPlasH, and prints one line of JSON for each method:

    {"case", "who", "particles", "error", "noise", "cpu_s_per_sim_s"}

A ball of 80 mm radius is held at the middle of a cube of water of 0.4 m; `error` is that of its mean lift against
Archimedes over the last quarter of the time, `noise` the deviation of its steps. Needs the packages pysplishsplash
(2.19.0) and numpy. See README.md beside this file.
"""

import argparse
import json
import math
import os
import struct
import sys
import tempfile
import time

SIDE, RADIUS, GRAVITY, DENSITY = 0.4, 0.08, 9.81, 1000.0
# A wall's samples stand this many spacings behind it, where the density before it is that at rest.
BEHIND = 0.6
# The wheel brings a libGLdispatch that clashes with the system's.
DISPATCH = "/lib/x86_64-linux-gnu/libGLdispatch.so.0"


def restart_with_library(threads):
    """Starts this program again with what must be set before it loads."""
    wanted = {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}
    if os.path.exists(DISPATCH):
        wanted["LD_PRELOAD"] = DISPATCH
    if any(os.environ.get(name) != value for name, value in wanted.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **wanted})


def lattice(cells, dx):
    """Water, without what is in the ball or just before it."""
    import numpy as np

    line = (np.arange(cells) + 0.5) * dx
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), -1).reshape(-1, 3)
    return points[np.linalg.norm(points - SIDE / 2, axis=1) > RADIUS + 0.25 * dx]


def walls(cells, dx):
    """One layer of samples round an open box half as high again as the water."""
    import numpy as np

    high = cells * 3 // 2
    k = np.stack(np.meshgrid(*(np.arange(-1, n + 1) for n in (cells, high, cells)), indexing="ij"), -1)
    k = k.reshape(-1, 3)
    shell = (k[:, 1] < high) & ((k < 0).any(1) | (k[:, 0] >= cells) | (k[:, 2] >= cells))
    k = k[shell]
    places = (k + 0.5) * dx
    places = np.where(k < 0, -BEHIND * dx, places)
    far = np.array([cells, np.iinfo(int).max, cells])
    return np.where(k >= far, (cells + BEHIND) * dx, places)


def ball(dx):
    """Samples on a sphere behind the ball's surface, about one for each square of the spacing."""
    import numpy as np

    count = round(4 * math.pi * (RADIUS / dx) ** 2)
    k = np.arange(count) + 0.5
    height, turn = 1 - 2 * k / count, math.pi * (1 + math.sqrt(5)) * k
    level = np.sqrt(1 - height**2)
    return (RADIUS - BEHIND * dx) * np.stack([level * np.cos(turn), height, level * np.sin(turn)], 1)


def write_points(path, points):
    """A BGEO file (Houdini, version 5) of points alone."""
    with open(path, "wb") as file:
        file.write(b"BgeoV" + struct.pack(">9i", 5, len(points), 0, 0, 0, 0, 0, 0, 0))
        for x, y, z in points:
            file.write(struct.pack(">4f", x, y, z, 1.0))
        file.write(b"\x00\xff")


def write_octahedron(path):
    """A closed surface, which every body must have; what counts are the samples."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6), (1, 4, 6)]
    with open(path, "w", encoding="ascii") as file:
        file.writelines(f"v {RADIUS * x} {RADIUS * y} {RADIUS * z}\n" for x, y, z in corners)
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in faces)


def write_scene(folder, method, cells):
    """The scene file; the time step is the one of the dated figures."""
    dx, sound = SIDE / cells, 10 * math.sqrt(2 * GRAVITY * SIDE)
    step = 0.4 * dx / (sound if method == "WCSPH" else math.sqrt(2 * GRAVITY * SIDE))
    write_points(f"{folder}/water.bgeo", lattice(cells, dx))
    write_points(f"{folder}/walls.bgeo", walls(cells, dx))
    write_points(f"{folder}/ball.bgeo", ball(dx))
    write_octahedron(f"{folder}/solid.obj")
    solve = {"minIterations": 2, "maxIterations": 100, "maxError": 0.05, "maxIterationsV": 100, "maxErrorV": 0.1}
    body = {"geometryFile": "solid.obj", "rotationAxis": [1, 0, 0], "rotationAngle": 0, "scale": [1, 1, 1]}
    middle = [SIDE / 2] * 3
    scene = {
        "Configuration": {
            "particleRadius": dx / 2,
            "simulationMethod": {"WCSPH": 0, "DFSPH": 4}[method],
            "gravitation": [0, -GRAVITY, 0],
            "timeStepSize": step,
            "cflMethod": 0,
            "boundaryHandlingMethod": 0,
            "enableZSort": True,
            "WCSPH": {"stiffness": DENSITY * sound**2 / 7, "exponent": 7},
            "DFSPH": {**solve, "enableDivergenceSolver": True},
        },
        "Simulation": {"timeStepSize": step},
        "Materials": [
            {
                "id": "Fluid",
                "density0": DENSITY,
                "viscosityMethod": 1,
                "Standard viscosity": {"viscosity": 0.01, "viscosityBoundary": 0.0},
            }
        ],
        "FluidModels": [
            {"id": "Fluid", "particleFile": "water.bgeo", "translation": [0, 0, 0], "rotationAxis": [1, 0, 0],
             "rotationAngle": 0, "scale": [1, 1, 1]}
        ],
        "RigidBodies": [
            {**body, "id": 1, "particleFile": "walls.bgeo", "translation": [0, 0, 0], "isDynamic": False,
             "isWall": True},
            {**body, "id": 2, "particleFile": "ball.bgeo", "translation": middle, "isDynamic": True,
             "density": DENSITY, "isWall": False},
        ],
    }
    with open(f"{folder}/scene.json", "w", encoding="ascii") as file:
        json.dump(scene, file)
    return middle, step


def run(method, cells, seconds, limit):
    """Steps the tank; only the steps themselves count as cost. Returns the line."""
    import numpy as np
    import pysplishsplash as sph

    with tempfile.TemporaryDirectory(prefix="peers-") as folder:
        middle, step = write_scene(folder, method, cells)
        base = sph.Exec.SimulatorBase()
        base.init(sceneFile=f"{folder}/scene.json", useGui=False, useCache=False, outputDir=folder,
                  initialPause=False)
        base.initSimulation()
        base.setValueFloat(base.STOP_AT, 1e-12)
        base.runSimulation()
        simulation, clock = sph.Simulation.getCurrent(), sph.TimeManager.getCurrent()
        stepper, samples = simulation.getTimeStep(), simulation.getBoundaryModel(1)
        held = samples.getRigidBodyObject()
        # The loader has made a step, in which the ball fell.
        held.setVelocity([0, 0, 0])
        held.setAngularVelocity([0, 0, 0])
        held.setPosition(middle)
        base.updateBoundaryParticles(True)
        mass, lift, costs = held.getMass(), [], []
        begun = time.monotonic()
        while clock.getTime() < seconds and time.monotonic() - begun < limit:
            samples.clearForceAndTorque()
            before = time.process_time()
            stepper.step()
            costs.append(time.process_time() - before)
            # A force is only told as what it does to a body that moves; this one is put back each time.
            base.getBoundarySimulator().updateBoundaryForces()
            lift.append(held.getVelocity()[1] * mass / step)
            held.setVelocity([0, 0, 0])
            held.setAngularVelocity([0, 0, 0])
        tail = np.array(lift[len(lift) * 3 // 4:])
        archimedes = DENSITY * GRAVITY * 4 / 3 * math.pi * RADIUS**3
        return {
            "case": "buoyancy",
            "who": f"SPlisHSPlasH {method}" + (" 0.05 %" if method == "DFSPH" else ""),
            "particles": simulation.getFluidModel(0).numActiveParticles(),
            "error": abs(float(tail.mean()) / archimedes - 1),
            "noise": float(tail.std()) / archimedes,
            "cpu_s_per_sim_s": float(np.median(costs[len(costs) // 5:])) / step,
            "simulated_s": clock.getTime(),
        }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("method", choices=["DFSPH", "WCSPH"], nargs="?", default="DFSPH")
    parser.add_argument("--cells", type=int, default=22, help="particles along the water's side")
    parser.add_argument("--seconds", type=float, default=1.0, help="simulated time")
    parser.add_argument("--limit", type=float, default=300.0, help="longest time on the wall, s")
    parser.add_argument("--threads", type=int, default=2)
    args = parser.parse_args()
    restart_with_library(args.threads)
    # The peer talks on the standard output; the line shall stand there alone.
    lines = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    print(json.dumps(run(args.method, args.cells, args.seconds, args.limit)), file=lines, flush=True)
    # Its destructors do not end well.
    os._exit(0)


if __name__ == "__main__":
    main()
