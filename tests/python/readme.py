"""The commands that the README shows do what their comments say."""

import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("RINGROAD", str(ROOT / "target/release/ringroad"))


class Readme(unittest.TestCase):
    def test_the_lines_run_in_order(self):
        shown = re.findall(r"^cargo run --release -- (.*)$", (ROOT / "README.md").read_text(), re.MULTILINE)
        self.assertEqual(len(shown), 7)
        with tempfile.TemporaryDirectory() as folder:
            for line in shown:
                with self.subTest(line):
                    arguments = shlex.split(line, comments=True)
                    done = subprocess.run([COMMAND, *arguments], cwd=folder, capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    if "--out" in arguments:
                        self.assertTrue(pathlib.Path(folder, arguments[-1]).read_text().startswith("# ringroad"))
                    elif "--json" in arguments:
                        self.assertEqual(json.loads(done.stdout)["outcome"], "collision")
                    else:
                        self.assertTrue(done.stdout or done.stderr)


if __name__ == "__main__":
    unittest.main()
