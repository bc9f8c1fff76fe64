#!/usr/bin/env bash
# Sets up, builds, runs the cylinder test of Fahey (1986), prints what came out and draws it. From any folder.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

bash apps/setup.sh
echo "Build: the program into build/release (the first time takes some minutes)"
cmake --preset release -DGAULT_BUILD_TESTS=OFF >/dev/null
cmake --build --preset release
echo "Run: configs/paper/fahey.yaml"
build/release/bin/gault run configs/paper/fahey.yaml -o out/fahey --force
build/release/bin/gault plot out/fahey -o out/fahey.png --measured 655
