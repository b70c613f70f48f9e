"""Names and numbers that all modules of this page share."""

import pathlib

import numpy as np

from paper import ROOT, rows_of

DATA = ROOT / "configs/data/cube_tosses"
RATE = 148.0  # samples a second
CORNERS = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)], float)
SETTLED = 10  # samples at rest that are kept
# Of a flight the first samples are left out, where the hand lets go and the tracker's filter begins, unless too few remain.
LATE, LEAST = 3, 6
FOLDS = 5
SCENE = ROOT / "configs/scenes/tossed_cube.hook"
TUNINGS = ROOT / "configs/tunings/acrylic_on_wood"
GIVEN = ROOT / "configs/tunings/acrylic_on_wood_given.hook"
PAGE = pathlib.Path(__file__).resolve().parent / "page.md"
LAWS = ["hookpoint", "hookpoint_reset", "nominal", "hunt_crossley", "azad_featherstone", "lugre", "elastoplastic", "exponential", "impulse", "impulse_reversal"]
ENGINES = ("ode", "ode_quickstep", "bullet", "mujoco", "dart", "simbody")
PEERS = [f"{engine}_{settings}" for engine in ENGINES for settings in ("matched", "recommended")]
DEFAULTS = [f"{engine}_default" for engine in ENGINES]
SUBJECTS = LAWS + PEERS
# Engines that nobody has identified, each with the subject whose constants it takes.
BORROWERS = {
    "mujoco_3_14_recommended": "mujoco_recommended",
    "mujoco_3_14_matched": "mujoco_matched",
    "rapier_recommended": "impulse",
    "jolt_recommended": "impulse",
}
POWERS = ("hunt_crossley", "azad_featherstone")  # whose stiffness is not in N/m
CONSTANTS = {"friction": "", "stiffness": "kN/m", "damping": "N.s/m", "restitution": "", "hysteresis": "s/m"}
MOVED = 120  # tosses whose initial states are moved within their errors
TRACKING_ANGLE, TRACKING_PLACE = 0.38, 0.33e-3  # deg, m: spread, about each axis and upwards, of the poses of cubes that lie flat


def frame_of_scene():
    """Gravity, half, table, offset of the centre of mass and moment of inertia of the scene's file, in SI."""
    text = SCENE.read_text()
    value = lambda name: float(text.split(f"Param {name} = ")[1].split()[0])
    offset = 1e-3 * np.array([value(f"center_{axis}") for axis in "xyz"])
    return {"gravity": value("fall"), "half": 1e-3 * value("half"), "table": 1e-3 * value("table"), "offset": offset, "inertia": value("moment")}


def parts_of(out, stage="identified"):
    """The calibrations of a stage of a run."""
    return [path.parent for path in sorted(out.glob(f"{stage}/*/curves.csv"))]


def summary(name):
    return rows_of(PAGE.parent / f"{name}.csv")
