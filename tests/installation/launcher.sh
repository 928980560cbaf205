#!/usr/bin/env bash
# The launcher with packages, CMake and ninja that only say what they were asked: what it builds and becomes for which
# words.
#
# launcher.sh <checkout> <empty folder>
set -euo pipefail
root=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"/tools "$folder"/checkout/{physics,mesh,solver,postproc,cases/{program,bar,point}}
cp "$root/pfdm" "$folder/checkout/pfdm"
touch "$folder/checkout/CMakeLists.txt"
printf '# a bar\nkind = "fracture"\n' >"$folder/checkout/cases/bar/case.toml"
printf 'kind = "endochronic" # not kind = "fracture"\n' >"$folder/checkout/cases/point/case.toml"

tool() { cat >"$folder/tools/$1" && chmod +x "$folder/tools/$1"; }
tool dpkg-query <<'EOF'
#!/bin/sh
shift 2
for package; do echo "$package installed"; done
EOF
tool cmake <<'EOF'
#!/bin/sh
while [ "$1" != -B ]; do shift; done
mkdir -p "$2" && echo PFDM_BUILD_TESTS:BOOL=OFF >"$2/CMakeCache.txt"
EOF
tool ninja <<'EOF'
#!/bin/sh
for target; do :; done
[ "$target" = all ] && target=pfdm
mkdir -p "$2/cases/program"
printf '#!/bin/sh\necho %s "$@"\n' "$target" >"$2/cases/program/$target"
chmod +x "$2/cases/program/$target"
echo "$target" >>"$2/targets"
EOF

cd "$folder/checkout"
export PATH=$folder/tools:$PATH XDG_CACHE_HOME=$folder/cache
failed=0
# $1: what is to be said, $2: the targets built so far; then the words.
expect() {
  local said built
  said=$(./pfdm "${@:3}" 2>"$folder/messages")
  built=$(paste -sd ' ' build/release/targets)
  if [[ $said != "$1" || $built != "$2" ]]; then
    printf 'pfdm %s: said "%s", expected "%s"; built "%s", expected "%s"\n' "${*:3}" "$said" "$1" "$built" "$2"
    failed=1
  fi
}
expect "pfdm_fracture run cases/bar" "pfdm_fracture" run cases/bar
expect "pfdm_fracture check --threads 2 cases/bar/case.toml" "pfdm_fracture" check --threads 2 cases/bar/case.toml
expect "pfdm list" "pfdm_fracture pfdm" list
expect "pfdm run cases/bar" "pfdm_fracture pfdm" run cases/bar
sleep 0.01
touch physics/law.cpp
expect "pfdm run cases/bar" "pfdm_fracture pfdm pfdm" run cases/bar
rm -r build
expect "pfdm run cases/point" "pfdm" run cases/point
rm -r build
expect "pfdm init cases/bar" "pfdm" init cases/bar
exit $failed
