"""Pictures of the numerics: work and precision, orders of convergence, time reversal, stable steps, scaling, and the
Coulomb field's error against time, its crossover with the direct sum and its growth, a chain held in subdomains."""

import matplotlib.pyplot as plt
import numpy as np

from pictures import CASES, COLOURS, OTHER, finish, grid, number, rows_of


def scheme_of(name):
    return name.split(",")[0]


def style(name):
    """Colour by scheme; a dashed line where events are seen at step ends, open marks where two rates are used."""
    return dict(
        color=COLOURS.get(scheme_of(name), OTHER),
        linestyle="--" if "step ends" in name else "-",
        marker="o",
        markerfacecolor="white" if "multirate" in name else None,
        markersize=4,
        linewidth=1.3,
        label=name,
    )


def lines(rows, x, y):
    """{scheme: (x, y)} in the order of the rows."""
    found = {}
    for row in rows:
        found.setdefault(row["scheme"], []).append((number(row[x]), number(row[y])))
    return {name: np.array(points).T for name, points in found.items()}


def draw_lines(panel, rows, x, y, unit_x=1.0):
    for name, (u, v) in lines(rows, x, y).items():
        good = np.isfinite(u) & np.isfinite(v) & (v > 0)
        if good.any():
            panel.loglog(u[good] * unit_x, v[good], **style(name))


def guide(panel, text):
    """A grey line of slope 1 below the curves."""
    right, top = panel.get_xlim()[1], panel.get_ylim()[0] ** 0.35 * panel.get_ylim()[1] ** 0.65
    panel.plot([1e-9 * right, right], [1e-9 * top, top], color="0.6", linewidth=0.8, linestyle=":", scalex=False, scaley=False)
    panel.annotate(text, (0.98, 0.04), xycoords="axes fraction", color="0.4", fontsize=8, ha="right")


def draw_work_precision(rows, directory):
    rows = [row for row in rows if "step ends" not in row["scheme"]]
    cases = [case for case in CASES if any(row["case"] == case for row in rows)]
    for x, label, name in (
        ("processor time [s]", "processor time (s)", "error_against_time.png"),
        ("evaluations", "evaluations of all forces", "error_against_evaluations.png"),
    ):
        figure, panels = plt.subplots(1, len(cases), figsize=(4.2 * len(cases), 4.4), squeeze=False, layout="constrained")
        for case, panel in zip(cases, panels[0]):
            draw_lines(panel, [row for row in rows if row["case"] == case], x, "error [cm]")
            panel.set(xlabel=label, title=CASES[case])
        panels[0, 0].set_ylabel("greatest error of a bead's position (cm)")
        finish(figure, panels[0], directory / name)


def draw_convergence(rows, directory):
    """Error against the step, with events located and at step ends; error against the tolerance."""
    fixed = [row for row in rows if row["timestep [s]"]]
    adaptive = [row for row in rows if row["tolerance"]]
    cases = [case for case in CASES if any(row["case"] == case for row in fixed)]
    figure, panels = plt.subplots(1, len(cases), figsize=(4.2 * len(cases), 4.4), squeeze=False, layout="constrained")
    for case, panel in zip(cases, panels[0]):
        draw_lines(panel, [row for row in fixed if row["case"] == case], "timestep [s]", "error [cm]")
        panel.set(xlabel="time step (s)", title=CASES[case])
    panels[0, 0].set_ylabel("greatest error of a bead's position (cm)")
    finish(figure, panels[0], directory / "error_against_step.png")

    cases = [case for case in CASES if any(row["case"] == case for row in adaptive)]
    figure, panels = plt.subplots(1, len(cases), figsize=(4.2 * len(cases), 4.2), squeeze=False, layout="constrained")
    for case, panel in zip(cases, panels[0]):
        draw_lines(panel, [row for row in adaptive if row["case"] == case], "tolerance", "error [cm]")
        guide(panel, "dotted: proportional to the tolerance")
        panel.set(xlabel="tolerance", title=CASES[case])
    panels[0, 0].set_ylabel("greatest error of a bead's position (cm)")
    finish(figure, panels[0], directory / "error_against_tolerance.png")


