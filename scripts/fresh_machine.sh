#!/usr/bin/env bash
# Proves that a fresh Debian 12 machine needs nothing but this repository: installs a minimal Debian
# into a folder (debootstrap), clones the repository into it, and runs there what a newcomer types.
#
#   sudo scripts/fresh_machine.sh FOLDER [COMMAND...]      default commands: "run" "test"
#   sudo scripts/fresh_machine.sh --package FILE.deb FOLDER [COMMAND...]    default: "run"
#                                                          installed with apt, without a clone
#
# FOLDER/base keeps the minimal system, so a second proof starts quickly; FOLDER/machine is made
# anew each time. Git and the certificates are there, because the clone needs them; nothing else.
# Only committed work is seen. Exit status: that of the first command that failed.
set -euo pipefail

repository=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
[ "$(id -u)" -eq 0 ] || { echo "fresh_machine: needs root (debootstrap, chroot)" >&2; exit 2; }
package=""
if [ "${1:-}" = --package ]; then
  package=$(readlink -f "${2:-}") && [ -f "$package" ] || { echo "fresh_machine: no package '${2:-}'" >&2; exit 2; }
  shift 2
fi
[ $# -ge 1 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0" >&2; exit 2; }
folder=$(readlink -m "$1")
shift
if [ $# -eq 0 ]; then
  if [ -n "$package" ]; then set -- run; else set -- run test; fi
fi
mirror=${LEVITAS_DEBIAN_MIRROR:-http://deb.debian.org/debian}

if [ ! -e "$folder/base/.complete" ]; then
  rm -rf "$folder/base"
  mkdir -p "$folder"
  debootstrap --variant=minbase --include=ca-certificates,git bookworm "$folder/base" "$mirror" \
    >"$folder/debootstrap.log" 2>&1 || { tail -n 3 "$folder/debootstrap.log" >&2; exit 1; }
  touch "$folder/base/.complete"
fi

machine=$folder/machine
rm -rf "$machine"
cp -a "$folder/base" "$machine"
cp /etc/resolv.conf "$machine/etc/resolv.conf"
# A folder with a space: the launcher must not mind.
mkdir -p "$machine/root/a clone/levitas"
amb=./amb
if [ -n "$package" ]; then
  cp "$package" "$machine/root/levitas.deb"
  amb=amb
else
  git clone -q "$repository" "$machine/root/a clone/levitas"
fi

# A mount and process namespace of its own: what is left running or mounted ends with it.
inside() {
  unshare --mount --pid --fork --kill-child bash -euc '
    machine=$1
    mount --make-rprivate /
    mount -t proc proc "$machine/proc"
    mount --rbind /sys "$machine/sys"
    mount --rbind /dev "$machine/dev"
    exec chroot "$machine" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 \
      PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
      bash -c "cd \"/root/a clone/levitas\" && $2" </dev/null' inside "$machine" "$1"
}

if [ -n "$package" ]; then
  inside 'apt-get -qq update && apt-get -qq install -y --no-install-recommends /root/levitas.deb >/dev/null 2>&1' ||
    { echo "fresh_machine: the package does not install" >&2; exit 1; }
fi

for command in "$@"; do
  echo "== $amb $command"
  started=$(date +%s)
  status=0
  inside "exec $amb $command" || status=$?
  echo "== $amb $command: status $status after $(($(date +%s) - started)) s"
  [ "$status" -eq 0 ] || exit "$status"
done
