"""What can be taken home of a fit: files, and the data in the page's link."""

from app.model.measured.film import packed
from app.model.measured.report import program, residuals_table
from app.tabs.measure.report import report
from app.text import say
from app.widgets.cards import Hidden, flow, note, words
from app.widgets.download import Download
from app.widgets.forms import Checks


class Home:
    """view: the buttons. film: the text of the data with their settings and fit. fit: (data, both fits, the parameters
    that were free, (start, end) in s, the page's words about it, the constants from the data). filmed: what a link
    stores."""

    def __init__(self, runs, filmed):
        self._filmed, self.film, self.fit = filmed, "", ()
        self.in_link = Checks(options={say("measure.in_link"): "link"}, margin=(4, 0))
        self.in_link.on("value", lambda event: self._put_in_link())
        self.of_link = words()
        self.view = Hidden(lambda: [flow(*self._downloads(runs)), self.in_link, self.of_link])

    def show(self, film, *fit):
        """Offers this fit."""
        self.film, self.fit = film, fit
        self._put_in_link()

    def clear(self):
        """Offers nothing; the link keeps what it has."""
        self.film, self.fit, self.view.visible = "", (), False

    def _put_in_link(self):
        """Puts the film into the link, if wanted and short enough."""
        wanted = bool(self.in_link.value)
        if wanted and not self.film:  # not fitted yet
            return
        self._filmed.film = packed(self.film) if wanted else ""
        too_long = wanted and not self._filmed.film
        says = say("measure.too_long_for_link") if too_long else say("measure.is_in_link") if wanted else ""
        self.of_link.object = note(says)

    def _downloads(self, runs):
        yield Download(runs, lambda: (self.film,), str.encode, label=say("measure.home.film"),
                       filename="top-on-film.csv")  # fmt: skip
        kinds = {"report": ("top-on-film.html", report_file), "residuals": ("residuals.csv", residuals_file),
                 "program": ("repeat_fit.py", program_file)}  # fmt: skip
        for kind, (name, make) in kinds.items():
            yield Download(runs, lambda: self.fit, make, label=say(f"measure.home.{kind}"), filename=name)


def report_file(data, fits, loose, part, says, constants):
    return report(data, fits, says, program(data, fits, loose, *part), constants).encode()


def residuals_file(data, fits, *others):
    return residuals_table(data, min(fits, key=lambda each: each.aic)).encode()


def program_file(data, fits, loose, part, *others):
    return program(data, fits, loose, *part).encode()
