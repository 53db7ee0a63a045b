"""load(): a recorded run of any kind as arrays."""

import csv
import datetime
import lzma
import mmap
import zlib
from pathlib import Path

import numpy

from . import event_log, mcap, messages, packed

MODES = ("off", "self_test", "lift", "levitating", "spinning", "coast_down", "landing", "tripped")


class Unreadable(ValueError):
    """A file that is no recorded run; the text says why."""


class Session:
    """Columns of a run, with the names and units of the CSV contract.

    session["position_de_x_m"]   a column, as are time_s, speed_rpm, control_current_de_x_a, mode ...
    session.names, .channels     all columns; the axes in order
    session.modes                the mode of each row as text
    session.rig_yaml             the files of the run, complete; "" where the file holds none
    session.records              of an LCM log: every field of every record, frames missing or not
    session.events               [(time in s, text)] of an LCM log or MCAP file
    session.damaged              records and events that could not be read
    """

    def __init__(self, path, columns, texts=None, **more):
        self.path = Path(path)
        self.columns = columns
        texts = texts or {}
        self.rig_yaml, self.controller_yaml, self.scenario_yaml = (
            texts.get(f"{name}_yaml", "") for name in ("rig", "controller", "scenario"))
        self.program_version = texts.get("program_version", "")
        self.pace = texts.get("pace", "")
        self.source = texts.get("source", "")
        self.machine = texts.get("machine", "")
        self.seed = more.get("seed")
        self.period_s = more.get("period_s")
        self.start = more.get("start")
        self.records = more.get("records")
        self.events = more.get("events", [])
        self.damaged = more.get("damaged", 0)

    def __getitem__(self, name):
        if name not in self.columns:
            raise KeyError(f"no column '{name}'; there are: {', '.join(self.columns)}")
        return self.columns[name]

    def __len__(self):
        return len(self.time_s)

    def __repr__(self):
        span = f"{self.time_s[0]:.4f} to {self.time_s[-1]:.4f} s" if len(self) else "no rows"
        return f"<levitas.Session {self.path.name}: {len(self)} rows, {span}, {' '.join(self.channels)}>"

    @property
    def names(self):
        return list(self.columns)

    @property
    def time_s(self):
        return self.columns["time_s"]

    @property
    def channels(self):
        return [name[len("position_"):-len("_m")] for name in self.columns
                if name.startswith("position_") and name.endswith("_m")]

    @property
    def modes(self):
        return numpy.array(MODES)[self["mode"].astype(int)]

    def between(self, from_s, to_s):
        """The same run from one time to another, both included; what is not a column stays."""
        rows = (self.time_s >= from_s) & (self.time_s <= to_s)
        out = Session.__new__(Session)
        out.__dict__ = {**self.__dict__, "columns": {n: c[rows] for n, c in self.columns.items()}}
        return out

    def frame(self):
        """A pandas DataFrame, a row per sample, its index the time in seconds."""
        import pandas  # only here: the rest needs numpy alone
        return pandas.DataFrame({n: c for n, c in self.columns.items() if n != "time_s"},
                                index=pandas.Index(self.time_s, name="time_s"))


def load(path):
    """The recorded run in `path`: an LCM log, plain or packed by zstd, or what `amb export` makes of one (CSV,
    CSV.xz, MCAP)."""
    path = Path(path)
    name = path.name.lower()
    try:
        if name.endswith((".csv", ".csv.xz")):
            return _csv(path)
        with path.open("rb") as file:
            first = file.read(8)
        if first == mcap.MAGIC:
            return _mcap(path)
        if packed.is_packed(first):
            return _log(path, packed.unpacked(path))
        if first[:4] == event_log.SYNC:
            with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                return _log(path, data)
    except (ValueError, IndexError, KeyError, EOFError, lzma.LZMAError) as error:
        if isinstance(error, Unreadable):
            raise
        raise Unreadable(f"{path}: {error}") from error
    raise Unreadable(f"{path}: neither a session, a CSV nor an MCAP file; `amb import` reads others")


def _csv(path):
    with (lzma.open if path.name.lower().endswith(".xz") else open)(path, "rt", encoding="utf-8-sig") as file:
        names = [name.strip() for name in next(csv.reader([file.readline()]), [])]
        if "time_s" not in names:
            raise Unreadable(f"{path}: no column 'time_s'; `amb import --guess` looks at other names")
        rows = numpy.loadtxt(file, delimiter=",", ndmin=2)
    if rows.size == 0:
        rows = numpy.empty((0, len(names)))
    return Session(path, dict(zip(names, numpy.ascontiguousarray(rows.T), strict=True)))


