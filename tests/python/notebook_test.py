"""Runs the code of docs/creep.ipynb, cell by cell, as its reader would: in docs/, but without Jupyter, which Debian's CI does not have."""
import json
import os
import pathlib
import unittest

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])


class Notebook(unittest.TestCase):
    def test_every_cell_runs_and_finds_what_it_says(self):
        notebook = json.loads((SOURCE / "docs" / "creep.ipynb").read_text())
        os.environ["MPLBACKEND"] = "Agg"
        os.chdir(SOURCE / "docs")
        names = {}
        for number, cell in enumerate(notebook["cells"]):
            if cell["cell_type"] == "code":
                exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
        # The last two seconds: what holds has come to rest by then.
        speed = {}
        for name, trace in names["traces"].items():
            time, drift = trace["time"], trace["drift"]
            late = int(len(time) / 2)
            speed[name] = (drift[-1] - drift[late]) / (time[-1] - time[late])
        self.assertLess(abs(speed["hookpoint"]), 1e-9)
        slope, measured, predicted = names["curves"]["hunt_crossley"]
        self.assertEqual(slope[0], 15)
        self.assertAlmostEqual(speed["hunt_crossley"] / predicted[0], 1, delta=0.01)
        self.assertAlmostEqual(speed["hunt_crossley"] / measured[0], 1, delta=1e-3)
        self.assertEqual(len(names["curves"]), 4)


if __name__ == "__main__":
    unittest.main()
