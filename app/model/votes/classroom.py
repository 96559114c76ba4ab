"""Votes of a class: rooms that all workers see, no names, bounded; a room is its teacher's, by a key of his own.

A room is plain data: {"step", "asks", "top", "shown", "owner", "used", "phones": {phone: address},
"votes": {phone: [value, address, when]}, "others": {step: votes}}: one question at a time, and the votes on others.
"""

import hashlib
import hmac
import ipaddress
import json
import logging
import re
import secrets
import time
from dataclasses import dataclass

MOST_ROOMS, ROOMS_OF_ADDRESS = 1000, 40
MOST_VOTES, VOTES_OF_ADDRESS = 400, 250  # of a room
LASTS = 6 * 3600.0  # s after its last use
USED = 600.0  # s: no oftener is it written that a room is in use
BETWEEN = 1.0  # s between two votes of one phone
LETTERS = "23456789ABCDEFGHJKLMNPQRSTUVWXYZ"  # none that is taken for another
CODE_LENGTH = 6
CODE = re.compile(rf"[{LETTERS}]{{{CODE_LENGTH}}}")
KEY = re.compile(rf"{CODE.pattern}\.[\w-]{{22}}", re.ASCII)  # the room's code, and its owner's secret
MARK = re.compile(r"[0-9a-f]{32}", re.ASCII)  # what a phone is known by
REGISTER = "rooms"  # the key of {code: [used, address]}: no code is so short

EMPTY = {"votes": {}, "others": {}, "phones": {}, "shown": False}

log = logging.getLogger("tippe")


class Refused(Exception):
    """A vote or a room that cannot be; its text is a key under [student] or [vote] in teach.toml."""


@dataclass(frozen=True)
class Room:
    """One question to a class, which each page says in its own language, and the votes so far.

    step: the name of a lesson.Step; asks: the fields of a lesson.Choice or Guess; top: the page's own, as a link has
    it; shown: whether its answer is; phones: how many have come.
    """

    code: str
    step: str
    asks: dict
    top: dict
    votes: tuple
    shown: bool
    phones: int

    @classmethod
    def of(cls, code, text):
        """Of what a store has under its code."""
        if text is None:
            return None
        record = json.loads(text)
        votes = tuple(value for value, _, _ in record["votes"].values())
        return cls(code, record["step"], record["asks"], record["top"], votes, record["shown"], len(record["phones"]))


def possible(asks, value):
    """Whether a vote is an answer."""
    if "options" in asks:
        return value in asks["options"]
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return number and asks["low"] <= value <= asks["high"]


def network(address):
    """What one person has all of: an address, of IPv6 the first half."""
    try:
        found = ipaddress.ip_address(address)
    except ValueError:
        return address
    if found.version == 6:
        found = found.ipv4_mapped or int(found) >> 64
    return str(found)


def mixed(*parts):
    """A number from which nobody gets its parts back, in hexadecimal."""
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


