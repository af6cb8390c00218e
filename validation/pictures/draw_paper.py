"""Pictures of the paper's cases, of the whipping's spectrum and of the length of the elements."""

import matplotlib.pyplot as plt
import numpy as np

from pictures import COLOURS, DENSITIES, OTHER, PUBLISHED, VOLTAGES, column, finish, rows_of, table

STAR = dict(color="#d62828", marker="*", markersize=12, linestyle="none", zorder=5)


def draw_case1(rows, directory):
    """The paper's figure of velocity and length, the latter divided by 5."""
    figure, panel = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    t, some = column(rows, "time"), slice(4, None, 5)
    panel.plot(t, column(rows, "velocity"), color="#00798c", label="velocity, Treejet")
    panel.plot(t, column(rows, "length") / 5, color="#00798c", linestyle=":", label="length / 5, Treejet")
    panel.plot(t[some], column(rows, "published velocity")[some], **PUBLISHED, label="JETSPIN, published")
    panel.plot(t[some], column(rows, "published length")[some] / 5, **PUBLISHED)
    point = table(directory / "case1_stationary.csv")[0]
    panel.plot(float(point["time"]), float(point["velocity"]), **STAR, label="quasi-stationary point")
    panel.set(xlabel="scaled time (0.01 s)", ylabel="scaled velocity (31.9 cm/s), length / 5 (0.319 cm)", title="Case 1: one bead")
    finish(figure, [panel], directory / "case1.png")


def draw_case2(rows, directory):
    """The dragging velocity, and the rows that JETSPIN published."""
    densities = rows_of(rows, "density")
    figure, panels = plt.subplots(1, len(densities), figsize=(4.6 * len(densities), 4), squeeze=False, layout="constrained")
    for (name, some), panel in zip(densities.items(), panels[0]):
        panel.plot(column(some, "t [s]"), column(some, "dragging velocity [cm/s]"), color=DENSITIES[name], label=f"{name} charge density")
        panel.set(xlabel="t (s)", title=f"Case 2, {name} charge density", ylim=(0, None))
    panels[0, 0].set_ylabel("dragging velocity (cm/s), mean of 0.01 s")
    finish(figure, panels[0], directory / "case2_dragging_velocity.png")

    figure, panels = plt.subplots(1, 4, figsize=(13.6, 3.8), layout="constrained")
    some = densities["example"]
    for panel, (name, label) in zip(panels, {"x [cm]": "x of the farthest bead (cm)", "n": "beads on the jet", "rc [cm]": "radius at the collector (cm)",
                                             "current [statC/s]": "current at the collector (statC/s)"}.items()):
        panel.plot(column(some, "t [s]"), column(some, name), color=DENSITIES["example"], linewidth=1.2, label="Treejet")
        panel.plot(column(some, "t [s]")[::2], column(some, f"published {name}")[::2], **PUBLISHED, label="JETSPIN, published")
        panel.set(xlabel="t (s)", ylabel=label)
    figure.suptitle("Case 2 with the example's charge density", fontsize=11)
    finish(figure, panels, directory / "case2_published.png")


def draw_case2_elements(rows, directory):
    densities = rows_of(rows, "density")
    figure, panels = plt.subplots(2, 2, figsize=(8.4, 6.4), layout="constrained")
    for (name, some), of_density in zip(densities.items(), panels.T):
        for panel, what, label in zip(of_density, ("rc [cm]", "current [statC/s]"), ("radius at the collector (cm)", "current at the collector (statC/s)")):
            panel.semilogx(column(some, "H"), column(some, what), color=DENSITIES[name], marker="o", markersize=4, label=f"{name} charge density")
            for h, value, step in zip(column(some, "H"), column(some, what), column(some, "l_step [cm]")):
                panel.annotate(f"{step:g}", (h, value), xytext=(3, 3), textcoords="offset points", fontsize=7, color="0.4")
            panel.set(xlabel="H = h / L$_0$ (grey: length of an element in cm)", ylabel=label)
            panel.minorticks_off()
            panel.margins(x=0.12)
            panel.set_xticks(column(some, "H"), [f"{h:.0f}" for h in column(some, "H")])
    figure.suptitle("Case 2: steady state against the length of an element", fontsize=11)
    finish(figure, panels.flat, directory / "case2_elements.png")


