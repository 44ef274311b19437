"""The command's CSV, read by the one line of the README, is what was written, to the last bit."""

import csv
import io
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import warnings

import pandas as pd

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("RINGROAD", str(ROOT / "target/release/ringroad"))
COLUMNS = [
    "time_s",
    "vehicle",
    "lane",
    "position_m",
    "speed_m_per_s",
    "headway_m",
    "perceived_headway_m",
    "frustration",
    "distance_m",
    "lane_changes",
]
COUNTS = ["vehicle", "lane", "lane_changes"]


def ringroad(*arguments):
    return subprocess.run([COMMAND, *arguments], check=True, capture_output=True).stdout.decode()


def readme_line():
    """The line of the README that reads a table, so that the line shown is the line tested."""
    (line,) = re.findall(r"pd\.read_csv\(.*\)$", (ROOT / "README.md").read_text(), re.MULTILINE)
    return line


def read(text):
    """What the README's line makes of a `run.csv` with this text."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "run.csv")
        path.write_bytes(text.encode())
        line = readme_line().replace('"run.csv"', "path")
        with warnings.catch_warnings():
            # From pandas 3.1 on, float_precision is no longer needed, and pandas says so.
            warnings.filterwarnings("ignore", message=".*float_precision.*")
            return eval(line, {"pd": pd, "path": path})


class ReadCsv(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # One lane with the paper's nudge; and lanes, where frustration and lane changes are not all 0.
        cls.texts = {
            "phantom-jam": ringroad("run", "--preset", "phantom-jam", "--until", "5"),
            "two lanes": ringroad("run", "--lanes", "2", "--vehicles", "60", "--start", "one-lane",
                                  "--time-step", "0.05", "--until", "20"),
        }

    def test_columns_rows_and_types(self):
        for name, text in self.texts.items():
            vehicles, last = {"phantom-jam": (50, 5), "two lanes": (60, 20)}[name]
            with self.subTest(name):
                table = read(text)
                self.assertEqual(list(table.columns), COLUMNS)
                self.assertEqual(len(table), vehicles * (last + 1))
                self.assertEqual(sorted(set(table["time_s"])), list(range(last + 1)))
                for column in COLUMNS:
                    kinds = "i" if column in COUNTS else "if"
                    self.assertIn(table[column].dtype.kind, kinds, column)
                self.assertFalse(table.isna().any().any())
        self.assertGreater(read(self.texts["two lanes"])["lane_changes"].sum(), 0)

    def test_numbers_survive_to_the_last_bit(self):
        for name, text in self.texts.items():
            with self.subTest(name):
                table = read(text)
                rows = list(csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#")))
                self.assertEqual(len(rows), len(table))
                for column in COLUMNS:
                    written = [float(row[column]).hex() for row in rows]
                    got = [float(value).hex() for value in table[column]]
                    self.assertEqual(written, got, column)

    def test_the_header_is_comment_and_carries_the_scenario(self):
        for name, text in self.texts.items():
            with self.subTest(name):
                header = [line[1:].strip() for line in text.splitlines() if line.startswith("#")]
                self.assertTrue(text.startswith("#"))
                self.assertIn("ringroad", header[0].lower())
                objects = [line[line.index("{"):] for line in header if "{" in line]
                scenarios = [o for o in map(json.loads, objects) if "vehicles" in o]
                self.assertEqual([s["vehicles"] for s in scenarios], [50 if name == "phantom-jam" else 60])

    def test_lines_end_as_unix_lines_and_are_whole(self):
        for name, text in self.texts.items():
            with self.subTest(name):
                self.assertNotIn("\r", text)
                self.assertTrue(text.endswith("\n"))


if __name__ == "__main__":
    unittest.main()
