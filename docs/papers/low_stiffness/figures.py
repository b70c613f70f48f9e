"""Figures of the page, drawn by gnuplot from the summary and the prediction."""

from paper import FIGURES, gnuplot
from tables import PREDICTED, SUMMARY, predictions

PREDICTION = (f'"{PREDICTED}" skip 1 using (column(1) == cruse ? column(2) / 1000 : 1/0):(column(3) > 0.01 ? column(3) : 0.0102) '
              'with lines dt 2 lw 1.5 lc rgb "#000000" title "predicted, level ground",')


def leg_limit(cruse):
    """The leg's limit if legs were rigid [kN/m]: load of a third or a quarter of the weight over the heave on hard ground."""
    return f"{41.4 / (4 if cruse else 3) / float(predictions()[cruse, 300.0]['heave']) / 1000:.3g}"


def draw(file, column, factor, title, low, high, prediction="", limits=(0, 0)):
    """`column` of the summary over stiffness: a panel a gait and ground, a line a subject. `limits`: vertical lines of both gaits [kN/m]; 0: none."""
    gnuplot(f"""
set terminal svg size 1200,720 font "sans,12" background "#ffffff"
set output "{file}"
set datafile separator ","
set multiplot layout 2,4 margins 0.06,0.99,0.21,0.94 spacing 0.012,0.05
set logscale xy
set xrange [0.2:450]
set yrange [{low}:{high}]
set format y "%g"
set format x "%g"
set grid lc rgb "#e5e5e5"
unset key
array Lines[3] = ["hookpoint, each stiffness at a stable step", "hookpoint, one step of 0.5 ms", "nominal, at stable steps"]
array Names[4] = ["concrete", "ice", "clay", "rubble"]
do for [cruse = 0:1] {{
  do for [ground = 1:4] {{
    if (cruse == 0) {{ set title Names[ground]; set format x "" }} else {{ unset title; set format x "%g"; set xlabel "stiffness [kN/m]" }}
    if (ground == 1) {{ set ylabel (cruse == 0 ? "tripods: " : "Cruse: ") . "{title}"; set format y "%g" }} else {{ unset ylabel; set format y "" }}
    unset arrow
    limit = cruse == 0 ? {limits[0]} : {limits[1]}
    if (limit > 0) {{ set arrow from limit, graph 0 to limit, graph 1 nohead dt 3 lc rgb "#888888" }}
    if (cruse == 1 && ground == 2) {{ set key at screen 0.5,0.02 bottom center vertical maxcols 1 samplen 3 }} else {{ unset key }}
    plot {prediction} for [s = 1:3] "{SUMMARY}" skip 1 using ((strcol(1) eq word("hookpoint fixed_step nominal", s) && column(2) == cruse && column(3) == ground && strlen(strcol({column})) > 0) ? column(4) : 1/0):(column({column}) * {factor} > {low} ? column({column}) * {factor} : {low} * 1.02) with linespoints pt (s == 1 ? 7 : s == 2 ? 5 : 9) ps 0.6 lw 1.5 lc rgb word("#0060ad #dd181f #2e8b57", s) title Lines[s]
  }}
}}
""")


def draw_all():
    draw(FIGURES / "low_stiffness_slip.svg", 9, 1000, "slip a stance [mm]", 0.05, 60)
    draw(FIGURES / "low_stiffness_losses.svg", 7, 1, "losses a stance", 0.01, 40, PREDICTION, (leg_limit(0), leg_limit(1)))
