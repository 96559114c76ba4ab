"""The results in words and tables."""

import html

import numpy as np

from app.model.measured.fit import WORSE, verdict
from app.model.measured.table import line_in_file
from app.text import listed, say, written
from app.widgets.cards import TABLE, note

SHOWN = {"tilt": 180 / np.pi}
NAMED = 8  # times of values that are far off
OF_MODELS = ("", " class=n", *[" class='n deep'"] * 2, "")
FOUND = (
    TABLE
    + """
table { width: 100% } p { margin: 4px 0 } th { font-size: calc(12px * var(--type, 1)) }
:host(.brief) .deep { display: none }
td.n, th + th:not(:last-child) { text-align: right } td.n { white-space: nowrap }
tr.best td { font-weight: 600 }
td.faint { color: var(--faint) } tr + tr { border-top: 1px solid var(--rule) }
h3 { font-size: calc(18px * var(--type, 1)); margin: 8px 0 2px; font-weight: 600; letter-spacing: -0.01em }
@media (max-width: 500px) { td, th { padding-right: 4px } }
"""
)


def _number(value, error):
    """(value, error), rounded to two digits of the error."""
    places = int(np.clip(1 - np.floor(np.log10(error)), 0, 6)) if 0 < error < np.inf else 3
    return written(value, f".{places}f"), written(error, f".{places}f") if error < np.inf else "∞"


def _error(value, below, above):
    """One standard error to either side; only one number if they are about the same."""
    if max(below, above) < 1.15 * min(below, above):
        return _number(value, max(below, above))
    least = min(below, above)
    return _number(value, least)[0], f"+{_number(value, above)[1]} −{_number(value, below)[1]}"


def result_words(result, again):
    """A Found in words and tables. again: it was saved with a film, and not fitted anew."""
    saved = note(say("measure.fit_of_film")) if again else ""
    found = found_words(*result.fits, result.kept)
    found += far_words(result.better, result.motion.data)
    return found + saved + numbers_table(result.better) + models_table(*result.fits)


def found_words(rolling, sliding, kept):
    """The result in a sentence, and the reasons for it."""
    found = verdict(rolling, sliding)
    other = {"rolled": sliding, "slipped": rolling}.get(found)
    why = "out" if other is not None and other.refused else "why"
    start = say(f"measure.start.{'push' if 'tilt_rate' in sliding.model.free else 'still'}")
    told = [say(f"measure.found.{found}.{why}", start=start)]
    told += [say("measure.gave_up", name=say(f"measure.models.{fit.model.name}"), times=WORSE)
             for fit in (rolling, sliding) if fit.given_up]  # fmt: skip
    return f"<h3>{say(f'measure.found.{found}.title')}</h3><p>{' '.join(told)}</p>" + kept_words(kept)


def far_words(fit, data):
    """Which values are far off a Fit, and when; and whether all are nearer than chance would have them."""
    told = []
    if fit.far:
        times = []
        for name, at in fit.far.items():
            when = ", ".join(written(data.series[name].t[i], ".3f") for i in at[:NAMED]) + " …" * (len(at) > NAMED)
            times.append(f"{say(f'measure.quantities.{name}')}: {when}")
        count = sum(map(len, fit.far.values()))
        told.append(say("measure.far", count=count, all=len(fit.residuals.row), times="; ".join(times)))
    if fit.too_good:
        told.append(say("measure.too_good", times=fit.too_good))
    return "".join(f"<p>{each}</p>" for each in told)


def name_of(file, example, of_file):
    """What a film is called: by the name of its file, if it has one."""
    if example:
        return say("measure.made_up", example=listed("measure.examples")[example])
    return html.escape(file) or say("measure.saved" if of_file else "measure.own")


def kept_words(kept):
    """Whether the constants of the motion were conserved, from the data alone, and what that means."""
    parts = []
    for name, constant in kept.items():
        (before, one), (after, other) = (_number(*part) for part in (constant.before, constant.after))
        key = "stayed" if constant.stayed else "went"
        says = say(f"measure.kept.{name}")
        parts.append(say(f"measure.kept.{key}", name=says, before=before, one=one, after=after, other=other))
    if kept:
        known = "".join("k" if kept[name].stayed else "w" for name in ("K_R", "K_J") if name in kept)
        parts.append(say(f"measure.kept.means.{known}"))
    return "".join(f"<p>{part}</p>" for part in parts)


