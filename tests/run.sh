#!/usr/bin/env bash
# Sets up, builds and runs the test suite. From any folder.
#   tests/run.sh [--all] [--sanitize address|thread | --coverage] [arguments of ctest]
#     --all       with the tests labelled `long`, which are left out otherwise
#     --sanitize  built with gcc's sanitizers (address: and of undefined behaviour), into build/asan or build/tsan
#     --coverage  built for gcov, into build/coverage; gcovr's summary by file at the end
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

usage() {
    sed -n '3s/^# *//p' "$0" >&2
    exit 2
}

preset=release selection=(-LE long) packages=(abigail-tools clang dpkg-dev file gfortran libgmock-dev librapidcheck-dev libxml2-dev)
while (($#)); do
    case "$1" in
    --all) selection=() ;;
    --sanitize)
        case "${2-}" in
        address) preset=asan ;;
        thread) preset=tsan ;;
        *) usage ;;
        esac
        shift
        ;;
    --coverage) preset=coverage packages+=(gcovr) ;;
    --help) usage ;;
    *) break ;;
    esac
    shift
done

bash apps/setup.sh "${packages[@]}"
echo "Build: program and tests into build/$preset (the first time takes some minutes)"
cmake --preset "$preset" -DGAULT_BUILD_TESTS=ON >/dev/null
if [[ $preset == coverage ]]; then # counts of earlier runs
    find build/coverage -name '*.gcda' -delete
fi
cmake --build --preset "$preset"
if ((${#selection[@]})); then
    echo "Tests: all but the long ones (--all: those too)"
else
    echo "Tests: all of them"
fi
status=0
ctest --preset "$preset" -j "$(nproc)" "${selection[@]}" "$@" || status=$?
if [[ $preset == coverage ]]; then
    gcovr --root . --object-directory build/coverage --filter core/ --filter plugins/ --filter sdk/include/ --filter apps/ \
        --exclude '.*_test\.[ch]pp' --exclude-throw-branches --print-summary -j "$(nproc)"
fi
exit "$status"
