#!/usr/bin/env bash
# The launcher with packages, CMake and ninja that only say what they were asked: what it builds and becomes for which
# words.
#
# launcher.sh <checkout> <empty folder>
set -euo pipefail
root=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"/tools "$folder"/checkout/{physics,mesh,solver,postproc,cases/{program,python/extension,bar,point}}
cp "$root"/{pfdm,README.md,CMakeLists.txt} "$folder/checkout/"
cp -r "$root"/cases/reference "$folder/checkout/cases/"
printf '# a bar\nkind = "fracture"\ntitle = "A bar"\ncsv = "../point/data.csv"\n' >"$folder/checkout/cases/bar/case.toml"
echo 1 >"$folder/checkout/cases/point/data.csv"
printf 'kind = "endochronic" # not kind = "fracture"\n' >"$folder/checkout/cases/point/case.toml"

tool() { cat >"$folder/tools/$1" && chmod +x "$folder/tools/$1"; }
all_are_there() {
  tool dpkg-query <<'EOF'
#!/bin/sh
shift 2
for package; do echo "$package installed"; done
EOF
}
all_are_there
tool cmake <<'EOF'
#!/bin/sh
[ $# = 1 ] && exit 0 # once more, as it is
while [ "$1" != -B ]; do shift; done
build=$2
mkdir -p "$build" && echo PFDM_BUILD_TESTS:BOOL=OFF >"$build/CMakeCache.txt"
shift 2
echo "$@" >"$build/../configured"
EOF
tool ninja <<'EOF'
#!/bin/sh
for target; do :; done
[ "$target" = all ] && target=pfdm
place=$2/cases/python/extension
suffix=$(PATH=/usr/bin:$PATH python3 -c 'import sysconfig; print(sysconfig.get_config_var("EXT_SUFFIX"))' || echo .so)
[ "$target" = pfdm_python ] && mkdir -p "$place" && install /dev/null "$place/_pfdm.another.so" &&
  install /dev/null "$place/_pfdm$suffix"
mkdir -p "$2/cases/program"
printf '#!/bin/sh\necho "$PFDM_LAUNCHER" >"$0.launcher"\necho %s "$@"\n' "$target" >"$2/cases/program/$target"
chmod +x "$2/cases/program/$target"
echo "$target" >>"$2/targets"
EOF

cd "$folder/checkout"
export PATH=$folder/tools:$PATH XDG_CACHE_HOME=$folder/cache
failed=0
complain() {
  printf '%s\n' "$*"
  failed=1
}

# $1: the status; $2: what is to be said among other things; then the words. Nothing may be built.
expect_no_build() {
  local status=0 said
  said=$(./pfdm "${@:3}" 2>&1) || status=$?
  [[ $status == "$1" && $said == *"$2"* ]] || complain "pfdm ${*:3}: status $status, said \"$said\", expected $1, \"$2\""
  [[ ! -e build && ! -e $folder/cache ]] || complain "pfdm ${*:3} builds"
}
version=$(sed -n 's/^project(pfdm VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
expect_no_build 0 "pfdm $version (not built yet)" --version
expect_no_build 0 "./pfdm run CASE [--restart]" --help
expect_no_build 0 "./pfdm run CASE [--restart]" help
expect_no_build 0 "meshes, solves, writes the results" help run
expect_no_build 0 "meshes, solves, writes the results" run --help
expect_no_build 0 "Fracture toughness, critical energy release rate Gc" help toughness
expect_no_build 0 "the documentation as a site" help docs
expect_no_build 2 "takes --output DIR alone" docs --outputs site
expect_no_build 0 "number, above -1 and at most 0.4999" help materials.poisson_ratio
expect_no_build 0 "(plate)" help cooling.emissivity
expect_no_build 0 "in         kind (chain, endochronic" help kind
expect_no_build 2 "no command and no key of case.toml has this name" help xyzzy.boundary
expect_no_build 2 "no command and no key of case.toml has this name" help xyzzy
expect_no_build 0 "Fracture toughness, critical energy release rate Gc" help toughnes
expect_no_build 0 "materials.NAME.law" help neo-Hookean
expect_no_build 0 "materials.NAME.expansion" help thermal expansion
expect_no_build 0 "others that tell of it: " help temperature
expect_no_build 0 'no key has the name "gc"; these tell of it' help gc
expect_no_build 0 "in         materials.NAME.poisson_ratio" help poisson
expect_no_build 0 "bar                         fracture       A bar" list
expect_no_build 0 "then: ./pfdm check new" init new --like bar
expect_no_build 2 "a new case goes into a new directory" init new --like bar
expect_no_build 2 "there is no such case directory" init other --like none
expect_no_build 2 "unknown command" runn cases/bar
expect_no_build 2 "there is no such case directory" run cases/none
expect_no_build 2 "there are no results; ./pfdm run cases/bar makes them" report cases/bar
[[ -f new/README.md && $(<new/data/point_data.csv) == 1 ]] || complain "init leaves out files"
[[ $(<new/case.toml) == *'title = "new"'*'csv = "data/point_data.csv"'* ]] || complain "init: $(<new/case.toml)"

# $1: what is to be said, $2: the targets built so far; then the words.
expect() {
  local said built
  said=$(./pfdm "${@:3}" 2>"$folder/messages")
  built=$(paste -sd ' ' build/release/targets)
  if [[ $said != "$1" || $built != "$2" ]]; then
    complain "pfdm ${*:3}: said \"$said\", expected \"$1\"; built \"$built\", expected \"$2\""
  fi
}
expect "pfdm_fracture run cases/bar" "pfdm_fracture" run cases/bar
expect "pfdm_fracture check --threads 2 cases/bar/case.toml" "pfdm_fracture" check --threads 2 cases/bar/case.toml
expect "pfdm_fracture list" "pfdm_fracture" list
[[ $(cat build/release/cases/program/*.launcher) == ./pfdm ]] || complain "list does not name the launcher"
expect "pfdm_fracture init new --like bar" "pfdm_fracture" init new --like bar
expect "pfdm_fracture help run" "pfdm_fracture" help run
expect "pfdm_fracture --version" "pfdm_fracture" --version
[[ $(./pfdm help cooling.emissivity) == *"radiation beside convection"* ]] || complain "no help on a key of another kind"
expect "pfdm_fracture report cases/bar" "pfdm_fracture" report cases/bar
expect "pfdm run cases/point" "pfdm_fracture pfdm" run cases/point
expect "pfdm run cases/bar" "pfdm_fracture pfdm" run cases/bar
tool python3 <<'EOF'
#!/bin/sh
[ "$1" = -c ] || echo "python3 $* with ${PFDM_PROGRAM##*/} and ${PYTHONPATH##*/cases/}"
EOF
script="python3 script.py 3 with pfdm and python/extension"
expect "$script" "pfdm_fracture pfdm" python script.py 3 # CMake did not find what the extension needs
grep --quiet 'going on without the pieces of the module' "$folder/messages" ||
  complain "python does not say that the extension is left out"
echo "build pfdm_python: phony" >build/release/build.ninja
expect "$script" "pfdm_fracture pfdm pfdm_python" python script.py 3
expect "$script" "pfdm_fracture pfdm pfdm_python" python script.py 3
sleep 0.01
touch physics/law.cpp
expect "pfdm list" "pfdm_fracture pfdm pfdm_python" list
grep --quiet 'the sources have changed since' "$folder/messages" || complain "list does not say that the program is old"
expect "pfdm run cases/bar" "pfdm_fracture pfdm pfdm_python pfdm" run cases/bar
expect "$script" "pfdm_fracture pfdm pfdm_python pfdm pfdm_python" python script.py 3
rm build/release/.built.pfdm_python
built="pfdm_fracture pfdm pfdm_python pfdm pfdm_python"
tool dpkg-query <<'EOF'
#!/bin/sh
shift 2
for package; do [ "$package" = pybind11-dev ] || echo "$package installed"; done
EOF
for refusing in sudo apt-get; do printf '#!/bin/sh\necho >>%s\nexit 1\n' "$folder/asked" | tool $refusing; done
expect "$script" "$built" python script.py 3
grep --quiet 'apt-get install .*pybind11-dev' "$folder/messages" || complain "python does not say how to install packages"
asked=$(wc -l <"$folder/asked")
expect "$script" "$built" python script.py 3
[[ $(wc -l <"$folder/asked") == "$asked" ]] || complain "python asks for packages again that were refused"
[[ $(wc -l <"$folder/messages") == 1 ]] || complain "of what was refused before python says: $(<"$folder/messages")"
all_are_there
expect "$script" "$built pfdm_python" python script.py 3
printf '#!/bin/sh\nexit 1\n' | tool dpkg-query
expect "$script" "$built pfdm_python" python script.py 3 # an extension that is there asks for nothing
[[ ! -s $folder/messages ]] || complain "python with all that it needs says: $(<"$folder/messages")"
all_are_there
rm -r build
expect "pfdm run cases/point" "pfdm" run cases/point
if ((EUID != 0)); then # root may write anywhere
  chmod -w build
  ./pfdm python script.py 3 >/dev/null 2>"$folder/messages"
  [[ -n $(find "$folder/cache" -name '_pfdm*.so') ]] || complain "beside a program of others: $(<"$folder/messages")"
  chmod +w build
fi

# The tests compare what the program says, wherever they are begun.
printf '#!/bin/sh\necho "ctest for ${PFDM_LAUNCHER:-no launcher}"\n' | tool ctest
said=$(PFDM_LAUNCHER=./other ./pfdm test -R bar 2>/dev/null || true)
[[ $said == *"for no launcher" ]] || complain "the tests see the launcher: \"$said\""

# What the compiler may use where /proc/cpuinfo shows these flags: $1, of the flags that follow.
expect_level() {
  local level
  level=$(cpuinfo=$folder/cpuinfo bash -c 'source <(sed -n "/^lower_level()/,/^}/p" pfdm | sed "s|/proc/cpuinfo|$cpuinfo|")
    uname() { echo x86_64; }; lower_level' 2>&1)
  [[ $level == "$1" ]] || complain "level \"$level\", expected \"$1\""
}
v2="cx16 lahf_lm popcnt sse4_1 sse4_2 ssse3"
v3="$v2 avx avx2 bmi1 bmi2 f16c fma abm movbe"
flags() { printf 'processor : 0\nflags\t\t: fpu %s\n' "$*" >"$folder/cpuinfo"; }
flags "$v3 avx512f" && expect_level ""
for hidden in abm bmi1 bmi2 movbe f16c; do
  flags "${v3/ $hidden/}" && expect_level "x86-64-v2 -mavx2"
done
flags "${v3/ fma/}" && expect_level ""  # no operation is fused
flags "${v3/ avx2/}" && expect_level x86-64-v2
flags "$v2" && expect_level x86-64-v2
flags "sse2" && expect_level x86-64
exit $failed
