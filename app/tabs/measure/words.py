"""What was found, in words and tables."""

import html

import numpy as np

from app.model.measured_fit import verdict
from app.text import listed, say

SHOWN = {"tilt": 180 / np.pi}
TABLE = """
table { border-collapse: collapse; margin: 6px 0; font-size: inherit } p { margin: 4px 0 }
td, th { padding: 3px 12px 3px 0; text-align: left; font-weight: normal; vertical-align: top }
th { color: var(--faint, #5b6875) } td.n { text-align: right; font-variant-numeric: tabular-nums }
h3 { font-size: 16px; margin: 8px 0 2px; font-weight: 600 }
"""


def _number(value, error):
    """(value, error) with two digits of the error."""
    places = int(np.clip(1 - np.floor(np.log10(error)), 0, 6)) if 0 < error < np.inf else 3
    return f"{value:.{places}f}".replace("-", "−"), f"{error:.{places}f}"


def found_words(rolling, sliding, kept):
    """The sentence of what was found, and why."""
    found = verdict(rolling, sliding)
    parts = [f"<h3>{say(f'measure.found.{found}.title')}</h3>", f"<p>{say(f'measure.found.{found}.why')}</p>"]
    for name, constant in kept.items():
        (before, one), (after, other) = constant.before, constant.after
        key = "stayed" if constant.stayed else "went"
        says = say(f"measure.kept.{name}")
        parts.append(
            f"<p>{say(f'measure.kept.{key}', name=says, before=before, one=one, after=after, other=other)}</p>"
        )
    return "".join(parts)


def numbers_table(fit, unit):
    """The numbers of a Fit with their errors. unit: rad/s in (g/R)^1/2."""
    sizes = SHOWN | dict.fromkeys(("spin", "across", "tilt_rate"), unit / (2 * np.pi))
    rows = []
    for name in fit.model.free:
        size = sizes.get(name, 1.0)
        value, error = _number(fit.model.values[name] * size, fit.errors[name] * size)
        marks = [say("measure.with", name=other, correlation=r) for other, r in _partners(fit, name)]
        if name in fit.unknown:
            marks.insert(0, say("measure.unknown" if _vague(fit, name) else "measure.rough"))
        rows.append(
            _row(
                say(f"measure.numbers.{name}"),
                value,
                f"± {error}",
                say(f"measure.number_units.{name}"),
                ", ".join(marks),
            )
        )
    if fit.model.name == "rolling":
        for name, (value, error) in fit.constants.items():
            rows.append(_row(say(f"measure.constants.{name}"), *(f"{mark}{part}" for mark, part in
                             zip(("", "± "), _number(value, error), strict=True)), "", ""))  # fmt: skip
    sentences = "".join(
        f"<p>{_together(*pair)}</p>" for pair in fit.together if all(_vague(fit, name) for name in pair[:2])
    )
    head = f"<tr><th colspan=5>{say(f'measure.models.{fit.model.name}')}</th></tr>"
    return f"<table>{head}{''.join(rows)}</table>{sentences}"


def _row(*cells):
    return (
        "<tr>" + "".join(f"<td{' class=n' if 0 < i < 3 else ''}>{cell}</td>" for i, cell in enumerate(cells)) + "</tr>"
    )


def _vague(fit, name):
    """Whether a number is known to no better than half of itself."""
    return fit.errors[name] > 0.5 * abs(fit.model.values[name])


def _partners(fit, name):
    for one, other, r in fit.together:
        if name in (one, other):
            yield say(f"measure.numbers.{other if name == one else one}"), r


def _together(one, other, r):
    names = say(f"measure.numbers.{one}"), say(f"measure.numbers.{other}")
    return say("measure.together.up" if r > 0 else "measure.together.down", one=names[0], other=names[1])


def models_table(rolling, sliding):
    """Both models on the same data."""
    head = "".join(f"<th>{word}</th>" for word in listed("measure.heads"))
    rows = []
    for fit in (sliding, rolling):
        seldom = f"{min(fit.runs.values()):.1f}".replace("-", "−")
        rows.append(_row(say(f"measure.models.{fit.model.name}"), f"{fit.chi2:.0f}", f"{fit.freedom}", f"{fit.aic:.0f}",
                         seldom, say(f"measure.{_state(fit)}")))  # fmt: skip
        for name, (chi2, count) in fit.chi2_of.items():
            rows.append(_row(f"&nbsp; {say(f'measure.quantities.{name}')}", f"{chi2:.0f}", f"{count}", "",
                             f"{fit.runs[name]:.1f}".replace("-", "−"), ""))  # fmt: skip
    return f"<table><tr>{head}</tr>{''.join(rows)}</table>"


def _state(fit):
    if fit.refused:
        return "refused" if fit.sure else "unsure"
    return "stands"


def notes_words(notes):
    """What was left out of a table."""
    return "".join(f"<div>{say(f'measure.notes.{code}', **_escaped(numbers))}</div>" for code, numbers in notes)


def _escaped(numbers):
    return {name: html.escape(value) if isinstance(value, str) else value for name, value in numbers.items()}
