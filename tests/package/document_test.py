#!/usr/bin/python3
"""Follows a page as its reader would: document_test.py PAGE BUILD WORK

What BUILD installs comes first in the PATH, and nothing else of it is in reach. In order: a block that follows `FILE`: on a line of its own is written to that
file; a `sh` block is run in one shell with those before it; of a `text` block, every line must be in what the `sh` block before it printed, in that order.
Numbers may differ by 1 %, below 1e-6 and in lines that give a time (ns, s) in any way.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")
TIMED = re.compile(r"\d (?:ns|s|M points/s)\b")


def blocks(page):
    """(kind of block, name of its file or None, text) of each fenced block."""
    for match in re.finditer(r"(?:^`([\w.]+)`:\n)?^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL):
        yield match[2], match[1], match[3]


def alike(expected, found):
    words = lambda line: NUMBER.sub("#", " ".join(line.split()))
    if words(expected) != words(found):
        return False
    if TIMED.search(expected):
        return True
    for a, b in zip(map(float, NUMBER.findall(expected)), map(float, NUMBER.findall(found))):
        if abs(a - b) > 0.01 * abs(a) and max(abs(a), abs(b)) >= 1e-6:
            return False
    return True


def check(text, output):
    left = output.splitlines()
    for line in filter(str.strip, text.splitlines()):
        while left and not alike(line, left[0]):
            left.pop(0)
        if not left:
            sys.exit(f"the page shows a line that did not come:\n{line}\nwhat came:\n{output}")
        left.pop(0)


class Shell:
    """One bash, fed block by block."""

    END = "end of block"

    def __init__(self, folder, environment):
        self.process = subprocess.Popen(["bash"], cwd=folder, env=environment, text=True, bufsize=1, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def run(self, commands):
        self.process.stdin.write(f"set -e\n{commands}\nset +e\necho \"{self.END} $PWD\"\n")
        self.process.stdin.flush()
        output = ""
        for line in self.process.stdout:
            if line.startswith(self.END):
                return output, Path(line[len(self.END) + 1:-1])
            output += line
        sys.exit(f"failed:\n{commands}\n{output}")


def main():
    page, build, work = (Path(word).resolve() for word in sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    folder = work / "empty"
    folder.mkdir(parents=True)
    subprocess.run(["cmake", "--install", build, "--prefix", work / "prefix"], check=True, stdout=subprocess.DEVNULL)
    shell = Shell(folder, {**os.environ, "PATH": f"{work / 'prefix/bin'}:{os.environ['PATH']}"})
    output = ""
    for kind, name, text in blocks(page.read_text()):
        if name:
            (folder / name).write_text(text)
        elif kind == "sh":
            output, folder = shell.run(text)
        elif kind == "text":
            check(text, output)


if __name__ == "__main__":
    main()
