# Sourced by ./amb: installs what is missing, configures and builds, quietly.
#
# Expects   $root (absolute path of the repository).
# Messages  to stderr, so that `./amb ... > file` holds only what the command printed.
# Repeats   everything here may be interrupted and started again, or started twice at once:
#           one lock serialises, and each step leaves its stamp only when it has finished.

build_root=$root/build
# The compiler's cache serves every clone on a machine, wherever it lies.
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root} CCACHE_NOHASHDIR=1
under=()  # what ninja runs under; the thread sanitizer needs a wrapper

say() { printf 'amb: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

# One line that overwrites itself on a terminal; nothing elsewhere.
progress() { if [ -t 2 ]; then printf '\r\033[Kamb: %s' "$*" >&2; fi; }
progress_end() { if [ -t 2 ]; then printf '\r\033[K' >&2; fi; }

# Jobs: LEVITAS_JOBS, else one per core, but no more than one per 1.5 GB of memory (the compiler
# needs about 1 GB on the files that use Eigen).
job_count() {
  if [ -n "${LEVITAS_JOBS:-}" ]; then
    [[ $LEVITAS_JOBS =~ ^[1-9][0-9]*$ ]] || die "LEVITAS_JOBS = '$LEVITAS_JOBS': expected a whole number from 1"
    echo "$LEVITAS_JOBS"
    return
  fi
  local cores memory_kb
  cores=$(nproc)
  memory_kb=$(awk '/^MemAvailable/ {print $2}' /proc/meminfo 2>/dev/null || true)
  local fits=$(( ${memory_kb:-3000000} / 1500000 ))
  [ "$fits" -ge 1 ] || fits=1
  echo $(( fits < cores ? fits : cores ))
}

# Holds the lock on descriptor 9 until release_lock; a second ./amb waits here.
take_lock() {
  mkdir -p "$build_root" || die "cannot write $build_root"
  exec 9>"$build_root/.amb.lock"
  flock -n 9 || { say "waiting for another ./amb that is building here"; flock 9; }
}
release_lock() { exec 9>&-; }

# Names in the given lists of packages that are not installed, one per line.
missing_packages() {
  local wanted
  wanted=$(sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$@" | sort -u)
  # shellcheck disable=SC2086 -- one word per package is meant
  comm -23 <(echo "$wanted") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
        sed -n 's/^installed //p' | sort -u)
}

install_packages() {
  command -v dpkg-query >/dev/null || {
    command -v ninja >/dev/null ||
      die "this is not a Debian system: install what packages.txt names, then run ./amb again"
    return 0
  }
  local missing log=$build_root/amb-install.log
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      die "missing packages, and neither root nor sudo here. As root: apt-get install" $missing
    as_root=(sudo)
  fi
  say "installing $(wc -l <<<"$missing") Debian packages:" $missing
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300)
  {
    date
    # An earlier installation that was interrupted is finished first; otherwise apt refuses.
    "${as_root[@]}" dpkg --configure -a
    # Without network the lists already here may still do, so a failed update is not the end.
    "${as_root[@]}" "${apt[@]}" update || true
    # shellcheck disable=SC2086
    "${as_root[@]}" "${apt[@]}" install --no-install-recommends $missing
  } >"$log" 2>&1 9>&- || {
    grep -E '^(E|Err):?' "$log" | head -n 3 >&2
    die "installing failed; the log is $log"
  }
}

# A preset is configured when its stamp is younger than the presets and the folder has not been
# moved since (CMake refuses a cache that names another folder). Later changes are ninja's to see.
configure() {
  local preset=$1 dir=$build_root/$1
  local stamp=$dir/.amb-configured log=$build_root/amb-configure-$1.log
  if [ -f "$dir/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$dir/CMakeCache.txt"; then
    say "build/$preset belongs to another folder: configuring it afresh"
    rm -rf "$dir"
  fi
  [ -f "$stamp" ] && [ "$stamp" -nt "$root/CMakePresets.json" ] && return 0
  say "configuring preset $preset"
  (cd "$root" && cmake --preset "$preset") >"$log" 2>&1 9>&- || {
    sed -n '/CMake Error/,$p' "$log" | head -n 12 >&2
    die "configuration failed; the log is $log"
  }
  touch "$stamp"
}

# The Debian package of a preset whose programs are built; prints its path.
make_package() {
  local log=$build_root/amb-package.log
  (cd "$build_root/$1" && cpack -G DEB -B "$build_root/package") >"$log" 2>&1 || {
    tail -n 5 "$log" >&2
    die "packing failed; the log is $log"
  }
  sed -n 's/^CPack: - package: \(.*\) generated\.$/\1/p' "$log"
}

# build_preset PRESET TARGET... : ninja behind one line of progress; where nothing overwrites itself,
# a line at each quarter of a long build.
build_preset() {
  local preset=$1 dir=$build_root/$1
  shift
  local log=$build_root/amb-build-$preset.log announced="" line status=0 jobs quarter=1 done_ all
  jobs=$(job_count) || exit 1
  local pattern='^\[([0-9]+)/([0-9]+)\]'
  "${under[@]}" ninja -C "$dir" -j "$jobs" "$@" 2>&1 9>&- | tee "$log" | while IFS= read -r line; do
    [[ $line =~ $pattern ]] || continue
    done_=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    if [ -z "$announced" ] && [[ $line != *"Re-checking globbed"* ]]; then
      announced=yes
      [ -t 2 ] || say "building preset $preset"
    fi
    progress "building preset $preset $done_/$all"
    if [ ! -t 2 ] && [ "$all" -ge 100 ] && [ $((4 * done_)) -ge $((quarter * all)) ] && [ $quarter -lt 4 ]; then
      say "building preset $preset: $done_ of $all"
      quarter=$((4 * done_ / all + 1))
    fi
  done || status=$?
  progress_end
  [ "$status" -eq 0 ] && return 0
  grep -m 1 -A 25 -E '^FAILED:|^ninja: error|CMake Error' "$log" | cut -c 1-400 >&2
  die "the build failed; the log is $log"
}