def draw_time_reversal(rows, directory):
    figure, panel = plt.subplots(figsize=(5.6, 4.6), layout="constrained")
    step = [number(row["scaled timestep"]) for row in rows]
    for name in ("Euler", "Heun", "Runge-Kutta 4"):
        panel.loglog(step, [number(row[name]) for row in rows], **style(name))
    panel.set(xlabel="scaled time step", ylabel=r"$|\bar x_{2n} - \bar x_0| / 2n$ (scaled length)",
              title="case 1 forth to scaled time 5 and back")
    finish(figure, [panel], directory / "time_reversal.png")


def draw_stable_steps(rows, directory):
    schemes = [name for name in rows[0] if name.endswith(" [s]") and not name.startswith("relaxation")]
    place = np.arange(len(rows))
    width = 0.8 / len(schemes)
    figure, panel = plt.subplots(figsize=(7.5, 4.4), layout="constrained")
    for k, column in enumerate(schemes):
        name = column.removesuffix(" [s]")
        panel.bar(place + (k - (len(schemes) - 1) / 2) * width, [number(row[column]) for row in rows], width,
                  color=COLOURS.get(name, OTHER), label=name)
    relaxation = [number(row["relaxation time [s]"]) for row in rows]
    panel.hlines(relaxation, place - 0.4, place + 0.4, color="0.2", linewidth=1, label="relaxation time of the fluid")
    panel.set_axisbelow(True)
    panel.set_yscale("log")
    panel.set(ylabel="largest stable time step (s)", title="Case 3 with a stiffer fluid or shorter elements")
    panel.set_xticks(place, [row["case"].replace("mu", "µ").replace(" x ", " × ") for row in rows])
    finish(figure, [panel], directory / "stable_steps.png")


def draw_scaling(rows, directory):
    """The paper's two figures: speedup and efficiency against the number of workers, one line a system size."""
    rows = [row for row in rows if row["speedup"]]
    kinds = [kind for kind in ("ranks", "ranks with subdomains", "threads", "mixed") if any(row["kind"] == kind for row in rows)]
    sizes = sorted({(int(row["beads"]), row["sum"]) for row in rows})
    colours = dict(zip(sizes, plt.get_cmap("viridis")(np.linspace(0, 0.9, len(sizes)))))
    most = max(int(row["workers"]) for row in rows)
    for column, name, label, ideal in (
        ("speedup", "speedup.png", r"speedup $S_p = T_s / T_p$", lambda p: p),
        ("efficiency", "efficiency.png", r"efficiency $S_p / n_p$", lambda p: 1 + 0 * p),
    ):
        figure, panels = plt.subplots(1, len(kinds), figsize=(4.4 * len(kinds), 4.6), sharey=True, squeeze=False,
                                      layout="constrained")
        for kind, panel in zip(kinds, panels[0]):
            workers = np.arange(1, most + 1)
            panel.plot(workers, ideal(workers), "k--", linewidth=1, label="ideal")
            for size in sizes:
                points = sorted(
                    (int(row["workers"]), number(row[column]), *(number(row[f"{which}speedup"]) for which in ("least ", "", "most ")))
                    for row in rows if (int(row["beads"]), row["sum"]) == size and row["kind"] in ("serial", kind)
                )
                if len(points) < 2:  # this size has no such workers
                    continue
                p, value, least, median, greatest = np.array(points).T
                spread = value * np.array([1 - least / median, greatest / median - 1])
                panel.errorbar(p, value, spread, marker="o", markersize=4, linewidth=1.3, capsize=2,
                               color=colours[size], label=f"{size[0]} beads, {size[1]}")
            panel.set(xlabel="workers", title=f"workers are {kind}", xticks=workers)
            panel.set_ylim(bottom=0)
            if column == "efficiency":
                panel.axhline(0.8, color="0.6", linewidth=0.8, linestyle=":")
        panels[0, 0].set_ylabel(label)
        finish(figure, panels[0], directory / name)


