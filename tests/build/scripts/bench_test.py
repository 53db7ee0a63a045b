"""scripts/bench.py with invented benchmarks: medians, units, failures, and what it writes."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])


def aggregate(name, statistic, cpu_time, unit="ns", **counters):
    return {"name": f"{name}_{statistic}", "run_name": name, "run_type": "aggregate",
            "aggregate_name": statistic, "cpu_time": cpu_time, "real_time": cpu_time,
            "time_unit": unit, "iterations": 5, **counters}


def iteration(name, cpu_time, unit="ns"):
    return {"name": name, "run_name": name, "run_type": "iteration", "cpu_time": cpu_time,
            "real_time": cpu_time, "time_unit": unit, "iterations": 9}


class Bench(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "scripts").mkdir()
        shutil.copy(SOURCE / "scripts/bench.py", self.root / "scripts")
        (self.root / "build/release/bench").mkdir(parents=True)
        (self.root / "benchmark/speed").mkdir(parents=True)

    def benchmark(self, name, rows, status=0):
        """A program that, as Google Benchmark does, writes its rows to --benchmark_out."""
        (self.root / f"{name}.json").write_text(json.dumps({"benchmarks": rows}))
        program = self.root / "build/release/bench" / name
        program.write_text(f"""#!/bin/sh
echo "$*" > {self.root}/{name}.calls
for word in "$@"; do
  case "$word" in --benchmark_out=*) cp {self.root}/{name}.json "${{word#*=}}";; esac
done
[ {status} -eq 0 ] || echo "no such counter" >&2
exit {status}
""")
        program.chmod(0o755)

    def script(self, name, body):
        path = self.root / "benchmark/speed" / name
        path.write_text("#!/bin/sh\n" + body)
        path.chmod(0o755)

    def bench(self, *words, environment=None):
        return subprocess.run([sys.executable, "-B", self.root / "scripts/bench.py", *words],
                              capture_output=True, text=True, check=False, env=environment)

    def row(self, done, name):
        return next(line.split() for line in done.stdout.splitlines() if line.split()[:1] == [name])

    def test_shows_the_median_never_the_mean_with_its_spread_and_counters(self):
        self.benchmark("law_bench", [aggregate("Step/4", "mean", 900.0),
                                     aggregate("Step/4", "median", 250.0, items_per_second=4e6,
                                               allocations=0.0),
                                     aggregate("Step/4", "cv", 0.042)])
        done = self.bench()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.row(done, "Step/4"),
                         ["Step/4", "250.0", "ns", "4.2", "%", "4e+06", "/s", "allocations", "0"])

    def test_one_repetition_shows_its_only_value_and_no_spread(self):
        self.benchmark("law_bench", [iteration("Step/4", 250.0)])  # there are no aggregates of one
        done = self.bench("--repeats", "1")
        self.assertEqual(self.row(done, "Step/4"), ["Step/4", "250.0", "ns", "-"])

    def test_times_come_in_a_unit_with_one_to_four_digits_before_the_point(self):
        for value, unit, shown in ((999.0, "ns", ["999.0", "ns"]), (1.5, "us", ["1.5", "us"]),
                                   (1500.0, "ns", ["1.5", "us"]), (2.5, "s", ["2.50", "s"]),
                                   (0.002, "s", ["2.0", "ms"]), (1000.0, "ms", ["1.00", "s"])):
            with self.subTest(value=value, unit=unit):
                self.benchmark("one_bench", [aggregate("B", "median", value, unit)])
                self.assertEqual(self.row(self.bench(), "B")[1:3], shown)

    def test_repeats_and_time_reach_the_program_and_the_filter_chooses_it(self):
        self.benchmark("law_bench", [aggregate("Law", "median", 1.0)])
        self.benchmark("rotor_bench", [aggregate("Rotor", "median", 1.0)])
        done = self.bench("law", "--repeats", "7", "--min-time", "0.01")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Rotor", done.stdout)
        called = (self.root / "law_bench.calls").read_text()
        self.assertIn("--benchmark_repetitions=7 --benchmark_min_time=0.01", called)

    def test_a_failed_program_is_named_and_the_others_still_run(self):
        self.benchmark("a_bench", [], status=3)
        self.benchmark("b_bench", [aggregate("B", "median", 1.0)])
        done = self.bench()
        self.assertEqual(done.returncode, 1)
        self.assertIn("failed with status 3: no such counter", done.stdout)
        self.assertEqual(done.stderr, "amb bench: failed: a_bench\n")
        self.assertTrue(self.row(done, "B"))

    def test_scripts_are_told_where_to_write_and_where_the_programs_are(self):
        self.script("latency.sh", 'echo "{}" > "$BENCH_JSON"; echo "$LEVITAS_BINARIES"\n')
        (self.root / "benchmark/speed/notes.sh").write_text("not executable: not a benchmark\n")
        done = self.bench()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.root / "build/bench/latency.json").exists())
        self.assertIn(str(self.root / "build/release/bin"), done.stdout)
        self.assertNotIn("notes", done.stdout)

    def test_a_script_that_says_what_it_lacks_is_named_as_not_run_and_nothing_fails(self):
        self.script("a.sh", 'echo "  not run: no such program here"; exit 77\n')
        self.script("b.sh", 'echo "the rest goes on"\n')
        done = self.bench()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no such program here", done.stdout)
        self.assertIn("the rest goes on", done.stdout)
        self.assertEqual(done.stderr, "amb bench: not run: a.sh\n")

    def test_without_cyclictest_its_comparison_is_one_sentence_and_no_failure(self):
        script = self.root / "benchmark/speed/realtime_vs_cyclictest.py"
        shutil.copy(SOURCE / "benchmark/speed" / script.name, script)
        (self.root / "tests").symlink_to(SOURCE / "tests")
        script.chmod(0o755)
        tools = self.root / "tools"  # a PATH without it
        tools.mkdir()
        for name in ("python3", "env"):
            (tools / name).symlink_to(shutil.which(name))
        done = self.bench(environment={**os.environ, "PATH": str(tools)})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("not run: the comparison needs cyclictest (Debian package rt-tests", done.stdout)
        self.assertNotIn("Traceback", done.stdout + done.stderr)

    def test_a_name_that_is_none_is_a_usage_error_that_lists_them(self):
        self.benchmark("law_bench", [])
        done = self.bench("lwa")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nothing is called 'lwa'; there are: law_bench", done.stderr)

    def test_a_number_of_repeats_below_one_is_a_usage_error(self):
        self.benchmark("law_bench", [])
        for words in (("--repeats", "0"), ("--repeats", "-3"), ("--min-time", "-1"),
                      ("--min-time", "nan")):
            with self.subTest(words):
                self.assertEqual(self.bench(*words).returncode, 2)

    def test_the_machine_is_written_beside_the_results(self):
        self.benchmark("law_bench", [aggregate("Law", "median", 1.0)])
        self.bench()
        facts = json.loads((self.root / "build/bench/environment.json").read_text())
        self.assertEqual(facts["cores"], os.cpu_count())
        self.assertEqual(facts["build_type"], "unknown")  # there is no cache in this folder


if __name__ == "__main__":
    unittest.main()
