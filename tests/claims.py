"""Everything the paper says that can be checked: the rows of docs/validation.md.

Section -> key -> (what it says, the functions of tippe_core it is about). Tests give evidence for a row with the
fixture `compare`; validation.py writes the page from what they found, and fails if a row has no evidence.
"""

ROLL, CURVE = "roll", "f, omega2, omega3"

ROWS = {
    "Equations": {
        "(1)": ("M v' = F + w", ROLL),
        "(2)": ("L' = -r x F", ROLL),
        "(3)": ("r = R z - a 3", ROLL),
        "(4)": ("v = omega x r", ROLL),
        "(5)": ("L = I1 omega + (I3 - I1) omega_3 3", ROLL),
        "(6)": ("the energy", "roll, Constants.from_state"),
        "(7)": ("L' . r = 0", ROLL),
        "(8)": ("L . r' = 0", ROLL),
        "(9)": ("d(L . r)/dt = 0", ROLL),
        "(10)": ("L . r = const", ROLL),
        "(11)": ("r' = -a omega x 3", ROLL),
        "(12)": ("L . r' = -a (I1 omega + (I3 - I1) omega_3 3) . (omega x 3)", ROLL),
        "(13)": ("L_z - (a/R) L_3 = J", ROLL),
        "(14)": ("I1 R sin(theta) omega_2' + I3 (R cos(theta) - a) omega_3 = const", "Trajectory.jellett"),
        "(15)": ("L' = -r x (M v' - w)", ROLL),
        "(16)": ("L_3' = M (3 x v') . r", ROLL),
        "(17)": ("3 x v' = r_3 omega' - omega_3' r + a omega_3 omega x 3", ROLL),
        "(18)": ("(3 x v') . r = r_3 (omega' . r) - r^2 omega_3' + a R omega_3 omega . (3 x z)", ROLL),
        "(19)": ("L' = I1 omega' + (I3 - I1) (omega_3' 3 + omega_3 3')", ROLL),
        "(20)": ("I1 omega' . r + (I3 - I1) [r_3 omega_3' + R omega_3 omega . (3 x z)] = 0", ROLL),
        "(21)": ("I3 omega_3' after elimination of omega'", ROLL),
        "(22)": ("the same times omega_3, with theta' (signs: see the slips)", ROLL),
        "(23)": ("the same with r_3' and r_perp'", ROLL),
        "(24)": ("d/dt of Routh's constant = 0", ROLL),
        "(25)": ("Routh's constant, K_R^2/2", "Trajectory.routh"),
        "(26)": ("Isaeva's form of it", ROLL),
        "(27)": ("L_3 for R -> 0, up to order R^2", "omega3"),
        "(28)": ("L_z for R -> 0", "omega2, omega3"),
        "(29)": ("L_CZ for R -> 0, and the motion there is Lagrange's top", "omega2, omega3, Rolling.period"),
        "(30)": ("K_J", "Constants.from_state, omega2"),
        "(31)": ("K_R", "Constants.from_state, omega3"),
        "(32)": ("f3^2", "f3_squared"),
        "(33)": ("2E'", "Constants.two_E_prime"),
        "(34)": ("f2^2", "f2_squared"),
        "(35)": ("f1^2", "f1_squared"),
        "(36)": ("theta_dot^2 = f(theta)", "f"),
        "(37)": ("F_z", "normal_force"),
        "(38)": ("F_x", "friction_force"),
        "(39)": ("F_y", "friction_force"),
        "(B1)": ("M v' = N + w, L' = -r x N", "glide"),
        "(B2)": ("the energy on the smooth plane", "glide"),
        "(B3)": ("the same without the constant terms", "glide"),
        "(B4)": ("L_z, and theta_dot^2 of a single variable", "glide, Gliding"),
    },
    "Printed numbers": {
        "8.37": ("K_J at P, K_R = 10", "pole_constants"),
        "18.6": ("f1^2 theta_dot^2 at P", "limit_energy, f"),
        "9.29": ("E' at P", "limit_energy"),
        "25.1": ("E at P", "limit_energy"),
        "20 cycles/s": ("spin for K_R = 10 (a slip, below)", "omega3"),
        "0.0226": ("(I3 - I1)/I1", "Top.paper"),
        "a/R = 0.070": ("appendix A, from R, c, l, r", "TruncatedSphere"),
        "I3 = 0.408": ("appendix A, from R, c, l, r, in MR^2", "TruncatedSphere"),
        "I1 = 0.399": ("appendix A, from R, c, l, r, in MR^2", "TruncatedSphere"),
        "0.4": ("both moments of a uniform ball, in MR^2", "Ball"),
        "mu_s = 0.5": ("F_h/F_z on the line of the verge in Fig. 6", "tielines, friction_force, normal_force"),
    },
    "Figures": {
        "Fig. 1": ("the top turns over, G rises, omega_3 changes its sign", "slide"),
        "Fig. 2": ("a top of sphere and eccentric mass: r, v, F", "roll"),
        "Fig. 3": ("r_1' = 0, r_2' = R sin(theta), r_3 = R cos(theta) - a", "roll"),
        "Fig. 4": ("torques F_1' a sin(theta) about z and F_1' R sin(theta) about 3", "slide"),
        "Fig. 5": ("tielines with F_z >= 0", "tielines"),
        "Fig. 6": ("tielines with F_h <= 0.5 F_z", "tielines"),
        "Fig. 7": ("mass M and radius R of the top of appendix A", "TruncatedSphere"),
    },
    "Claims": {
        "about 20 %": ("kinetic energy lost from theta near 0 to pi by Routh's constant", "omega3"),
        "1 % to 25 %": ("2Mga over the kinetic energy of hand spins", "Top.paper"),
        "93 %": ("L_z left when friction has taken L_3 (note 57)", "slide"),
        "about 90 deg": ("theta when friction has taken L_3 (note 57)", "slide"),
        "sign of omega_3": ("rolling never changes it, sliding does", "roll, slide"),
        "Jellett with sliding": ("C_J is kept by any friction", "slide"),
        "Gallop's minimum": ("least kinetic energy at theta and J is J^2/2 I_eff (note 58)", "jellett_potential"),
        "rotation about r": ("there the top turns about r, and I_eff = (r/R)^2 I_r (note 58)", "jellett_potential"),
        "Routh by I_eff": ("[I1 I3/(MR^2) + I_eff] omega_3^2/2 = const (note 58)", "roll"),
        "verge off the turning point": ("F_h/F_z = mu_s is not always first at the outer turning point", "tielines"),
        "lift-off at the outer turning point": ("F_z = 0 is, for every K_J of Fig. 5", "tielines"),
        "barrier at P": ("[...]^2 of (36) falls as theta^4 at P, so f stays finite", "f"),
        "peaks are stable": ("f = f' = 0 and f'' < 0 at the peaks of Fig. 5", "steady_precessions"),
        "small motion": ("theta'' = f''(theta_p)/2 (theta - theta_p) near a steady precession", "Rolling.period"),
        "a considerable fraction": (
            "friction 0.5 leaves less of the (K_J, theta) plane than lift-off",
            "lift_off_and_slip_tielines",
        ),
        "no transition": ("without slipping no motion goes from theta near 0 to near pi", "turning_points"),
        "five constants": ("v_x, v_y, L_3, L_z, E on the smooth plane", "glide"),
        "t by quadrature": ("t(theta) is the integral of dtheta/f^(1/2)", "Rolling"),
    },
    "Oracles": {
        "Lagrange": (
            "sympy: Lagrange's equations with multipliers for the rolling constraint",
            "f, friction_force, normal_force, roll, glide, slide, Viscous",
        ),
        "mpmath: f": ("fifty digits at poles, at P, merging wells, a = -10", "f"),
        "mpmath: forces": ("the same places", "normal_force, friction_force"),
        "mpmath: turning points": ("the same places", "turning_points"),
        "mpmath: period": ("the same places", "Rolling.period"),
        "MuJoCo: smooth": ("frictionless contact", "glide"),
        "MuJoCo: viscous": ("contact with a force -gamma F_z u", "slide, Viscous"),
        "MuJoCo: Coulomb": ("its own elliptic cone, slow slip, until after sticking", "slide, Coulomb"),
        "Contensou": ("a patch that slides 0.01 to 1,000 times as fast as its rim turns", "Contensou"),
        "rigid body": ("the rolling body in space, 80-bit collocation", "roll"),
    },
}

SLIPS = [
    ("Sec. VI: K_R = 10 is “about 20 cycles/s”",
     "(31) gives omega_3 = 8.80 (g/R)^1/2 near theta = 0, for R = 1.6 cm 34.7 cycles/s", "20 cycles/s"),
    ("(22) in the text of the published PDF has both terms with theta' of the opposite sign",
     "with + M (I3/I1 - 1) R r_3 ... and - M a R ... the equation holds on computed motions and leads to (23); as "
     "printed it does not", "(22)"),
]  # fmt: skip


def section(row):
    return next(name for name, rows in ROWS.items() if row in rows)
