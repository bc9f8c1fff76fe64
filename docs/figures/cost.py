#!/usr/bin/python3
"""What accuracy costs: Fahey's test on finer grids and with more mass, error against wall time. Writes cost.csv and cost.png
beside itself. Program: $GAULT, or build/release/bin/gault; --draw only draws what cost.csv holds. Wall times are those of one run
on the machine at hand, whatever else it does."""
from runs import HERE, plt, run, style, table

CELLS = [18, 36, 72, 144]
SCALINGS = [25, 100, 400]
POINTS = [4, 16]
RESULTS = {"pressure": "cavity pressure, largest error from 0.5 to 10 %", "sigma_r_l2": "raw radial stress at 10 %, L2 error"}
COLORS = dict(zip(SCALINGS, ["#1f5fa8", "#2a9d6f", "#b5432a"]))


def measure():
    rows = []
    for points in POINTS:
        for scaling in SCALINGS:
            for cells in CELLS:
                summary = run("paper/fahey.yaml", {"grid.cells": f"[{cells}, 1]", "points.per_cell": points,
                                                   "solver.mass_scaling": scaling})
                rows.append({"points_per_cell": points, "mass_scaling": scaling, "cells": cells,
                             "pressure": summary["reference"]["curves"][0]["largest_relative_error"],
                             "sigma_r_l2": summary["reference"]["profiles"][-1]["sigma_r_l2"],
                             "steps": summary["counts"]["steps"],
                             "wall_seconds": round(summary["wall_seconds"]["total"], 2)})
    return rows


def draw(rows):
    style()
    figure, panels = plt.subplots(1, 2, figsize=(12, 6), layout="constrained")
    figure.suptitle("Fahey's test: error against wall time, 18 to 144 graded cells along the radius")
    for axes, (result, title) in zip(panels, RESULTS.items()):
        for points, line, marker in zip(POINTS, ["-", "--"], ["o", "s"]):
            for scaling in SCALINGS:
                mine = [row for row in rows if (row["points_per_cell"], row["mass_scaling"]) == (points, scaling)]
                time, error = [row["wall_seconds"] for row in mine], [100 * row[result] for row in mine]
                axes.loglog(time, error, ls=line, marker=marker, ms=5, lw=1.4, color=COLORS[scaling], mfc="white",
                            label=f"mass x {scaling}, {points} points a cell")
                if scaling == SCALINGS[0]:
                    for row, x, y in zip(mine, time, error):
                        axes.annotate(row["cells"], (x, y), xytext=(5, 4), textcoords="offset points", fontsize=8, color="#666666")
        axes.set(xlabel="wall time (s)", ylabel="relative error (%)", title=title)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter("{x:g}")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, fontsize=9)
    figure.savefig(HERE / "cost.png", dpi=150)


def main():
    draw(table("cost.csv", measure))


if __name__ == "__main__":
    main()