def draw_coulomb_shapes(rows, directory):
    """Error against time of every shape of the tree, one panel a set of charges; what the program chose stands out."""
    ways = {
        "chain": dict(color="#31688e", marker="o", label="chain, any order and opening"),
        "space": dict(color="#edae49", marker="s", label="space"),
        "Barnes-Hut": dict(color="#999999", marker="^", label="Barnes-Hut"),
        "chosen": dict(color="#d1495b", marker="D", label="chosen for an accuracy", linestyle="-", linewidth=1),
    }
    sets = rows_of(rows, "charges")
    figure, panels = grid(len(sets))
    for (name, some), panel in zip(sets.items(), panels.flat):
        for way, of_way in rows_of(some, "way").items():
            u = np.array([number(row["time [ns/point]"]) for row in of_way])
            v = np.array([number(row["error"]) for row in of_way])
            good = v > 1e-14
            panel.loglog(u[good], v[good], **{"linestyle": "none", "markersize": 3.5, **ways[way]})
        if all(number(row["error"]) <= 1e-14 for row in some):
            panel.annotate("the direct sum is faster", (0.5, 0.5), xycoords="axes fraction", ha="center", color="0.4")
        panel.set(title=f"{name}, {int(some[0]['N']):,} points", xlabel="time (ns a point, one thread)")
        panel.title.set_fontsize(9)
    for line in panels:
        line[0].set_ylabel("relative L2 error of the field")
    finish(figure, panels.flat, directory / "coulomb_error_against_time.png")


def draw_coulomb_accuracy(rows, directory):
    """What came of each accuracy asked for: the error, and how much faster than the direct sum."""
    rows = [row for row in rows if row["tree"] != '"direct"' and number(row["order"]) > 0]
    sizes = list(rows_of(rows, "N").items())
    figure, panels = plt.subplots(2, len(sizes), figsize=(max(6.4, 4.0 * len(sizes)), 7.4), squeeze=False, sharex=True, layout="constrained")
    for (n, of_size), (error, gain) in zip(sizes, panels.T):
        for (name, some), colour in zip(rows_of(of_size, "charges").items(), plt.cm.tab10.colors):
            u = [number(row["accuracy"]) for row in some]
            look = dict(color=colour, marker="o", markersize=4, linewidth=1.2, label=name)
            error.loglog(u, [number(row["error"]) for row in some], **look)
            gain.loglog(u, [number(row["direct / tree"]) for row in some], **look)
        ends = np.array(error.get_xlim())
        error.plot(ends, ends, color="0.4", linewidth=0.8, linestyle=":", scalex=False, scaley=False)
        gain.axhline(1, color="0.4", linewidth=0.8, linestyle=":")
        error.set_title(f"{int(n):,} points")
        gain.set_xlabel("accuracy asked for")
    panels[0, 0].set_ylabel("relative L2 error\n(dotted: the promise)")
    panels[1, 0].set_ylabel("time of the direct sum\nover that of the tree")
    finish(figure, panels.flat, directory / "coulomb_accuracy.png")


def draw_coulomb_crossover(rows, directory):
    paths = rows_of(rows, "vectors")
    figure, panels = grid(len(paths), width=4.2, height=3.8)
    for (path, some), panel in zip(paths.items(), panels.flat):
        for (name, of_set), colour in zip(rows_of(some, "charges").items(), plt.cm.tab10.colors):
            panel.loglog([number(row["accuracy"]) for row in of_set], [number(row["measured"]) for row in of_set],
                         color=colour, marker="o", markersize=4, linewidth=1.2, label=f"measured, {name}")
        one = next(iter(rows_of(some, "charges").values()))
        panel.loglog([number(row["accuracy"]) for row in one], [number(row["table"]) for row in one], color="0.2",
                     linestyle="--", linewidth=1.2, label="shipped table")
        panel.set(title=path, xlabel="accuracy")
    panels[0, 0].set_ylabel("points at which the tree becomes faster")
    finish(figure, panels.flat, directory / "coulomb_crossover.png")


