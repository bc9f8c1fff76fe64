#!/usr/bin/python3
"""Order of convergence of the raw stress: writes convergence.csv and convergence.png beside itself, prints the orders.

Case II of the paper on finer and finer grids, for both bases. Its closed form is one of small strain, so the pressures are a
ten-thousandth of the paper's: with the full ones the finite strain (the wall moves by 0.011 %) is an error of some 2e-5 that no
grid removes. Linear cells with a single point do without local damping, see docs/method.md. Program: $GAULT, or
build/release/bin/gault; --draw only draws what convergence.csv holds.
"""
import numpy as np

from runs import HERE, plt, run, style, table

CELLS = [12, 25, 50, 100, 200]
FAMILIES = [("linear", 1), ("linear", 4), ("linear", 16), ("quadratic", 4), ("quadratic", 9), ("quadratic", 16)]
RESULTS = {"sigma_r_l2": "radial stress", "sigma_theta_l2": "hoop stress"}
COLORS = {"linear": "#b5432a", "quadratic": "#1f5fa8"}
MARKERS = {1: ("v", 5), 4: ("o", 4), 9: ("^", 4), 16: ("s", 8)} # points a cell: marker and its size


def load(ramp_ms):
    return {
        "boundaries.0.table": f"[[0 s, 0 kPa], [{ramp_ms} ms, 2 kPa], [{3 * ramp_ms} ms, 2 kPa]]",
        "program.pressure": f"[[0 s, 0 kPa], [{ramp_ms} ms, 1 kPa], [{3 * ramp_ms} ms, 1 kPa]]",
        "reference.observers.inner_pressure": "2 kPa",
        "reference.observers.outer_pressure": "1 kPa",
    }


def measure():
    rows = []
    for basis, points in FAMILIES:
        for cells in CELLS:
            calm = {**load(150), "solver.damping": 0} if points == 1 else load(50)
            summary = run("paper/case2.yaml", {**calm, "grid.cells": f"[{cells}, 1]", "grid.basis": basis,
                                               "points.per_cell": points})
            errors = summary["derived"]["thick_cylinder"]
            rows.append({"basis": basis, "points_per_cell": points, "cells": cells,
                         **{name: errors[name] for name in [*RESULTS, "inner_displacement_error"]}})
    return rows


def family(rows, basis, points, result):
    return np.array([row[result] for row in rows if (row["basis"], row["points_per_cell"]) == (basis, points)])


def order(errors):
    """Slope of the line through the three finest grids."""
    return -np.polyfit(np.log(CELLS[-3:]), np.log(errors[-3:]), 1)[0]


def slope_guide(axes, exponent, at):
    x = np.array([70.0, 200.0])
    y = at * (x / x[0]) ** -exponent
    axes.plot(x, y, color="#888888", lw=1, ls=":")
    axes.annotate(f"order {exponent}", (x[1], y[1]), xytext=(4, 0), textcoords="offset points", color="#666666", va="center")


def draw(rows):
    style()
    figure, panels = plt.subplots(1, 2, figsize=(12, 6), layout="constrained", sharey=True)
    figure.suptitle("Elastic thick cylinder (Case II at a ten-thousandth of its load): error of the raw stress of the material points")
    for axes, (result, title) in zip(panels, RESULTS.items()):
        for basis, points in FAMILIES:
            errors = family(rows, basis, points, result)
            marker, size = MARKERS[points]
            axes.loglog(CELLS, errors, marker=marker, ms=size, lw=1.4, color=COLORS[basis], mfc="white" if size < 8 else "none",
                        label=f"{basis}, {points} point{'s' if points > 1 else ''} a cell: order {order(errors):.2f}")
        axes.set(xlabel="cells along the radius (graded)", title=title, xlim=(10, 300))
        axes.set_xticks(CELLS, [str(n) for n in CELLS])
        axes.minorticks_off()
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, fontsize=9)
        for exponent, at in [(1, 5e-3), (2, 7e-5), (3, 1.5e-6)]:
            slope_guide(axes, exponent, at)
    panels[0].set_ylabel("relative L2 error")
    figure.savefig(HERE / "convergence.png", dpi=150)


def main():
    rows = table("convergence.csv", measure)
    for basis, points in FAMILIES:
        print(f"{basis}, {points} a cell:", ", ".join(
            f"{result} {order(family(rows, basis, points, result)):.2f}" for result in RESULTS))
    draw(rows)


if __name__ == "__main__":
    main()
