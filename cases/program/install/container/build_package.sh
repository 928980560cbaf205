#!/bin/sh
# Builds pfdm_*.deb of the checkout around it, as root in a bare Debian, and puts it into the folder $1. $2: the level of
# x86-64 to build for.
set -eu
cd "$(dirname "$0")/../../../.."
apt-get update
apt-get install --no-install-recommends --yes file # by which cpack finds the libraries that the program needs
PFDM_CMAKE_OPTIONS="-DPFDM_ARCH=$2 -DPFDM_BUILD_TESTS=OFF" ./pfdm python -c 'import pfdm; pfdm.set_threads(1)'
kilobytes=$(awk '/^MemAvailable/ { print $2 }' /proc/meminfo)
jobs=$((kilobytes / 1700000)) # as the launcher counts
[ "$jobs" -le "$(nproc)" ] || jobs=$(nproc)
cmake --build build/release --parallel "$((jobs > 0 ? jobs : 1))"
cd build/release
cpack -D CPACK_COMPONENTS_ALL=program
mkdir -p "$1"
mv pfdm_*.deb "$1"