def draw_case2_bead(rows, directory):
    """The paper's figure: velocity divided by 10 and position of a bead on its way."""
    points = rows_of(table(directory / "case2_stationary.csv"), "density")
    densities = rows_of(rows, "density")
    figure, panels = plt.subplots(1, len(densities), figsize=(4.8 * len(densities), 4.4), squeeze=False, layout="constrained")
    for (name, some), panel in zip(densities.items(), panels[0]):
        t = 1e3 * column(some, "t [s]")
        panel.plot(t, column(some, "v [cm/s]") / 10, color=DENSITIES[name], label=f"velocity / 10 (cm/s), {name} density")
        panel.plot(t, column(some, "x [cm]"), color=DENSITIES[name], linestyle="--", label=f"position (cm), {name} density")
        turns = points.get(name, [])
        panel.plot(1e3 * column(turns, "t [s]"), column(turns, "v [cm/s]") / 10, **STAR, label="quasi-stationary points")
        panel.set(xlabel="time since release (ms)", title=f"A bead of the steady jet, {name} charge density", ylim=(0, None))
        inset = panel.inset_axes([0.09, 0.6, 0.36, 0.36])
        early = t < 8
        inset.plot(t[early], column(some, "v [cm/s]")[early] / 10, color=DENSITIES[name])
        seen = 1e3 * column(turns, "t [s]") < t[early].max()
        inset.plot(1e3 * column(turns, "t [s]")[seen], column(turns, "v [cm/s]")[seen] / 10, **{**STAR, "markersize": 9})
        inset.tick_params(labelsize=7)
    finish(figure, panels[0], directory / "case2_bead.png")


def draw_case3(rows, directory):
    voltages = rows_of(rows, "kV")
    figure, panels = plt.subplots(1, 4, figsize=(13.6, 3.8), layout="constrained")
    for panel, (what, label) in zip(panels, {"vn [cm/s]": "velocity at the nozzle (cm/s)", "vc [cm/s]": "velocity at the collector (cm/s)", "n": "beads on the jet",
                                             "aperture [degree]": "aperture (degrees)"}.items()):
        for name, some in voltages.items():
            t = 1e3 * column(some, "t [s]")
            panel.plot(t[1:], column(some, what)[1:], color=VOLTAGES[name], marker=".", markersize=4, linewidth=1.2, label=f"{name} kV")
            if f"published {what}" in some[0] and name == "9":
                panel.plot(t[1:], column(some, f"published {what}")[1:], **PUBLISHED, label="JETSPIN, published, 9 kV")
        panel.set(xlabel="t (ms)", ylabel=label)
    panels[0].axhspan(200, 240, color="0.93", zorder=0, label="the paper's range")
    panels[3].axhspan(30, 36, color="0.93", zorder=0)
    finish(figure, panels, directory / "case3.png")


def draw_case3_jets(rows, directory):
    """Side views, to scale: early and near the nozzle, then in the bending regime with the cone of the aperture."""
    jets = [(name, float(t), some) for name, of_voltage in rows_of(rows, "kV").items() for t, some in rows_of(of_voltage, "t [s]").items()]
    aperture = {row["kV"]: float(row["aperture [degree]"]) for row in table(directory / "case3_steady.csv")}
    early = [jet for jet in jets if jet[0] == "9"][:3]
    late = [jet for jet in jets if jet[1] == max(t for _, t, _ in jets)]
    figure, panels = plt.subplots(1, 6, figsize=(14.4, 4.5), layout="constrained")
    for panel, (name, t, some) in zip(panels, early + late):
        x, y = column(some, "x [cm]"), column(some, "y [cm]")
        panel.plot(y, x, color=VOLTAGES[name], linewidth=1.1, marker=".", markersize=2, label=f"{name} kV")
        panel.plot(y[-1], x[-1], "v", color="0.2", markersize=6, label="nozzle")
        panel.set(title=f"{name} kV, {1e3 * t:.3g} ms", xlabel="y (cm)", xlim=(-5.6, 5.6), ylim=(16.4, -0.6), aspect="equal")
        if t > 0.03:
            half = np.tan(np.radians(aperture[name] / 2)) * 16
            panel.plot([-half, 0, half], [16, 0, 16], color="0.4", linestyle="--", linewidth=0.9, label="cone of the steady aperture")
            panel.annotate(f"{aperture[name]:.1f}°", (0, 0), xytext=(10, -14), textcoords="offset points", fontsize=9)
    panels[0].set_ylabel("x, distance from the nozzle (cm)")
    finish(figure, panels, directory / "case3_jets.png")


