"""Makes links of version 2 of every kind as the page makes them, and adds those that data/links.json does not have:
python tests/links_made.py

Each is of a session that opens an address and then gets the requests that a browser sends; some are typed. It is of
today's page: where the page is built otherwise, the links stay, and this goes.
"""

from contextlib import contextmanager
from unittest.mock import patch

import panel as pn
from bokeh.document import Document
from links import main
from met import alone, kept, noted
from panel.io.state import set_curdoc

from app.model.measured.examples import FOLDER
from app.model.votes.classroom import Rooms
from app.page import page
from app.page.session import Session
from app.state import names
from app.tabs.learn.poll import Counter
from app.tabs.maps.maps import Maps
from app.tabs.measure.measure import Measure
from app.widgets.head import HeadBar
from app.widgets.scheduling import RenderScheduler
from tippe_core import PRESETS, TruncatedSphere, save_top

PAPER, CONE, TOY = "The paper's tippe top", "Wooden cone", "Leine and Glocker's toy"


class Store(dict):
    """A store of votes."""

    def read(self, keys):
        return {key: self[key] for key in keys if key in self}

    def change(self, key, function):
        self[key] = function(self.get(key))


class Opened:
    """A page without a browser."""

    def __init__(self, link, made, parts):
        self.link, self._made, self._parts, self._count = link, made, parts, 0

    def _one(self, kind):
        return next(each for each in self._made if isinstance(each, kind))

    def owner(self, name):
        return next(owner for _, owner, _ in self._parts if type(owner).__name__ == name)

    @property
    def session(self):
        return self._one(Session)

    @property
    def maps(self):
        return self._one(Maps)

    def head(self, **wishes):
        """What is clicked in the head: room, level, table, toy, dark, large, language."""
        for name, value in wishes.items():
            self._count += 1
            self._one(HeadBar).view.asked = [self._count, name, value]
        return self

    def asks(self, **inputs):
        """What the controls of the rolling motion ask for."""
        scheduler = self.session.scheduler
        scheduler.ask(**inputs)
        scheduler._requested = 0.0
        scheduler._rest()
        assert not self.session.scene.messages, self.session.scene.messages
        return self

    def planes(self, **inputs):
        """What the controls of the three planes ask for."""
        self.session.start._planes.ask(**inputs)
        self.session.explorer.settle()
        return self

    def lab(self, **inputs):
        """What the controls of the toy that flips ask for."""
        self.session.lab_of.ask(**inputs)
        assert not self.session.lab_of.scene.messages, self.session.lab_of.scene.messages
        return self

    def builds(self, does, *inputs):
        """What the bench asks for."""
        getattr(self.session.builder, does)(*inputs)
        self.session.scheduler._requested = 0.0
        self.session.scheduler._rest()
        assert not self.session.builder.draft.messages, self.session.builder.draft.messages
        return self

    def plays(self, **settings):
        """What a picture sends back."""
        self.owner("Playing").param.update(**settings)
        return self

    def learns(self, name, value):
        self._count += 1
        self.owner("Learn").lesson.asked = [self._count, name, value]
        return self

    def maps_by(self, **choices):
        for name, value in choices.items():
            self.maps.settings.choices[name].value = value
        return self

    def maps_type(self, **entries):
        for name, value in entries.items():
            self.maps.settings.entries[name].value = value
        assert "alert" not in self.maps.said.object, self.maps.said.object
        return self

    def films(self, name, law="", loose=(), text=None):
        measure = self._one(Measure)
        if text is None:
            measure.take_example(name)
        else:
            measure.take(text, name=name)
        if law:
            measure.law.value = law
        if loose:
            measure.loose.value = [*loose]
        measure.compute()
        measure.home.in_link.value = ["link"]
        assert measure.filmed.film
        return self

    def query(self):
        """The link as Share gives it, with a teacher's key, which Share leaves out."""
        self.session.explorer.settle()
        self.session.url_state.commit()
        assert not self.session.url_state.sentence, self.session.url_state.sentence
        return self.session.url_state.query


@contextmanager
def opened(link=""):
    store = Store()

    def ask(counter, work, done):
        done(work(Rooms(store)))

    with (
        set_curdoc(Document()), alone("lab", "planes", "guess", "fit"), noted(Session, HeadBar, Maps, Measure) as made,
        kept(link, every=True) as parts, patch.object(RenderScheduler, "_send", lambda scheduler, draw, flying: draw()),
        patch.object(Counter, "ask", ask), patch.object(Counter, "watch", lambda *rest, **named: None),
    ):  # fmt: skip
        pn.state.location.search = link
        page.page()
        yield Opened(link, made, parts)


ROLL, PLANES = "?v=2&tab=roll", "?v=2&tab=three-planes"


