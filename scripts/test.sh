# Sourced by ./amb: builds and runs the tests.
#
#   run_tests                 every label of preset release, without what is long
#   run_tests unit loop       these labels, with what is long
#   run_tests long            what is long: minutes for what another test has in small
#   run_tests -R Pid          single tests by name; whatever ctest understands
#   run_tests --all           what CI runs: besides, clang-tidy, ASan+UBSan, and fuzzing for a minute each
#   run_tests --tsan          parts with threads, and the processes, under the thread sanitizer
#   run_tests --help          says the above

test_labels="unit loop replay process hardware build"
more_labels="long"  # on tests that bear one of the others, too
# Unit tests of the parts that start threads or are shared between them.
threaded_tests="common_test session_log_test session_exchange_test transport_test loop_test rt_test doctor_test gpio_test diagnosis_model_test diagnosis_inference_test dashboard_test"

left_out=()  # names of tests that were not run, of every preset so far

# The names of the tests of a preset that were skipped: entries of ctest, and single tests of a program
# that went on without them.
skipped_in() {
  sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .*\*\*\*Skipped.*/\1/p' "$build_root/amb-test-$1.log"
  sed -nE 's/^\[  SKIPPED \] ([^ ]+)$/\1/p' "$build_root/$1/Testing/Temporary/LastTest.log" 2>/dev/null | sort -u
}

# How many single tests the programs of a preset have run: "3218 tests in 63 programs".
counted_in() {
  awk '/^\[==========\] [0-9]+ tests? from .* ran\./ { tests += $2; programs++ }
       /^Ran [0-9]+ tests? in / { tests += $2; programs++ }
       END { printf "%d tests in %d programs\n", tests, programs }' "$build_root/$1/Testing/Temporary/LastTest.log"
}

# What would run a test that was not run.
remedy_of() {
  case $2 in
    process.dashboard.*) echo "./amb test --all runs it: it installs Chromium (packages-browser.txt)" ;;
    process.python_package | process.python_controller) echo "./amb test --all runs it: it installs numpy (packages-ci.txt)" ;;
    process.notebooks) echo "./amb test --all runs it: it installs nbclient and ipykernel (packages-notebooks.txt)" ;;
    build.*) echo "./amb test --all runs it: it installs what it needs (packages-ci.txt, packages-deb.txt)" ;;
    hardware.*) echo "./amb test hardware runs it, where it can have a kernel for it (CONTRIBUTING.md)" ;;
    *) echo "ctest --test-dir build/$1 -R '$2' -V says what it lacks" ;;
  esac
}

# test_count PRESET: tests at a time. LEVITAS_JOBS, else two per core, for those of several processes
# wait most of the time; under a sanitizer they compute more, and three for two cores are enough.
test_count() {
  local jobs
  jobs=$(job_count) || exit 1
  if [ "$1" = release ]; then jobs=$((2 * jobs)); else jobs=$(((3 * jobs + 1) / 2)); fi
  echo "${LEVITAS_JOBS:-$jobs}"
}

