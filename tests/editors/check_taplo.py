"""What taplo, on which the TOML extensions of editors rest, shows of case files with the schema beside the cases.

check_taplo.py CASES_DIR; skipped (77) where taplo is not installed (npm install -g @taplo/cli, or PFDM_TAPLO is its path).
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ACCEPTED = ("bar_at2", "prony_calibration", "chain", "composite_stiffness")

# In bar_at2: what is in the file, what is put in its place, and what the message has to name.
WRONG = {
    "key": ("toughness = ", "toughnes = ", "'toughnes' was unexpected"),
    "unit": ('young_modulus = "30 GPa"', 'young_modulus = "30 kg"', '"30 kg" is not valid'),
    "value": ("poisson_ratio = 0.0", "poisson_ratio = true", "true is not valid"),
    "word": ('model = "AT2"', 'model = "AT3"', '"AT3" is not'),
    "kind": ('kind = "fracture"', 'kind = "fractur"', '"fractur" is not'),
}


def lint(taplo, folder, files):
    """Status, and messages by (name of file, line)."""
    done = subprocess.run([taplo, "lint", "--colors", "never", *[str(f.relative_to(folder)) for f in files]], cwd=folder,
                          capture_output=True, text=True, timeout=300, check=False)
    found = {}
    for message, path, line in re.findall(r"^error: (.*)\n *┌─ (.*?):(\d+):\d+$", done.stdout + done.stderr, re.MULTILINE):
        found.setdefault((Path(path).name, int(line)), []).append(message)
    return done.returncode, found


def copy_cases(cases, folder):
    shutil.copy(cases / "case.schema.json", folder)
    files = []
    for name in ACCEPTED:
        (folder / name).mkdir()
        files.append(Path(shutil.copy(cases / name / "case.toml", folder / name / "case.toml")))
    return files


def wrong_files(good):
    """(what, file, line of the fault, words) of each fault in a copy of the good file."""
    text = good.read_text(encoding="utf-8")
    for what, (right, wrong, words) in WRONG.items():
        assert text.count(right) >= 1, f"{good}: no {right}"
        file = good.with_name(f"{what}.toml")
        file.write_text(text.replace(right, wrong, 1), encoding="utf-8")
        yield what, file, text[: text.index(right)].count("\n") + 1, words


def main():
    taplo = os.environ.get("PFDM_TAPLO") or shutil.which("taplo")
    if not taplo:
        print("taplo is not installed")
        return 77
    faults = []
    with tempfile.TemporaryDirectory(prefix="pfdm_taplo_") as scratch:
        folder = Path(scratch).resolve()
        good = copy_cases(Path(sys.argv[1]).resolve(), folder)
        status, found = lint(taplo, folder, good)
        if status != 0 or found:
            faults.append(f"shipped cases: status {status}, {found}")
        wrong = list(wrong_files(good[0]))
        status, found = lint(taplo, folder, [file for _, file, _, _ in wrong])
        if status == 0:
            faults.append("wrong files are accepted")
        for what, file, line, words in wrong:
            if not any(words in message for message in found.get((file.name, line), [])):
                faults.append(f"wrong {what}: no message with {words} at line {line}: {found}"[:2000])
    print("\n".join(faults) or f"{len(good)} cases accepted, {len(wrong)} faults named at their lines")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