class Rooms:
    """The rooms in a store. clock: s, the same for all hosts."""

    def __init__(self, store, votes_of_address=VOTES_OF_ADDRESS, clock=time.time):
        self._store, self._clock, self._votes_of_address = store, clock, votes_of_address

    def open(self, address, **question):
        """(Room, key): a new one, with these fields of it; Refused("full" or "crowded") where there are too many."""
        now, old, found = self._clock(), [], []
        # so many addresses have the same: which one it was is not kept
        address = mixed(network(address))[:6]

        def entered(text):
            all_of = json.loads(text) if text else {}
            register = {code: entry for code, entry in all_of.items() if now - entry[0] <= LASTS}
            old[:] = all_of.keys() - register.keys()
            if len(register) >= MOST_ROOMS:
                raise Refused("full")
            if sum(entry[1] == address for entry in register.values()) >= ROOMS_OF_ADDRESS:
                raise Refused("crowded")
            while (code := "".join(secrets.choice(LETTERS) for _ in range(CODE_LENGTH))) in all_of:
                pass
            found[:] = [code]
            return json.dumps(register | {code: [now, address]})

        self._store.change(REGISTER, entered)
        for gone in old:
            self._store.change(gone, lambda text: None)
        [code], secret = found, secrets.token_urlsafe(16)
        text = json.dumps({**question, "owner": mixed(secret), "used": now} | EMPTY)
        self._store.change(code, lambda _: text)
        return Room.of(code, text), f"{code}.{secret}"

    def _living(self, text):
        """The record in a text, or None."""
        record = json.loads(text) if text else None
        return record if record and self._clock() - record["used"] <= LASTS else None

    def _read(self, code):
        """(text, record) of a room, which this uses; (None, None) where there is none."""
        text = self._store.read([code]).get(code) if CODE.fullmatch(code) else None
        record = self._living(text)
        if record is None:
            return None, None
        self._use(code, record)
        return text, record

    def _use(self, code, record):
        if self._clock() - record["used"] > USED:
            self.use(code)

    def use(self, code):
        """Lets a room last from now on."""
        now = self._clock()

        def in_register(text):
            register = json.loads(text) if text else {}
            return json.dumps(register | {code: [now, register.get(code, [now, ""])[1]]})

        def in_room(text):
            record = self._living(text)
            return json.dumps(record | {"used": now}) if record else text

        self._store.change(REGISTER, in_register)  # first: a room that lasts is never thought to be old
        self._store.change(code, in_room)

    def owned(self, key):
        """The Room of a teacher's key; Refused("over") where there is none, or it is another's."""
        code, secret = key.split(".")
        text, record = self._read(code)
        if record is None or not hmac.compare_digest(record["owner"], mixed(secret)):
            raise Refused("over")
        return Room.of(code, text)

    def close(self, key):
        """Forgets a teacher's room and its votes, if it is there."""
        try:
            code = self.owned(key).code
        except Refused:
            return
        self._store.change(code, lambda text: None)
        self._store.change(REGISTER, lambda text: json.dumps(
            {each: entry for each, entry in json.loads(text or "{}").items() if each != code}))  # fmt: skip

    def _owners(self, key, changed):
        """The Room of a teacher's key after changed(record); Refused("over") as owned()."""
        code, found = self.owned(key).code, []

        def change(text):
            record = self._living(text)
            if record is None:
                raise Refused("over")
            found[:] = [json.dumps(record | changed(record) | {"used": self._clock()})]
            return found[0]

        self._store.change(code, change)
        return Room.of(code, found[0])

    def ask(self, key, **question):
        """Has a teacher's room ask another question; the votes on the one before are kept, and come back with it."""

        def changed(record):
            if record["step"] == question["step"]:
                return {}
            others = record["others"] | {record["step"]: record["votes"]}
            return question | {"votes": others.pop(question["step"], {}), "others": others, "shown": False}

        return self._owners(key, changed)

    def reveal(self, key):
        """Shows the answer in a teacher's room: no vote is taken any more."""
        return self._owners(key, lambda record: {"shown": True})

    def reset(self, key):
        """Forgets all votes and phones in a teacher's room, for the next class."""
        return self._owners(key, lambda record: EMPTY)

    def ballot(self, code, phone, address=""):
        """(Room, the vote of this phone or None), and the phone has come; (None, None) where there is no room."""
        text, record = self._read(code)
        if record is None:
            return None, None
        name, place = mixed(code, phone), mixed(code, network(address))[:6]

        def come(record):
            seats = record["phones"]
            alike = sum(each == place for each in seats.values())
            return name in seats or len(seats) >= MOST_VOTES or alike >= self._votes_of_address

        def change(text):
            record = self._living(text)
            if record is None or come(record):
                return text
            return json.dumps(record | {"phones": record["phones"] | {name: place}})

        if not come(record):
            self._store.change(code, change)
            text = self._store.read([code]).get(code, text)
        mine = record["votes"].get(name)
        return Room.of(code, text), mine[0] if mine else None

    def vote(self, code, phone, address, value, step=None):
        """Counts the vote of a phone (any text that it is known by) in place of its earlier one, or raises Refused.
        step: the question that the phone had, of which the class may have gone on."""
        if not CODE.fullmatch(code):
            raise Refused("gone")
        phone, address, now = mixed(code, phone), mixed(code, network(address))[:6], self._clock()
        found = []

        def counted(text):
            record = self._living(text)
            if record is None:
                raise Refused("gone")
            if step not in (None, record["step"]):
                raise Refused("moved")
            if record["shown"]:
                raise Refused("shown")
            if not possible(record["asks"], value):
                raise Refused("wrong")
            votes = record["votes"]
            if phone in votes:
                if abs(now - votes[phone][2]) < BETWEEN:
                    raise Refused("fast")
            elif len(votes) >= MOST_VOTES:
                raise Refused("full")
            elif sum(each[1] == address for each in votes.values()) >= self._votes_of_address:
                raise Refused("crowded")
            found[:] = [record]
            votes[phone] = [value, address, now]
            return json.dumps(record)

        self._store.change(code, counted)
        self._use(code, *found)

    def look(self, codes):
        """{code: text} of those that are there; Room.of reads a text, where it is another than before."""
        return self._store.read(codes)
