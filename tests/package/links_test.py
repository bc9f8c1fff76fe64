#!/usr/bin/python3
"""Every link of the documents in ROOT leads to a file, and to a heading in it: links_test.py ROOT"""
import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\((?!https?:)([^)#\s]*\.\w+|)(?:#([^)\s]+))?\)")
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def anchors(page):
    """Of the headings, as they are made where the pages are read."""
    for heading in re.findall(r"^#+ (.*)$", FENCED.sub("", page.read_text()), re.MULTILINE):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def main():
    root = Path(sys.argv[1]).resolve()
    pages = [p for p in root.rglob("*.md") if "build" not in p.relative_to(root).parts]
    broken = []
    for page in pages:
        for file, anchor in LINK.findall(FENCED.sub("", page.read_text())):
            target = (page.parent / file) if file else page
            if not target.exists() or (anchor and anchor not in anchors(target)):
                broken.append(f"{page.relative_to(root)}: {file}{'#' + anchor if anchor else ''}")
    if broken or not pages:
        sys.exit("\n".join(broken) or f"no document in {root}")


if __name__ == "__main__":
    main()
