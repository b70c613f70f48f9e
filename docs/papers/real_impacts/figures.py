"""Figures of the page, drawn by gnuplot from the summaries beside it."""

from paper import FIGURES, gnuplot
from setting import CONSTANTS, LAWS, PEERS, summary
from runs import ranges
from tables import metric_of, subjects_by_error

COMMON = 'set terminal svg size 1100,520 font "sans,12" background "#ffffff"\nset grid lc rgb "#e5e5e5"\n'


def draw_errors():
    rows = summary("metrics")
    order = subjects_by_error(rows)
    plots, blocks = [], ""
    for metric, label in (("position", "position, mean [% of the edge]"), ("rotation", "rotation, mean [deg]")):
        for stage in ("identified", "untuned"):
            name = f"${metric}_{stage}"
            blocks += f"{name} << EOD\n"
            for i, subject in enumerate(order):
                row = metric_of(rows, stage, subject, metric)
                if row:
                    blocks += f"{row['mean']} {len(order) - i} {row['low']} {row['high']}\n"
            blocks += "EOD\n"
        plots.append((metric, label))
    tics = ", ".join(f'"{subject}" {len(order) - i}' for i, subject in enumerate(order)).replace("_", "\\\\_")
    text = COMMON + f'set output "{FIGURES}/real_impacts_errors.svg"\n' + blocks + f"set multiplot layout 1,2\nset yrange [0:{len(order) + 1}]\nset ytics ({tics})\nset key above samplen 1 width -3\nset xrange [0:*]\n"
    for metric, label in plots:
        text += f'set xlabel "{label}"\nplot ${metric}_identified using 1:2:3:4 with xerrorbars pt 7 ps 0.6 lw 1.5 lc rgb "#0060ad" title "identified, held out", ${metric}_untuned using 1:2:3:4 with xerrorbars pt 6 ps 0.6 lc rgb "#aaaaaa" title "untuned"\n'
    gnuplot(text)


def draw_constants():
    rows, within_range = summary("constants"), ranges()
    order = [s for s in subjects_by_error(summary("metrics")) if any(row["subject"] == s for row in rows)]
    tics = ", ".join(f'"{subject}" {len(order) - i}' for i, subject in enumerate(order)).replace("_", "\\\\_")
    text = COMMON + f'set output "{FIGURES}/real_impacts_constants.svg"\nset multiplot\nset yrange [0:{len(order) + 1}]\nset ytics ({tics})\nset tmargin at screen 0.9\nset bmargin at screen 0.14\nunset key\n'
    for i, constant in enumerate(("friction", "restitution", "stiffness", "damping", "hysteresis")):
        lower, upper, logarithmic = within_range[constant]
        of = [row for row in rows if row["constant"] == constant]
        for told in (True, False):
            text += f"${constant}_{'told' if told else 'untold'} << EOD\n" + "".join(
                f"{row['value']} {len(order) - order.index(row['subject'])} {row['low']} {row['high']}\n" for row in of if (row["untold"] == "") == told
            ) + "NaN NaN NaN NaN\nEOD\n"
        unit = f" [{CONSTANTS[constant]}]" if CONSTANTS[constant] else ""
        text += f'set lmargin at screen {0.18 + 0.165 * i}\nset rmargin at screen {0.31 + 0.165 * i}\n' + ("set logscale x\n" if logarithmic else "unset logscale x\n")
        text += f'set xrange [{lower}:{upper}]\nset xtics autofreq\nset xlabel "{constant}{unit}"\n' + ("set xtics 0.1\n" if constant == "friction" else "set xtics 0.2\n" if constant == "restitution" else "")
        text += f'plot ${constant}_told using 1:2:3:4 with xerrorbars pt 7 ps 0.5 lw 1.5 lc rgb "#0060ad", ${constant}_untold using 1:2:3:4 with xerrorbars pt 6 ps 0.5 lc rgb "#aaaaaa"\n'
        text += f'set ytics ({", ".join(str(n) for n in range(1, len(order) + 1))})\nset format y ""\n'
    gnuplot(text)


COLORS = ["#0060ad", "#dd181f", "#2e8b57", "#e69f00", "#8a2be2", "#00a0a0"]


def draw_impacts():
    rows = summary("by_impacts")
    shown = [s for s in subjects_by_error(summary("metrics")) if s in LAWS][:3] + [s for s in subjects_by_error(summary("metrics")) if s in PEERS][:3]
    text = COMMON + f'set output "{FIGURES}/real_impacts_by_impacts.svg"\n'
    for stage in ("identified", "floor"):
        for subject in shown:
            text += f"${stage}_{subject} << EOD\n" + "".join(
                f"{row['impacts']} {row['position [%]']} {row['rotation [deg]']}\n" for row in rows if (row["stage"], row["subject"]) == (stage, subject)
            ) + "-1 NaN NaN\nEOD\n"
    text += 'set multiplot layout 1,2\nset logscale y\nset xrange [0:*]\nset xlabel "impacts so far, measured"\nset key bottom right\n'
    for column, label in ((2, "position [% of the edge]"), (3, "rotation [deg]")):
        curves = []
        for i, subject in enumerate(shown):
            name = subject.replace("_", "\\\\_")
            curves.append(f'$identified_{subject} using 1:{column} with linespoints pt 7 ps 0.5 lc rgb "{COLORS[i]}" title "{name}"')
            curves.append(f'$floor_{subject} using 1:{column} with lines dt 2 lc rgb "{COLORS[i]}" notitle')
        text += f'set ylabel "{label}"\nplot ' + ", ".join(curves) + "\n"
    gnuplot(text)


def draw_toss():
    rows = summary("toss")
    subjects = list(dict.fromkeys(row["subject"] for row in rows))
    text = COMMON + f'set output "{FIGURES}/real_impacts_toss.svg"\n'
    for subject in subjects:
        text += f"$of_{subject} << EOD\n" + "".join(f"{row['t [ms]']} {row['x [mm]']} {row['z [mm]']} {row['angle [deg]']}\n" for row in rows if row["subject"] == subject) + "EOD\n"
    color = lambda subject: "#000000" if subject == "measured" else "#0060ad" if subject in LAWS else "#dd181f"
    text += f'set multiplot layout 1,2 title "toss {rows[0]["toss"]}: measured black, our laws blue, other engines red"\nunset key\nset xlabel "time [ms]"\n'
    for column, label in ((3, "height of the centre [mm]"), (4, "turned away from the measured orientation [deg]")):
        curves = [
            f'$of_{subject} using 1:{column} with {"points pt 7 ps 0.4" if subject == "measured" else "lines lw 0.8"} lc rgb "{color(subject)}"'
            for subject in [*subjects[1:], "measured"]
            if not (column == 4 and subject == "measured")
        ]
        text += f'set ylabel "{label}"\nplot ' + ", ".join(curves) + "\n"
    gnuplot(text)
