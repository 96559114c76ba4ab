"""Draws random starts and holds what is told of them against their runs: python tests/story_checker.py 100 7

draws 100 starts from the seed 7 and prints how many false phases and sentences of each kind there are. What is told
comes from app.model.tell in another process; nothing else of the app is used. python tests/story_checker.py cases
takes the starts of which something false was said before, and the arrival.
"""

import collections
import json
import subprocess
import sys

import numpy as np
import story_kept
import story_phases
import story_words
from story_said import Said
from story_samples import Phase, Run

BODIES = {
    "paper": "TruncatedSphere_.016_.0082_.0192_.0032_.0115&a=.07&I1=.399&I3=.408",
    "Top S": "BareSphere_.02_.02_.3_.3742857142857143_.4",
    "loaded": "LoadedSphere_.02_.008_.01_1190_7850",
    "disc": "OrdinaryTop_.0018_.0162_.025_.025_.004_.002_.015_.02",
    "cone": "OrdinaryTop_.006_0_.006_.022_.025_.004_.02_.013",
    "ball": "Ball_.02_.04",
    "hollow": "zeNqNkE1ugzAQhfecAnkNqTExkBwgB4iyalVVFYyKFbAt26Stoty9M6FNikLVbGy_b_6e5xjFzNct9K9sHbOgrIU0GJvCh-2MA"
              "_eAgiWYdADnldGYlZHcK91QxW5wGppzRqN60JTjMXCM4pht8cEXPCsSUt50imqeUJzjyKyCGqjPo9FAXQh25h1ReqlE1Kq3dmz"
              "GK_HNGpoWPhGXUi6qlVwKWXAps-KnajIfdQ06OBghkVMyZ2XjBh-GfupmMvnqRpTLu924l2urXFzgr6_l4m9X8wvi-e2CyhtH6"
              "T8L4nJmQXw0g8dzhNcp-gIewICy",
    "profile": "zeNp9j0EKwjAQRfc5Rci61aSmKp7BlVtxUcxAgzYJTRCl9O7ORGkRiptkft77kBkYF_HaQteIAxfJhgBl8qGEZ7j7Hvo1BlGg9"
               "IA-Wu_QUhRv1hlqHJvUQhaM7cCREvF9YJyLEw5yJWVdUAreukTsjOlzzDSPdF-KH6r2E1ULuKpmvP1fr5b6Us9cL_HNxHWdOfs"
               "6wtCy6YX77GT--8hG9gbaAkTz",
    "appendix": "TruncatedSphere_.016_.0082_.0192_.0032_.0115",
    "Leine": "StemmedSphere_.015_.006_.2_.5925925925925926_.5185185185185185_.005_.013",
}  # fmt: skip
"""{preset: its body in an address}."""
CASES = (
    ("Leine", "spin=47.5&tilt=126.8"), ("Top S", "spin=.3&tilt=172.6"),
    ("paper", "spin=.3&tilt=13.4"), ("paper", "spin=.3&tilt=0"), ("Top S", "spin=100&tilt=43.4"),
    ("loaded", "spin=50&tilt=10"), ("loaded", "spin=15.2&tilt=10"), ("Top S", "spin=10.8&tilt=8.3"),
    ("paper", "spin=100&tilt=180"), ("Leine", "spin=8&tilt=159.9"), ("hollow", "spin=34.7&tilt=166.4"),
    ("Top S", "spin=1&tilt=180&mu_k=.46&patch=.19"), ("Leine", "spin=12.9&tilt=173.2"),
    ("Leine", "spin=.3&tilt=180"), ("ball", "spin=50&tilt=107.3"), ("loaded", "spin=-58.2&tilt=10&mu_k=1"),
    ("Leine", "spin=50&tilt=10&patch=5"), ("Leine", "spin=.3&tilt=10"),
    ("Leine", "spin=50&tilt=5.5&mu_k=.01&patch=1.94"), ("paper", "spin=50&tilt=5&mu_k=.1"),
    ("paper", "spin=46&tilt=5&mu_k=.1"), ("paper", "spin=34&tilt=5&mu_k=.1"), ("Leine", "spin=40&tilt=5.7&mu_k=.05"),
    ("Leine", "spin=20&tilt=5.7&mu_k=.05"), ("Leine", "spin=40&tilt=5.7&mu_k=.1"), ("cone", "spin=30&tilt=44"),
    ("loaded", "spin=2.245&tilt=179.44&mu_k=.075"), ("profile", "spin=24.765&tilt=7.84&mu_k=.467"),
    ("Top S", "spin=36.591&tilt=73.12&mu_k=.086"), ("paper", "spin=18.473&tilt=82.8&mu_k=.364"),
    ("hollow", "spin=17.237&tilt=107.89&mu_k=.13"),
)  # fmt: skip
LIVES = (
    ("cone", "spin=3.8&tilt=15.6"), ("paper", "spin=37&tilt=61.7"), ("paper", "spin=27.5&tilt=51.8"),
    ("hollow", "spin=35.5&tilt=65.2"), ("Leine", "spin=47.2&tilt=90"), ("Leine", "spin=-30.9&tilt=90"),
    ("Top S", "spin=-40.9&tilt=136.6&mu_k=1&patch=.01"), ("Top S", "spin=42.956&tilt=10.21&mu_k=.187"),
)  # fmt: skip
"""(preset, start) of which something false was said before; on all tables. LIVES take seconds each."""
STEMLESS = "Top S", "loaded", "ball"
TABLES = "ordinary", "rough", "ice", "three"
WORKER = """
import json, sys
from app.model import tell
for line in sys.stdin:
    try:
        told = tell(line.strip())
    except Exception as error:
        told = {"error": repr(error)}
    print(json.dumps(told, default=lambda value: value.tolist()), flush=True)
"""


