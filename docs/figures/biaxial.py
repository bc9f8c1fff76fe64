#!/usr/bin/python3
"""Shear bands with and without regularisation: writes biaxial.csv, biaxial_fields.csv and biaxial.png beside itself.

configs/hard/biaxial.yaml on cells of 5, 2.5 and 1.25 mm: its load curves, and the plastic strain at the end, mean of the points of each
cell. Without regularisation the length is that of the cells, so nothing is scaled. Program: $GAULT, or build/release/bin/gault; --draw
only draws what the CSV files hold.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from runs import GAULT, HERE, ROOT, plt, style, table

CELLS = {5.0: (8, 20), 2.5: (16, 40), 1.25: (32, 80)} # mm: cells along 40 and 100 mm
COLORS = {5.0: "#9bbfe0", 2.5: "#4f8fc9", 1.25: "#123f70"}
LENGTHS = {0.0: "5 % in every cell", 10.0: "5 % in cells of 10 mm, more in smaller ones"}
UNTIL = 0.7 # mm: where the band has formed


def run(cell, length):
    import h5py
    columns, rows = CELLS[cell]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([GAULT, "run", ROOT / "configs/hard/biaxial.yaml", "-o", Path(folder) / "run", "--quiet",
                        "--set", f"grid.cells=[{columns}, {rows}]",
                        "--set", f"materials.sand.regularisation_length={length or cell} mm"], check=True)
        history = np.genfromtxt(Path(folder) / "run/history.csv", delimiter=",", names=True)
        with h5py.File(Path(folder) / "run/results.h5") as results:
            frame = results["frames"][sorted(results["frames"])[-1]]
            place, strain = frame["reference_position"][:, :2], frame["plastic_strain"][:]
    at = (place // (cell * 1e-3)).astype(int)
    field = np.zeros((rows, columns))
    np.add.at(field, (at[:, 1], at[:, 0]), strain / 4)
    return history["displacement_m"] * 1e3, history["normal_force_N"] / 40, field


def measure():
    curves, fields = [], []
    for length in LENGTHS:
        for cell in CELLS:
            way, load, field = run(cell, length)
            curves += [{"regularisation_length_mm": length, "cell_mm": cell, "displacement_mm": f"{u:.5f}", "load_kPa": f"{p:.2f}"}
                       for u, p in zip(way, load)]
            fields += [[length, cell, *(f"{value:.3g}" for value in row)] for row in field]
    with open(HERE / "biaxial_fields.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["regularisation_length_mm", "cell_mm", "plastic_strain_of_a_row_of_cells"])
        writer.writerows(fields)
    return curves


def curve(rows, length, cell):
    own = [row for row in rows if (float(row["regularisation_length_mm"]), float(row["cell_mm"])) == (length, cell)]
    return np.array([[float(row["displacement_mm"]), float(row["load_kPa"])] for row in own]).T


def field_of(length, cell):
    with open(HERE / "biaxial_fields.csv", newline="") as file:
        rows = list(csv.reader(file))[1:]
    return np.array([[float(value) for value in row[2:]] for row in rows if (float(row[0]), float(row[1])) == (length, cell)])


def band(field, cell):
    """Width, mm, that a band of one strain would have, between x = 10 and 30 mm, and its angle, degrees."""
    rows, columns = field.shape
    y, x = np.meshgrid((np.arange(rows) + 0.5) * cell, (np.arange(columns) + 0.5) * cell, indexing="ij")
    inner = (x > 10) & (x < 30)
    slope = np.polyfit(x[inner], y[inner], 1, w=field[inner])[0]
    width = field[inner].sum() ** 2 / (field[inner] ** 2).sum() * cell**2 / (20 * np.hypot(1, slope))
    return width, np.degrees(np.arctan(slope))


def apart(rows, length, a, b):
    u = np.linspace(UNTIL, 3, 300)
    coarse, fine = (np.interp(u, *curve(rows, length, cell)) for cell in (a, b))
    return np.abs(coarse / fine - 1)


def report(rows):
    for length in LENGTHS:
        for cell in CELLS:
            way, load = curve(rows, length, cell)
            width, angle = band(field_of(length, cell), cell)
            print(f"l {length:g} mm, cells {cell:g} mm: peak {load.max():.1f} kPa, {np.interp(1.0, way, load):.1f} at 1 mm, {load[-1]:.1f} at 3 mm, "
                  f"work {np.trapezoid(load, way) if hasattr(np, 'trapezoid') else np.trapz(load, way):.1f} kPa mm; "
                  f"band {width:.2f} mm = {width / cell:.2f} cells at {angle:.1f} degrees")
        for a, b in [(5.0, 2.5), (2.5, 1.25)]:
            difference = apart(rows, length, a, b)
            print(f"    {a:g} against {b:g} mm from {UNTIL} to 3 mm: {100 * difference.mean():.2f} %, at most {100 * difference.max():.2f} %")


def draw(rows):
    style()
    figure, panels = plt.subplots(2, 4, figsize=(13, 12), layout="constrained", width_ratios=[2.1, 1, 1, 1])
    figure.suptitle("Biaxial test on sand whose friction angle falls from 48 to 36 degrees (a quarter of the specimen, explicit solver)")
    for line, (length, title) in zip(panels, LENGTHS.items()):
        for cell in CELLS:
            line[0].plot(*curve(rows, length, cell), color=COLORS[cell], lw=1.6, label=f"cells of {cell:g} mm")
        line[0].set(xlabel="displacement of the plate, mm", ylabel="axial stress (over the initial width), kPa", ylim=(0, 720), xlim=(0, 3),
                    title=("without regularisation: " if not length else "with it: ") + title)
        line[0].legend(loc="lower right")
        for axes, cell in zip(line[1:], CELLS):
            field = field_of(length, cell)
            width, _ = band(field, cell)
            image = axes.imshow(field, origin="lower", extent=(0, 40, 0, 100), cmap="magma_r", vmin=0, vmax=0.8, interpolation="nearest")
            axes.set(title=f"cells of {cell:g} mm\nband {width:.1f} mm wide", xticks=[0, 20, 40])
            axes.grid(False)
            if axes is not line[1]:
                axes.set_yticklabels([])
        figure.colorbar(image, ax=line[3], label="plastic strain at 3 mm", shrink=0.8)
    figure.savefig(HERE / "biaxial.png", dpi=110)


def main():
    rows = table("biaxial.csv", measure)
    report(rows)
    draw(rows)


if __name__ == "__main__":
    main()
