#!/usr/bin/python3
"""Measures docs/accuracy.md anew: runs the studies of configs/frontier (all, or those named on the command line) and replaces their
tables, figures and the line that says what was measured on. Program: $GAULT, or build/release/bin/gault. About twenty minutes on
a machine that does nothing else: times are worth no more than that."""
import csv
import datetime
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from runs import GAULT, HERE, ROOT

PAGE = ROOT / "docs/accuracy.md"
SUMMARISED = {"fahey": "Fahey's test", "case2": "Case II", "case3": "Case III", "sand_without_bound": "unbounded sand",
              "clay": "undrained clay"}


def measured(study):
    """What frontier.json of this study holds; its figure and its CSV file go beside this script."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([GAULT, "frontier", study, "-o", folder, "--force"], check=True, stdout=subprocess.DEVNULL)
        for kind in ("png", "csv"):
            shutil.copy(Path(folder) / f"frontier.{kind}", HERE / f"frontier_{study.stem}.{kind}")
        return json.loads((Path(folder) / "frontier.json").read_text())


def amount(value):
    for size, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:.3g} {prefix}"
    return f"{value:.3g}"


def error_cell(member, error):
    value = member["errors"].get(error)
    if value is None:
        return ""
    order = member.get("orders", {}).get(error)
    text = f"{100 * value:.2g} %" + (f" ({order:.1f})" if order is not None else "")
    return f"**{text}**" if member["front"].get(error) else text


def value_cell(value):
    return "" if value is None else f"{value:.6g}"


def row(member, data):
    first = [member["label"] or "as it is"]
    if member["status"] != "done":
        return first + [f"fails: {member.get('message', '')}"]
    wall = member["wall_seconds"]
    spread = f" ({wall['least']:.2g} to {wall['most']:.2g})" if len(wall["runs"]) > 1 else ""
    return first + [f"{wall['median']:.3g}{spread}", amount(member["constitutive_updates"]),
                    amount(member["point_steps_per_second"] or 0), f"{member['peak_memory_bytes'] / 1e6:.0f}"] + \
        [error_cell(member, error) for error in data["errors"]] + [value_cell(member["values"].get(v)) for v in data["values"]]


def table(data):
    heads = ["setting", "time, s", "updates", "updates/s", "MB"] + data["errors"] + data["values"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for family in data["families"]:
        lines.append(f"| *{family['name']}* |" + " |" * (len(heads) - 1))
        for member in family["members"]:
            cells = row(member, data)
            lines.append("| " + " | ".join(cells + [""] * (len(heads) - len(cells))) + " |")
    return "\n".join(lines)


def replaced(page, name, text):
    pattern = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
    assert pattern.search(page), f"docs/accuracy.md has no place for {name}"
    return pattern.sub(lambda match: match[1] + text + "\n" + match[2], page)


def fastest(rows, error, bound):
    """The fastest setting whose error is within the bound."""
    within = [row for row in rows if row[error] and float(row[error]) <= bound]
    if not within:
        return "none"
    best = min(within, key=lambda row: float(row["wall_median_s"]))
    return f"{float(best['wall_median_s']):.2g} s, {float(best['constitutive_updates']):.3g} updates: {best['family']}, {best['setting']}"


def summary():
    lines = []
    for name, title in SUMMARISED.items():
        with open(HERE / f"frontier_{name}.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        error = next(column for column in rows[0] if column.startswith("error_"))
        lines.append(f"| {title}: {error[6:]} | " + " | ".join(fastest(rows, error, bound) for bound in (1e-2, 1e-3, 1e-4)) + " |")
    return "\n".join(lines)


def main():
    wanted = sys.argv[1:]
    studies = sorted(study for study in (ROOT / "configs/frontier").glob("*.yaml") if not wanted or study.stem in wanted)
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], check=True, capture_output=True, text=True).stdout.strip()
    for study in studies:
        data = measured(study)
        machine = data["machine"]
        line = (f"`gault frontier configs/frontier/{study.name}`, commit {commit}, {datetime.date.today()}, {data['program']}, "
                f"{machine['processor']}, {machine['cores']} cores, {machine['instruction_set']}.")
        text = f"{line}\n\n![{data['title']}](figures/frontier_{study.stem}.png)\n\n{table(data)}"
        PAGE.write_text(replaced(PAGE.read_text(), study.stem, text))
        print(f"{study.name}: done", flush=True)
    PAGE.write_text(replaced(PAGE.read_text(), "summary", summary()))


if __name__ == "__main__":
    main()
