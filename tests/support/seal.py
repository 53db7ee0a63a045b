"""The trailer of a network with a key, written from docs/dashboard.md with Python's own BLAKE2b."""

import hashlib
import os
import struct
import time
from pathlib import Path

from lcm_network import GROUP


def new_key(path):
    """A key file; returns the key."""
    key = os.urandom(32)
    with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT, 0o600), "w") as file:
        file.write(key.hex() + "\n")
    return key


def read_key(path):
    return bytes.fromhex(Path(path).read_text().strip())


def mac(key, data):
    return hashlib.blake2b(data, digest_size=16, key=key).digest()


class Sealer:
    def __init__(self, key):
        self.key, self.sender, self.number = key, os.urandom(8), 0

    def seal(self, datagram, port, challenge=None, group=GROUP):
        name = f"levitas network key 1 {group}:{port}"
        key = mac(self.key, f"{name} a".encode()) + mac(self.key, f"{name} b".encode())
        self.number += 1
        fresh = time.time_ns() if challenge is None else challenge
        sealed = (datagram + b"LKY2" + self.sender + struct.pack(">QQ", self.number, fresh))
        return sealed + mac(key, sealed)
