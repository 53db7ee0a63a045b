"""Programs of others on the installed library: installing it, building and running them."""

import os
import subprocess
from pathlib import Path

from waiting import LIMIT_S

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
BUILD = Path(os.environ["LEVITAS_BUILD"])
CMAKE = os.environ["CMAKE"]


def run(*words, **more):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False,
                          timeout=LIMIT_S, **more)


def must(*words, **more):
    done = run(*words, **more)
    if done.returncode != 0:
        raise AssertionError(" ".join(map(str, words)) + "\n" + done.stdout + done.stderr)
    return done.stdout


def install(prefix):
    """What a program is built with, and the examples; not the programs of the product."""
    must(CMAKE, "--install", BUILD, "--prefix", prefix, "--component", "development")


def build(source, folder, prefix, flags="-O1"):
    """Configures and builds the project `source` in `folder` against what lies under `prefix`."""
    must(CMAKE, "-G", "Ninja", "-S", source, "-B", folder, f"-DCMAKE_PREFIX_PATH={prefix}",
         f"-DCMAKE_CXX_FLAGS_RELEASE={flags}", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
    must(CMAKE, "--build", folder, "--parallel", "1")


def run_on(prefix, *words):
    """Runs a program with the rigs and controllers of the installation."""
    return run(*words, env={**os.environ, "LEVITAS_CONFIG": str(Path(prefix) / "share/levitas")})
