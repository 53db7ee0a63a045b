"""amb report: a session becomes one page; pictures by themselves; what is refused."""

import os
import re
import shutil
import unittest
import urllib.parse
import xml.etree.ElementTree as xml

from command import BAD_INPUT, DONE, USAGE, CommandTest, amb, make_record

ROWS = 6_000
SPEED_RPM = 3000


class Report(CommandTest):
    def setUp(self):
        super().setUp()
        make_record(self.folder / "r.csv", "unbalance", SPEED_RPM, ROWS)
        done = amb(self.folder, "import", "r.csv", "--rig", "flexible_rotor", "--out", "s.lcmlog")
        self.assertEqual(done.returncode, DONE, done.stderr)

    def test_is_one_page_whose_pictures_are_inside_it_and_are_drawings(self):
        _, told = self.compute("report", "s.lcmlog", "--out", "r.html")
        page = (self.folder / "r.html").read_text(encoding="utf-8")
        pictures = re.findall(r'src="data:image/svg\+xml,([^"]*)"', page)
        self.assertEqual(len(pictures), len(told["pictures"]))
        for picture in pictures:
            self.assertTrue(xml.fromstring(urllib.parse.unquote(picture)).tag.endswith("svg"))
        outside = [address for address in re.findall(r'(?:src|href)="([^"]*)"', page)
                   if not address.startswith(("data:", "#"))]
        self.assertEqual(outside, [])
        self.assertIn(f"{SPEED_RPM} rpm", page)

    def test_writes_each_picture_by_itself_too(self):
        _, told = self.compute("report", "s.lcmlog", "--out", "r.html", "--pictures", "p")
        kinds = ("svg", "png") if told["png"] else ("svg",)
        self.assertEqual(told["png"], shutil.which("rsvg-convert") is not None)
        self.assertEqual(sorted(path.name for path in (self.folder / "p").iterdir()),
                         sorted(f"{name}.{kind}" for name in told["pictures"] for kind in kinds))
        for path in (self.folder / "p").glob("*.svg"):
            width = float(xml.parse(path).getroot().get("viewBox").split()[2])
            if told["png"]:
                head = path.with_suffix(".png").read_bytes()[:24]
                self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
                self.assertEqual(int.from_bytes(head[16:20], "big"), 2 * width)

    def test_says_how_to_get_png_where_the_converter_is_missing(self):
        done = amb(self.folder, "report", "s.lcmlog", "--out", "r.html", "--pictures", "p",
                   environment={**os.environ, "PATH": "/nowhere"})
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("librsvg2-bin", done.stdout)
        self.assertEqual(list((self.folder / "p").glob("*.png")), [])

    def test_shows_the_orbits_that_were_asked_for(self):
        amb(self.folder, "report", "s.lcmlog", "--out", "r.html", "--pictures", "p", "--speeds", "3000")
        orbit = (self.folder / "p/orbit_de.svg").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r">(\d+ rpm)<", orbit), ["3000 rpm"])

    def test_says_that_an_imported_record_is_not_judged(self):
        _, told = self.compute("report", "s.lcmlog", "--out", "r.html")
        self.assertIsNone(told["verdict"])
        self.assertIn("Not judged", (self.folder / "r.html").read_text(encoding="utf-8"))

    def test_a_run_whose_record_breaks_off_is_not_accepted(self):
        done = amb(self.folder, "run", "--duration", "1", "--record", "run.lcm")
        self.assertEqual(done.returncode, DONE, done.stderr)
        whole = (self.folder / "run.lcm").read_bytes()
        for name, share in (("inside", 0.5), ("whole", 1.0)):
            (self.folder / name).write_bytes(whole[:int(len(whole) * share) - (share < 1.0)])
            _, told = self.compute("report", name, "--out", name + ".html")
            self.assertEqual(told["verdict"] == "incomplete", name == "inside", told)
        printed = amb(self.folder, "report", "inside", "--out", "r.html").stdout
        self.assertIn("INCOMPLETE: the record", printed)
        self.assertIn("Not everything could be read", printed)

    def test_a_run_has_its_verdict_as_tables_its_sensitivity_and_its_critical_speeds(self):
        done = amb(self.folder, "run", "--duration", "1", "--record", "run.lcm")
        self.assertEqual(done.returncode, DONE, done.stderr)
        _, told = self.compute("report", "run.lcm", "--out", "r.html")
        page = (self.folder / "r.html").read_text(encoding="utf-8")
        self.assertIn("sensitivity_0_rpm", told["pictures"])
        self.assertIn("campbell", told["pictures"])
        self.assertLess(page.index("<table id=\"sensitivity\""), page.index("<figure"))
        for axis in told["judgement"]["sensitivity"][0]["axes"]:
            self.assertIn(f"<td>{axis['axis']}</td><td class=n>{axis['peak']:.3f}</td>", page)
        self.assertGreater(len(told["critical_speeds"]), 0)
        for critical in told["critical_speeds"]:
            self.assertIn(f"<td class=n>{critical['speed_rpm']:.0f}</td>"
                          f"<td class=n>{critical['frequency_hz']:.2f}</td>", page)
        # Those that amb poles prints for the rig and controller of the run.
        _, poles = self.compute("poles", "--controller", "flexible_rotor_commissioned")
        self.assertEqual(told["critical_speeds"], poles["critical_speeds"])

    def test_refuses_what_is_no_session_and_writes_nothing(self):
        self.write("x", "no session")
        self.refuse(BAD_INPUT, "x", "report", "x", "--out", "r.html")
        self.refuse(BAD_INPUT, "gone", "report", "gone.lcmlog", "--out", "r.html")
        self.refuse(USAGE, "--out", "report", "s.lcmlog")

    def test_refuses_to_write_over_what_it_reads(self):
        before = (self.folder / "s.lcmlog").read_bytes()
        amb(self.folder, "report", "s.lcmlog", "--out", "s.lcmlog")
        self.assertEqual((self.folder / "s.lcmlog").read_bytes(), before)

    def test_refuses_a_file_that_a_run_did_not_write(self):
        self.write("other.json", '{"timing": 3}')
        self.refuse(BAD_INPUT, "other.json", "report", "s.lcmlog", "--out", "r.html", "--run-json",
                    "other.json")


if __name__ == "__main__":
    unittest.main()
