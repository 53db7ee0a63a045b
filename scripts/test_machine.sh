#!/usr/bin/env bash
# A machine with CAN, GPIO lines and virtual time for the tests (CONTRIBUTING.md).
#
#   scripts/test_machine.sh build                    builds its kernel once; prints the path
#   scripts/test_machine.sh kernel                   prints the path; status 1: not built
#   scripts/test_machine.sh host                     status 0: this kernel has vcan and gpio-sim
#   scripts/test_machine.sh run [OPTION] COMMAND...  boots it and runs COMMAND inside, as root
#   scripts/test_machine.sh test [OPTION] COMMAND... on this kernel if it can, else inside
#
# Options   --real-time     inside, time is the host's instead of virtual
#           --only-virtual  never on this kernel: the command asserts instants
# Inside    the host's files; /tmp and /dev/shm are empty and forgotten; the loopback has a
#           multicast route. The working directory and LEVITAS_* variables are handed in;
#           LEVITAS_TEST_MACHINE says virtual, real or host.
# Status    that of COMMAND; 77: it could not be run, and the last line says why.
# Limit     LEVITAS_MACHINE_SECONDS (1500) of the host's time, then the machine is killed: 124.
set -euo pipefail

scripts=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
config=$scripts/test_machine/kernel.config
cache=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/levitas
source_archive=$(ls /usr/src/linux-source-6.*.tar.xz 2>/dev/null | tail -n 1 || true)

say() { printf 'test machine: %s\n' "$*" >&2; }
not_run() { say "not run: $*"; exit 77; }

key() { grep -E '^CONFIG' "$config" | sha256sum | cut -c 1-16; }

# The newest kernel built from this configuration, whatever the version of its source.
kernel() { ls -t "$cache/uml-$(key)"-*/linux 2>/dev/null | head -n 1 | grep .; }

# Everything but the code of devices that the machine does not have: a third of the archive.
unpack() {
  tar -C "$1" -xf "$source_archive" --strip-components=1 \
    --exclude='*/drivers/gpu/*.[ch]' --exclude='*/drivers/media/*.[ch]' \
    --exclude='*/drivers/net/ethernet/*.[ch]' --exclude='*/drivers/net/wireless/*.[ch]' \
    --exclude='*/drivers/staging/*.[ch]' --exclude='*/sound/*.[ch]' --exclude='*/Documentation/*.rst'
}

compile() {
  local tree=$1 out=$2 missing
  make -C "$tree" ARCH=um O="$out" KCONFIG_ALLCONFIG="$config" allnoconfig
  # Kconfig drops without a word what it does not know or what depends on something that is off.
  missing=$(grep -E '^CONFIG' "$config" | grep -vxFf "$out/.config") &&
    { echo "not taken by the configuration: $missing"; return 1; }
  nice make -C "$tree" ARCH=um O="$out" -j "${LEVITAS_JOBS:-$(nproc)}" linux
}

# The release of the source is part of the name: another one stands beside it, none is replaced.
build() {
  local work release target log=$cache/kernel-build.log
  mkdir -p "$cache"
  exec 8>"$cache/.kernel.lock"
  flock 8
  kernel && return
  [ -n "$source_archive" ] || { say "no kernel source: apt-get install linux-source-6.1"; return 1; }
  say "building its kernel, once (about 5 minutes on two cores; log $log)"
  work=$(mktemp -d "$cache/build.XXXXXX")
  # shellcheck disable=SC2064 -- the folder of now is meant
  trap "rm -rf '$work'" EXIT
  mkdir "$work/tree" "$work/out"
  { unpack "$work/tree" && compile "$work/tree" "$work/out"; } >"$log" 2>&1 8>&- ||
    { grep -E -m 3 'rror|not taken|No space' "$log" >&2; say "the kernel was not built: $log"; return 1; }
  release=$(cat "$work/out/include/config/kernel.release")
  target=$cache/uml-$(key)-$release
  mkdir -p "$target"
  strip -o "$work/linux" "$work/out/linux"
  mv "$work/linux" "$target/linux"
  kernel
}

