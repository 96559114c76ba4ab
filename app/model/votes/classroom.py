"""Votes of a class, in rooms that all workers share, anonymous and bounded; a teacher owns a room by a secret key.

A room is plain data: {"step", "asks", "top", "shown", "owner", "used", "phones": {phone: address}, "votes": {phone:
[value, address, when]}, "others": {step: votes}}: one question at a time, and the votes on others.
"""

import hashlib
import hmac
import ipaddress
import json
import logging
import math
import re
import secrets
import time
from dataclasses import dataclass

MOST_ROOMS, ROOMS_OF_ADDRESS = 1000, 40
MOST_VOTES, VOTES_OF_ADDRESS = 400, 250  # in each room
LASTS = 6 * 3600.0  # s after its last use, until a room is deleted
USED = 600.0  # s: the use of a room is recorded at most this often
BETWEEN = 1.0  # s between two votes from one phone
LETTERS = "23456789ABCDEFGHJKLMNPQRSTUVWXYZ"  # without letters and digits that look alike
CODE_LENGTH = 6
CODE = re.compile(rf"[{LETTERS}]{{{CODE_LENGTH}}}")
KEY = re.compile(rf"{CODE.pattern}\.[\w-]{{22}}", re.ASCII)  # the room's code, and its owner's secret
MARK = re.compile(r"[0-9a-f]{32}", re.ASCII)  # the identifier of a phone
LOST = ""  # in place of the text of a room whose store came back without it
REGISTER = "rooms"  # the key of {code: [used, address]}; it cannot be a room's code

EMPTY = {"votes": {}, "others": {}, "phones": {}, "shown": False}

log = logging.getLogger("tippe")


class Refused(Exception):
    """A vote or a room that is refused; the text is a key under [student] or [vote] in teach.toml."""


@dataclass(frozen=True)
class Room:
    """One question to a class, which each page shows in its own language, and the votes so far.

    step: the name of a lesson.Step; asks: the fields of a lesson.Choice or Guess; top: that of the teacher's page, as
    in a link; shown: whether the answer is shown; phones: how many have joined.
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
        """The Room stored as text under its code."""
        if text is None:
            return None
        record = json.loads(text)
        votes = tuple(value for value, _, _ in record["votes"].values())
        return cls(code, record["step"], record["asks"], record["top"], votes, record["shown"], len(record["phones"]))


def possible(asks, value):
    """Whether a vote is one of the possible answers."""
    if "options" in asks:
        return value in asks["options"]
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return number and asks["low"] <= value <= asks["high"]


def network(address):
    """The part of an address that belongs to one person: all of it, but only the first half of an IPv6 address."""
    try:
        found = ipaddress.ip_address(address)
    except ValueError:
        return address
    if found.version == 6:
        found = found.ipv4_mapped or int(found) >> 64
    return str(found)


def mixed(*parts):
    """A hash of the parts, in hexadecimal, from which they cannot be recovered."""
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


class Rooms:
    """The rooms in a store. clock: returns the time in s, the same on all hosts."""

    def __init__(self, store, votes_of_address=VOTES_OF_ADDRESS, clock=time.time):
        self._store, self._clock, self._votes_of_address = store, clock, votes_of_address

    def open(self, address, **question):
        """(Room, key) of a new room with these fields; raises Refused("full" or "crowded") if there are too many."""
        now, old, found = self._clock(), [], []
        # many addresses share the same six digits, so that the address itself is not stored
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
        """The record in a text, or None if it has expired."""
        record = json.loads(text) if text else None
        return record if record and self._clock() - record["used"] <= LASTS else None

    def _read(self, code):
        """(text, record) of a room, and records its use; (None, None) if there is none."""
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
        """Extends the life of a room from now on."""
        now = self._clock()

        def in_register(text):
            register = json.loads(text) if text else {}
            return json.dumps(register | {code: [now, register.get(code, [now, ""])[1]]})

        def in_room(text):
            record = self._living(text)
            return json.dumps(record | {"used": now}) if record else text

        self._store.change(REGISTER, in_register)  # first, so that a room that is in use never looks expired
        self._store.change(code, in_room)

    def owned(self, key):
        """The Room of a teacher's key; raises Refused("over") if there is none or if the key is wrong."""
        code, secret = key.split(".")
        text, record = self._read(code)
        if record is None or not hmac.compare_digest(record["owner"], mixed(secret)):
            raise Refused("over")
        return Room.of(code, text)

    def close(self, key):
        """Deletes a teacher's room and its votes, if it exists."""
        try:
            code = self.owned(key).code
        except Refused:
            return
        self._store.change(code, lambda text: None)
        self._store.change(REGISTER, lambda text: json.dumps(
            {each: entry for each, entry in json.loads(text or "{}").items() if each != code}))  # fmt: skip

    def _owners(self, key, changed):
        """The Room of a teacher's key after changed(record); raises Refused("over") as owned() does."""
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
        """Makes another question the current one in a teacher's room; votes on the previous one are kept, and restored
        with it."""

        def changed(record):
            if record["step"] == question["step"]:
                return {}
            others = record["others"] | {record["step"]: record["votes"]}
            return question | {"votes": others.pop(question["step"], {}), "others": others, "shown": False}

        return self._owners(key, changed)

    def reveal(self, key):
        """Shows the answer in a teacher's room; no more votes are accepted."""
        return self._owners(key, lambda record: {"shown": True})

    def reset(self, key):
        """Deletes all votes and phones in a teacher's room, for the next class."""
        return self._owners(key, lambda record: EMPTY)

    def ballot(self, code, phone, address=""):
        """(Room, the vote of this phone or None), and counts the phone as joined; (None, None) if there is no room."""
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
        """Counts the vote of a phone (identified by any text) in place of its earlier one, or raises Refused. step: the
        question that the phone shows; the class may have moved on to another."""
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
        """{code: text} of the rooms that exist, LOST for one that nobody closed; Room.of() reads a text that has
        changed."""
        texts = self._store.read([*codes, REGISTER])
        register = texts.pop(REGISTER, None)
        for code in {*codes} - texts.keys():
            used, _ = json.loads(register).get(code, [-math.inf, ""]) if register else [math.inf, ""]
            if self._clock() - used <= LASTS:
                texts[code] = LOST
        return texts
