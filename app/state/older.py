"""Links of earlier versions: they still open what they opened, and are rewritten with today's names.

In version 1 each view of the Lab had its own top, start and table. In versions 1 and 2 an address without a tab opened
the rolling motion, the toy always had a real contact, and static friction was .5 until it was set. Up to version 3 the
Lab had three rooms, two of them at the level "Research", at which the paper's top was the default, and a link to Maps
that named no map opened that of 6 s.
"""

from app.model.setup import LAWS, TOYS
from app.state.codecs import Body, Number
from app.state.names import LAB, LEVEL, LEVELS, ROOMS, TAB
from tippe_core import TruncatedSphere

ROLLING, PLANES = "roll", "three-planes"

OF_TOY = {"turns": "spin", "lean": "tilt", "rub": "mu_k"}  # of a start by hand in the Lab
MOTION = "by", "KJ", "KR", "e", "E", "th", "thd", "w2", "w3", "phi", "psi"
HAND = "spin", "tilt", "slip"  # of a start by hand on the three planes
TABLE = {"sliding": "ordinary", "smooth": "ice", "compare": "three"}
ONLY_THEN = {*OF_TOY, "toy", "plane", "start", "mu_smooth", "mu_stick"}
MU = ".5"  # static friction where none was said
MU_S = ".4"  # the default of Coulomb's law on the three planes in version 1
PAPERS = {"by": "share", "spin": "20", "tilt": "10", "mu_k": ".3", "mu": ".5", "law": "smoothed"}
"""The start at the level "Research" up to version 3, where it differed from the arrival."""
MAP = "spin_5_50_tilt_1_40_contensou_0_6_48"
PAPERS_BODY = {"body": Body.text(TruncatedSphere.paper()), "a": ".07", "I1": ".399", "I3": ".408"}


def fourth(texts):
    """The texts of a version 3 query in version 4."""
    named = texts.get(TAB, LAB)
    room = named if named in (*ROOMS, PLANES) else ROLLING
    level = texts.get(LEVEL, LEVELS[0] if room == LAB else LEVELS[1])
    found = {key: text for key, text in texts.items() if key not in (TAB, LEVEL, "seconds")}
    if level != LEVELS[0]:
        found = PAPERS | ({} if "body" in texts else PAPERS_BODY) | found
    if room == ROLLING:
        found = {"slow": "16", "table": "rough"} | found
    if room == "maps":
        found = {"map": MAP} | found
    is_lab = room in (ROLLING, PLANES)
    known = LAB if named in (ROLLING, PLANES) else named  # what is not known is said to be
    return found | {TAB: known, LEVEL: LEVELS[1] if is_lab else level}


def third(texts):
    """The texts of a version 2 query in version 3."""
    found = {TAB: ROLLING} | texts
    toy = found[TAB] == LAB
    if found.get(LEVEL, LEVELS[0] if toy else LEVELS[1]) == LEVELS[0]:
        found = {"mu": MU} | found
    return found | {"law": LAWS[0]} if toy else found


def second(texts):
    """The texts of a version 1 query in version 2. Texts of views that it did not open are left out."""
    room = texts.get(TAB, "roll")
    of_room = {"lab": _lab, "three-planes": _planes}.get(room, dict)
    return {key: text for key, text in of_room(texts).items() if key not in ONLY_THEN}


def _lab(texts):
    left = {*MOTION, *HAND, "body", "a", "I1", "I3", "mu_k", "law", "gamma", "eps", "patch"}
    found = {OF_TOY.get(key, key): text for key, text in texts.items() if key not in left}
    return found | _body(texts.get("toy", ""))


def _body(text):
    """The text of a body: that of a toy was its index, or a body."""
    if text[:1].isalpha():
        return {"body": text}
    if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= len(TOYS):
        return {}
    toy = list(TOYS.values())[int(text) - 1]
    own = {name: Number.text(getattr(toy.top, name)) for name in ("a", "I1", "I3")}
    return {"body": Body.text(toy.shape)} | (own if toy.top != toy.shape.top else {})


def _planes(texts):
    found = dict(texts)
    if "plane" in texts:
        found["table"] = TABLE.get(texts["plane"], texts["plane"])
    if texts.get("start") != "constants":
        found = {key: text for key, text in found.items() if key not in MOTION} | {"by": "hand"}
    if texts.get("law") == "coulomb":
        return found | {"mu": texts.get("mu_stick", MU_S)}
    found.pop("mu_k", None)
    return found | ({"mu_k": texts["mu_smooth"]} if "mu_smooth" in texts else {})