def by_start():
    """Each way of giving a start, on each table, at both levels."""
    yield ROLL, lambda page: page.asks(K_J=6.7, mu_s=0.3, given="share")
    yield ROLL, lambda page: page.asks(K_J=6.25, K_R=9.5, given="share").asks(energy=0.0, given="share")
    yield ROLL, lambda page: page.asks(E=29.5, given="E")
    yield ROLL, lambda page: page.asks(E=31.25, K_J=6.4, given="E").plays(time=3.25, playing=False)
    yield ROLL, lambda page: page.asks(theta=0.6, theta_dot=0.25, omega2=-1.1, omega3=8.5, given="state")
    yield ROLL, lambda page: page.asks(theta=0.3, phi=1.25, psi=-0.5, given="state").plays(time=0.5, playing=False)
    yield ROLL, lambda page: page.asks(theta=0.4, omega3=-9.0, omega2=1.5, given="state")
    yield ROLL, lambda page: page.asks(theta=0.0, theta_dot=0.0, omega2=0.0, omega3=9.0, given="state")
    yield ROLL, lambda page: page.head(table="ordinary").head(room="roll").asks(mu_s=0.0)
    yield ROLL, lambda page: page.asks(limit="slip", upper=False)
    yield ROLL, lambda page: page.asks(upper="paper", K_R=12.0)
    yield ROLL, lambda page: face(page)
    yield PLANES, lambda page: page.planes(by="spin", spin=25.0, tilt=12.0)
    yield PLANES, lambda page: page.planes(by="spin", spin=-18.5, tilt=8.0, slip=0.0)
    yield PLANES, lambda page: page.planes(by="spin", spin=22.0, tilt=20.0, slip=1.5, seconds=2.5)
    for table in ("ordinary", "rough", "ice", "three"):
        yield "", lambda page, table=table: page.lab(spin=24.0, tilt=14.0, table=table)
        yield "", lambda page, table=table: page.lab(spin=21.0).head(level="research", table=table)
    yield "", lambda page: page.lab(spin=-28.65, mu=0.2, patch=1.25)
    yield "", lambda page: page.lab(toy=CONE, spin=20.0, tilt=15.0)
    yield "", lambda page: page.lab(spin=30.0, tilt=0.0, mu=0.05)
    yield "", lambda page: page.lab(tilt=100.0, spin=100.0, mu=1.5, patch=5.0)
    yield "", lambda page: page.lab(toy="Uniform ball", table="three", spin=10.0)


def face(page):
    """The sliders of the state, which change nothing else."""
    page.owner("Controls").face = "state"
    return page


def by_law():
    """Each law of friction, and what happens at the edge of the stem and after a hop."""
    for law, inputs in (("contact", {"mu": 0.25, "patch": 0.8}), ("coulomb", {"mu": 0.28, "mu_s": 0.45}),
                        ("viscous", {"gamma": 0.55}), ("smoothed", {"mu": 0.35, "eps": 0.05})):  # fmt: skip
        yield PLANES, lambda page, law=law, inputs=inputs: page.planes(law=law, by="spin").planes(**inputs)
    yield PLANES, lambda page: page.planes(law="coulomb", mu=0.4).planes(mu_s=0.4)
    yield PLANES, lambda page: page.planes(law="contact", landing="stop", by="spin", spin=30.0)
    yield PLANES, lambda page: page.planes(stem=False, by="spin", spin=24.0, seconds=8.0)
    yield PLANES, lambda page: page.planes(law="coulomb", landing="stop", stem=False, seconds=0.75)
    yield PLANES + "&table=three", lambda page: page.planes(law="viscous", gamma=1.2).asks(K_J=5.5, given="share")
    yield PLANES + "&table=ice", lambda page: page.asks(theta=0.7, theta_dot=0.2, omega3=7.0, given="state")
    yield PLANES, lambda page: page.asks(E=28.5, given="E").planes(law="contact")


def by_body():
    """Each kind of body, and some of one's own."""
    for preset in PRESETS[1:]:
        yield ROLL, lambda page, name=preset.name: page.head(toy=name)
    yield ROLL, lambda page: page.asks(a=0.12, I1=0.42, I3=0.45)
    bench = "?v=2&tab=build-a-top"
    yield bench, lambda page: page.builds("set", "c", 0.0075).builds("set", "R", 0.0165)
    yield bench, lambda page: page.builds("fill", "hole").builds("set", "depth", 0.007)
    yield bench, lambda page: page.builds("fill", "both")
    yield bench, lambda page: page.builds("fill", "disc").builds("set", "density", 650.0)
    yield bench, lambda page: page.builds("set", "rounding", 0.0012)
    yield bench, lambda page: page.builds("choose", "Free profile").builds("add_point", 0.015, 0.02)
    yield bench, lambda page: in_parts(page)
    yield bench, lambda page: page.builds("compose", "ball", -400.0, 0.004, 0.0, 0.0)
    yield bench, lambda page: page.builds("choose", "Loaded sphere").builds("set", "core_density", 11340.0)
    yield bench, lambda page: page.builds("choose", CONE).builds("set", "r2", 0.024)
    yield bench, lambda page: page.builds("load", save_top(TruncatedSphere.paper())).head(room="lab")


def in_parts(page):
    """A turned profile of several woods."""
    return page.builds("choose", "Free profile").builds("part_densities").builds("set", "density 2", 900.0)


