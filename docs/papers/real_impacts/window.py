"""The toss of the page in the window: its file, its measured way, its picture."""

import os
import pathlib
import subprocess
import sys

import numpy as np

from paper import FIGURES, ROOT, program, rows_of
from setting import CONSTANTS, DATA, LAWS, POWERS, RATE, frame_of_scene, summary
from rotations import inverse, logarithm, product
from flights import MASS
from runs import published_constants

VIEW = ROOT / "configs/views/thrown_cube.hook"
FAMILIES = {  # the ends of each one's hue, dark and light
    "ours": ("#00286a", "#58c4f0"),
    "ode": ("#a01010", "#d84a3a"),
    "ode_quickstep": ("#e0602a", "#f59a70"),
    "bullet": ("#006b3c", "#4cc38a"),
    "mujoco": ("#6a2a9c", "#b68ae0"),
    "dart": ("#8a6a00", "#d8b030"),
    "simbody": ("#c2187a", "#f082c0"),
}


def family_of(subject):
    return "ours" if subject in LAWS else subject.rpartition("_")[0] or subject


def colours_of(subjects):
    """Of each a colour of its family's, evenly from the dark end to the light one."""
    found = {}
    for subject in subjects:
        family = [other for other in subjects if family_of(other) == family_of(subject)]
        share = family.index(subject) / max(1, len(family) - 1)
        ends = [[int(end[i : i + 2], 16) / 255 for i in (1, 3, 5)] for end in FAMILIES[family_of(subject)]]
        found[subject] = ", ".join(f"{(1 - share) * dark + share * light:.3g}" for dark, light in zip(*ends))
    return found


def write_way(number):
    """What was measured of a toss, with velocities (the slopes between samples before and after), for the hand that leads the run's cube."""
    rows = [row for row in rows_of(DATA / "tosses.csv") if int(row["toss"]) == number]
    values = lambda *titles: np.array([[float(row[title]) for title in titles] for row in rows])
    t, p, q = 1e-3 * values("t [ms]")[:, 0], values("x [m]", "y [m]", "z [m]"), values("qw", "qx", "qy", "qz")
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    for k in range(1, len(q)):
        q[k] *= 1.0 if q[k] @ q[k - 1] >= 0 else -1.0
    v, w = np.diff(p, axis=0) * RATE, logarithm(product(q[1:], inverse(q[:-1]))) * RATE
    middle = lambda slopes: np.concatenate([slopes[:1], (slopes[1:] + slopes[:-1]) / 2, slopes[-1:]])
    with open(DATA / "shown.csv", "w") as file:
        file.write("t [s],x [m],y [m],z [m],qw,qx,qy,qz,vx [m/s],vy [m/s],vz [m/s],wx [rad/s],wy [rad/s],wz [rad/s]\n")
        for each in zip(t, *p.T, *q.T, *middle(v).T, *middle(w).T):
            file.write(",".join(f"{x:.6g}" for x in each) + "\n")


