#!/usr/bin/python3
"""Certifies every shipped soil (each material of `gault list`), or those named on the command line, on the scene of its plugin, and
replaces its part of docs/certificates.md. Program: $GAULT, or build/release/bin/gault. About three minutes."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GAULT = os.environ.get("GAULT", ROOT / "build/release/bin/gault")
PAGE = ROOT / "docs/certificates.md"
BEGIN, END = "<!-- begin soils -->\n", "<!-- end soils -->"


def soils():
    """Name and scene of every material; several models of one plugin share its scene."""
    listed = subprocess.run([GAULT, "list"], check=True, capture_output=True, text=True).stdout
    for line in listed.splitlines():
        kind, name, _, file = line.split(None, 3)
        if kind == "material":
            yield name, ROOT / "plugins" / Path(file).stem / "scene.yaml"


def certified(name, scene):
    used = re.search(r"^materials:.*\n +(\w+):", scene.read_text(), re.MULTILINE)[1]
    with tempfile.TemporaryDirectory() as folder:
        certificate = Path(folder) / "certificate.json"
        command = [GAULT, "certify", name, "--with", scene, "--set", f"materials.{used}.model={name}", "--json", certificate]
        status = subprocess.run(command, stdout=subprocess.DEVNULL).returncode
        assert status in (0, 3), f"{name}: exit status {status}"
        return json.loads(certificate.read_text())


def section(certificate, scene):
    verdict = "Certified" if certificate["passed"] else "**Not certified**"
    pressure = -sum(certificate["initial_stress_Pa"][:3]) / 3e3
    lines = [f"### {certificate['model']} {certificate['version']}",
             f"{verdict} on `{scene.relative_to(ROOT)}`, mean stress {pressure:g} kPa.\n", "| check | verdict | measured |", "|---|---|---|"]
    lines += [f"| {c['name']} | {c['verdict']} | {c['figure']} |" for c in certificate["checks"]]
    return "\n".join(lines) + "\n"


def machine():
    processor = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())[1]
    instructions = next((f"x86-64-v{n}" for n in (4, 3) if any(f"x86-64-v{n}" in str(p) for p in files)), "baseline")
    return f"{processor}, {instructions}"


files = []


def main():
    page = PAGE.read_text()
    head, old = page[:page.index(BEGIN)], page[page.index(BEGIN) + len(BEGIN):page.index(END)]
    sections = {part.split(None, 1)[0]: "### " + part for part in old.split("### ")[1:]}
    for name, scene in soils():
        if sys.argv[1:] and name not in sys.argv[1:]:
            continue
        certificate = certified(name, scene)
        files.append(certificate["file"])
        sections[name] = section(certificate, scene)
        print(f"{name}: {'certified' if certificate['passed'] else 'NOT certified'}", flush=True)
    listed = {name for name, _ in soils()}
    text = "\n".join(sections[name] for name in sorted(sections) if name in listed)
    head = re.sub(r"(?<=`speed` was measured on )[^\n]*(?= by)", machine(), head)
    PAGE.write_text(head + BEGIN + text + END + page[page.index(END) + len(END):])


if __name__ == "__main__":
    main()