def draw_coulomb_growth(rows, directory):
    accuracies = rows_of(rows, "accuracy")
    figure, panels = grid(len(accuracies))
    for (accuracy, some), panel in zip(accuracies.items(), panels.flat):
        n = sorted({number(row["N"]) for row in some})
        direct = [np.mean([number(row["direct [s]"]) for row in some if number(row["N"]) == size]) for size in n]
        panel.loglog(n, direct, color="0.2", linestyle="--", linewidth=1.2, label="direct sum")
        for (name, of_set), colour in zip(rows_of(some, "charges").items(), plt.cm.tab10.colors):
            panel.loglog([number(row["N"]) for row in of_set], [number(row["time [s]"]) for row in of_set], color=colour,
                         marker="o", markersize=4, linewidth=1.2, label=name)
        panel.set(title=f"accuracy {accuracy}", xlabel="number of points N")
    panels[0, 0].set_ylabel("time of an evaluation (s, one thread)")
    finish(figure, panels.flat, directory / "coulomb_growth.png")


def draw_distributed(rows, directory):
    """What a rank of a chain in subdomains is sent, holds, and how accurate the field is."""
    figure, panels = plt.subplots(1, 3, figsize=(11, 4), layout="constrained")
    groups = {(chain, size): of for chain, some in rows_of(rows, "chain").items() for size, of in rows_of(some, "points").items()}
    for ((chain, size), some), colour in zip(groups.items(), plt.cm.tab10.colors):
        ranks = [number(row["ranks"]) for row in some]
        line = dict(color=colour, marker="o", markersize=4, linewidth=1.2, label=f"{chain}, {int(size):,} points")
        several = [row for row in some if number(row["ranks"]) > 1]
        panels[0].loglog([number(row["ranks"]) for row in several], [number(row["sent [kB]"]) / 1e3 for row in several], **line)
        panels[1].loglog(ranks, [number(row["held [MB]"]) for row in some], **line)
        panels[2].loglog(ranks, [number(row["error L2"]) for row in some], **line)
    for panel, title in zip(panels, ("sent by a rank in an evaluation (MB)", "held by a rank (MB)", "relative L2 error, 1e-5 asked for")):
        panel.set(xlabel="ranks", title=title)
        panel.set_xscale("log", base=2)
    panels[2].axhline(1e-5, color="0.6", linewidth=0.8, linestyle=":")
    finish(figure, panels, directory / "distributed.png")


def draw_distributed_model(rows, directory):
    """The MODEL of strong and weak scaling."""
    figure, panel = plt.subplots(figsize=(6, 4.2), layout="constrained")
    groups = rows_of(rows, "scaling")
    lines_of = {f"strong, {float(size):.0e} points": of for size, of in rows_of(groups["strong"], "points").items()}
    weak = groups["weak"]
    lines_of[f"weak, {number(weak[0]['points']) / number(weak[0]['ranks']):.0e} points a rank"] = weak
    for (label, some), colour in zip(lines_of.items(), plt.cm.tab10.colors):
        panel.semilogx([number(row["ranks"]) for row in some], [number(row["MODEL efficiency"]) for row in some],
                       color=colour, marker="o", markersize=4, linewidth=1.2, label=label)
    panel.set(xlabel="ranks", ylabel="efficiency", title="MODEL, not a measurement: chain in subdomains", ylim=(0, 1.05))
    panel.axhline(0.8, color="0.6", linewidth=0.8, linestyle=":")
    finish(figure, [panel], directory / "distributed_model.png")


DRAWINGS = {
    "time_reversal": [draw_time_reversal],
    "work_precision": [draw_work_precision, draw_convergence],
    "stable_steps": [draw_stable_steps],
    "scaling": [draw_scaling],
    "coulomb_accuracy": [draw_coulomb_accuracy],
    "coulomb_shapes": [draw_coulomb_shapes],
    "coulomb_crossover": [draw_coulomb_crossover],
    "coulomb_growth": [draw_coulomb_growth],
    "distributed": [draw_distributed],
    "distributed_model": [draw_distributed_model],
}
