"""Another program's answer to compression-1d: finite differences, nothing of ours.

    anechoic show compression-1d --export column
    python3 column.py column series.csv
    anechoic score column/scene.toml series.csv --name finite-difference --method dashpot

Velocity and stress on staggered nodes of a column, leapfrog in time. The base takes what comes: its
traction is rho c v, a wave that leaves. Python 3 and nothing else.
"""

import csv
import sys
from pathlib import Path


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def solve(scene, series):
    material = rows(scene / "materials.csv")[0]
    rho, c = float(material["rho_kg_m3"]), float(material["c_p_m_s"])
    load = rows(scene / "load.csv")
    times = [float(line["t_s"]) for line in load]
    dt = times[1]
    mesh = rows(scene / "mesh.csv")
    bottom = min(float(cell["y_min_m"]) for cell in mesh)
    height = max(float(cell["y_max_m"]) for cell in mesh) - bottom
    # As many cells as are stable: with c dt = dx the scheme is exact.
    cells = int(height / (c * dt))
    dx = height / cells
    courant = c * dt / dx
    places = {
        line["name"]: (float(line["y_m"]) - bottom) / dx
        for line in rows(scene / "receivers_places.csv")
    }

    def at(values, place):
        below = min(int(place), cells - 1)
        return values[below] + (place - below) * (values[below + 1] - values[below])

    v = [0.0] * (cells + 1)  # velocities at the nodes, upward, at whole steps
    s = [0.0] * cells  # stresses between them, tension positive, at half steps
    u = dict.fromkeys(places, 0.0)
    with open(series, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["t_s"] + [f"{r}_{q}" for r in places for q in ("ux_m", "uy_m", "vx_m_s", "vy_m_s")])
        for step, time in enumerate(times):
            if step > 0:
                before = {r: at(v, place) for r, place in places.items()}
                for i in range(cells):
                    s[i] += dt * rho * c**2 * (v[i + 1] - v[i]) / dx
                for i in range(1, cells):
                    v[i] += dt * (s[i] - s[i - 1]) / (rho * dx)
                v[0] = ((1 - courant) * v[0] + 2 * dt * s[0] / (rho * dx)) / (1 + courant)
                if float(load[step]["top_prescribed_1"]) == 1:
                    v[cells] = float(load[step]["top_vy_m_s"])
                else:
                    v[cells] -= 2 * dt * s[cells - 1] / (rho * dx)
                for r, place in places.items():
                    u[r] += 0.5 * dt * (before[r] + at(v, place))
            line = [time]
            for r, place in places.items():
                line += [0.0, u[r], 0.0, at(v, place)]
            out.writerow(line)


if __name__ == "__main__":
    solve(Path(sys.argv[1]), sys.argv[2])
