#!/usr/bin/env bash
# Makes every figure of the documentation anew, from runs: a quarter of an hour. Program: $GAULT, or build/release/bin/gault.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
export GAULT="${GAULT:-$PWD/build/release/bin/gault}"

results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
"$GAULT" run configs/paper/fahey.yaml -o "$results/fahey"
"$GAULT" plot "$results/fahey" -o docs/figures/fahey.png --measured 655
"$GAULT" element configs/element/sand_cyclic_shear.yaml -o "$results/element"
cp "$results/element/element.png" docs/figures/element.png
/usr/bin/python3 docs/figures/convergence.py
/usr/bin/python3 docs/figures/accuracy.py
/usr/bin/python3 docs/figures/biaxial.py
/usr/bin/python3 docs/figures/certificates.py
