#!/usr/bin/env bash
# Does work on the processor time that nothing else wants.
#
#   setsid scripts/aside.sh build asan-ubsan tests_unit >LOG 2>&1 &    a preset's targets
#   setsid scripts/aside.sh look >LOG 2>&1 &                           fuzz targets, then clang-tidy
#   setsid scripts/aside.sh both asan-ubsan tests_unit >LOG 2>&1 &     one after the other
#
# For work beside tests: a session of its own with the lowest weight, and the policy for idle
# processors, so that a test is preempted by nothing here. Where the system refuses a policy the
# command runs all the same, only less politely.
set -euo pipefail

root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
# shellcheck source=scripts/setup.sh
. "$root/scripts/setup.sh"

{ echo 19 >/proc/self/autogroup; } 2>/dev/null || true
chrt --idle --pid 0 $$ 2>/dev/null || renice -n 19 -p $$ >/dev/null 2>&1 || true

build() { configure "$1" && build_preset "$@"; }
look() {
  local status=0
  (build fuzz fuzzers) || status=1  # clang-tidy names its own all the same
  build tidy lcmtypes_generate
  say "clang-tidy"
  python3 "$root/scripts/tidy.py" --jobs "$(job_count)" || status=1
  return "$status"
}
# The status of the build is in a file as soon as it is known: who needs only what was built does not
# wait for the look.
both() {
  local status=0 told=$build_root/amb-aside-build.status
  (build "$@") || status=$?
  echo "$status" >"$told.new" && mv "$told.new" "$told"
  look
}
"$@"
