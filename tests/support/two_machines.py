"""A second machine beside the test's own: a network namespace joined to it by a cable (veth).

The test's namespace (lcm_network.run) becomes an ordinary machine: an address of a local network and
a default route through it, no route of its own for multicast.
"""

import json
import os
import shutil
import subprocess
import sys

from lcm_network import GROUP, UNSHARE, Process
from waiting import LIMIT_S, until

OWN, OTHER = "10.77.0.1", "10.77.0.2"

SEND = """
import json, socket, sys, time
group, datagrams, times = json.load(sys.stdin)
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 1)
for _ in range(times):
    for port, data in datagrams:
        out.sendto(bytes.fromhex(data), (group, port))
    time.sleep(0.002)
"""

# Prints, one a line, what arrives on the port until it is killed.
LISTEN = """
import socket, struct, sys
group, port, own = sys.argv[1], int(sys.argv[2]), sys.argv[3]
into = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
into.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
into.bind((group, port))
into.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                socket.inet_aton(group) + socket.inet_aton(own))
print("listening", flush=True)
while True:
    print(into.recv(65536).hex(), flush=True)
"""


def sh(script):
    subprocess.run(["sh", "-ec", script], check=True, timeout=LIMIT_S, capture_output=True)


class OtherMachine:
    """Lives until close(); needs the namespace of lcm_network.run around it."""

    def __init__(self):
        self.holder = subprocess.Popen(["unshare", "-n", "sleep", "infinity"])
        pid = self.holder.pid
        own = os.readlink("/proc/self/ns/net")
        until(lambda: os.readlink(f"/proc/{pid}/ns/net") != own, "a network of the other machine",
              running=lambda: self.holder.poll() is None)
        sh("ip route flush root 224.0.0.0/4;"
           f"ip link add vA type veth peer name vB; ip link set vB netns {pid};"
           f"ip address add {OWN}/24 dev vA; ip link set vA up")
        self.sh(f"ip link set lo up; ip address add {OTHER}/24 dev vB; ip link set vB up;"
                f"ip route add default via {OWN}")
        sh(f"ip route add default via {OTHER}")

    def close(self):
        subprocess.run(["ip", "link", "delete", "vA"], check=False, capture_output=True)
        self.holder.kill()
        self.holder.wait()

    def command(self, *arguments):
        return [shutil.which("nsenter"), "-n", f"-t{self.holder.pid}", *map(str, arguments)]

    def sh(self, script):
        subprocess.run(self.command("sh", "-ec", script), check=True, timeout=LIMIT_S,
                       capture_output=True)

    def send(self, datagrams, times=20):
        """(port, bytes) to the group, as often as asked for."""
        subprocess.run(self.command(sys.executable, "-c", SEND), check=True, timeout=LIMIT_S, text=True,
                       input=json.dumps([GROUP, [(port, data.hex()) for port, data in datagrams],
                                         times]))

    def listen(self, folder, port):
        """A process that prints, in hexadecimal, what it hears; the caller kills it."""
        listener = Process(folder, *self.command(sys.executable, "-c", LISTEN, GROUP, port, OTHER))
        listener.says("listening\n")
        return listener


def possible():
    """Whether this machine lets a namespace be joined to another."""
    script = ("own() { readlink /proc/$1/ns/net; }; unshare -n sleep infinity & "
              "while [ \"$(own $!)\" = \"$(own self)\" ]; do kill -0 $! || exit 1; done; "
              "ip link add vA type veth peer name vB && ip link set vB netns $! && "
              "nsenter -n -t$! true; status=$?; kill $!; exit $status")
    return subprocess.run([*UNSHARE, "sh", "-c", script], capture_output=True,
                          check=False).returncode == 0
