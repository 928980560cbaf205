"""The notebook cases/python/study.ipynb, cell by cell, pictures and a film of one of its runs, the picture of a sweep, and the
list of pictures of cases.

Exit status 77 where matplotlib, Pillow or VTK's Python is not installed.
"""

import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import matplotlib
    from PIL import Image
    import vtkmodules  # noqa: F401
except ImportError as error:
    print(error)
    sys.exit(77)

checkout = pathlib.Path(__file__).resolve().parents[2]


class Notebook(unittest.TestCase):
    def test_runs_and_its_runs_can_be_drawn(self):
        matplotlib.use("Agg")
        os.chdir(checkout / "cases/python")
        names = {}
        for cell in json.loads(pathlib.Path("study.ipynb").read_text())["cells"]:
            if cell["cell_type"] == "code":
                exec("".join(cell["source"]), names)
        runs = names["runs"]
        # Which interface comes off first, and how far the weakest lags behind.
        off = [run.summary["first_debonding_displacement_m"] for run in runs.values()]
        self.assertIsNone(off[0])
        self.assertEqual(sorted(off[1:], reverse=True), off[1:])

        with tempfile.TemporaryDirectory() as folder:
            picture, film = pathlib.Path(folder) / "body.png", pathlib.Path(folder) / "body.webp"
            draw = [sys.executable, checkout / "postproc/plots/draw_body.py", runs["15 MPa"].folder, "--colour", "von_mises"]
            subprocess.run([*draw, "--output", picture], check=True)
            subprocess.run([*draw, "--film", film], check=True)
            if shutil.which("xvfb-run"):
                self.draw_in_space(runs["15 MPa"].folder, pathlib.Path(folder) / "space.png")
            with Image.open(picture) as image:
                self.assertEqual(image.width, 600)
                glass = image.convert("RGB").getpixel((int(0.42 * image.width), image.height // 2))
                self.assertNotEqual(glass, (255, 255, 255))
            with Image.open(film) as moving:
                self.assertEqual(moving.n_frames, len(runs["15 MPa"].frames))

    def draw_in_space(self, results, picture):
        draw = ["xvfb-run", "-a", sys.executable, checkout / "postproc/plots/draw_space.py", results, "--cut", "xz"]
        subprocess.run([*draw, "--output", picture], check=True)
        with Image.open(picture) as image:
            self.assertEqual(image.width, 600)
            self.assertGreater(len(image.convert("RGB").getcolors(1 << 20)), 50)  # shaded, not a plain area


class PicturesOfSweeps(unittest.TestCase):
    def test_are_drawn_from_the_table_that_the_program_writes(self):
        text = (checkout / "cases/glass_bead_radius/case.toml").read_text(encoding="utf-8")
        for name in ("values", "polar"):
            self.assertIn(f"\n{name} = [", text)
        text = re.sub(r'values = \[("[^"]* J/m\^2", |"[^"]* MPa", ){3}', "values = [", text)  # the last two of five
        text = re.sub(r"(polar = .*)cells = 90", r"\1cells = 30", text)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "case.toml").write_text(text, encoding="utf-8")
            subprocess.run([os.environ["PFDM_PROGRAM"], "sweep", folder, "--quiet"], check=True)
            draw = [sys.executable, checkout / "postproc/plots/plot_debond_stress.py", "whole"]
            subprocess.run([*draw, folder / "results/sweep.csv", "--output", folder / "stress.png"], check=True)
            with open(folder / "stress.csv", newline="", encoding="utf-8") as table:
                rows = list(csv.DictReader(table))
            with Image.open(folder / "stress.png") as picture:
                self.assertEqual(picture.format, "PNG")
        self.assertEqual([round(float(row["radius_over_l_ch"])) for row in rows], [5, 10])
        larger, smaller = (float(row["debond_stress_over_strength"]) for row in reversed(rows))
        self.assertGreater(larger, 0.515)  # ft over the stress concentration at the pole, the limit of a large bead
        self.assertGreater(smaller, larger)
        self.assertLess(smaller, 0.7)


class PicturesOfCases(unittest.TestCase):
    def test_have_a_command_and_are_shown(self):
        sys.path.insert(0, str(checkout / "postproc/plots"))
        import draw_cases

        listed = {picture: command[0] for _, picture, command in draw_cases.commands()}
        for picture, script in listed.items():
            case, name = picture.split("/")
            self.assertTrue(script.is_file(), script)
            self.assertTrue((checkout / "cases" / picture).is_file(), picture)
            self.assertIn(f"({name})", (checkout / "cases" / case / "README.md").read_text(encoding="utf-8"), picture)
        text = (checkout / "postproc/plots/pictures.txt").read_text(encoding="utf-8")
        for case in (checkout / "cases").glob("*/case.toml"):
            for picture in [*case.parent.glob("*.png"), *case.parent.glob("*.webp")]:
                self.assertIn(f"{case.parent.name}/{picture.name}", text)


if __name__ == "__main__":
    unittest.main()
