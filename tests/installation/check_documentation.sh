#!/usr/bin/env bash
# check_documentation.sh <checkout> <build> <folder>: installs the documentation as its package has it, and checks it.
# Exit status 77: there is none, as Sphinx or what it needs is not installed.
set -euo pipefail
checkout=$1 build=$2 folder=$3
grep --quiet 'CPACK_COMPONENTS_ALL .*documentation' "$build/CPackConfig.cmake" || exit 77
rm -rf "$folder"
cmake --install "$build" --component documentation --prefix "$folder" >"$folder.log" 2>&1 || { cat "$folder.log"; exit 1; }
site=$folder/share/doc/pfdm/html
/usr/bin/python3 "$checkout/cases/site/check_site.py" "$site"
failed=0
complain() {
  printf '%s\n' "$*"
  failed=1
}
for page in index.html cases/tutorials/bead.html cases/reference/README.html cases/site/python.html; do
  [[ -s $site/$page ]] || complain "$page is not in the package"
done
# Nothing but the site, and nothing of this machine.
others=$(find "$folder" -type f -not -path "$site/*" | head -n 5)
[[ -z $others ]] || complain "files beside the site: $others"
if grep --recursive --files-with-matches --fixed-strings "$build" "$site" | head -n 5 | grep .; then
  complain "these pages name the folder of the build"
fi
exit $failed