def _mcap(path):
    topics, metadata = mcap.read(path.read_bytes())
    if "/levitas/cycle" not in topics:
        raise Unreadable(f"{path}: no topic /levitas/cycle; its topics: {', '.join(topics) or 'none'}")
    fields, cycles = topics["/levitas/cycle"]
    start_ns = cycles[0][0] if cycles else 0
    values = mcap.doubles([message for _, message in cycles]) if cycles else {}
    columns = {name: values.get(number, numpy.empty(0)) for number, name in fields.items()}
    if "time_s" not in columns:
        columns = {"time_s": numpy.array([(time - start_ns) / 1e9 for time, _ in cycles])} | columns
    _, events = topics.get("/levitas/event", ({}, []))
    texts = {f"{name}_yaml": metadata.get(name, "") for name in ("rig", "controller", "scenario")}
    return Session(path, columns, metadata | texts,
                   events=[((time - start_ns) / 1e9, dict(mcap.protobuf(message))[1].decode())
                           for time, message in events])


def _sound(payload):
    """A record's last field is the CRC-32 of its bytes with that field zero."""
    return zlib.crc32(b"\0\0\0\0", zlib.crc32(payload[:-4])) == int.from_bytes(payload[-4:], "big")


def _log(path, data):
    header, events, damaged = None, [], 0
    of_size = {}
    event_fields = messages.fields("event_t")
    for channel, payload in event_log.events(data):
        if channel == "LEVITAS_CYCLE":
            if _sound(payload):
                of_size.setdefault(len(payload), []).append(payload)
            else:
                damaged += 1
        elif channel == "LEVITAS_HEADER" and header is None and _sound(payload):
            header = messages.decode(messages.fields("session_header_t"), payload)
        elif channel == "LEVITAS_EVENT":
            try:
                event = messages.decode(event_fields, payload)
                events.append((event["time_ns"] / 1e9, event["text"]))
            except ValueError:  # events have no CRC
                damaged += 1
    if header is None:
        raise Unreadable(f"{path}: an LCM log without a header: no session of this program")
    records = _records(of_size)
    return Session(path, _columns(records, header), header, records=records, events=events,
                   damaged=damaged, seed=header["seed"], period_s=1e-9 * header["period_ns"],
                   start=datetime.datetime.fromtimestamp(1e-9 * header["start_utc_ns"],
                                                         datetime.timezone.utc))


def _records(of_size):
    """One array of all records, in the order of their cycles: those with coil currents when there are."""
    fields = messages.fields("cycle_record_t")
    known = messages.fingerprint(fields).to_bytes(messages.FINGERPRINT, "big")
    if any(payload[:messages.FINGERPRINT] != known for payloads in of_size.values() for payload in payloads[:1]):
        raise Unreadable("records of another version of this program; its own `amb export` reads them")
    parts = [numpy.frombuffer(b"".join(payloads), messages.layout(fields, payloads[0]))
             for payloads in of_size.values()]
    if not parts:
        return numpy.empty(0, messages.layout(fields, bytes(1024)))
    if len(parts) == 1:
        return _in_order(parts[0])
    most = max(parts, key=lambda part: part.dtype.itemsize)
    whole = numpy.zeros(sum(len(part) for part in parts), most.dtype)
    at = 0
    for part in parts:
        for name in part.dtype.names:
            if whole[name].shape[1:] == part[name].shape[1:]:
                whole[name][at:at + len(part)] = part[name]
        at += len(part)
    return _in_order(whole)


def _in_order(records):
    cycles = records["cycle"].astype("i8")
    return records if (numpy.diff(cycles) >= 0).all() else records[numpy.argsort(cycles, kind="stable")]


def _times(rows, header):
    """Of the samples, from 0 in real time; a rig that starts anew counts anew, and time runs on."""
    times = rows["sample_time_ns"].astype("i8")
    cycles = rows["cycle"].astype("i8")
    if len(times) and header["pace"] == "realtime":
        times = times - times[0]
    for at in numpy.flatnonzero(numpy.diff(rows["rig_session"].astype("i8"))) + 1:
        times[at:] += times[at - 1] + (cycles[at] - cycles[at - 1]) * header["period_ns"] - times[at]
    return times / 1e9


def _columns(records, header):
    rows = records[records["frame_present"] != 0]
    native = lambda values: numpy.ascontiguousarray(values, dtype=float)  # noqa: E731
    columns = {"time_s": _times(rows, header), "rotor_angle_rad": native(rows["angle_rad"]),
               "speed_rpm": native(rows["speed_rad_per_s"]) * (30.0 / numpy.pi)}
    for field, name in (("position_m", "position_{}_m"), ("control_current_a", "control_current_{}_a"),
                        ("excitation_a", "excitation_{}_a"), ("excitation_m", "excitation_{}_m")):
        if field == "excitation_m" and "point: measured_position" not in header["scenario_yaml"]:
            continue
        for axis, channel in enumerate(header["channel"]):
            columns[name.format(channel)] = native(rows[field][:, axis])
    coils = rows["coil_current_a"]
    if coils.shape[1]:
        for axis, channel in enumerate(header["channel"]):
            columns[f"coil_current_towards_{channel}_a"] = native(coils[:, 2 * axis])
            columns[f"coil_current_away_{channel}_a"] = native(coils[:, 2 * axis + 1])
    for name in ("mode", "fault", "saturated_axes", "missed_deadlines"):
        columns[name] = native(rows[name])
    return columns
