"""The figures for print, PNG and SVG: drawn by matplotlib from a Scene, with the parameters in the caption.

The colours are those of the page. Nothing is shared with a screen, so it can run in a thread. matplotlib is imported
when a figure is requested, because it needs a place to write, which the page does not.
"""

import io

import numpy as np

from app.model.colours import COLOURS, FAINT, INK
from app.model.lab.traced import pieces
from app.model.roll import portraits
from app.text import listed, say

# Journals print columns of 89 mm and pages of 183 mm, and ask for 600 dpi for line drawings.
WIDTH = 183 / 25.4
DPI = 600
FIGURES = ("plane", "surface", "motion", "phase", "f", "potential", "track", "force")
FONT = {"font.size": 9, "font.family": "DejaVu Sans", "mathtext.fontset": "dejavuserif", "axes.linewidth": 0.8,
        "axes.edgecolor": INK, "svg.fonttype": "path", "svg.hashsalt": "tippe top"}  # fmt: skip


def caption(scene):
    """The parameters, in two lines of mathtext: those of the top and the table, and those of the motion."""
    top, constants, scales = scene.top, scene.constants, scene.scales
    inner, outer = scene.turning
    return (
        f"$a$ = {top.a:.6g} $R$,  $I_1$ = {top.I1:.6g} $MR^2$,  $I_3$ = {top.I3:.6g} $MR^2$,  "
        rf"$\mu_s$ = {scene.mu_s:.6g};  $R$ = {1e3 * scales.R:.4g} mm,  $M$ = {1e3 * scales.M:.4g} g",
        f"$K_R$ = {constants.K_R:.6g} $(MR^2)^{{1/2}}(g/R)^{{1/2}}$,  $K_J$ = {constants.K_J:.6g} $(g/R)^{{1/2}}$,  "
        f"$E$ = {constants.E:.6g} $MgR$;  {say('prints.tilts', inner=inner, outer=outer)}",
    )


def draw(scene, name, kind):
    """One of FIGURES as the bytes of a "png" or "svg" file."""
    import matplotlib

    with matplotlib.rc_context(FONT):
        return _saved(DRAWN[name](scene), kind)


def _saved(figure, kind):
    file = io.BytesIO()
    # with a date, two files of the same figure would differ
    metadata = {"Title": say("main.title")} | ({"Date": None} if kind == "svg" else {})
    figure.savefig(file, format=kind, dpi=DPI, metadata=metadata)
    return file.getvalue()


def curves(seconds, rows, words, trace, kind):
    """Curves {quantity: values} over the time in s, the trace (n, 3) beside them, above two lines of words, as the
    bytes of a file."""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(FONT):
        figure = Figure(figsize=(WIDTH, 5.0), layout="constrained")
        figure.get_layout_engine().set(rect=(0, 0.12, 1, 0.88))
        left, right = figure.subfigures(1, 2, width_ratios=(2, 1))
        right.suptitle(say("lab_view.view.answers.trace.question"), fontsize=8)
        _caps(right.subplots(2), trace)
        for axes, (named, values) in zip(np.ravel(left.subplots(len(rows), sharex=True)), rows.items(), strict=True):
            axes.plot(seconds, values, color=INK, linewidth=0.9)
            if np.ptp(values) < 1e-6 * np.abs(values).max():  # a conserved quantity is not to look like noise
                axes.set_ylim(*sorted((0, 1.2 * values[0])))
            axes.set_ylabel(named)
            axes.ticklabel_format(useOffset=False)
        axes.set_xlabel("$t$ (s)")
        for line, text in enumerate(words):
            figure.text(0.5, 0.084 - 0.04 * line, text, ha="center", va="center", fontsize=7.5, color=INK)
        return _saved(figure, kind)


