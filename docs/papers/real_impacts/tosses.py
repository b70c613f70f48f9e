"""The source's table of tosses as configs/data/cube_tosses/."""

import math

import numpy as np

from paper import write_csv
from setting import DATA, PAGE, RATE
from rotations import matrices
from flights import Bias, centre_of_mass, fit_centre, fit_turn, flight_of, lowest, settled_length


def read_tosses(path):
    table = np.genfromtxt(path, delimiter=",", skip_header=1, usecols=range(9))
    return {int(i): (table[table[:, 0] == i][:, 2:5], table[table[:, 0] == i][:, 5:9]) for i in np.unique(table[:, 0])}


def frame_rows(even, odd):
    """Of each quantity of frame and cube what the tosses of even number say, with its standard error or its quartiles, and what those of odd number say."""
    each = lambda values, factor=1: " ".join(f"{factor * x:.2f}" for x in values)
    of = {
        ("fall", "m/s^2"): lambda b: (f"{b.gravity:.3f}", f"{b.gravity_error:.3f}"),
        ("half", "mm"): lambda b: (f"{1e3 * b.half:.2f}", f"{1e3 * b.half_error:.2f}"),
        ("table", "mm"): lambda b: (f"{1e3 * b.table:.2f}", ""),
        ("centre of mass, by impacts", "mm"): lambda b: (each(b.offset, 1e3), each(b.offset_error, 1e3)),
        ("centre of mass, by flights", "mm"): lambda b: (each(b.flight_offset, 1e3), each(b.flight_offset_error, 1e3)),
        ("moment of inertia", "g m^2"): lambda b: (f"{1e3 * b.inertia:.3f}", f"{1e3 * b.inertia_error:.3f}"),
        ("impacts of one corner", ""): lambda b: (f"{b.impacts}", ""),
        ("their momentum left unbalanced, median", "%"): lambda b: (f"{100 * b.unbalanced:.0f}", ""),
        ("their rebound, median and quartiles", ""): lambda b: (f"{b.rebound[1]:.3f}", f"{b.rebound[0]:.3f} to {b.rebound[2]:.3f}"),
        ("their friction, median and quartiles", ""): lambda b: (f"{b.friction[1]:.3f}", f"{b.friction[0]:.3f} to {b.friction[2]:.3f}"),
    }
    return [[*title, *told(even), *told(odd)] for title, told in of.items()]


def write_data(source):
    tosses = read_tosses(source)
    bias = Bias([poses for number, poses in tosses.items() if number % 2 == 0])
    other = Bias([poses for number, poses in tosses.items() if number % 2 == 1])
    states, noise = [], []
    for number, (p, q) in tosses.items():
        flight = flight_of(lowest(p, q, bias.half, bias.table))
        part = slice(flight.start, flight.stop)
        t = np.array(flight) / RATE
        (c0, v), rest_p, unit = fit_centre(t, centre_of_mass(p[part], q[part], bias.offset), bias.gravity)
        w, q0, rest_q = fit_turn(t, q[part])
        turned = matrices(q0[None])[0] @ bias.offset
        p0, v = c0 - turned, v - np.cross(w, turned)
        free = len(t) / (len(t) - 2)
        noise.append(np.concatenate([np.mean(rest_p**2, 0), np.mean(rest_q**2, 0)]) * free)
        states.append((number, p0, q0 / np.linalg.norm(q0), v, w, len(t), flight.stop / RATE, unit))
    # One noise for all tosses: the median is that of a flight which nothing touched.
    noise = np.median(noise, 0)
    lines = ["toss,x [m],y [m],z [m],qw,qx,qy,qz,vx [m/s],vy [m/s],vz [m/s],wx [rad/s],wy [rad/s],wz [rad/s],flight [s],position_error [mm],velocity_error [mm/s],angle_error [deg],rate_error [deg/s]"]
    for number, p0, q0, v, w, count, end, unit in states:
        place, turn = math.sqrt(noise[:3].mean()), math.degrees(math.sqrt(noise[3:].mean()))
        root = np.sqrt(np.diag(unit))
        fields = [f"{number}"]
        fields += [f"{x:.6f}" for x in [*p0, *q0]] + [f"{x:.5f}" for x in [*v, *w]]
        fields += [f"{end:.4f}", *(f"{x:.3g}" for x in (1e3 * place * root[0], 1e3 * place * root[1], turn * root[0], turn * root[1]))]
        lines.append(",".join(fields))
    DATA.mkdir(parents=True, exist_ok=True)
    (DATA / "states.csv").write_text("\n".join(lines) + "\n")
    with open(DATA / "tosses.csv", "w") as file:
        file.write("toss,t [ms],x [m],y [m],z [m],qw,qx,qy,qz\n")
        for number, (p, q) in tosses.items():
            for k in range(settled_length(p, q)):
                file.write(f"{number},{1e3 * k / RATE:.3f}," + ",".join(f"{x:.5f}" for x in [*p[k], *q[k]]) + "\n")
    write_csv(PAGE.parent / "frame.csv", ["quantity", "unit", "even", "even_error", "odd", "odd_error"], frame_rows(bias, other))
    print("noise of a sample: position [mm]", 1e3 * np.sqrt(noise[:3]), "angle [deg]", np.degrees(np.sqrt(noise[3:])))
