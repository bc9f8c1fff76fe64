#!/usr/bin/python3
"""Draws what `gault frontier` measured: frontier.py FRONTIER_JSON -o PNG

One panel an error: error against wall time, one line a family, the front that nothing beats in both drawn beneath. Where a
study keeps curves and has no errors, one panel a family: the curves of its members.
"""
import argparse
import json
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLORS = ["#1f5fa8", "#b5432a", "#2a9d6f", "#8a5fb0", "#c98a1b", "#4a4a4a", "#d16ba5", "#3bb0c9", "#7a8b2a", "#8c564b", "#000000", "#e08a8a"]
MARKERS = "osD^vP*Xhd<>"


def points(family, error):
    """[(seconds, least, most, error, label)] of the members that have this error."""
    found = []
    for member in family["members"]:
        value = member.get("errors", {}).get(error)
        if value:
            wall = member["wall_seconds"]
            found.append((wall["median"], wall["least"], wall["most"], value, member["label"]))
    return found


def draw_errors(axes, data, error):
    front = []
    for number, family in enumerate(data["families"]):
        found = points(family, error)
        if not found:
            continue
        time, least, most, value, labels = zip(*found)
        color, percent = COLORS[number % len(COLORS)], [100 * v for v in value]
        spread = [[t - l for t, l in zip(time, least)], [m - t for t, m in zip(time, most)]]
        alone = len(found) == 1
        axes.errorbar(time, percent, xerr=spread, color=color, marker=MARKERS[number % len(MARKERS)], ms=9 if alone else 5, lw=1.3,
                      mfc=color if alone else "white", elinewidth=0.8, capsize=2, label=family["name"])
        for x, y, label in (zip(time, percent, labels) if len(found) > 1 else []):
            number = re.search(r"[\d.]+(e[-+]?\d+)?( ?%| \w+(/\w+)?)?", label)
            axes.annotate(number[0] if number else label, (x, y), xytext=(5, 4), textcoords="offset points", fontsize=7,
                          color=color)
        front += [(m["wall_seconds"]["median"], 100 * m["errors"][error]) for m in family["members"]
                  if m.get("front", {}).get(error) and m["errors"][error]]
    if front:
        front.sort()
        axes.step(*zip(*front), where="post", color="#bbbbbb", lw=6, alpha=0.5, zorder=0, label="front: none is faster and nearer")
    axes.set(xscale="log", yscale="log", xlabel="wall time of the whole command (s)", ylabel="relative error (%)", title=error)
    axes.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def draw_curves(axes, data, family):
    members = [member for member in family["members"] if "curve" in member]
    shades = plt.cm.viridis([0.9 * k / max(1, len(members) - 1) for k in range(len(members))])
    for color, member in zip(shades, members):
        x, y = member["curve"]["x"], member["curve"]["y"]
        axes.plot(x, [1e-3 * v for v in y] if data["curve"][1].endswith("_Pa") else y, color=color, lw=1.5, label=member["label"])
    axes.set(xlabel=data["curve"][0], ylabel=data["curve"][1].replace("_Pa", " (kPa)"), title=family["name"])
    axes.legend(fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("frontier", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    arguments = parser.parse_args()
    data = json.loads(arguments.frontier.read_text())
    plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True,
                         "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    errors = [error for error in data["errors"] if any(points(family, error) for family in data["families"])]
    if errors:
        columns = min(2, len(errors))
        rows = -(-len(errors) // columns)
        figure, panels = plt.subplots(rows, columns, figsize=(7 * columns, 5.5 * rows), layout="constrained", squeeze=False)
        for axes, error in zip(panels.flat, errors):
            draw_errors(axes, data, error)
        for axes in panels.flat[len(errors):]:
            axes.axis("off")
        handles, labels = panels.flat[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=2, fontsize=9)
    else:
        families = [family for family in data["families"] if any("curve" in member for member in family["members"])]
        columns = min(3, max(1, len(families)))
        rows = -(-len(families) // columns) or 1
        figure, panels = plt.subplots(rows, columns, figsize=(5 * columns, 4 * rows), layout="constrained", squeeze=False)
        for axes, family in zip(panels.flat, families):
            draw_curves(axes, data, family)
        for axes in panels.flat[len(families):]:
            axes.axis("off")
    machine = data["machine"]
    figure.suptitle(f"{data['title']}\n{data['program']}, {machine['processor']}, {machine['cores']} cores", fontsize=11)
    figure.savefig(arguments.output, dpi=130, bbox_inches="tight")


if __name__ == "__main__":
    main()