def numbers_table(fit):
    """The parameters of a Fit with their errors."""
    scales = fit.model.scales
    turns = scales.angular_velocity / (2 * np.pi)  # rev/s in one (g/R)^1/2
    sizes = SHOWN | dict.fromkeys(("spin", "across", "tilt_rate"), turns) | {"radius": 1e3 * scales.R}
    rows = []
    for name in fit.model.free:
        size = sizes.get(name, 1.0)
        value, error = _error(fit.model.values[name] * size, *(side * size for side in fit.sides[name]))
        marks = [f"<span class=deep>{say('measure.with', name=other, correlation=r)}</span>"
                 for other, r in _partners(fit, name)]  # fmt: skip
        if name in fit.unknown:
            marks.insert(0, say("measure.unknown"))
        if name in fit.bounded:
            marks.insert(0, say("measure.bound", bound=written(fit.bounded[name] * size, "g")))
        if name in ("spin", "across") and not fit.handed:
            marks.insert(0, say("measure.mirrored"))
        error = f"± {error}" if error[0] not in "+∞" else error
        unit_of = say(f"measure.number_units.{name}")
        rows.append(_row(say(f"measure.numbers.{name}"), value, error, unit_of, ", ".join(marks)))
    if fit.model.name == "rolling":
        for name, (value, error) in fit.constants.items():
            rows.append(_row(say(f"measure.constants.{name}"), *(f"{mark}{part}" for mark, part in
                             zip(("", "± "), _number(value, error), strict=True)), "", ""))  # fmt: skip
    sentences = "".join(f"<p>{_together(*pair)}</p>" for pair in fit.together if set(pair[:2]) & set(fit.unknown))
    head = f"<tr><th colspan=5>{say('measure.of_model', model=say(f'measure.models.{fit.model.name}'))}</th></tr>"
    doubt = "worthless" if fit.refused else "others" if not fit.sure else ""
    worthless = f"<p>{say(f'measure.{doubt}')}</p>" if doubt else ""
    return f"<table>{head}{''.join(rows)}</table>{worthless}{sentences}"


def _row(*cells, best=False, marks=("", " class=n", " class='n faint'", " class=faint", " class=faint")):
    told = "".join(f"<td{mark}>{cell}</td>" for mark, cell in zip(marks, cells, strict=True))
    return f"<tr{' class=best' if best else ''}>{told}</tr>"


def _partners(fit, name):
    for one, other, r in fit.together:
        if name in (one, other):
            yield say(f"measure.numbers.{other if name == one else one}"), r


def _together(one, other, r):
    names = say(f"measure.numbers.{one}"), say(f"measure.numbers.{other}")
    return say("measure.together.up" if r > 0 else "measure.together.down", one=names[0], other=names[1])


def models_table(rolling, sliding):
    """Both models, fitted to the same data."""
    heads = zip(OF_MODELS, listed("measure.heads"), strict=True)
    head = "".join(f"<th{mark.replace('n deep', 'deep')}>{word}</th>" for mark, word in heads)
    better = min(rolling, sliding, key=lambda fit: fit.aic)
    rows = []
    for fit in (sliding, rolling):
        seldom = written(min(fit.runs.values()), ".1f")
        chi2, aic = (written(value, ",.0f") for value in (fit.chi2, fit.aic))
        cells = (f"{chi2} ({fit.freedom})", aic, seldom, say(f"measure.{_state(fit)}"))
        rows.append(_row(say(f"measure.models.{fit.model.name}"), *cells, best=fit is better, marks=OF_MODELS))
    return f"<table><tr>{head}</tr>{''.join(rows)}</table><div class=deep>{note(say('measure.heads_mean'))}</div>"


def _state(fit):
    if not fit.sure:
        return "given_up" if fit.given_up else "unsure"
    return "refused" if fit.refused else "stands"


def notes_words(notes, each=1):
    """What was left out of a table, which contains every each-th row of its file."""
    return "".join(f"<div>{html.escape(say(f'measure.notes.{code}', **in_file(numbers, each)), quote=False)}</div>"
                   for code, numbers in notes)  # fmt: skip


def in_file(numbers, each):
    """The numbers of a sentence about a table, with the line number of the file."""
    return numbers | {"line": line_in_file(numbers["line"], each)} if "line" in numbers else numbers
