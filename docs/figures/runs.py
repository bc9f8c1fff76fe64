"""What the figure scripts share: runs of a scene with overrides, tables of what came out, the look of the plots."""
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
GAULT = os.environ.get("GAULT", ROOT / "build/release/bin/gault")


def run(scene, overrides):
    """The summary of `gault run configs/SCENE` with {key: value} set."""
    with tempfile.TemporaryDirectory() as folder:
        command = [GAULT, "run", ROOT / "configs" / scene, "-o", Path(folder) / "run", "--quiet"]
        for key, value in overrides.items():
            command += ["--set", f"{key}={value}"]
        subprocess.run(command, check=True)
        return json.loads((Path(folder) / "run/summary.json").read_text())


def table(name, measure):
    """Rows of numbers: measured and written to the CSV file NAME or, with --draw on the command line, read from it."""
    if "--draw" in sys.argv[1:]:
        with open(HERE / name, newline="") as file:
            return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]
    rows = measure()
    with open(HERE / name, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return rows


def number(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def style():
    plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True,
                         "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