def draw_performance(rows, directory):
    cases = rows_of(rows, "case")
    figure, panels = plt.subplots(1, len(cases), figsize=(4.4 * len(cases), 4), squeeze=False, layout="constrained")
    for (name, some), panel in zip(cases.items(), panels[0]):
        place = np.arange(len(some))
        colours = [COLOURS.get(row["scheme"], OTHER) for row in some]
        panel.bar(place - 0.2, column(some, "time here [s]"), 0.38, color=colours)
        panel.bar(place + 0.2, column(some, "published [s]"), 0.38, color="white", edgecolor=colours, hatch="//")
        panel.set_xticks(place, [row["scheme"] for row in some])
        panel.set(yscale="log", title=name, ylim=(5e-8, 1e-5))
        panel.set_axisbelow(True)
    panels[0, 0].set_ylabel("time per bead and step (s)\nfull: here; hatched: published, the authors' machines")
    finish(figure, panels[0], directory / "performance.png")


def draw_resolution(rows, directory):
    figure, panel = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    step = column(rows, "l_step [cm]")
    middle = list(step).index(0.02)
    for what, colour in zip(("vn [cm/s]", "vc [cm/s]", "current [statC/s]", "rc [cm]", "path [cm]", "aperture [degree]"), plt.cm.Dark2.colors):
        value = column(rows, what)
        panel.semilogx(step, value / value[middle], color=colour, marker="o", markersize=4, label=what.split(" [")[0])
    panel.invert_xaxis()
    panel.minorticks_off()
    panel.set_xticks(step, [f"{s:g}" for s in step])
    panel.set(xlabel="length of an element (cm)", ylabel="value over that at 0.02 cm", title="PVP jet at 9 kV: steady state")
    finish(figure, [panel], directory / "resolution.png")


def draw_convergence(rows, directory, name, answers):
    figure, panels = plt.subplots(1, len(answers), figsize=(3.4 * len(answers), 3.8), layout="constrained")
    step = column(rows, "l_step [cm]")
    for panel, what in zip(panels, answers):
        for field, colour in (("points", "#d62828"), ("slender", "#00798c")):
            panel.semilogx(step, column(rows, f"{field}: {what}"), color=colour, marker="o", markersize=4, label=field)
        panel.invert_xaxis()
        panel.minorticks_off()
        panel.set_xticks(step, [f"{s:g}" for s in step], rotation=45)
        panel.set(xlabel="length of an element (cm)", title=what)
    finish(figure, panels, directory / f"{name}.png")


def draw_convergence_pvp(rows, directory):
    draw_convergence(rows, directory, "convergence-pvp", ("aperture [degree]", "path [cm]", "current [statC/s]", "vc [cm/s]"))


def draw_convergence_straight(rows, directory):
    draw_convergence(rows, directory, "convergence-straight", ("current [statC/s]", "vc [cm/s]", "rc [cm]"))


def draw_convergence_flow(rows, directory):
    """Aperture and path against the elements: both inlets, both self-fields, fixed and adaptive elements, the limit."""
    figure, panels = plt.subplots(1, 2, figsize=(10.4, 4.6), layout="constrained")
    step = column(rows, "l_step [cm]")
    by_pull = directory / "convergence-pvp.csv"
    paper = table(by_pull) if by_pull.exists() else []
    for panel, what in zip(panels, ("aperture [degree]", "path [cm]")):
        for field, colour in (("points", "#d62828"), ("slender", "#00798c"), ("adaptive", "#edae49")):
            panel.semilogx(step, column(rows, f"{field}: {what}"), color=colour, marker="o", markersize=4, label=f"{field}, given flow")
            if paper and field != "adaptive":
                panel.semilogx(column(paper, "l_step [cm]"), column(paper, f"{field}: {what}"), color=colour, linestyle=":", marker="s", markersize=3,
                               label=f"{field}, paper's inlet")
        limit = column(rows, f"limit: {what}")[-1]
        panel.axhline(limit, color="#555555", linestyle="--", linewidth=0.9, label="adaptive, shortest")
        panel.axhspan(0.97 * limit, 1.03 * limit, color="#cccccc", alpha=0.35, label="3 % of it")
        panel.invert_xaxis()
        panel.minorticks_off()
        ticks = sorted({*step, *(column(paper, "l_step [cm]") if paper else ())})
        panel.set_xticks(ticks, [f"{s:g}" for s in ticks], rotation=45)
        panel.set(xlabel="length of an element at the nozzle (cm)", title=what)
    finish(figure, panels, directory / "convergence-flow.png")


def draw_against_theory(rows, directory, name, elements, theories, title):
    """What chains of points and of tubes give on a closed thread, and what theory does."""
    figure, panel = plt.subplots(figsize=(5.6, 4), layout="constrained")
    count = column(rows, elements)
    for field, theory, colour in theories:
        panel.semilogx(count, column(rows, field), color=colour, marker="o", markersize=4, label=field)
        if theory:
            panel.axhline(column(rows, theory)[0], color=colour, linestyle="--", linewidth=0.9, label=theory)
    panel.minorticks_off()
    panel.set_xticks(count, [f"{n:g}" for n in count])
    panel.set(xlabel="elements in 2 cm", title=title)
    finish(figure, [panel], directory / f"{name}.png")


