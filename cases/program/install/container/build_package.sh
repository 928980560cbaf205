#!/bin/sh
# Builds pfdm_*.deb of the checkout around it, as root in a bare Debian, and puts it into the folder $1. $2: the level of
# x86-64 to build for.
set -eu
cd "$(dirname "$0")/../../../.."
apt-get update
apt-get install --no-install-recommends --yes file # by which cpack finds the libraries that the program needs
PFDM_CMAKE_OPTIONS="-DPFDM_ARCH=$2 -DPFDM_BUILD_TESTS=OFF" ./pfdm python -c 'import pfdm'
cmake --build build/release
cd build/release
cpack -D CPACK_COMPONENTS_ALL=program
mkdir -p "$1"
mv pfdm_*.deb "$1"
