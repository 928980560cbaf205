#!/usr/bin/env bash
# build_and_check.sh <checkout> <folder>: builds the documentation site into the folder and checks it.
# Exit status 77: Sphinx or what it needs is not installed.
set -euo pipefail
checkout=$1 folder=$2
/usr/bin/python3 -c 'import sphinx, myst_parser, furo, sphinx_copybutton, breathe, numpy, pandas' 2>/dev/null &&
  command -v doxygen >/dev/null && [[ -d /usr/share/javascript/katex ]] || exit 77
rm -rf "$folder"
export PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 -m sphinx -q -W --keep-going -c "$checkout/cases/site" -d "$folder.pages" -b html "$checkout" "$folder"
/usr/bin/python3 "$checkout/cases/site/check_site.py" "$folder"
