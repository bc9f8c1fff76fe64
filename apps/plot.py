#!/usr/bin/python3
"""Draws the results of a run and prints its main numbers: plot.py RESULTS_DIR -o PNG [--measured KPA]

Left, the cavity pressure against the cavity strain; right, the radial stress of the raw material points against their
current radius at each frame; references are those that summary.json names. What a run does not have is left out.
"""
import argparse
import csv
import json
import re
import sys
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

MOST_FRAMES = 8  # more are thinned out: a plot of fifty profiles says nothing
LINE, REFERENCE, MEASURED = "#1f5fa8", "#222222", "#b5432a"


def columns(file):
    """A CSV file as {header: numbers}; a last line without its end is no row."""
    lines = [line for line in Path(file).read_text().splitlines(keepends=True) if line.endswith("\n")]
    header, *rows = csv.reader(lines)
    return dict(zip(header, np.array([row for row in rows if row], dtype=float).reshape(-1, len(header)).T))


def pick(table, *names):
    """The first column whose name begins with one of `names`, a pressure or stress in kPa, a length in mm."""
    for name in names:
        for header, values in table.items():
            if header.startswith(name):
                return values * {"_Pa": 1e-3, "_m": 1e3}.get(re.search(r"(_Pa|_m)?$", header)[0], 1.0)
    raise KeyError(names[0])


def found(file, summary):
    """A reference file, which a summary names relative to the scene's folder; None, with a word, if it is gone."""
    if not file:
        return None
    place = Path(summary["provenance"]["scene"]).parent / file
    if place.is_file():
        return place
    print(f"reference {place} is not there: left out", file=sys.stderr)
    return None


def read_frames(file):
    """[(attributes, radius in mm, radial stress in kPa, compression positive)], one a frame; the scene's title."""
    if not file.is_file():
        return [], ""
    with h5py.File(file, "r") as results:
        frames = []
        for name in sorted(results["frames"], key=int):
            frame = results["frames"][name]
            if "position" in frame and "stress" in frame:
                frames.append((dict(frame.attrs), 1e3 * frame["position"][:, 0], -1e-3 * frame["stress"][:, 0]))
        title = re.search(r"^title:\s*(.+?)\s*$", results["scene"].asstr()[()], re.MULTILINE)
        return frames, title[1].strip("'\"") if title else ""


def has_curve(history):
    return {"cavity_strain", "true_pressure_Pa"} <= history.keys() and len(history["cavity_strain"]) > 0


def draw_curve(axes, summary, history, reference, measured):
    strain, pressure = 100 * pick(history, "cavity_strain"), pick(history, "true_pressure")
    peak = int(np.argmax(pressure))
    axes.plot(strain, pressure, color=LINE, lw=2, label="Gault")
    for number, curve in enumerate(reference.get("curves", [])):
        if "pressure" not in curve.get("y", "true_pressure") or not (file := found(curve.get("file"), summary)):
            continue
        x, y = list(columns(file).items())[:2]
        axes.plot(100 * x[1], pick(dict([y]), y[0]), color=REFERENCE, lw=1.2, ls="--",
                  label="reference" if number == 0 else None)
    if measured:
        axes.axhline(measured, color=MEASURED, lw=1.2, ls=(0, (6, 3)), label=f"measured peak, {measured:g} kPa")
    axes.plot(strain[peak], pressure[peak], "o", color=LINE, ms=5)
    axes.annotate(f"peak {pressure[peak]:.1f} kPa at {strain[peak]:.2f} %", (0.03, 0.97), xycoords="axes fraction", va="top", color=LINE)
    axes.set(xlabel="cavity strain (%)", ylabel="true cavity pressure (kPa)", xlim=(min(0, strain.min()), strain.max()), ylim=(None, pressure.max() + 0.16 * np.ptp(pressure)))
    axes.legend(loc="lower right")


def frame_label(attributes):
    if "cavity_strain" in attributes:
        return f"{100 * attributes['cavity_strain']:.3g} %"
    return f"{attributes['time']:.3g} s"


def draw_profiles(axes, summary, frames, reference):
    if len(frames) > MOST_FRAMES:
        frames = [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, MOST_FRAMES).round().astype(int))]
    for color, (attributes, radius, stress) in zip(plt.cm.viridis(np.linspace(0, 0.85, len(frames))), frames):
        axes.plot(radius, stress, ".", color=color, ms=8, mew=0, alpha=0.7, label=frame_label(attributes))
    label = "reference"
    for profile in reference.get("profiles", []):
        if file := found(profile.get("file"), summary):
            table = columns(file)
            axes.plot(pick(table, "current_radius", "radius"), pick(table, "sigma_r"), color=REFERENCE, lw=0.8,
                      label=label)
            label = None
    axes.set(xscale="log", xlabel="current radius (mm)", ylabel="radial stress, compression positive (kPa)")
    ticks = matplotlib.ticker.LogLocator(subs=(1, 2, 5))
    axes.xaxis.set_major_locator(ticks)
    axes.xaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    strain = any("cavity_strain" in attributes for attributes, _, _ in frames)
    axes.legend(title="cavity strain" if strain else "time", markerscale=2)


def report(folder, history, summary):
    if has_curve(history):
        peak = int(np.argmax(history["true_pressure_Pa"]))
        print(f"Peak pressure: {1e-3 * history['true_pressure_Pa'][peak]:.2f} kPa (true, per current area) "
              f"at {100 * history['cavity_strain'][peak]:.2f} % cavity strain")
    reference = summary.get("reference") or {}
    for curve in reference.get("curves", []):
        if "largest_relative_error" in curve:
            print(f"Error of the curve: {100 * curve['largest_relative_error']:.3f} % at most, against {curve.get('file') or curve['against']}")
    for profile in reference.get("profiles", []):
        if "sigma_r_l2" in profile:
            print(f"Error of the radial stress of the points at {100 * profile['value']:g} %: "
                  f"{100 * profile['sigma_r_l2']:.3f} % (L2), against {profile.get('file') or profile['against']}")
    if "total" in summary.get("wall_seconds", {}):
        print(f"Wall time: {summary['wall_seconds']['total']:.1f} s")
    print(f"Results: {folder.resolve()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, help="the folder that 'gault run' wrote")
    parser.add_argument("-o", "--output", type=Path, required=True, help="the PNG file to write")
    parser.add_argument("--measured", type=float, metavar="KPA", help="a measured peak pressure to mark, kPa")
    arguments = parser.parse_args()
    folder = arguments.results
    if not folder.is_dir():
        parser.error(f"'{folder}' is not a folder")

    history = columns(folder / "history.csv") if (folder / "history.csv").is_file() else {}
    summary = json.loads((folder / "summary.json").read_text()) if (folder / "summary.json").is_file() else {}
    reference = summary.get("reference") or {}
    frames, title = read_frames(folder / "results.h5")

    plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True,
                         "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
    figure.suptitle(title or folder.resolve().name)
    if has_curve(history):
        draw_curve(left, summary, history, reference, arguments.measured)
    else:
        left.text(0.5, 0.5, "no cavity pressure curve", ha="center", transform=left.transAxes)
    if frames:
        draw_profiles(right, summary, frames, reference)
    else:
        right.text(0.5, 0.5, "no frames", ha="center", transform=right.transAxes)
    figure.savefig(arguments.output, dpi=150)
    report(folder, history, summary)
    print(f"Plot: {arguments.output.resolve()}")


if __name__ == "__main__":
    main()