# ctest_preset PRESET ARGUMENT...: one line of progress, then ctest's own closing lines.
ctest_preset() {
  local preset=$1 log=$build_root/amb-test-$1.log line status=0 jobs
  jobs=$(test_count "$preset") || exit 1
  shift
  local pattern='^ *([0-9]+/[0-9]+) Test +#[0-9]+: ([^ ]+)'
  say "testing preset $preset"
  "${under[@]}" ctest --test-dir "$build_root/$preset" -j "$jobs" --output-on-failure \
        --no-tests=error "$@" 2>&1 | tee "$log" | while IFS= read -r line; do
    if [[ $line =~ $pattern ]]; then progress "testing ${BASH_REMATCH[1]} ${BASH_REMATCH[2]}"; fi
  done || status=$?
  progress_end
  # From the closing line on: the share that passed, what did not run, what failed, times.
  sed -n '/% tests passed/,$p' "$log"
  [ ! -f "$build_root/$preset/Testing/Temporary/LastTest.log" ] || say "$(counted_in "$preset")"
  local name
  while IFS= read -r name; do
    say "not run: $name. $(remedy_of "$preset" "$name")"
    left_out+=("$name")
  done < <(skipped_in "$preset")
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
# (CONTRIBUTING.md). Where neither is possible they are named as not run; nothing else stops.
machine_missing() { ! "$root/scripts/test_machine.sh" kernel >/dev/null 2>&1; }
build_machine() {
  "$root/scripts/test_machine.sh" build >/dev/null ||
    say "hardware tests will not run: no vcan and gpio-sim here, and no kernel that has them"
}

# prepare_whole LABEL... : the tests of these labels in preset release. The kernel of the test machine
# is compiled beside them: it fills the cores where our compiler waits for one long source.
prepare_whole() {
  local kernel=""
  if [[ " $* " =~ \ (hardware|long)\  ]] && machine_missing; then
    take_lock
    if (install_packages "$root/packages.txt" "${ci_packages[@]}" "$root/packages-machine.txt"); then
      build_machine 9>&- &
      kernel=$!
    else
      say "hardware tests will not run: their packages could not be installed"
    fi
    release_lock
  fi
  prepare_preset release "${@/#/tests_}"
  [ -z "$kernel" ] || wait "$kernel"
}

run_tsan() {
  local ci_packages=()
  # The thread sanitizer of GCC 12 does not know the wider address randomisation of newer kernels.
  if setarch --addr-no-randomize true 2>/dev/null; then under=(setarch --addr-no-randomize); fi
  # Only what has threads: elsewhere the thread sanitizer has nothing to see.
  # shellcheck disable=SC2086 -- one word per target is meant
  prepare_preset tsan $threaded_tests tests_process
  ctest_preset tsan -L '^(unit|process)$' -R "^(unit[.](${threaded_tests// /|})|process[.].*)\$"
}

aside_pid="" aside_log=""

# aside STEP ARGUMENT...: begins it on processor time that the tests leave (scripts/aside.sh).
aside() {
  aside_log=$build_root/amb-aside-$1.log
  setsid "$root/scripts/aside.sh" "$@" >"$aside_log" 2>&1 &
  aside_pid=$!
  trap 'kill -- "-$aside_pid" 2>/dev/null || true' EXIT
  trap 'exit 130' INT TERM
}

# Waits until what is built aside is built, and returns the status of that.
await_build_aside() {
  local told=$build_root/amb-aside-build.status
  until [ -f "$told" ]; do
    kill -0 "$aside_pid" 2>/dev/null || return 1
    sleep 1
  done
  return "$(cat "$told")"
}

# Waits for it, prints what it said, and returns its status.
end_aside() {
  local status=0
  wait "$aside_pid" || status=$?
  trap - EXIT INT TERM
  cat "$aside_log" >&2
  return "$status"
}

# Every stage runs even when an earlier one failed, so that one run names everything. Tests wait as
# often as they compute: what is compiled and looked at next is done beside them.
run_all() {
  local failed=() ci_packages=("$root/packages-ci.txt" "$root/packages-deb.txt" "$root/packages-browser.txt"
    "$root/packages-notebooks.txt")
  SECONDS=0
  # shellcheck disable=SC2086 -- one word per label is meant
  prepare_whole $test_labels
  say "built after $SECONDS s"
  rm -f "$build_root/amb-aside-build.status"
  aside both asan-ubsan tests_unit tests_loop tests_replay tests_process
  # Three minutes of the page's memory; its other tests need no number.
  LEVITAS_PAGE_SECONDS=180 ctest_preset release -L "^(${test_labels// /|})\$" || failed+=("release tests")
  say "release tested after $SECONDS s"
  local sanitized=yes
  await_build_aside || { sanitized="" failed+=("asan-ubsan build"); }
  say "asan-ubsan built after $SECONDS s"
  # A sanitizer keeps what is freed: its memory says nothing about the program's. A library loaded before
  # it, as in blind_run, is not supported by it. What is long runs the code of a shorter test on more
  # data: preset release has run it, a sanitizer would see nothing new in three times as long.
  [ -z "$sanitized" ] || ctest_preset asan-ubsan -L '^(unit|loop|replay|process)$' -LE '^long$' \
    -E '^process\.(dashboard\.memory|blind_run|notebooks)$' || failed+=("asan-ubsan tests")
  say "asan-ubsan tested after $SECONDS s"
  end_aside || failed+=("clang-tidy or the build for fuzzing")
  say "looked at after $SECONDS s"
  say "fuzzing"
  python3 -B "$root/tests/fuzz/run.py" "$build_root/fuzz/fuzzers" --seconds 60 --jobs "$(job_count)" \
    fuzz_message fuzz_session fuzz_csv fuzz_mat fuzz_candump fuzz_http fuzz_yaml || failed+=("fuzzing")
  close_all
}

# The last word of run_all. The page's tests were given their browser, the notebooks their runner and
# the Python package its numpy: not run is failed.
close_all() {
  local name
  for name in "${left_out[@]}"; do
    [[ $name != process.dashboard.* && $name != process.notebooks && $name != process.python_* ]] || failed+=("$name was not run")
  done
  if [ ${#failed[@]} -ne 0 ]; then
    say "failed: $(IFS=,; echo "${failed[*]}")"
    return 1
  fi
  if [ ${#left_out[@]} -ne 0 ]; then
    say "passed after $SECONDS s, but not run: $(printf '%s\n' "${left_out[@]}" | sort -u | tr '\n' ' ')"
    return
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
./amb test               every test of preset release but the long ones
./amb test LABEL...      unit, loop, replay, process, hardware, build, with the long ones among them
./amb test long          the long ones: minutes for what another test has in small
./amb test -R Pid        single tests by name; whatever ctest understands
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
  local labels=() ci_packages=() started=$SECONDS
  while [ $# -gt 0 ] && [[ $1 != -* ]]; do
    [[ " $test_labels $more_labels " == *" $1 "* ]] ||
      { say "no test label '$1'; labels: $test_labels $more_labels"; return 2; }
    labels+=("$1")
    shift
  done
  # What was asked for by a label or by name is run, however long it takes.
  local without=()
  [ ${#labels[@]} -ne 0 ] || [ $# -ne 0 ] || without=(-LE '^long$')
  # shellcheck disable=SC2206 -- one word per label is meant
  [ ${#labels[@]} -ne 0 ] || labels=($test_labels)
  local selection="(${labels[*]})"
  # What ctest is asked to choose by name, it chooses among the single tests of the programs, too.
  [ $# -eq 0 ] || selection="(single[.])?$selection"
  prepare_whole "${labels[@]}"
  say "built after $((SECONDS - started)) s"
  local status=0
  ctest_preset release -L "^${selection// /|}\$" "${without[@]}" "$@" || status=$?
  [ ${#without[@]} -eq 0 ] || say_long
  return "$status"
}

# Names what a run without arguments left out.
say_long() {
  local names
  mapfile -t names < <(ctest --test-dir "$build_root/release" -N -L '^long$' | sed -nE 's/^ *Test +#[0-9]+: //p')
  say "not run: ${#names[@]} long tests (${names[*]}). ./amb test long runs them"
}