def _caps(both, trace):
    """The ball's surface as two caps, as in lab/caps.js, with the trace of the contact."""
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Circle

    x, y, z = np.moveaxis(pieces(trace), 2, 0)
    out = np.hypot(x, y)
    for axes, side, named in zip(both, (-1, 1), listed("lab_view.view.answers.trace.caps"), strict=True):
        tilt = np.degrees(np.arctan2(out, side * z))
        scale = tilt / np.where(out > 0, out, 1)
        lines = np.stack([side * x * scale, y * scale], axis=2)[tilt.min(axis=1) < 90]  # both as seen from outside
        axes.add_collection(LineCollection(lines, colors=COLOURS["theta"], linewidths=0.7))
        for ring in (30, 60, 90):
            axes.add_patch(Circle((0, 0), ring, fill=False, color=INK if ring == 90 else FAINT, linewidth=0.6))
            if ring < 90:
                axes.text(0, -ring, f"{90 + side * (90 - ring)}°", ha="center", va="center", fontsize=7,
                          bbox={"color": "white", "pad": 0.5})  # fmt: skip
        axes.set(xlim=(-93, 93), ylim=(-93, 93), aspect="equal")
        axes.axis("off")
        axes.set_title(named, fontsize=8, y=-0.09)


def _page(scene, height, title):
    """A figure of this height (inches), with its title above and its caption below."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.62 / height, 1, 1 - 0.95 / height))
    figure.text(0.5, 1 - 0.1 / height, title, ha="center", va="top", color=INK)
    for line, text in enumerate(caption(scene)):
        figure.text(0.5, (0.42 - 0.2 * line) / height, text, ha="center", va="center", fontsize=7.5, color=INK)
    return figure


def _plane(scene):
    plane = scene.plane
    lift, slip, K_J = plane.lift, plane.slip, plane.K_J
    figure = _page(scene, 5.0, say("prints.titles.plane"))
    axes, named = figure.add_subplot(), listed("prints.curves")
    lost = {"color": COLOURS["friction"], "alpha": 0.16, "linewidth": 0}
    axes.fill_betweenx(K_J, lift.theta_inner, slip.theta_inner, label=named["lost"], **lost)
    axes.fill_betweenx(K_J, slip.theta_outer, lift.theta_outer, **lost)
    axes.hlines(K_J, slip.theta_inner, slip.theta_outer, color=FAINT, linewidth=0.5, label=named["tielines"])
    axes.plot(lift.theta_inner, K_J, color=FAINT, linewidth=0.8)
    axes.plot(lift.theta_verge, K_J, color=COLOURS["normal"], linewidth=1.4, label=r"$F_z = 0$")
    axes.plot(slip.theta_verge, K_J, color=COLOURS["friction"], linewidth=1.4, label=named["verge"])
    axes.plot(lift.theta_steady, K_J, "--", color=INK, linewidth=1, label=named["steady"])
    axes.plot(scene.turning, [scene.constants.K_J] * 2, color=COLOURS["theta"], linewidth=3, label=named["motion"],
              solid_capstyle="round", zorder=3)  # fmt: skip
    axes.plot(0, plane.pole, "o", color=INK, markersize=4, clip_on=False)
    axes.annotate("$P$", (0, plane.pole), xytext=(4, 4), textcoords="offset points")
    low, high = plane.K_J_range
    axes.set(xlim=plane.theta_range, ylim=(low, high + 0.06 * (high - low)),
             xlabel=r"$\theta$ (rad)", ylabel=r"$K_J$ $((g/R)^{1/2})$")  # fmt: skip
    axes.legend(fontsize=8, frameon=False)
    return figure


def _surface(scene):
    plane = scene.plane
    limit = "$F_z = 0$" if plane.limit == "lift-off" else r"$F_h = \mu_s F_z$"
    figure = _page(scene, 5.6, say("prints.titles.surface", limit=limit))
    axes, named = figure.add_subplot(projection="3d", computed_zorder=False), listed("prints.curves")
    rows = np.isfinite(plane.height).all(axis=1)
    theta, K_J, height = plane.theta[rows], plane.K_J[rows], plane.height[rows]
    if rows.sum() > 1:
        axes.plot_surface(theta, K_J[:, None] + 0 * theta, height, rcount=len(K_J), ccount=theta.shape[1],
                          color="#e5bb76", alpha=0.9, linewidth=0, antialiased=True, zorder=1)  # fmt: skip
        for row in range(0, len(K_J), max(1, len(K_J) // 26)):
            axes.plot(theta[row], [K_J[row]] * theta.shape[1], height[row], color=INK, linewidth=0.5, zorder=2)
            axes.plot(theta[row, [0, -1]], [K_J[row]] * 2, [0, 0], color=FAINT, linewidth=0.5, zorder=0)
    lift, verge = plane.lift, plane.surface.theta_verge
    colour = COLOURS["normal" if plane.limit == "lift-off" else "friction"]
    axes.plot(verge, plane.K_J, np.zeros(len(plane.K_J)), color=colour, linewidth=1.4, zorder=0, label=limit)
    axes.plot(lift.theta_steady, plane.K_J, np.zeros(len(plane.K_J)), "--", color=INK, linewidth=1, zorder=0,
              label=named["steady"])  # fmt: skip
    axes.plot(scene.curve[:, 0], [scene.constants.K_J] * len(scene.curve), scene.curve[:, 1], color=COLOURS["theta"],
              linewidth=2.5, zorder=4, label=named["motion"])  # fmt: skip
    axes.set(xlim=plane.surface_range, ylim=plane.K_J_range, xlabel=r"$\theta$ (rad)", ylabel="$K_J$ $((g/R)^{1/2})$",
             zlabel=r"$f_1^2\,\dot\theta^2$ ($MgR$)")  # fmt: skip
    axes.set_zlim(bottom=0)
    axes.view_init(elev=28, azim=-62)
    axes.set_box_aspect((1.25, 1.1, 0.75), zoom=1.0)
    axes.legend(loc="upper left", fontsize=8, frameon=False)
    return figure


def _motion(scene):
    motion = scene.trajectory
    figure, named = _page(scene, 6.4, say("prints.titles.motion")), listed("prints.curves")
    rows = figure.subplots(4, sharex=True)
    curves = (
        (r"$\theta$ (rad)", {"": (motion.theta, COLOURS["theta"])}),
        ("$F_z$ ($Mg$)", {"": (scene.normal, COLOURS["normal"])}),
        ("$F_h/F_z$", {"": (scene.ratio, COLOURS["friction"])}),
        (named["constants"], {"$K_J$": (scene.K_J, COLOURS["jellett"]), "$K_R$": (scene.K_R, COLOURS["routh"]),
                       "$E$": (scene.E, COLOURS["energy"])}),
    )  # fmt: skip
    for axes, (label, drawn) in zip(rows, curves, strict=True):
        for name, (values, colour) in drawn.items():
            axes.plot(motion.t, values, color=colour, linewidth=1.1, label=name)
        axes.set_ylabel(label)
        axes.grid(color="#e7ebef", linewidth=0.6)
        axes.margins(x=0, y=0.08)
    force, ratio, kept = rows[1:]
    force.set_ylim(bottom=min(0, force.get_ylim()[0]))
    ratio.set_ylim(0, max(1.4 * scene.mu_s, min(scene.ratio.max(), 4 * scene.mu_s + 1)))
    ratio.axhline(scene.mu_s, color=INK, linestyle="--", linewidth=1, label=named["slips"])
    ratio.legend(loc="upper right", fontsize=7, frameon=False)
    kept.legend(loc="center right", fontsize=7, frameon=False, ncols=3)
    kept.set_xlabel(rf"$t$ ($(R/g)^{{1/2}}$ = {1e3 * scene.scales.time:.4g} ms)")
    figure.align_ylabels()
    return figure


def _portrait(scene, name, xlabel, ylabel, equal=False):
    figure = _page(scene, 5.0, say(f"prints.titles.{name}"))
    axes = figure.add_subplot(xlabel=xlabel, ylabel=ylabel)
    axes.grid(color="#e7ebef", linewidth=0.6)
    if equal:
        axes.set_aspect("equal", adjustable="datalim")
    return figure, axes, listed("prints.curves")


def _phase(scene):
    rate = r"$\dot\theta$ $((g/R)^{1/2})$"
    figure, axes, named = _portrait(scene, "phase", r"$\theta$ (rad)", rate)
    *inside, slip, lift = scene.levels
    for theta, rate in inside:
        axes.plot([*theta, *theta[::-1]], [*rate, *-rate[::-1]], color=FAINT, linewidth=0.8)
    for (theta, rate), colour, name in ((slip, "friction", named["verge"]), (lift, "normal", "$F_z = 0$")):
        axes.plot([*theta, *theta[::-1]], [*rate, *-rate[::-1]], "--", color=COLOURS[colour], linewidth=1, label=name)
    motion = scene.nutation
    axes.plot(motion.theta, motion.omega[:, 0], color=COLOURS["theta"], linewidth=2, label=named["motion"])
    axes.legend(fontsize=8, loc="upper right")
    return figure


def _f(scene):
    square = r"$\dot\theta^2 = f(\theta)$ $(g/R)$"
    figure, axes, _ = _portrait(scene, "f", r"$\theta$ (rad)", square)
    axes.plot(scene.nutation.theta, portraits.square(scene), color=COLOURS["theta"], linewidth=2)
    axes.axhline(0, color=FAINT, linewidth=0.8)
    return figure


def _potential(scene):
    figure, axes, named = _portrait(scene, "potential", r"$\theta$ (rad)", "$E$ ($MgR$)")
    theta, least = scene.potential
    marks, E = scene.marks, scene.constants.E
    limits = {named["slips_from"]: (marks.slip, "friction"), named["lifts_from"]: (marks.lift, "normal")}
    top = max([E + 0.05, *(limit for limit, _ in limits.values() if np.isfinite(limit))])
    axes.plot(theta, least, color=INK, linewidth=1.4, label=named["least"])
    for name, (limit, colour) in limits.items():
        if np.isfinite(limit):
            axes.axhline(limit, color=COLOURS[colour], linestyle="--", linewidth=1, label=name)
    axes.plot(scene.turning, [E, E], color=COLOURS["energy"], linewidth=2.5, label=named["motion"])
    pad = 0.1 * (top - marks.steady)
    axes.set(xlim=(theta[0], theta[-1]), ylim=(marks.steady - pad, top + pad))
    axes.legend(fontsize=8, loc="best")
    return figure


def _track(scene):
    figure, axes, _ = _portrait(scene, "track", "$x$ ($R$)", "$y$ ($R$)", equal=True)
    seen = portraits.track(scene)
    axes.plot(seen.x, seen.y, color=COLOURS["theta"], linewidth=1.2)
    for ring in seen.rings:
        axes.plot(*ring, "--", color=FAINT, linewidth=0.8)
    return figure


def _force(scene):
    figure, axes, named = _portrait(scene, "force", "$F_x/F_z$", "$F_y/F_z$", equal=True)
    disc = portraits.circle(scene.mu_s)
    axes.fill(*disc, color=COLOURS["friction"], alpha=0.1, linewidth=0)
    axes.plot(*disc, "--", color=INK, linewidth=1, label=r"$F_h = \mu_s F_z$")
    axes.plot(*portraits.pushes(scene), color=COLOURS["friction"], linewidth=2, label=named["motion"])
    axes.legend(fontsize=8, loc="upper right")
    return figure


DRAWN = {"plane": _plane, "surface": _surface, "motion": _motion, "phase": _phase, "f": _f, "potential": _potential,
         "track": _track, "force": _force}  # fmt: skip
