#!/usr/bin/python3
"""Draws a test of one material point: element.py HISTORY.CSV --output PNG [--title TITLE] [--time]

Stress path, stress against the strain that is driven, volume or pore pressure; a colour a stage, a dot at the start.
Compression positive; a deviator stress below zero is extension along y. --time: one panel shows strain against time.
"""
import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.ticker import LogLocator, NullFormatter

MEAN = "mean effective stress $p'$ (kPa)"
AXIAL = "axial effective stress $\\sigma'_{yy}$ (kPa)"
STRAIN = "axial strain $\\epsilon_{yy}$ (%)"
VOLUME = "volumetric strain $\\epsilon_v$ (%), compression +"
PORE = "excess pore pressure $u$ (kPa)"
TIMES = [(86400, "d"), (3600, "h"), (60, "min"), (1, "s")]


def columns(file):
    header, *rows = csv.reader(Path(file).read_text().splitlines())
    return dict(zip(header, np.array(rows, dtype=float).reshape(-1, len(header)).T))


def varies(x):
    return np.ptp(x) > 1e-6 * np.abs(x).max() + 1e-9


def panels(table, over_time):
    """x, y and their labels, of four panels."""
    p, q = 1e-3 * table["mean_stress_Pa"], 1e-3 * table["deviator_stress_Pa"]
    q = np.where(1e-3 * table["stress_yy_Pa"] < p, -q, q)
    volume = 100 * table["volumetric_strain"]
    pore = 1e-3 * table.get("pore_pressure_Pa", np.zeros_like(p))
    if np.ptp(table["strain_xy"]) > np.ptp(table["strain_yy"]):
        strain, name = 200 * table["strain_xy"], "shear strain $\\gamma_{xy}$ (%)"
        normal, normal_name = 1e-3 * table["stress_yy_Pa"], "normal effective stress $\\sigma'_{yy}$ (kPa)"
        stress, stress_name = 1e-3 * table["stress_xy_Pa"], "shear stress $\\tau_{xy}$ (kPa)"
        ratio_name = "stress ratio $\\tau_{xy}/\\sigma'_{yy}$"
    else:
        strain, name = 100 * table["strain_yy"], STRAIN
        normal, normal_name = p, MEAN
        stress, stress_name = q, "deviator stress $q$ (kPa)"
        ratio_name = "stress ratio $q/p'$"
    yield normal, stress, normal_name, stress_name
    yield strain, stress, name, stress_name
    if name == STRAIN and varies(strain) and not varies(volume - strain):  # an oedometer
        axial, lateral = 1e-3 * table["stress_yy_Pa"], 1e-3 * table["stress_xx_Pa"]
        yield axial, strain, AXIAL, STRAIN
        yield axial, lateral / np.maximum(axial, 1e-9), AXIAL, "lateral over axial stress $\\sigma'_{xx}/\\sigma'_{yy}$"
        return
    yield (strain, pore, name, PORE) if varies(pore) and not varies(volume) else (strain, volume, name, VOLUME)
    if over_time:
        time = table["time_s"]
        seconds, unit = next(pair for pair in TIMES if np.ptp(time) >= 3 * pair[0] or pair[0] == 1)
        yield time / seconds, strain, f"time ({unit})", name
    elif varies(volume) and varies(pore):
        yield strain, pore, name, PORE
    elif varies(volume):
        yield p, volume, MEAN, VOLUME
    else:
        yield strain, stress / np.maximum(normal, 1e-9), name, ratio_name


def draw(panel, stage, colour, x, y, xlabel, ylabel):
    for number in np.unique(stage[1:]):
        rows = np.flatnonzero(stage == number)
        rows = np.r_[rows[0] - 1, rows]  # from where the stage before ended
        panel.plot(x[rows], y[rows], color=colour(number), lw=1.5)
    panel.plot(x[:1], y[:1], "o", color="black", ms=5, zorder=3)
    panel.set(xlabel=xlabel, ylabel=ylabel)
    if not varies(x):
        panel.set_xlim(x[0] - 0.1 * abs(x[0]) - 1, x[0] + 0.1 * abs(x[0]) + 1)
    if (xlabel, ylabel) in ((MEAN, VOLUME), (AXIAL, STRAIN)) and x.min() > 0 and x.max() > 3 * x.min():
        panel.set_xscale("log")
        panel.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        panel.xaxis.set_major_formatter("{x:g}")
        panel.xaxis.set_minor_formatter(NullFormatter())
    if ylabel in (VOLUME, STRAIN) and not xlabel.startswith("time"):
        panel.invert_yaxis()  # compression downwards


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("history", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("-t", "--title", default="")
    parser.add_argument("--time", action="store_true")
    arguments = parser.parse_args()
    table = columns(arguments.history)
    stage = table["stage"]
    last = max(int(stage[-1]), 1)
    colours = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.1, 0.85, last)))
    scale = ScalarMappable(Normalize(0.5, last + 0.5), colours)
    plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True,
                         "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(2, 2, figsize=(10, 8), layout="constrained")
    for panel, content in zip(axes.flat, panels(table, arguments.time)):
        draw(panel, stage, scale.to_rgba, *content)
    if last > 1:
        ticks = np.unique(np.linspace(1, last, min(last, 8)).round())
        figure.colorbar(scale, ax=axes, label="stage", ticks=ticks, fraction=0.03, aspect=50)
    figure.suptitle(arguments.title, fontsize=11)
    figure.savefig(arguments.output, dpi=120)


if __name__ == "__main__":
    main()
