#!/usr/bin/env bash
# check_containers.sh <checkout>: the Dockerfile and the recipe for Apptainer make the same image, of the packages that the
# launcher installs for scripts.
set -euo pipefail
checkout=$1
containers=$checkout/cases/program/install/container
failed=0
# $1: what it is, $2: what was found, $3: what is due.
expect() {
  [[ $2 == "$3" ]] || { printf '%s: "%s", expected "%s"\n' "$1" "$2" "$3" && failed=1; }
}

# Sections of the recipe, "stage section" before each line; keys of its head are in the section "head".
recipe=$(awk '/^Bootstrap:/ { stage++; section = "head" } /^%/ { section = $0; next }
  NF && !/^#/ { sub(/^ +/, ""); print stage " " section ": " $0 }' "$containers/pfdm.def")
lines_of() { sed -n "s/^$1: //p" <<<"$recipe"; }
# Of the Dockerfile, with joined lines and the arguments' defaults.
docker=$(sed -e ':a' -e '/\\$/N; s/ *\\\n */ /; ta' "$containers/Dockerfile" | grep -v '^#')
default_of() { sed -n "s/^ARG $1=//p" <<<"$docker"; }
base=$(default_of BASE) level=$(default_of LEVEL)

for stage in 1 2; do
  expect "bootstrap of stage $stage" "$(lines_of "$stage head" | sed -n 's/^Bootstrap: //p')" docker
  expect "base of stage $stage" "$(lines_of "$stage head" | sed -n 's/^From: //p')" "$base"
done
built=$(grep -o '/pfdm/cases.*build_package.sh .*' <<<"$docker")
expect "how the recipe builds the package" "$(lines_of '1 %post' | grep build_package)" "${built/\"\$LEVEL\"/$level}"
expect "what the recipe takes along" "$(lines_of '1 %files')" ". /pfdm"
expect "what the recipe's second stage takes along" "$(lines_of '2 %files from build')" "/package /package"

packages_of() { grep -o 'apt-get install .*' | sed 's/ &&.*//'; }
of_docker=$(packages_of <<<"$docker")
expect "packages of the recipe" "$(lines_of '2 %post' | packages_of)" "$of_docker"
launched=$(sed -n 's/^python_packages=(\(.*\))/\1/p' "$checkout/pfdm")
[[ -n $launched ]] || { echo "the launcher's python_packages are not found" && failed=1; }
due=$(printf '%s\n' /package/\*.deb python3-matplotlib $launched | sort)
expect "packages of the image" "$(sed 's/.*--yes //' <<<"$of_docker" | tr ' ' '\n' | sort)" "$due"

# The commands are for sh.
for stage in 1 2; do
  lines_of "$stage %post" | sh -n || failed=1
done
[[ -x $containers/build_package.sh ]] || { echo "build_package.sh cannot be executed" && failed=1; }
sh -n "$containers/build_package.sh" || failed=1
exit $failed
