"""The paper's equations (1) to (39) and (B1) to (B4): both sides of each, evaluated on a motion by different routes.

One side uses time derivatives of the motion's own poses (stretches.py), the other the constants of the motion. The
limits (27) to (29), R -> 0, are derivatives at R = 0, by a complex step, of the formula for any R.

Units R, M, g. Vectors are given along the rotating axes 1', y = z x 1', z. The words are in app/text.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from app.model.stretches import EDGE, Long, Window, Z, column, dot
from tippe_core import f, f1_squared, f2_squared, f3_squared, friction_force, normal_force, omega2, omega3
from tippe_core.types import Array, Number, Scalars

Reading: TypeAlias = Callable[[Window], Long]


@dataclass(frozen=True)
class Line:
    """An equation: its number, its TeX, its two sides on a Window, (n,) or (n, 3), and its symbols, which can be
    pointed at.

    plane: "rough" or "smooth".
    """

    number: str
    tex: str
    sides: Callable[[Window], tuple[Long, Long]]
    symbols: str
    plane: str = "rough"

    @property
    def key(self) -> str:
        return self.number.strip("()")


def isaeva(m: Window) -> Long:
    """(26) at any state."""
    w_z = m.omega[:, 2]
    w3 = dot(m.omega, m.axis)
    return _isaeva(m, w3, w_z)


def _isaeva(m: Window, w3: Number, w_z: Number) -> Number:
    C_J = m.I1 * m.constants.K_J
    return (m.dI * (m.I3 + 1) - m.I3 * m.a**2) * w3**2 - 2 * C_J * w_z + m.I1 * w_z**2


def isaeva_elsewhere(m: Window) -> Long:
    """(26) at another tilt with the same constants: the smallest tilt of the motion."""
    theta = m.theta.min()
    w2, w3 = (function(theta, m.top, m.constants) for function in (omega2, omega3))
    return 0 * m.theta + _isaeva(m, w3, w3 * np.cos(theta) + w2 * np.sin(theta))


def half_f3(m: Window) -> Long:
    return (m.I3 + m.r_across**2 + m.I3 / m.I1 * m.r3**2) / 2


def tipping(m: Window) -> Long:
    """w3^2 theta_dot sin(theta), of (22)."""
    return m.along(m.axis) ** 2 * m.theta_dot * m.s


def falling(m: Window) -> Long:
    """-(I3/I1) r3^2 w3 w3_dot - r_across^2 w3 w3_dot, of (22) and (23)."""
    return -(m.I3 / m.I1 * m.r3**2 + m.r_across**2) * m.along(m.axis) * m.w3_dot


def carried(m: Window) -> Long:
    return np.cross(m.axis, m.v_dot)


def start(m: Window) -> tuple[float, float, float]:
    """E, I3 w3 and L_z at the first instant, from the motion's State (smooth plane, G at rest)."""
    state, top = m.state, m.top
    s, c = np.sin(state.theta), np.cos(state.theta)
    L_z = top.I3 * state.omega3 * c + top.I1 * state.omega2 * s
    rising = top.a * s * state.theta_dot
    E = (top.I1 * (state.theta_dot**2 + state.omega2**2) + top.I3 * state.omega3**2 + rising**2) / 2 + top.a * (1 - c)
    return E, top.I3 * state.omega3, L_z


def changing(m: Window) -> Long:
    v_z = m.d(m.com)[:, 2]
    return (m.I1 * (m.along(m.e1) ** 2 + m.along(m.e2) ** 2) + v_z**2) / 2 + m.a * (1 - m.c)


def constant(m: Window, value: Scalars) -> Array:
    return 0 * m.theta + value


