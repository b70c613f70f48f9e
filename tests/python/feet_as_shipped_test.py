"""docs/make/feet_as_shipped: what it reads of a file, and the table of docs/feet_as_shipped.md where the makers' files are here."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest
import xml.etree.ElementTree as xml

SOURCE = pathlib.Path(os.environ["HOOKPOINT_SOURCE_DIR"])
SCRIPT = SOURCE / "docs/make/feet_as_shipped"


def script():
    loader = importlib.machinery.SourceFileLoader("feet_as_shipped", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("feet_as_shipped", loader))
    loader.exec_module(module)
    return module


def makers_folder():
    for way in ("../shared/data", "../../shared/data"):
        if (SOURCE / way / "mjcf").is_dir():
            return SOURCE / way
    return None


def rows_of(text):
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    return {cells[0]: cells[1:] for cells in ([cell.strip() for cell in line.strip("|").split("|")] for line in lines[1:])}


class Reading(unittest.TestCase):
    robot = """<mujoco><option cone="elliptic"/><default><geom friction="0.7"/><default class="foot"><geom solref="0.04 1" {priority}/></default>
        </default><worldbody><body name="base"><joint type="free"/><geom size="0.1"/><body name="shin"><joint/>
        <geom size="0.02" class="foot" pos="0 0 -0.2"/><geom size="0.02" contype="0" conaffinity="0" pos="0 0 -0.3"/></body></body>
        </worldbody></mujoco>"""

    def stated(self, priority=""):
        return script().stated_in_mjcf(xml.fromstring(self.robot.format(priority=priority)), "shin")

    def test_the_greater_friction_and_the_mean_of_solref_hold_on_a_default_floor(self):
        engine, said, parameters = self.stated()
        self.assertEqual((engine, parameters["friction"][0], parameters["cone"]), ("mujoco", 1., "elliptic"))
        self.assertEqual(parameters["solref"], [0.03, 1.])
        self.assertIn("solref 0.04 1", said)

    def test_priority_decides(self):
        parameters = self.stated('priority="1"')[2]
        self.assertEqual((parameters["friction"], parameters["solref"]), ([0.7, 0.005, 0.0001], [0.04, 1.]))

    def test_a_foot_without_friction_has_one_row(self):
        parameters = self.stated('priority="1" condim="1"')[2]
        self.assertEqual((parameters["friction"][0], parameters["cone"]), (0., "elliptic"))

    def test_gazebo_of_a_fixed_foot_counts(self):
        root = xml.fromstring('<robot name="r"><joint name="j" type="fixed"><parent link="calf"/><child link="foot"/></joint>'
                              '<gazebo reference="foot"><kp value="1e5"/><kd>20</kd><mu1>0.6</mu1></gazebo></robot>')
        self.assertEqual(script().stated_in_urdf(root, "calf")[2], {"kp": 1e5, "kd": 20., "mu": 0.6})


class Page(unittest.TestCase):
    def test_is_what_the_files_give(self):
        folder = makers_folder()
        if folder is None:
            self.skipTest("no ../shared/data")
        made = subprocess.run([sys.executable, SCRIPT, folder / "mjcf", folder / "urdf"], capture_output=True, text=True, check=True)
        fresh, page = rows_of(made.stdout), rows_of((SOURCE / "docs/feet_as_shipped.md").read_text().split("<!-- feet -->")[1].split("<!-- end feet -->")[0])
        self.assertEqual(list(fresh), list(page))
        self.assertGreater(len(fresh), 10)
        for robot, cells in fresh.items():
            for own, shown in zip(cells, page[robot]):
                with self.subTest(robot):
                    try:
                        self.assertAlmostEqual(float(own), float(shown), delta=0.02 * abs(float(own)))
                    except ValueError:
                        self.assertEqual(own, shown)


if __name__ == "__main__":
    unittest.main()
