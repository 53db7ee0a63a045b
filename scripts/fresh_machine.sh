#!/usr/bin/env bash
# Proves that a fresh Debian 12 machine needs nothing but this repository: installs a minimal Debian
# into a folder (debootstrap), clones the repository into it, and runs there what a newcomer types.
#
#   sudo scripts/fresh_machine.sh FOLDER [COMMAND...]      default commands: "run" "test"
#
# FOLDER/base keeps the minimal system, so a second proof starts quickly; FOLDER/machine is made
# anew each time. Git and the certificates are there, because the clone needs them; nothing else.
# Only committed work is seen. Exit status: that of the first command that failed.
set -euo pipefail

repository=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
[ "$(id -u)" -eq 0 ] || { echo "fresh_machine: needs root (debootstrap, chroot)" >&2; exit 2; }
[ $# -ge 1 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
folder=$(readlink -m "$1")
shift
[ $# -gt 0 ] || set -- run test
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
git clone -q "$repository" "$machine/root/a clone/levitas"

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
      bash -c "cd \"/root/a clone/levitas\" && exec ./amb $2" </dev/null' inside "$machine" "$1"
}

for command in "$@"; do
  echo "== ./amb $command"
  started=$(date +%s)
  status=0
  inside "$command" || status=$?
  echo "== ./amb $command: status $status after $(($(date +%s) - started)) s"
  [ "$status" -eq 0 ] || exit "$status"
done