LAWS = "law=coulomb", "law=viscous&gamma=.5", "law=smoothed"


def starts_of_laws(n, seed):
    """The same with each of the laws of friction at a point."""
    for i, (name, query) in enumerate(starts(n, seed)):
        yield name, f"{query.replace('v=2', 'v=3')}&{LAWS[i % len(LAWS)]}"


def starts(n, seed):
    """[(preset, query)]: n random starts on a real contact."""
    random = np.random.default_rng(seed)
    for _ in range(n):
        name = str(random.choice(list(BODIES)))
        tilt = random.choice([random.uniform(0, 15), random.uniform(0, 110), random.uniform(0, 180)])
        spin, mu = random.uniform(0, 50), 0.02 * 40 ** random.random()
        start = f"spin={spin:.3f}&tilt={tilt:.2f}&mu_k={mu:.3f}&table={random.choice(TABLES)}"
        yield name, f"?v=2&body={BODIES[name]}&{start}&tab=lab"


def told_by(queries, command=(sys.executable, "-c", WORKER)):
    """What tell says of each query, one after the other."""
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as worker:
        for query in queries:
            worker.stdin.write(query + "\n")
            worker.stdin.flush()
            yield json.loads(worker.stdout.readline() or '{"error": "the process of tell has ended"}')
        worker.stdin.close()


def faults(told, stemless=False):
    """[(kind of fault, table, text)] of all that tell says of one start."""
    runs, bad = {}, []
    for name, table in told["tables"].items():
        if not table["refused"]:
            runs[name] = Run.told(name, table)
    for name, run in runs.items():
        bad += [(kind, name, text) for kind, text in story_phases.faults(run)]
        table = told["tables"][name]
        for text, phase, whole in texts(run, table):
            said = Said(text, run, phase, runs, stemless, whole)
            bad += [(kind, name, why) for kind, why in story_words.faults(said)]
        given = runs.get("ordinary") or runs.get("ice", run)  # no table but the rough one grips
        bad += [(kind, name, why) for kind, why in story_kept.faults(run, rows(table["kept"]), given)]
    for text in told.get("wording", ()) if runs else ():
        run = next(iter(runs.values()))
        said = Said(text, run, Phase("", run.start, run.end), runs, stemless, True)
        bad += [(kind, "all", why) for kind, why in story_words.faults(said)]
    return bad


def rows(kept):
    """{quantity: text} of the table of what is kept."""
    return {name: row["wording"] if isinstance(row, dict) else row for name, row in dict(kept).items()}


def texts(run, table):
    """(a text of a table, the phase that it is said of, is it said of the whole run)."""
    for phase, told in zip(run.phases, table["phases"], strict=True):
        yield told["headline"], phase, False
        yield told["why"], phase, False
    for key in ("caption", "ended", "headline", "why"):
        if table.get(key):
            yield table[key], Phase("", run.start, run.end), True


def arrival_faults(told):
    """What holds of the arrival only: it is told of all of it, in few words that say little."""
    table = told["tables"]["ordinary"]
    run = Run.told("ordinary", table)
    little = sum(one.t1 - one.t0 for one in run.phases if one.kind in ("slides", "nods"))
    if little > 0.2 * (run.end - run.start):
        yield "arrival", "ordinary", f"slides and nods cover {little:.2f} of {run.end - run.start:.2f} s"
    for phase in table["phases"]:
        if not phase["headline"] or not phase["why"]:
            yield "arrival", "ordinary", f"{phase['kind']} has no headline or no reason"


def cases(starts=CASES + LIVES):
    """[(preset, query)]: the arrival, and these starts."""
    tabled = ((name, f"?v=2&body={BODIES[name]}&{start}&table=three&tab=lab") for name, start in starts)
    return [("paper", ""), *tabled]


def counted(drawn):
    """Prints how many faults of each kind there are."""
    kinds, first, refused, tables, impossible = collections.Counter(), {}, 0, 0, 0
    for (name, query), told in zip(drawn, told_by(query for _, query in drawn), strict=True):
        if "TopError" in told.get("error", ""):  # a body that cannot be put down so
            impossible += 1
            continue
        if "error" in told:
            bad = [("tell fails", "all", told["error"])]
        else:
            bad = [*faults(told, name in STEMLESS), *(arrival_faults(told) if not query else ())]
            tables += len(told["tables"])
            refused += sum(bool(table["refused"]) for table in told["tables"].values())
        kinds.update({kind for kind, _, _ in bad})
        for kind, table, text in bad:
            first.setdefault(kind, []).append(f"{name} on {table}: {text}\n      {query}")
    print(f"{len(drawn)} starts: {tables} tables, {refused} refused, {impossible} starts impossible")
    for kind, count in kinds.most_common():
        print(f"{count:5d} starts  {kind}", *first[kind][:3], sep="\n    ")
    return kinds


if __name__ == "__main__":
    sys.exit(bool(counted(cases() if sys.argv[1:] == ["cases"] else list(starts(*map(int, sys.argv[1:]))))))