O, W, L, F, V = r"\vec r", r"\vec\omega", r"\vec L", r"\vec F", r"\vec v"
THREE, ZED = r"\hat 3", r"\hat z"
DOT_L, DOT_V, DOT_W, DOT_R = r"\dot{\vec L}", r"\dot{\vec v}", r"\dot{\vec\omega}", r"\dot{\vec r}"
COS, SIN = r"\cos\theta", r"\sin\theta"
W1, W2, W3 = r"\omega_{1'}", r"\omega_{2'}", r"\omega_3"
R3, RP, DI = "r_3", r"r_\perp", r"{\Delta I}"
LINES = (
    Line("(1)", rf"M{DOT_V}={F}+\vec w", lambda m: (m.v_dot, m.F + m.weight), "M v F w"),
    Line("(2)", rf"{DOT_L}=-{O}\times{F}", lambda m: (m.L_dot, -np.cross(m.r, m.F)), "L r F"),
    Line("(3)", rf"{O}=R{ZED}-a{THREE}", lambda m: (m.r, Z - m.a * m.axis), "r R z a three"),
    Line("(4)", rf"{V}={W}\times{O}", lambda m: (m.d(m.com), np.cross(m.omega, m.r)), "v omega r"),
    Line("(5)", rf"{L}=I_1{W}+{DI}\,{W3}{THREE}",
         lambda m: (m.L, m.I1 * m.omega + m.dI * column(m.w3) * m.axis), "L I1 omega dI w3 three"),
    Line("(6)", rf"\begin{{aligned}}"
         rf"&\tfrac12\left[I_1+M(R^2+a^2-2Ra{COS})\right]{W1}^2+\tfrac12I_1{W2}^2\\&+\tfrac12M\left[(R{COS}-a)"
         rf"{W2}-R{SIN}\,{W3}\right]^2+\tfrac12I_3{W3}^2\\&+Mga(1-{COS})=E\end{{aligned}}",
         lambda m: (m.energy, constant(m, m.constants.E)), "I1 theta w1 w2 w3 a I3 E"),
    Line("(7)", rf"{DOT_L}\cdot{O}=0", lambda m: (dot(m.L_dot, m.r), 0 * m.theta), "L r"),
    Line("(8)", rf"{L}\cdot{DOT_R}=0", lambda m: (dot(m.L, m.r_dot), 0 * m.theta), "L r"),
    Line("(9)", rf"\frac{{d}}{{dt}}\left({L}\cdot{O}\right)=0",
         lambda m: (m.d(dot(m.L, m.r)), 0 * m.theta), "L r"),
    Line("(10)", rf"{L}\cdot{O}=C_J", lambda m: (dot(m.L, m.r), constant(m, m.I1 * m.constants.K_J)), "L r C_J"),
    Line("(11)", rf"{DOT_R}=-a{W}\times{THREE}", lambda m: (m.r_dot, -m.a * np.cross(m.omega, m.axis)),
         "r a omega three"),
    Line("(12)", rf"{L}\cdot{DOT_R}=-a\left(I_1{W}+{DI}\,{W3}{THREE}\right)\cdot\left({W}\times{THREE}\right)",
         lambda m: (dot(m.L, m.r_dot),
                    -m.a * dot(m.I1 * m.omega + m.dI * column(m.w3) * m.axis, np.cross(m.omega, m.axis))),
         "L r a omega w3 three"),
    Line("(13)", r"L_z-\frac aR L_3=J", lambda m: (m.L[:, 2] - m.a * dot(m.L, m.axis),
                                                    constant(m, m.I1 * m.constants.K_J)), "L_z a L_3 J"),
    Line("(14)", rf"I_1R{SIN}\,{W2}+I_3(R{COS}-a){W3}=C_J",
         lambda m: (m.I1 * m.s * m.along(m.e2) + m.I3 * (m.c - m.a) * m.along(m.axis),
                    constant(m, m.I1 * m.constants.K_J)), "I1 theta w2 I3 a w3 C_J"),
    Line("(15)", rf"{DOT_L}=-{O}\times\left(M{DOT_V}-\vec w\right)",
         lambda m: (m.L_dot, -np.cross(m.r, m.v_dot - m.weight)), "L r v w"),
    Line("(16)", rf"\dot L_3=M\,{THREE}\times{DOT_V}\cdot{O}",
         lambda m: (m.I3 * m.d(m.w3), dot(carried(m), m.r)), "L_3 three v r"),
    Line("(17)", rf"{THREE}\times{DOT_V}={R3}{DOT_W}-\dot\omega_3{O}+a{W3}\,{W}\times{THREE}",
         lambda m: (carried(m), column(m.r3) * m.omega_dot - column(m.w3_dot) * m.r
                    + m.a * column(m.along(m.axis)) * np.cross(m.omega, m.axis)), "three v r3 omega w3 r a"),
    Line("(18)", rf"{THREE}\times{DOT_V}\cdot{O}={R3}({DOT_W}\cdot{O})-r^2\dot\omega_3+aR{W3}\,{W}\cdot({THREE}\times"
         rf"{ZED})", lambda m: (dot(carried(m), m.r), m.r3 * dot(m.omega_dot, m.r) - dot(m.r, m.r) * m.w3_dot
                                + m.a * m.along(m.axis) * m.lean), "three v r r3 omega w3 a z"),
    Line("(19)", rf"{DOT_L}=I_1{DOT_W}+{DI}\,\dot\omega_3{THREE}+{DI}\,{W3}\dot{{\hat 3}}",
         lambda m: (m.L_dot, m.I1 * m.omega_dot + m.dI * (column(m.w3_dot) * m.axis
                                                          + column(m.along(m.axis)) * m.d(m.axis))),
         "L I1 omega dI w3 three"),
    Line("(20)", rf"I_1({DOT_W}\cdot{O})+{DI}\,{R3}\dot\omega_3+{DI}\,R{W3}\,{W}\cdot"
         rf"({THREE}\times{ZED})=0",
         lambda m: (m.I1 * dot(m.omega_dot, m.r) + m.dI * (m.r3 * m.w3_dot + m.along(m.axis) * m.lean), 0 * m.theta),
         "I1 omega r dI r3 w3 three z"),
    Line("(21)", rf"\begin{{aligned}}I_3\dot\omega_3=&-\frac{DI}{{I_1}}M{R3}^2\dot\omega_3-\frac{DI}{{I_1}}MR{R3}{W3}\,"
         rf"{W}\cdot({THREE}\times{ZED})\\&-Mr^2\dot\omega_3+MaR{W3}\,{W}\cdot({THREE}\times{ZED})\end{{aligned}}",
         lambda m: (m.I3 * m.d(m.w3), -(m.dI / m.I1 * m.r3**2 + dot(m.r, m.r)) * m.w3_dot
                    + (m.a - m.dI / m.I1 * m.r3) * m.along(m.axis) * m.lean), "I3 w3 dI I1 r3 omega r a"),
    Line("(22)", rf"\begin{{aligned}}"
         rf"I_3{W3}\dot\omega_3=&-\frac{{I_3}}{{I_1}}M{R3}^2{W3}\dot\omega_3+\left(\frac{{I_3}}{{I_1}}-1\right)"
         rf"MR{R3}{W3}^2\dot\theta{SIN}\\&-M{RP}^2{W3}\dot\omega_3-MaR{W3}^2\dot\theta{SIN}\end{{aligned}}",
         lambda m: (m.I3 * m.w3 * m.d(m.w3),
                    falling(m) + ((m.I3 / m.I1 - 1) * m.r3 - m.a) * tipping(m)), "I3 w3 I1 r3 theta rp a"),
    Line("(23)", rf"\begin{{aligned}}"
         rf"I_3{W3}\dot\omega_3=&-\frac{{I_3}}{{I_1}}M{R3}^2{W3}\dot\omega_3-\frac{{I_3}}{{I_1}}M{R3}\dot r_3"
         rf"{W3}^2\\&-M{RP}\dot r_\perp{W3}^2-M{RP}^2{W3}\dot\omega_3\end{{aligned}}",
         lambda m: (m.I3 * m.w3 * m.d(m.w3),
                    falling(m) - (m.I3 / m.I1 * m.r3 * m.d(m.r3) + m.d(m.r_across**2) / 2) * m.along(m.axis) ** 2),
         "I3 w3 I1 r3 rp"),
    Line("(24)", rf"\frac{{d}}{{dt}}\left[\tfrac12I_3{W3}^2+\tfrac12M{RP}^2{W3}^2+\tfrac12M\frac{{I_3}}{{I_1}}{R3}^2"
         rf"{W3}^2\right]=0", lambda m: (m.d(half_f3(m) * m.w3**2), 0 * m.theta), "I3 w3 rp I1 r3"),
    Line("(25)", rf"\tfrac12\left[I_3+MR^2\sin^2\theta+M\frac{{I_3}}{{I_1}}(R{COS}-a)^2\right]{W3}^2=\tfrac12K_R^2",
         lambda m: (half_f3(m) * m.along(m.axis) ** 2, constant(m, m.constants.K_R**2 / 2)), "I3 theta I1 a w3 K_R"),
    Line("(26)", rf"\begin{{aligned}}&\left[{DI}(I_3+MR^2)-I_3Ma^2\right]{W3}^2\\&-2C_JMR\omega_z+I_1MR^2\omega_z^2=C"
         r"\end{aligned}",
         lambda m: (isaeva(m), isaeva_elsewhere(m)), "dI I3 a w3 C_J wz I1"),
    Line("(27)", rf"\left.\frac{{dL_3}}{{dR}}\right|_{{R=0}}=\frac{{Ma{COS}}}{{I_1+Ma^2}}\,L_3",
         lambda m: (m.L3_slope, m.a * m.c / (m.I1 + m.a**2) * m.L3_pointed), "L_3 a theta I1"),
    Line("(28)", rf"L_z-\frac{{Ma^2{COS}}}{{I_1+Ma^2}}\,L_3=C\quad(R\to0)",
         lambda m: (m.Lz_pointed - m.a**2 * m.c / (m.I1 + m.a**2) * m.L3_pointed,
                    constant(m, -m.a**2 * m.c[0] / (m.I1 + m.a**2) * m.L3_pointed[0])), "L_z a theta I1 L_3"),
    Line("(29)", r"L_{CZ}=C\quad(R\to0)",
         lambda m: (m.Lz_pointed + m.a**2 * (m.Lz_pointed - m.L3_pointed * m.c) / m.I1,
                    constant(m, -m.a**2 * m.L3_pointed[0] * m.c[0] / m.I1)), "L_z"),
    Line("(30)", rf"{SIN}\,{W2}+\frac{{I_3}}{{I_1}}({COS}-a){W3}=K_J",
         lambda m: (m.s * m.along(m.e2) + m.I3 / m.I1 * (m.c - m.a) * m.along(m.axis), constant(m, m.constants.K_J)),
         "theta w2 I3 I1 a w3 K_J"),
    Line("(31)", rf"f_3^2{W3}^2=K_R^2",
         lambda m: (f3_squared(m.theta, m.top) * m.along(m.axis) ** 2, constant(m, m.constants.K_R**2)), "f3 w3 K_R"),
    Line("(32)", rf"f_3^2=I_3+\sin^2\theta+\frac{{I_3}}{{I_1}}({COS}-a)^2",
         lambda m: (f3_squared(m.theta, m.top), 2 * half_f3(m)), "f3 I3 theta I1 a"),
    Line("(33)", rf"2E'=2a(1-{COS})+f_2^2{W2}^2+f_1^2{W1}^2",
         lambda m: (constant(m, m.constants.two_E_prime(m.top)),
                    2 * m.a * (1 - m.c) + f2_squared(m.theta, m.top) * m.along(m.e2) ** 2
                    + f1_squared(m.theta, m.top) * m.along(m.e1) ** 2), "Ep a theta f2 w2 f1 w1"),
    Line("(34)", rf"f_2^2=I_1+\frac{{I_1}}{{I_3}}\sin^2\theta+({COS}-a)^2",
         lambda m: (f2_squared(m.theta, m.top), m.I1 + m.I1 / m.I3 * m.r_across**2 + m.r3**2), "f2 I1 I3 theta a"),
    Line("(35)", rf"f_1^2=I_1+1+a^2-2a{COS}",
         lambda m: (f1_squared(m.theta, m.top), m.I1 + dot(m.r, m.r)), "f1 I1 a theta"),
    Line("(36)", rf"\begin{{aligned}}"
         rf"f_1^2\dot\theta^2={{}}&2E'-2a(1-{COS})\\&-\frac{{f_2^2}}{{\sin^2\theta}}\left[K_J-\frac{{I_3}}{{I_1}}"
         rf"({COS}-a)\frac{{K_R}}{{f_3}}\right]^2\end{{aligned}}",
         lambda m: (f1_squared(m.theta, m.top) * m.theta_dot**2, f1_squared(m.theta, m.top) * m.of(f)),
         "f1 theta Ep a f2 K_J I3 I1 K_R f3"),
    Line("(37)", rf"F_z=1+a\left(\tfrac12{SIN}\,f'+{COS}\,f\right)",
         lambda m: (1 + m.v_dot[:, 2], m.of(normal_force)), "Fz a theta f"),
    Line("(38)", rf"F_x=-\frac{{I_3K_R\,f^{{1/2}}}}{{f_3^3}}\left({COS}-\frac{{I_3}}{{I_1}}({COS}-a)\right)",
         lambda m: (dot(m.v_dot, m.e1), m.sense * np.nan_to_num(m.of(friction_force)[0])),
         "Fx I3 K_R f f3 theta I1 a"),
    Line("(39)", rf"(1-a{COS})F_y=a{SIN}\,F_z+\tfrac12I_1f'-I_1\cot\theta\,{W2}^2+I_3{W2}{W3}",
         lambda m: ((1 - m.a * m.c) * dot(m.v_dot, m.y),
                    m.a * m.s * m.of(normal_force) + m.I1 * m.theta_double_dot
                    + (m.I3 * m.along(m.axis) - m.I1 * m.c / m.s * m.along(m.e2)) * m.along(m.e2)),
         "a theta Fy Fz I1 f w2 I3 w3"),
    Line("(B1)", rf"M{DOT_V}=\vec N+\vec w,\quad{DOT_L}=-{O}\times\vec N",
         lambda m: (np.hstack([m.v_dot, m.L_dot]), np.hstack([m.F + m.weight, -np.cross(m.r, m.F)])),
         "M v N w L r", "smooth"),
    Line("(B2)", rf"\tfrac12I_1{W1}^2+\tfrac12I_1{W2}^2+\tfrac12I_3{W3}^2+\tfrac12Mv^2+Mga(1-{COS})=E",
         lambda m: (m.energy, constant(m, start(m)[0])), "I1 w1 w2 I3 w3 v a theta E", "smooth"),
    Line("(B3)", rf"\tfrac12I_1{W1}^2+\tfrac12I_1{W2}^2+\tfrac12Mv_z^2+Mga(1-{COS})=E-\tfrac12I_3{W3}^2",
         lambda m: (changing(m), constant(m, start(m)[0] - start(m)[1] ** 2 / (2 * m.I3))), "I1 w1 w2 vz a theta E w3",
         "smooth"),
    Line("(B4)", rf"L_z=I_3{W3}{COS}+I_1{W2}{SIN}",
         lambda m: (constant(m, start(m)[2]), m.I3 * m.along(m.axis) * m.c + m.I1 * m.along(m.e2) * m.s),
         "L_z I3 w3 theta I1 w2", "smooth"),
)  # fmt: skip


