"""Bodies for a menu, with their names and sources."""

from dataclasses import dataclass

from ..paper.top import Top
from .bare import BareSphere, StemmedSphere
from .shape import Shape
from .shapes import Ball, Lathe, LoadedSphere, OrdinaryTop, TruncatedSphere
from .solids import ball


@dataclass(frozen=True)
class Preset:
    """A shape with its name in a menu.

    Attributes
    ----------
    name : str
        in the menu
    shape : Shape
        the body
    source : str
        where its numbers come from
    stated : Top or None
        its Top, if the source states that besides the lengths
    """

    name: str
    shape: Shape
    source: str
    stated: Top | None = None

    @property
    def top(self) -> Top:
        """The Top that its source states, or that of its shape."""
        return self.stated or self.shape.top


PRESETS = (
    Preset(
        "The paper's tippe top", TruncatedSphere.paper(),
        "Gray and Nickel, Am. J. Phys. 68, 821 (2000), appendix A and Fig. 7: a = 0.070, I₁ = 0.399, I₃ = 0.408, "
        "in the body whose lengths are given there.", Top.paper()),
    Preset(
        "Top S", BareSphere(R=0.02, M=0.02, a=0.3, I1=131 / 350, I3=2 / 5),
        "Simulations of the tippe top by Rauch-Wojciechowski and Rutstam (SIGMA 10, 017 (2014), "
        "arXiv:1306.2470), with g = 9.82 m/s². A sphere whose inside is not told; the bracket of (26) is 0."),
    Preset(
        "Loaded sphere", LoadedSphere(R=0.02, b=0.008, d=0.010, density=1190.0, core_density=7850.0),
        "The form of the paper's Fig. 2; dimensions our own: an acrylic ball 40 mm across with a steel ball of 16 mm."),
    Preset(
        "Disc on a peg", OrdinaryTop(R=0.0018, h=0.0162, r1=0.025, r2=0.025, t=0.004, r=0.002, l=0.015, M=0.020),
        "Math. Probl. Eng. 2018, 6132891, Table 2: disc of 25 mm radius, 20 g, G 20 mm above the table. Peg, thickness "
        "and stem our own; a/R near -10 as in Gray and Nickel's closing remark on ordinary tops."),
    Preset(
        "Wooden cone", OrdinaryTop(R=0.006, h=0.0, r1=0.006, r2=0.022, t=0.025, r=0.004, l=0.020, M=0.013),
        "Dimensions our own: a turned wooden top on a blunt peg."),
    Preset(
        "Uniform ball", Ball(R=0.02, M=0.040),
        "a = 0 and I₁ = I₃ = 2/5; dimensions our own, an acrylic ball 40 mm across."),
    Preset(
        "Hollow tippe top", TruncatedSphere.paper() - TruncatedSphere.paper().density * ball(0.005, 0.002),
        "The paper's top with a ball of 5 mm radius taken away about 2 mm above O; the cavity is our own."),
    Preset(
        "Free profile", Lathe(
            R=0.005, density=700.0,
            points=((0.005, 0.0), (0.018, 0.010), (0.022, 0.016), (0.018, 0.021), (0.004, 0.024), (0.003, 0.045))),
        "Dimensions our own: a turned wooden top whose points can be dragged."),
    Preset(
        "Appendix A's shape, a = 0.0698", TruncatedSphere.paper(),
        "The same body with what its lengths give, not rounded: a = 0.0698, I₁ = 0.3991, I₃ = 0.4081. Where the stem "
        "touches, so small a difference may decide where a motion ends."),
    Preset(
        "Leine and Glocker's toy", StemmedSphere(R=0.015, M=0.006, a=1 / 5, I1=16 / 27, I3=14 / 27, r=0.005, h=0.013),
        "R. I. Leine and Ch. Glocker, Eur. J. Mech. A/Solids 22, 193 (2003): 6 g, a ball of 15 mm radius 3 mm above G "
        "and a stem that ends in one of 5 mm, 16 mm above G; I₁ = 8·10⁻⁷, I₃ = 7·10⁻⁷ kg m². They let it slide with "
        "a friction of 0.3 on a patch of 0.5 mm radius. It is also the second example of Friedl 1997."),
    Preset(
        "Cohen's top", BareSphere(R=0.025, M=0.015, a=0.2, I1=0.4, I3=0.4),
        "R. J. Cohen, Am. J. Phys. 45, 12 (1977), Fig. 5: 15 g, a ball of 25 mm radius, G 5 mm below its middle, "
        "I₁ = I₃ = 0.4. He let it slide with Coulomb's friction, 0.3, at 100 rad/s and 0.1 rad."),
    Preset(
        "MuJoCo's tippe top", BareSphere(R=0.02, M=0.0554745694, a=0.271579, I1=0.573941, I3=0.578216),
        "The Python tutorial of MuJoCo, 200 rad/s, friction 1; mass, G and moments of inertia as MuJoCo computes them "
        "from its parts: a ball of 20 mm radius, a stem and a ballast. Here the stem does not touch."),
    Preset(
        "Friedl's first top", StemmedSphere(R=0.015, M=0.006, a=1 / 5, I1=2 / 3, I3=14 / 27, r=0.005, h=0.013),
        "C. Friedl, Der Stehaufkreisel, thesis, Augsburg (1997), chapter 4: Leine and Glocker's toy, but for "
        "I₁ = 9·10⁻⁷ kg m². His second example is that toy itself."),
    Preset(
        "The Ghent group's top", BareSphere(R=0.015, M=0.006, a=1 / 5, I1=82 / 135, I3=14 / 27),
        "Animations of M.-C. Ciocci, B. Malengier, B. Langerock and B. Grimonprez: 6 g, 15 mm, I₁ = 8.2·10⁻⁷ and "
        "I₃ = 7·10⁻⁷ kg m², friction 0.3. Its a/R is not stated: 0.2, as of Leine and Glocker's toy, is our choice. "
        "Their top turns over, which needs more than 0.17."),
)  # fmt: skip
