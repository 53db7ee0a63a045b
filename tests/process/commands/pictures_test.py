"""--svg of amb modes, poles and margins: a drawing whose labels are the numbers of the JSON."""

import unittest
import xml.etree.ElementTree as xml

from command import SHIPPED_RIG, CommandTest, amb, edited

TEXT = "{http://www.w3.org/2000/svg}text"


class Pictures(CommandTest):
    def draw(self, *arguments):
        """(texts of the drawing, JSON) of a command."""
        _, told = self.compute(*arguments, "--svg", self.folder / "p.svg")
        root = xml.parse(self.folder / "p.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))
        # Readable on a page of 900 pixels: letters of 11 units on a drawing not much wider.
        self.assertLessEqual(float(root.get("viewBox").split()[2]), 1000)
        drawing = (self.folder / "p.svg").read_text()
        self.assertNotRegex(drawing, r"['\"> ](nan|inf)\b")
        return [node.text or "" for node in root.iter(TEXT)], told

    def test_a_critical_speed_of_the_picture_is_where_a_printed_frequency_equals_rotation(self):
        texts, told = self.draw("modes")
        self.assertEqual(len(told["critical_speeds"]), 2)
        for critical in told["critical_speeds"]:
            letter = critical["whirl"][0].upper()
            self.assertIn(f"{critical['speed_rpm']:.0f} rpm {letter}", texts)
            self.assertAlmostEqual(critical["frequency_hz"], critical["speed_rpm"] / 60, 5)
            _, there = self.compute("modes", "--speed-rpm", repr(critical["speed_rpm"]))
            frequency = there["speeds"][0][critical["whirl"] + "_hz"][0]
            self.assertAlmostEqual(frequency, critical["frequency_hz"], 5)

    def test_modes_have_their_loads_centre_and_inertia(self):
        texts, told = self.draw("modes")
        for bearing in told["bearings"]:
            self.assertIn(f"{bearing['name']} carries {bearing['static_load_n']:.2f} N", texts)
        loads = sum(bearing["static_load_n"] for bearing in told["bearings"])
        self.assertAlmostEqual(loads, 9.81 * told["rotor_mass_kg"], 6)
        self.assertTrue(any("transverse inertia" in text for text in texts))
        self.assertIn("rated 6000 rpm", texts)

    def test_a_rotor_without_bending_modes_is_drawn_too(self):
        texts, told = self.draw("modes", "--rig", "one_axis")
        self.assertEqual(told["critical_speeds"], [])
        self.assertIn("rigid rotor: no bending mode", texts)

    def test_a_geared_rig_is_drawn(self):
        texts, _ = self.draw("modes", "--rig", "geared_rotor_8dof")
        self.assertTrue(any("speed of the first shaft" in text for text in texts))
        for order in ("1x of pinion", "1x of gear", "mesh 20x"):
            self.assertIn(order, texts)

    def test_poles_have_the_critical_speeds_of_the_levitated_rotor(self):
        texts, told = self.draw("poles", "--speeds", "0,3000")
        for critical in told["critical_speeds"]:
            _, there = self.compute("poles", "--speed-rpm", repr(critical["speed_rpm"]))
            nearest = min(abs(abs(pole["frequency_hz"]) - critical["speed_rpm"] / 60)
                          for pole in there["speeds"][0]["poles"])
            self.assertLess(nearest, 1e-4)
            if critical["whirl"] == "forward":
                self.assertIn(f"{critical['speed_rpm']:.0f} rpm F", texts)
        self.assertGreater(len(told["critical_speeds"]), 0)
        self.assertTrue(any(text.startswith("3000 rpm forward") for text in texts))

    def test_margins_have_the_zones_and_the_peaks_of_the_table(self):
        texts, told = self.draw("margins", "--speeds", "0,6000")
        for zone in ("zone B from 3", "zone C from 4", "zone D from 5"):
            self.assertEqual(texts.count(zone), 2)
        for at, curves in zip(told["speeds"], told["curves"]):
            worst = max(at["axes"], key=lambda axis: axis["sensitivity_peak"])
            self.assertIn(f"{worst['channel']} {worst['sensitivity_peak']:.2f} at "
                          f"{worst['frequency_hz']:.1f} Hz", texts)
            self.assertIn(f"Sensitivity |S| at {at['speed_rpm']:.0f} rpm, zone {at['zone']}", texts)
            for axis, curve in zip(at["axes"], curves["axes"]):
                highest = max(abs(complex(*value)) for value in
                              zip(curve["sensitivity_real"], curve["sensitivity_imaginary"]))
                self.assertAlmostEqual(highest, axis["sensitivity_peak"],
                                       delta=0.01 * axis["sensitivity_peak"])

    def test_without_a_picture_the_json_has_no_curves(self):
        self.assertNotIn("curves", self.compute("margins")[1])

    def test_names_of_others_are_text(self):
        rig = self.write("r.yaml", edited(SHIPPED_RIG, ("name: flexible_rotor", "name: a_b")))
        texts, _ = self.draw("modes", "--rig", rig)
        self.assertIn("Rig a_b", texts)

    def test_nothing_is_drawn_for_a_rig_that_cannot_be_read(self):
        done = amb(self.folder, "modes", "--rig", "absent.yaml", "--svg", "p.svg")
        self.assertEqual(done.returncode, 3)
        self.assertFalse((self.folder / "p.svg").exists())


if __name__ == "__main__":
    unittest.main()