def by_view():
    """Language, look, clock, pace, camera and what is drawn."""
    yield "", lambda page: page.head(dark=True)
    yield ROLL, lambda page: page.head(large=True, dark=True).asks(K_J=6.5)
    yield "?v=2&lang=de&tab=lab", lambda page: page.head(large=True).lab(spin=26.0)
    yield "?v=2&lang=en&tab=lab", lambda page: page.head(dark=False)
    yield "?v=2&lang=de&tab=roll", lambda page: page.asks(K_J=7.25)
    yield ROLL, lambda page: page.plays(speed=1 / 64, show_track=False, show_com_path=False)
    yield ROLL, lambda page: page.plays(speed=1.0, show_force=False, show_cone=False)
    yield ROLL, lambda page: page.plays(show_omega=False, show_momentum=False, follow=False)
    yield ROLL, lambda page: page.plays(camera=[0.75, 0.4, 6.5], time=12.125, playing=False)
    yield PLANES, lambda page: page.plays(speed=0.25, time=7.5, playing=False, camera=[-1.5, 0.2, 9.0])


def by_lesson():
    for step in names.STEPS:
        yield "?v=2&tab=learn", lambda page, step=step: page.learns("step", step)
    for section in names.SECTIONS[1:]:
        yield "?v=2&tab=learn", lambda page, section=section: page.learns("section", section)
    for room in ("learn", "families", "maps", "build-a-top", "measure"):
        yield "", lambda page, room=room: page.head(room=room)
    yield "?v=2&tab=learn&lang=de", lambda page: page.head(toy=CONE).learns("step", "yours")
    yield "?v=2&tab=learn", lambda page: page.learns("step", "height").learns("present", "")


def by_map():
    maps = "?v=2&tab=maps"
    yield maps, lambda page: page.maps_by(colour="time_90")
    yield maps, lambda page: page.maps_by(across="mu", colour="theta_end")
    yield maps, lambda page: page.maps_by(law="coulomb", up="slip").maps_type(cells="24", tilt="8")
    yield maps, lambda page: page.maps_by(law="viscous", across="a", up="ratio", colour="F_z_least")
    heat = {"law": "smoothed", "across": "second", "colour": "heat"}
    yield maps, lambda page: page.maps_by(**heat).maps_type(seconds="3", cells="12")
    yield maps, lambda page: page.maps_by(across="R", up="stem", colour="flew").maps_type(cells="9")
    yield maps, lambda page: page.maps_by(up="rounding", colour="hops").maps_type(mu="0.2", cells="9")
    yield maps, lambda page: page.maps_by(colour="growth").maps_type(cells="6", seconds="2")
    yield maps, lambda page: zoomed(page)
    yield maps, lambda page: page.maps_type(here_across="20.5").maps_type(here_up="9.25")
    yield maps, lambda page: page.head(toy=CONE).maps_by(law="viscous")
    yield maps, lambda page: page.builds("set", "c", 0.0075).maps_type(slip="0.5", second="0.8")
    yield "?v=2&tab=families", lambda page: page
    yield "?v=2&tab=families", lambda page: page.head(toy="Hollow tippe top", large=True)


def zoomed(page):
    """Closer around a place."""
    page.maps.go(31.0, 12.0)
    page.maps.settings.look_at(*page.maps._around())
    return page


def by_film():
    measure = "?v=2&tab=measure"
    yield measure, lambda page: page
    yield measure, lambda page: page.films("slips")
    yield measure, lambda page: page.films("rolls")
    plain = (FOLDER / "made-slips.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    yield measure, lambda page: page.films("mine.csv", law="viscous", text="".join([*plain[:2], *plain[2:120:3]]))
    yield measure, lambda page: page.head(toy=TOY)


def typed():
    """Links that a person types, some partly wrong."""
    code = "7KQ2MX"
    return [
        names.link(vote=code), names.link(vote=code, lang="de"), "?vote=not-a-class",
        "?v=2&tab=lab&spin=30", "?v=2&tab=lab&spin=30&mu_k=-1", "?v=2&tab=lab&lang=de&tilt=steep", "?v=2&KJ=many&mu=.3",
        "?v=2&body=Nonsense_1&KJ=6.6", "?v=2&I3=9&a=.2", "?v=2&tab=learn&step=free", "?v=2&tab=nowhere&KJ=6.6",
        "?v=2&tab=maps&map=spin_1_2", "?v=2&tab=measure&film=eJw", "?v=2&lang=fr&KJ=6.6", "?v=4&KJ=6.7&mu=.4",
        "?v=2&tab=three-planes&by=hand&spin=20&tilt=200", "?v=2&KJ=-6.7&KR=-10",
    ]  # fmt: skip


def made():
    """The links, each once."""
    found = []
    for kind in (by_start, by_law, by_body, by_view, by_lesson, by_map, by_film):
        for link, does in kind():
            with opened(link) as page:
                does(page)
                query = page.query()
            print(kind.__name__, query[:150], flush=True)
            found.append(query)
    return list(dict.fromkeys([*found, *typed()]))


if __name__ == "__main__":
    main(made())
