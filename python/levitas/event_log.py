"""Events of an LCM event log: sync word, number, time, lengths, channel, data; big-endian.

A damaged event is left by looking for the next sync word behind its own, as the programs do.
"""

import struct

SYNC = b"\xed\xa1\xda\x01"
HEAD = struct.Struct(">4sqqii")
MOST_CHANNEL, MOST_DATA = 128, 1 << 24


def events(data):
    """(channel, payload) of every event that is whole; `data` is bytes or a memory map."""
    at = 0
    while True:
        at = data.find(SYNC, at)
        if at < 0 or at + HEAD.size > len(data):
            return
        _, _, _, channel_size, data_size = HEAD.unpack_from(data, at)
        start = at + HEAD.size + channel_size
        if not (0 < channel_size <= MOST_CHANNEL and 0 <= data_size <= MOST_DATA
                and start + data_size <= len(data)):
            at += len(SYNC)
            continue
        channel = bytes(data[at + HEAD.size:start])
        if not channel.startswith(b"LEVITAS_"):
            at += len(SYNC)
            continue
        yield channel.decode("ascii", "replace"), data[start:start + data_size]
        at = start + data_size