def write_view(number, constants):
    state = next(row for row in rows_of(DATA / "states.csv") if int(row["toss"]) == number)
    frame = frame_of_scene()
    three = lambda *titles: ", ".join(state[title] for title in titles)
    text = f"""// Toss {number} of a real cube (docs/papers/real_impacts/page.md) as it was measured and, as ghosts, as our laws and other engines predict it
// under the constants identified of each. The run's own cube is led along the measured way by a hand: a stiff spring and damper to its
// pose and velocity, beside which what the table does to it is nothing. Written by docs/papers/real_impacts/make.py.
Param led = 1;  // 0: nobody leads it, and it flies from the state that its measured flight tells
Param friction = 0;
Param stiffness = 1 N/m;
Param damping = 0 N.s/m;
Param restitution = 0;
Param hysteresis = 0 s/m;
Param powers = 1;

World world {{
  gravity = {frame["gravity"]:g};
  deltat = 0.5 ms;
  duration = {len([row for row in rows_of(DATA / "tosses.csv") if int(row["toss"]) == number]) / RATE:.2g} s;
  Include "materials/acrylic_on_wood.hook" (friction = friction, stiffness = stiffness, damping = damping, restitution = restitution, hysteresis = hysteresis, powers = powers);
  Terrain.Flat ground {{ height = {1e3 * frame["table"]:g} mm; material = acrylic_on_wood; spacing = 0.1 m; size = 2, 2; }}
  Robot cube {{
    Base.mobile {{
      location = {three("x [m]", "y [m]", "z [m]")};
      orientation = {three("qw", "qx", "qy", "qz")};
      velocity = {three("vx [m/s]", "vy [m/s]", "vz [m/s]")};
      angular_velocity = {three("wx [rad/s]", "wy [rad/s]", "wz [rad/s]")};
      mass = {MASS} kg;
      center_of_mass = {", ".join(f"{1e3 * x:g} mm" for x in frame["offset"])};
      inertia = {frame["inertia"]:g}, {frame["inertia"]:g}, {frame["inertia"]:g}, 0, 0, 0;
      Shape.Box {{ dimensions = {2e3 * frame["half"]:g} mm, {2e3 * frame["half"]:g} mm, {2e3 * frame["half"]:g} mm; }}
    }}
  }}
  For hand in 1..led {{
    Force hand {{ body = cube.base; }}
  }}
}}

"""
    columns = ["x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"]
    text += "For hand in 1..led {\n"
    text += "".join(f'  Data {name} {{ file = "data/cube_tosses/shown.csv"; column = "{name}"; }}\n' for name in columns)
    turn = ("x", "y", "z")
    q = "world.cube.orientation"
    for i, axis in enumerate(turn):
        text += f"""  Expression push_{axis} {{ formula = "0.37 kg * (250000 / (1 s^2) * ({axis}.output - world.cube.position.{axis}) + 1000 / (1 s) * (v{axis}.output - world.cube.velocity.{axis}))"; Wire TO world.hand.force.{axis}; }}\n"""
    # Twice the vector of measured x inverse of present, times their scalar product, which is nearly 1 or -1 as their signs are.
    for i, axis in enumerate(turn):
        a, b = turn[(i + 1) % 3], turn[(i + 2) % 3]
        error = f"2 * (q{axis}.output * {q}.w - qw.output * {q}.{axis} + q{b}.output * {q}.{a} - q{a}.output * {q}.{b}) * (qw.output * {q}.w + qx.output * {q}.x + qy.output * {q}.y + qz.output * {q}.z)"
        text += f"""  Expression turn_{axis} {{ formula = "{frame["inertia"]:g} kg.m^2 * (250000 / (1 s^2) * {error} + 1000 / (1 s) * (w{axis}.output - world.cube.angular_velocity.{axis}))"; Wire TO world.hand.torque.{axis}; }}\n"""
    text += "}\n\n"
    colours = colours_of(list(constants))
    text += "Ghost measured { colour = 1, 1, 1; }\n"
    for subject, values in constants.items():
        fields = [] if subject in LAWS else [f"engine = {subject.rpartition('_')[0]}; settings = {subject.rpartition('_')[2]};"]
        fields += [f"contact = {subject};"] if subject in LAWS else []
        fixes = ["Fix led { value = 0; }"] + [f"Fix {name} {{ value = {value} {CONSTANTS[name]}; }}" for name, value in values.items()]
        fixes += ["Fix powers { value = 31.6; }"] if subject in POWERS else []
        text += f"Ghost {subject} {{ {' '.join(fields)} colour = {colours[subject]}; {' '.join(fixes)} }}\n"
    text += f"""
Window {{
  Window.grob along {{ label = "toss {number}, along the table"; size = 612, 520; drawer = world; follow = world.cube.base; distance = 1; zoom = 2.3; euler1 = -12 deg; euler2 = 9 deg; }}
  Window.grob above {{ label = "from above"; size = 612, 520; drawer = world; follow = world.cube.base; distance = 1; zoom = 2.3; euler1 = 20 deg; euler2 = 58 deg; }}
}}
"""
    VIEW.write_text(text)
    subprocess.run([program(), "fmt", VIEW], check=True, capture_output=True)


def window_picture():
    """The toss of the page in the window, by a Chromium without a display; where there is none the picture stays as it is."""
    number = int(summary("toss")[0]["toss"])
    write_way(number)
    write_view(number, published_constants())
    picture = FIGURES / "real_impacts_window.png"
    build = pathlib.Path(program()).resolve().parent
    status = subprocess.run([ROOT / "docs/make/gallery", picture.stem], env={**os.environ, "HOOKPOINT_BUILD": build}, check=False).returncode
    if status == 3:
        print(f"real_impacts: {picture.relative_to(ROOT)} stays as it is: Node, Chromium or npm's registry is missing", file=sys.stderr)
    elif status != 0:
        sys.exit(f"real_impacts: docs/make/gallery {picture.stem} gave {status}")
