"""docs/mjcf_and_back.md: its numbers are those of its own blocks, and MuJoCo 3.14 does with the MJCF what translate says."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])
NOT_HERE = 3


def between_marks(text):
    return {name: [[cell.strip() for cell in line.strip("|").split("|")] for line in body.splitlines() if line.startswith("| ")]
            for name, body in re.findall(r"<!-- (tuned|measured|again) -->\n(.*?)<!-- end -->", text, re.S)}


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        made = subprocess.run([sys.executable, SOURCE / "docs/make/mjcf_and_back"], capture_output=True, text=True)
        cls.has_mujoco = made.returncode != NOT_HERE
        if made.returncode not in (0, NOT_HERE):
            raise AssertionError(made.stderr)
        cls.text = made.stdout
        cls.fresh = between_marks(made.stdout)
        cls.page = between_marks((SOURCE / "docs/mjcf_and_back.md").read_text())

    def test_holds_what_its_blocks_give(self):
        self.assertEqual(set(self.page), {"tuned", "measured", "again"})
        for name, rows in self.page.items():
            self.assertEqual(len(rows), len(self.fresh[name]), name)
            for shown, own in zip(rows, self.fresh[name]):
                for was, now in zip(shown, own):
                    if not now:
                        continue  # of MuJoCo, which is not here
                    with self.subTest(f"{name}: {was}, now {now}"):
                        try:
                            self.assertAlmostEqual(float(now), float(was), delta=0.02 * abs(float(was)) + 1e-6)
                        except ValueError:
                            self.assertEqual(now, was)

    def test_mujoco_stands_and_creeps_as_predicted(self):
        if not self.has_mujoco:
            self.skipTest("MuJoCo 3.14 is not installed (./run --engines)")
        depth, creep = map(float, re.search(r"predicts ([\d.]+) mm, and ([\d.]+) mm/s", self.text).groups())
        level, steep = self.fresh["measured"][1], self.fresh["measured"][3]
        self.assertAlmostEqual(float(level[3]), depth, delta=0.02 * depth)
        self.assertAlmostEqual(float(steep[4]), creep, delta=0.05 * creep)

    def test_reading_the_mjcf_gives_the_tuned_constants_back(self):
        for _, tuned, read in self.fresh["again"][1:]:
            self.assertAlmostEqual(float(read), float(tuned), delta=0.02 * float(tuned))


if __name__ == "__main__":
    unittest.main()
