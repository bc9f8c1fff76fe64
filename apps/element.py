#!/usr/bin/python3
"""Draws a test of one material point: element.py HISTORY.CSV -o PNG [-t TITLE]

Stress path, deviator stress and volume against the strain that is driven, and pore pressure where no water moved.
Compression positive.
"""
import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

LINE = "#1f5fa8"


def columns(file):
    header, *rows = csv.reader(Path(file).read_text().splitlines())
    return dict(zip(header, np.array(rows, dtype=float).reshape(-1, len(header)).T))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("history", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("-t", "--title", default="")
    arguments = parser.parse_args()
    table = columns(arguments.history)
    sheared = np.ptp(table["strain_xy"]) > np.ptp(table["strain_yy"])
    strain = 200 * table["strain_xy"] if sheared else 100 * table["strain_yy"]
    name = "shear strain $\\gamma_{xy}$ (%)" if sheared else "axial strain $\\epsilon_{yy}$ (%)"
    p, q = 1e-3 * table["mean_stress_Pa"], 1e-3 * table["deviator_stress_Pa"]
    shear = 1e-3 * table["stress_xy_Pa"]
    panels = [(p, q, "mean effective stress p' (kPa)", "deviator stress q (kPa)"),
              (strain, shear if sheared else q, name, "shear stress $\\tau_{xy}$ (kPa)" if sheared else "deviator stress q (kPa)"),
              (strain, 100 * table["volumetric_strain"], name, "volumetric strain (%), compression positive")]
    if "pore_pressure_Pa" in table:
        panels.append((strain, 1e-3 * table["pore_pressure_Pa"], name, "excess pore pressure (kPa)"))
    else:
        panels.append((p, 100 * table["volumetric_strain"], "mean effective stress p' (kPa)", "volumetric strain (%)"))
    plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True,
                         "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(2, 2, figsize=(10, 8), layout="constrained")
    for panel, (x, y, xlabel, ylabel) in zip(axes.flat, panels):
        panel.plot(x, y, color=LINE, lw=1.6)
        panel.plot(x[:1], y[:1], "o", color=LINE, ms=5)
        panel.set(xlabel=xlabel, ylabel=ylabel)
    axes[0, 0].set_ylim(bottom=0)
    figure.suptitle(arguments.title, fontsize=11)
    figure.savefig(arguments.output, dpi=120)


if __name__ == "__main__":
    main()