class Symbol(NamedTuple):
    """texts: how it is written in the MathML, without spaces; value (n,) or (n, 3), along the rotating axes; arrow,
    start: the vector to be drawn and its starting point."""

    texts: tuple[str, ...]
    value: Reading
    arrow: Reading | None = None
    start: str = "com"


def _vector(get: Reading, start: str = "com") -> dict[str, Number]:
    return _part(lambda m: m.turning(get(m)), get, start)


def _part(value: Reading, arrow: Reading, start: str = "com") -> dict[str, Number]:
    return {"value": value, "arrow": lambda m: m.turning(arrow(m)), "start": start}


SYMBOLS = {
    "M": Symbol(("M",), lambda m: constant(m, 1.0)),
    "R": Symbol(("R",), **_part(lambda m: constant(m, 1.0), lambda m: np.broadcast_to(Z, m.r.shape), "contact")),
    "a": Symbol(("a",), **_part(lambda m: constant(m, m.a), lambda m: m.a * m.axis)),
    "I1": Symbol(("I1",), lambda m: constant(m, m.I1)),
    "I3": Symbol(("I3",), lambda m: constant(m, m.I3)),
    "dI": Symbol(("ΔI",), lambda m: constant(m, m.dI)),
    "theta": Symbol(("θ",), **_part(lambda m: m.theta, lambda m: m.axis)),
    "omega": Symbol(("ω→",), **_vector(lambda m: m.omega)),
    "w1": Symbol(("ω1′", "ω1′2"), **_part(lambda m: m.w1, lambda m: column(m.w1) * m.e1)),
    "w2": Symbol(("ω2′", "ω2′2"), **_part(lambda m: m.w2, lambda m: column(m.w2) * m.e2)),
    "w3": Symbol(("ω3", "ω32", "ω˙3"), **_part(lambda m: m.w3, lambda m: column(m.w3) * m.axis)),
    "wz": Symbol(("ωz", "ωz2"), **_part(lambda m: m.omega[:, 2], lambda m: column(m.omega[:, 2]) * Z)),
    "L": Symbol(("L→",), **_vector(lambda m: m.L)),
    "L_3": Symbol(("L3", "L˙3"), **_part(lambda m: dot(m.L, m.axis), lambda m: column(dot(m.L, m.axis)) * m.axis)),
    "L_z": Symbol(("Lz", "LCZ"), **_part(lambda m: m.L[:, 2], lambda m: column(m.L[:, 2]) * Z)),
    "r": Symbol(("r→", "r2"), **_vector(lambda m: m.r, "contact")),
    "r3": Symbol(("r3", "r32", "r˙3"), **_part(lambda m: m.r3, lambda m: column(m.r3) * m.axis, "contact")),
    "rp": Symbol(("r⊥", "r⊥2", "r˙⊥"),
                 **_part(lambda m: m.r_across, lambda m: m.r - column(m.r3) * m.axis, "contact")),
    "v": Symbol(("v→", "v2"), **_vector(lambda m: m.v)),
    "vz": Symbol(("vz", "vz2"), **_part(lambda m: m.v[:, 2], lambda m: column(m.v[:, 2]) * Z)),
    "F": Symbol(("F→",), **_vector(lambda m: m.F, "contact")),
    "N": Symbol(("N→",), **_vector(lambda m: m.F, "contact")),
    "Fx": Symbol(("Fx",), **_part(lambda m: dot(m.F, m.e1), lambda m: column(dot(m.F, m.e1)) * m.e1, "contact")),
    "Fy": Symbol(("Fy",), **_part(lambda m: dot(m.F, m.y), lambda m: column(dot(m.F, m.y)) * m.y, "contact")),
    "Fz": Symbol(("Fz",), **_part(lambda m: m.F[:, 2], lambda m: column(m.F[:, 2]) * Z, "contact")),
    "w": Symbol(("w→",), **_vector(lambda m: m.weight)),
    "three": Symbol(("3^",), **_vector(lambda m: m.axis)),
    "z": Symbol(("z^",), **_vector(lambda m: np.broadcast_to(Z, m.r.shape))),
    "E": Symbol(("E",), lambda m: m.motion.energy),
    "Ep": Symbol(("E′",), lambda m: constant(m, m.constants.two_E_prime(m.top) / 2)),
    "C_J": Symbol(("CJ",), lambda m: m.motion.jellett),
    "J": Symbol(("J",), lambda m: m.motion.jellett),
    "K_J": Symbol(("KJ",), lambda m: m.motion.jellett / m.I1),
    "K_R": Symbol(("KR", "KR2"), lambda m: m.motion.routh),
    "f": Symbol(("f", "f′", "f1/2"), lambda m: m.of(f)),
    "f1": Symbol(("f12",), lambda m: np.sqrt(f1_squared(m.theta, m.top))),
    "f2": Symbol(("f22",), lambda m: np.sqrt(f2_squared(m.theta, m.top))),
    "f3": Symbol(("f3", "f32", "f33"), lambda m: np.sqrt(f3_squared(m.theta, m.top))),
}  # fmt: skip


def both_sides(line: Line, parts: Iterable[Window]) -> tuple[Array, Array, Array]:
    """t (n,), left and right (n, k) of a line, vectors along 1', y, z; points near the ends of the windows are left
    out."""
    rows = []
    for m in parts:
        sides = []
        for side in np.broadcast_arrays(*line.sides(m)):
            if side.ndim == 2:
                side = np.hstack([m.turning(side[:, i : i + 3]) for i in range(0, side.shape[1], 3)])
            sides.append(np.asarray(side, dtype=float).reshape(len(m.t), -1)[EDGE:-EDGE])
        rows.append((m.t[EDGE:-EDGE], *sides))
    t, left, right = (np.concatenate(column) for column in zip(*rows, strict=True))
    return t, left, right


def difference(left: Array, right: Array) -> Array:
    """The largest difference of any component, relative to 1 + the largest value of either side; (n,)."""
    return np.abs(left - right).max(axis=1) / (1 + max(np.nanmax(np.abs(left)), np.nanmax(np.abs(right))))