# The tests need all of it; a kernel with half of it is treated as one without.
host() {
  [ "$(id -u)" -eq 0 ] || return 1
  unshare -n ip link add dev vcan0 type vcan 2>/dev/null || return 1
  [ -d /sys/kernel/config ] && modprobe -q gpio-sim 2>/dev/null
  [ -d /sys/kernel/config/gpio-sim ]
}

on_host() {
  export LEVITAS_TEST_MACHINE=host
  # shellcheck disable=SC2016 -- expanded by the inner shell
  exec unshare -n sh -c 'ip link set lo up; ip route add 224.0.0.0/4 dev lo; exec "$@"' sh "$@"
}

# The processes of a killed machine are traced ones, which go on without their tracer: by the name of
# this machine's own folder in their command line.
kill_left() {
  local file process
  for file in $(grep -lsF "init=$1/init" /proc/[0-9]*/cmdline); do
    process=${file#/proc/}
    kill -KILL "${process%/cmdline}" 2>/dev/null || true
  done
}

# The machine's first process. What is written to the console comes out of run; the last line of
# it is the status.
write_init() {
  local init=$1 name
  shift
  {
    echo '#!/bin/bash'
    echo 'export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp'
    for name in $(compgen -e | grep -E '^(LEVITAS_|GTEST_|AMB_)'); do
      printf 'export %s=%q\n' "$name" "${!name}"
    done
    printf 'export LANG=C.UTF-8 LEVITAS_TEST_MACHINE=%q\n' "$time"
    printf 'export LEVITAS_REPOSITORY=%q\n' "$(dirname "$scripts")"
    cat "$scripts/test_machine/prepare.sh"
    printf 'cd %q\n' "$PWD"
    printf '%q ' "$@"
    printf '</dev/null\n'
    cat "$scripts/test_machine/finish.sh"
  } >"$init"
  chmod +x "$init"
}

run() {
  local linux scratch option="" status=""
  linux=$(kernel) || not_run "its kernel is not built; './amb test hardware' builds it"
  [ "$time" = real ] || option=time-travel=inf-cpu
  scratch=$(mktemp -d /tmp/levitas-machine.XXXXXX)
  # shellcheck disable=SC2064
  trap "kill_left '$scratch'; rm -rf '$scratch'" EXIT
  write_init "$scratch/init" "$@"
  # shellcheck disable=SC2086 -- no option is no word
  # What a killed machine leaves behind holds the pipe open, for good: it goes before awk has to end.
  {
    TMPDIR=$scratch timeout -k 2 "${LEVITAS_MACHINE_SECONDS:-1500}" \
      "$linux" mem="${LEVITAS_MACHINE_MEMORY:-512M}" rootfstype=hostfs rootflags=/ rw init="$scratch/init" \
      con=null con0=fd:0,fd:1 uml_dir="$scratch/" quiet $option </dev/null 2>"$scratch/kernel" || true
    kill_left "$scratch"
  } |
    awk -v kept="$scratch/status" '
      { sub(/\r$/, "") }
      /^levitas-test-machine: status [0-9]+$/ { print $3 > kept; exit }
      { print; fflush() }' || true
  status=$(cat "$scratch/status" 2>/dev/null || true)
  if [ -z "$status" ]; then
    tail -n 5 "$scratch/kernel" >&2
    say "the machine ended without a status (killed after ${LEVITAS_MACHINE_SECONDS:-1500} s?)"
    exit 124
  fi
  exit "$status"
}

action=${1:-}
[ $# -eq 0 ] || shift
time=virtual
only_virtual=""
while [[ ${1:-} == --* ]]; do
  case $1 in
    --real-time) time=real ;;
    --only-virtual) only_virtual=yes ;;
    *) say "unknown option $1"; exit 2 ;;
  esac
  shift
done
case $action in
  build | kernel | host) "$action" ;;
  run | test)
    [ $# -gt 0 ] || { say "$action: no command"; exit 2; }
    if [ "$action" = test ] && [ -z "$only_virtual" ] && host; then on_host "$@"; fi
    run "$@"
    ;;
  *) sed -n '2,18s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
