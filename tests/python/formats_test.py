"""One trajectory from CSV, MAT, XLSX and as arrays: identical. MAT and XLSX are read by their specifications, by no library."""

import csv
import os
import struct
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile

import numpy

import kurbel

PRESS = os.path.join(os.environ["KURBEL_SCENES"], "crank_press.toml")
SHEET = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


def mat5(path):
    """Matrices of a MAT file of version 5, little-endian, not compressed."""
    letters = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 9: "f8", 17: "u2"}

    def element(data, at):
        kind, size = struct.unpack_from("<II", data, at)
        if kind >> 16:  # a small one: type and size in one word, four bytes behind
            return kind & 0xFFFF, data[at + 4:at + 4 + (kind >> 16)], at + 8
        return kind, data[at + 8:at + 8 + size], at + 8 + (size + 7) // 8 * 8

    with open(path, "rb") as file:
        data = file.read()
    matrices, at = {}, 128
    while at < len(data):
        kind, body, at = element(data, at)
        assert kind == 14, "a matrix"
        flags, rest = element(body, 0)[1:]
        extent, rest = element(body, rest)[1:]
        name, rest = element(body, rest)[1:]
        kind, numbers, _ = element(body, rest)
        values = numpy.frombuffer(numbers, "<" + letters[kind])
        matrices[name.decode()] = values.reshape(struct.unpack("<ii", extent), order="F"), flags[0]
    return matrices


def xlsx(path, title):
    """Rows of a sheet: numbers and texts."""
    with zipfile.ZipFile(path) as book:
        names = [s.get("name") for s in xml.etree.ElementTree.fromstring(book.read("xl/workbook.xml")).iter(SHEET + "sheet")]
        sheet = xml.etree.ElementTree.fromstring(book.read(f"xl/worksheets/sheet{names.index(title) + 1}.xml"))
    for row in sheet.iter(SHEET + "row"):
        yield [float(c.find(SHEET + "v").text) if c.get("t") is None else c.find(f"{SHEET}is/{SHEET}t").text for c in row]


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_of_press = kurbel.run(PRESS, until=1.0, no_error=True)
        cls.folder = tempfile.TemporaryDirectory()
        cls.place = os.path.join(cls.folder.name, "out")
        cls.run_of_press.write(cls.place, formats="csv,mat,xlsx")
        trajectory = cls.run_of_press.trajectory
        cls.headings = ["time [s]"] + [f"{name} [{unit}]" for name, unit in trajectory.units.items()]
        cls.arrays = numpy.column_stack([trajectory.time] + [trajectory[name] for name in trajectory])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def same(self, rows):
        self.assertEqual(self.arrays.shape, rows.shape)
        self.assertEqual(self.arrays.tobytes(), numpy.ascontiguousarray(rows, dtype="<f8").tobytes(), "to the last bit")

    def test_csv(self):
        with open(os.path.join(self.place, "trajectory.csv")) as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], self.headings)
        self.same(numpy.array([[float(cell) for cell in row] for row in rows[1:]]))

    def test_xlsx(self):
        rows = list(xlsx(os.path.join(self.place, "results.xlsx"), "trajectory"))
        self.assertEqual(rows[0], self.headings)
        self.same(numpy.array(rows[1:]))

    def test_mat(self):
        matrices = mat5(os.path.join(self.place, "trajectory.mat"))
        info, kind = matrices["dataInfo"]
        self.assertEqual(kind, 12, "int32")
        names = ["".join(map(chr, column)).rstrip() for column in matrices["name"][0].T]
        where = [names.index(heading.rsplit(" [", 1)[0]) for heading in self.headings]
        self.assertEqual(set(info[0, where[1:]]), {2})
        self.same(matrices["data_2"][0][info[1, where] - 1].T)

    def test_figures_stand_in_both_with_their_units(self):
        matrices = mat5(os.path.join(self.place, "trajectory.mat"))
        names = ["".join(map(chr, column)).rstrip() for column in matrices["name"][0].T]
        rows = {row[0]: row for row in xlsx(os.path.join(self.place, "results.xlsx"), "figures")}
        for name, figure in self.run_of_press.figures.items():
            self.assertEqual(rows[name][1], figure.value)
            if figure.unit:
                self.assertEqual(rows[name][2], figure.unit)
            at = names.index(name)
            self.assertEqual(matrices["dataInfo"][0][0, at], 1)
            self.assertEqual(matrices["data_1"][0][matrices["dataInfo"][0][1, at] - 1, 1], figure.value)

    def test_every_studys_tables_are_the_same_in_each_format(self):
        asked = {"compare": dict(no_error=True, no_trials=True, until="0.3 s"), "modes": dict(spot_checks=0, count=3),
                 "forces": dict(no_run=True), "reduce": {}, "size": dict(delta=0.05, no_run=True),
                 "steady": dict(no_start=True)}
        for name, options in asked.items():
            place = os.path.join(self.folder.name, name)
            study = kurbel.study(name, PRESS, **options)
            study.write(place, formats="csv,mat,xlsx")
            for table, text in study.tables.items():
                with self.subTest(name, table=table):
                    self.same_in_each(text, place, table.removesuffix(".csv"))

    def same_in_each(self, text, place, title):
        rows = list(csv.reader(line for line in text.splitlines() if not line.startswith("# ")))
        headings = [heading.rsplit(" [", 1)[0] for heading in rows[0]]
        sheet = list(xlsx(os.path.join(place, "results.xlsx"), title))
        self.assertEqual(sheet[0], rows[0])
        # An empty cell is none in a sheet.
        told = [[cell for cell in row if cell] for row in rows[1:]]
        self.assertEqual([[repr(cell) if isinstance(cell, float) else cell for cell in row] for row in sheet[1:]],
                         [[repr(float(cell)) if is_number(cell) else cell for cell in row] for row in told])
        matrices = mat5(os.path.join(place, title + ".mat"))
        numbers = [k for k in range(len(headings)) if all(is_number(row[k] or "nan") for row in rows[1:])]
        names = ["".join(map(chr, column)).rstrip() for column in matrices["name"][0].T]
        self.assertGreater(len(numbers), 1)
        for k in numbers:
            place_of = matrices["dataInfo"][0][:, names.index(headings[k])]
            held = matrices["data_2"][0][place_of[1] - 1]
            self.assertEqual(held.tobytes(), numpy.array([float(row[k] or "nan") for row in rows[1:]]).tobytes(),
                             headings[k])

    def test_peaks_stand_among_the_rows(self):
        peak = self.run_of_press.figures["peak_torque.main_coupling"]
        self.assertIn(peak.at, self.run_of_press.trajectory.time)
        self.assertEqual(numpy.abs(self.run_of_press.trajectory["torque.main_coupling"]).max(), abs(peak.value))

    def test_a_format_that_is_none_is_refused(self):
        with self.assertRaisesRegex(ValueError, "allowed: csv, mat, xlsx"):
            self.run_of_press.write(self.place, formats="ods")


if __name__ == "__main__":
    unittest.main()
