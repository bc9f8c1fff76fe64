#!/usr/bin/env bash
# Installs the Debian packages that Gault needs and that are missing: as root, or with sudo. Arguments: more packages.
# The scripts name /usr/bin/python3, since Debian's matplotlib and h5py are there; another python3 of the PATH may lack them.
set -euo pipefail

packages=(build-essential cmake ninja-build pkg-config libeigen3-dev libyaml-cpp-dev libspdlog-dev libfmt-dev
    libhdf5-dev libgtest-dev libcli11-dev libudunits2-dev libsuitesparse-dev nlohmann-json3-dev libssl-dev
    python3-matplotlib python3-h5py python3-numpy "$@")
missing=()
for package in "${packages[@]}"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    echo "Set-up: every Debian package that is needed is installed."
    exit
fi

echo "Set-up: installing ${missing[*]}"
as_root=()
if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "Set-up: run this as root, or install sudo." >&2; exit 1; }
    as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