def draw_convergence_thread(rows, directory):
    fields = (("points [1/s]", None, "#d62828"), ("slender [1/s]", "theory [1/s]", "#00798c"))
    draw_against_theory(rows, directory, "convergence-thread", "elements", fields, "Growth rate of a helical wave")


def draw_convergence_helix(rows, directory):
    fields = (("points", None, "#d62828"), ("slender", "endless helix", "#00798c"), ("small wave: slender", "linear theory", "#edae49"))
    draw_against_theory(rows, directory, "convergence-helix", "elements in 2 cm", fields, "Amplification of a helical wave in 0.6 ms")


def draw_convergence_fed(rows, directory):
    draw_convergence(rows, directory, "convergence-fed", ("current [statC/s]", "vc [cm/s]", "rc [cm]"))


def draw_convergence_adaptive(rows, directory):
    fixed = [row for row in rows if row["tolerance of an arc"] == "fixed"][0]
    adaptive = [row for row in rows if row["tolerance of an arc"] != "fixed"]
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 3.8), layout="constrained")
    for panel, what in zip(panels, ("aperture [degree]", "path [cm]")):
        tolerance = column(adaptive, "tolerance of an arc")
        panel.semilogx(tolerance, column(adaptive, what), color="#edae49", marker="o", markersize=4, label="adaptive")
        panel.axhline(float(fixed[what]), color="#00798c", linestyle="--", linewidth=0.9, label="fixed")
        panel.invert_xaxis()
        panel.minorticks_off()
        panel.set_xticks(tolerance, [f"{t:g}" for t in tolerance])
        panel.set(xlabel="tolerance of an arc", title=what)
    finish(figure, panels, directory / "convergence-adaptive.png")


def draw_whipping_frequencies(rows, directory):
    frequencies = rows_of(rows, "omega [rad/s]")
    figure, panels = plt.subplots(1, len(frequencies), figsize=(max(6.4, 4.6 * len(frequencies)), 4.4), squeeze=False, layout="constrained")
    for (omega, some), panel in zip(frequencies.items(), panels[0]):
        heights = rows_of(some, "height [cm]")
        for (height, of_height), colour in zip(heights.items(), plt.cm.viridis(np.linspace(0, 0.9, len(heights)))):
            panel.semilogy(column(of_height, "frequency [Hz]") / 1e3, column(of_height, "power"), color=colour, linewidth=0.9, label=f"{height} cm below the nozzle")
        panel.axvline(float(omega) / 2e3 / np.pi, color="#d62828", linestyle=":", linewidth=1, label="the nozzle's frequency")
        panel.set(xlabel="frequency (kHz)", title=f"nozzle at {float(omega):g} rad/s", ylim=(1e-13, 2))
    panels[0, 0].set_ylabel("power, of all 1")
    finish(figure, panels[0], directory / "whipping_frequencies.png")


def draw_whipping_axis(rows, directory):
    frequencies = rows_of(rows, "omega [rad/s]")
    figure, panels = plt.subplots(1, len(frequencies), figsize=(max(6.4, 4.6 * len(frequencies)), 4), squeeze=False, layout="constrained")
    for (omega, some), panel in zip(frequencies.items(), panels[0]):
        for what, colour in (("y [cm]", "#00798c"), ("z [cm]", "#edae49")):
            panel.plot(column(some, "x [cm]"), column(some, what), color=colour, linewidth=1.2, label=what.split(" [")[0])
        panel.set(xlabel="x, distance from the nozzle (cm)", title=f"nozzle at {float(omega):g} rad/s")
    panels[0, 0].set_ylabel("displacement across the axis (cm)")
    finish(figure, panels[0], directory / "whipping_axis.png")


DRAWINGS = {
    "case1": [draw_case1],
    "case2": [draw_case2],
    "case2_elements": [draw_case2_elements],
    "case2_bead": [draw_case2_bead],
    "case3": [draw_case3],
    "case3_jets": [draw_case3_jets],
    "performance": [draw_performance],
    "resolution": [draw_resolution],
    "convergence-pvp": [draw_convergence_pvp],
    "convergence-straight": [draw_convergence_straight],
    "convergence-flow": [draw_convergence_flow],
    "convergence-thread": [draw_convergence_thread],
    "convergence-helix": [draw_convergence_helix],
    "convergence-fed": [draw_convergence_fed],
    "convergence-adaptive": [draw_convergence_adaptive],
    "whipping_frequencies": [draw_whipping_frequencies],
    "whipping_axis": [draw_whipping_axis],
}
