# Sourced by ./amb: builds and runs the tests.
#
#   run_tests                 every label of preset release
#   run_tests unit loop       these labels
#   run_tests -R Pid          whatever ctest understands
#   run_tests --all           what CI runs: besides, clang-tidy, ASan+UBSan, and fuzzing for a minute each
#   run_tests --tsan          parts with threads, and the processes, under the thread sanitizer
#   run_tests --help          says the above

test_labels="unit loop replay process hardware build"
# Unit tests of the parts that start threads or are shared between them.
threaded_tests="common_test session_test transport_test loop_test rt_test doctor_test gpio_test diagnosis_unit_test dashboard_test"

# ctest_preset PRESET ARGUMENT...: one line of progress, then ctest's own closing lines.
ctest_preset() {
  local preset=$1 log=$build_root/amb-test-$1.log line status=0
  shift
  local pattern='^ *([0-9]+/[0-9]+) Test +#[0-9]+: ([^ ]+)'
  say "testing preset $preset"
  "${under[@]}" ctest --test-dir "$build_root/$preset" -j "${LEVITAS_JOBS:-2}" --output-on-failure \
        --no-tests=error "$@" 2>&1 | tee "$log" | while IFS= read -r line; do
    if [[ $line =~ $pattern ]]; then progress "testing ${BASH_REMATCH[1]} ${BASH_REMATCH[2]}"; fi
  done || status=$?
  progress_end
  # From the closing line on: the share that passed, what did not run, what failed, times.
  sed -n '/% tests passed/,$p' "$log"
  if [ "$status" -ne 0 ]; then
    said_by_failed "$log"
    grep -q '% tests passed' "$log" || tail -n 5 "$log"
    say "tests failed in preset $preset; what they printed is in $log"
  fi
  return "$status"
}

# The first lines that each failed test printed, for a machine whose logs nobody can open.
said_by_failed() {
  awk '/^ *[0-9]+\/[0-9]+ Test +#/ { left = /\*\*\*/ ? 60 : 0 }
       /^ +Start +[0-9]+:/ { next }
       /% tests passed/ { exit }
       left > 0 { print substr($0, 1, 300); left-- }' "$1"
}

# prepare_preset PRESET [TARGET...]
prepare_preset() {
  take_lock
  install_packages "$root/packages.txt" "${ci_packages[@]}"
  configure "$1"
  build_preset "$@"
  release_lock
}

# Hardware tests need vcan and gpio-sim: of this kernel, or of a machine whose kernel is built once
# (docs/test_machine.md). Where neither is possible they are named as not run; nothing else stops.
prepare_machine() {
  local machine=$root/scripts/test_machine.sh
  if "$machine" kernel >/dev/null 2>&1; then return; fi
  if ! (install_packages "$root/packages.txt" "$root/packages-machine.txt") || ! "$machine" build >/dev/null; then
    say "hardware tests will not run: no vcan and gpio-sim here, and no kernel that has them"
  fi
}

run_tsan() {
  local ci_packages=()
  # The thread sanitizer of GCC 12 does not know the wider address randomisation of newer kernels.
  if setarch --addr-no-randomize true 2>/dev/null; then under=(setarch --addr-no-randomize); fi
  # Only what has threads: elsewhere the thread sanitizer has nothing to see.
  # shellcheck disable=SC2086 -- one word per target is meant
  prepare_preset tsan $threaded_tests tests_process
  ctest_preset tsan -L '^(unit|process)$' -E '_NOT_BUILT$'
}

# Every stage runs even when an earlier one failed, so that one run names everything.
run_all() {
  local failed=() ci_packages=("$root/packages-ci.txt" "$root/packages-deb.txt")
  SECONDS=0
  prepare_preset release
  prepare_machine
  say "built after $SECONDS s"
  ctest_preset release || failed+=("release tests")
  say "release tested after $SECONDS s"
  prepare_preset asan-ubsan
  say "asan-ubsan built after $SECONDS s"
  ctest_preset asan-ubsan -L '^(unit|loop|replay|process)$' || failed+=("asan-ubsan tests")
  say "asan-ubsan tested after $SECONDS s"
  prepare_preset fuzz fuzzers
  say "fuzzing"
  python3 -B "$root/tests/fuzz/run.py" "$build_root/fuzz/fuzzers" --seconds 60 --jobs "$(job_count)" \
    fuzz_message fuzz_session fuzz_csv fuzz_mat fuzz_candump fuzz_http fuzz_yaml || failed+=("fuzzing")
  say "fuzzed after $SECONDS s"
  prepare_preset tidy lcmtypes_generate
  say "clang-tidy"
  python3 "$root/scripts/tidy.py" --jobs "$(job_count)" || failed+=("clang-tidy")
  if [ ${#failed[@]} -ne 0 ]; then
    say "failed: $(IFS=,; echo "${failed[*]}")"
    return 1
  fi
  say "everything passed after $SECONDS s"
}

run_tests() {
  if [ "${1:-}" = --tsan ]; then
    [ $# -eq 1 ] || { say "./amb test --tsan takes nothing else"; return 2; }
    run_tsan
    return
  fi
  if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
    cat <<'USAGE'
./amb test               every test of preset release
./amb test LABEL...      unit, loop, replay, process, hardware, build
./amb test -R Pid        whatever ctest understands
./amb test --tsan        what has threads, under the thread sanitizer
./amb test --all         what CI runs: besides, clang-tidy, ASan+UBSan, and fuzzing for a minute each
USAGE
    return
  fi
  if [ "${1:-}" = --all ]; then
    [ $# -eq 1 ] || { say "./amb test --all takes nothing else"; return 2; }
    run_all
    return
  fi
  local labels=() whole="" ci_packages=()
  [ $# -gt 0 ] || whole=yes
  while [ $# -gt 0 ] && [[ $1 != -* ]]; do
    [[ " $test_labels " == *" $1 "* ]] || { say "no test label '$1'; labels: $test_labels"; return 2; }
    labels+=("$1")
    shift
  done
  local selection=()
  [ ${#labels[@]} -eq 0 ] || selection=(-L "^($(IFS='|'; echo "${labels[*]}"))\$")
  prepare_preset release "${labels[@]/#/tests_}"
  if [ -n "$whole" ] || [[ " ${labels[*]} " == *" hardware "* ]]; then prepare_machine; fi
  ctest_preset release "${selection[@]}" "$@"
}
