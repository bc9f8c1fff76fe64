#!/usr/bin/env bash
# Sets up, builds and runs the whole test suite. From any folder; arguments go to ctest.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

bash apps/setup.sh clang libgmock-dev libxml2-dev
echo "Build: program and tests into build/release (the first time takes some minutes)"
cmake --preset release -DGAULT_BUILD_TESTS=ON >/dev/null
cmake --build --preset release
echo "Tests: all of them"
ctest --preset release -j "$(nproc)" "$@"
