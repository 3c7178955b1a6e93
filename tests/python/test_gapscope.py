"""The Python package answers as the command does. GAPSCOPE is the executable, SOURCE the folder of the project."""

import contextlib
import io
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy

import gapscope

GAPSCOPE, SOURCE = os.environ["GAPSCOPE"], Path(os.environ["SOURCE"])
YAML, CSV = SOURCE / "configs/03_recording.yaml", SOURCE / "configs/03_recording.csv"


def command(*arguments):
    """What the command prints; its warnings and its exit status are left to its own tests."""
    return subprocess.run([GAPSCOPE, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def columns():
    t, u, x1 = numpy.loadtxt(CSV, delimiter=",", skiprows=2, unpack=True)
    return {"time": t, "input": u, "position": x1}


def all_but(*kept):
    """Effects to exclude, so that a diagnosis takes a second."""
    return [name for name in command("effects").stdout.split() if name not in kept]


class InAFolder(unittest.TestCase):
    def setUp(self):
        self.maxDiff = 1000
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def stored(self, name, *arguments):
        """The bytes of a file that the command leaves, and its folder."""
        folder = self.folder / f"command_{len(os.listdir(self.folder))}"
        done = command(*arguments, "-o", folder, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (folder / name).read_text(), folder


class SameBytes(InAFolder):
    def test_check(self):
        told = command("check", CSV, "--bits", 16, "--json").stdout
        self.assertEqual(gapscope.check(YAML).json, told)
        self.assertEqual(gapscope.check(CSV).json, command("check", CSV, "--json").stdout)
        judged = gapscope.check(CSV, purpose="gap")
        self.assertEqual(judged.json, command("check", CSV, "--json", "--for", "gap").stdout)
        self.assertEqual(judged.files["report.txt"].decode(), command("check", CSV, "--for", "gap").stdout)
        self.assertFalse(judged["spoilt"])

    def test_detect_and_its_traces(self):
        told, folder = self.stored("result.json", "detect", YAML)
        found = gapscope.detect(YAML)
        self.assertEqual(found.json, told)
        self.assertEqual(found["model_free"]["verdict"], "backlash")
        self.assertEqual(found.files["resolved.yaml"], (folder / "resolved.yaml").read_bytes())
        name = found["recordings"][0]["trace"]
        header = (folder / name).read_text().split("\n", 1)[0].split(",")
        self.assertEqual(list(found.traces[name]), header)
        written = numpy.genfromtxt(folder / name, delimiter=",", names=True)
        for column in header:
            numpy.testing.assert_array_equal(found.traces[name][column], written[column])
        self.assertTrue(found.traces[name]["e_x_rad"].flags.writeable)
        numpy.testing.assert_array_equal(
            found.bound_map, numpy.loadtxt(folder / "traces/bound_map.csv", delimiter=","))

    def test_fit_with_a_setting_and_its_export(self):
        told, folder = self.stored("result.json", "fit", YAML, "--set", "model.parameters.gap.value=0.02")
        found = gapscope.fit(YAML, settings={"model.parameters.gap.value": 0.02})
        self.assertEqual(found.json, told)
        self.assertEqual(found.files["fitted.yaml"], (folder / "fitted.yaml").read_bytes())
        trace = found.traces["traces/1_03_recording.csv"]
        self.assertEqual(trace["fit_mode"].dtype, numpy.int8)
        self.assertLessEqual(set(trace["fit_mode"].tolist()), set(gapscope.MODES))
        _, exported = self.stored("certificate.json", "export", folder, "--to", "c")
        files = {name: (exported / name).read_bytes() for name in os.listdir(exported) if name != "files.json"}
        self.assertEqual(dict(gapscope.export(found, to="c")), files)
        self.assertEqual(dict(gapscope.export(folder, to="c")), files)

    def test_run_into_a_folder(self):
        told, folder = self.stored("result.json", "run", YAML)
        mine = self.folder / "mine"
        found = gapscope.run(YAML, output=mine)
        self.assertEqual(found.json, told)
        for name in os.listdir(folder):
            if name not in ("timing.json", "files.json") and (folder / name).is_file():
                self.assertEqual((mine / name).read_bytes(), (folder / name).read_bytes(), name)
        self.assertEqual(found.files["fitted.yaml"], (folder / "fitted.yaml").read_bytes())

    def test_diagnose(self):
        excluded = all_but("cogging_torque", "stribeck_friction")
        options = [word for name in excluded for word in ("--exclude", name)]
        told, folder = self.stored("diagnosis.json", "diagnose", YAML, *options)
        found = gapscope.diagnose(YAML, exclude=excluded)
        self.assertEqual(found.json, told)
        self.assertEqual(found.files["fitted.yaml"], (folder / "fitted.yaml").read_bytes())
        for name in found.tables:
            self.assertEqual(found.files[name], (folder / name).read_bytes())
        trace = found.traces["traces/held_out_1_03_recording.csv"]
        self.assertEqual(trace["torque_before_nm"].shape, trace["t_s"].shape)


class Configurations(InAFolder):
    def test_text_and_dict_are_read_as_the_file(self):
        text = YAML.read_text()
        from_file = gapscope.detect(YAML).json
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(YAML.parent)
        self.assertEqual(gapscope.detect(text).json, from_file)
        asked = {"name": "03_recording", "encoder": {"bits": numpy.int64(16)}, "detector": {"bound": "auto"},
                 "recording": {"file": Path("03_recording.csv"), "columns": {"time": "t"}}}
        found = gapscope.detect(asked)
        self.assertEqual(found["model_free"]["gap_rad"], gapscope.detect(YAML)["model_free"]["gap_rad"])

    def test_arrays_are_read_as_the_file_that_has_them(self):
        arrays = columns()
        copy = self.folder / "03_recording.csv"
        rows = zip(*(arrays[key].tolist() for key in ("time", "input", "position")))
        copy.write_text("t,u,x1\n" + "".join(f"{t!r},{u!r},{x!r}\n" for t, u, x in rows))
        (self.folder / "03_recording.yaml").write_text(YAML.read_text())
        told, _ = self.stored("result.json", "run", self.folder / "03_recording.yaml")
        of_file = gapscope.run(self.folder / "03_recording.yaml")
        self.assertEqual(of_file.json, told)
        found = gapscope.run(YAML, {**arrays, "name": "03_recording.csv"})
        # But for the SHA-256 of the rows, whose numbers Python writes with another exponent, the same bytes.
        self.assertEqual([s.pop("sha256") for s in found["sources"]][0], of_file["sources"][0].pop("sha256"))
        of_file["sources"][1].pop("sha256")
        self.assertEqual(found, of_file)
        trace = found.traces["traces/1_03_recording.csv"]
        numpy.testing.assert_array_equal(trace["x1_rad"], arrays["position"])

    def test_arrays_need_no_configuration_and_take_its_names_and_units(self):
        arrays = columns()
        plain = gapscope.detect(recording=arrays)
        self.assertEqual(plain["recordings"][0]["trace"], "traces/1_recording.csv")
        asked = {"recording": {"columns": {"time": "stamp", "input": "i_q", "position": "q[:, 0]"},
                               "units": {"time": "ms", "position": "mrad"}}}
        scaled = {"time": 1e3 * arrays["time"], "input": arrays["input"], "position": 1e3 * arrays["position"]}
        found = gapscope.detect(asked, scaled)
        self.assertAlmostEqual(found["model_free"]["gap_rad"], plain["model_free"]["gap_rad"], places=9)
        self.assertIn('position: "position"', found["configuration"]["resolved"])
        robot = {"recording": {"columns": {"input": "{axis}.u", "position": "{axis}.x"}}}
        of_axis = gapscope.detect(robot, arrays, axis="elbow")
        self.assertIn('position: "elbow.x"', of_axis["configuration"]["resolved"])
        self.assertEqual(of_axis["model_free"], plain["model_free"])

    def test_a_simulator_is_compared_from_its_arrays(self):
        arrays, excluded = columns(), all_but("cogging_torque")
        simulated = {"time": arrays["time"], "position": 1.01 * arrays["position"]}
        found = gapscope.diagnose(YAML, arrays, simulated=simulated, exclude=excluded)
        self.assertIn("sentence", found["simulated"])
        held_out = {key: values[: len(values) // 2] for key, values in arrays.items()}
        self.assertIn("held_out.csv", gapscope.diagnose(YAML, arrays, held_out, exclude=excluded).json)


class BadInput(InAFolder):
    def refused(self, message, call, *arguments, **options):
        with self.assertRaises(ValueError) as caught:
            call(*arguments, **options)
        self.assertIn(message, str(caught.exception))
        self.assertNotIn("/gapscope-", str(caught.exception))
        return str(caught.exception)

    def test_a_configuration_is_refused_in_the_words_of_the_command(self):
        bad = self.folder / "bad.yaml"
        bad.write_text(YAML.read_text().replace("gap: {value: 0.0250", "gap: {value: -0.01"))
        with self.assertRaises(ValueError) as caught:
            gapscope.fit(bad)
        self.assertEqual(str(caught.exception) + "\n", command("fit", bad).stderr)
        self.assertRegex(str(caught.exception), r"bad\.yaml:\d+: .*gap.*expected")
        self.refused("--set model.parameters.gap", gapscope.fit, YAML, settings={"model.parameters.gap": -1})
        self.refused("there.yaml", gapscope.fit, "not/there.yaml")

    def test_arrays_are_refused_with_key_and_sample(self):
        good = columns()
        self.refused("position[7] is nan", gapscope.detect, YAML,
                     {**good, "position": numpy.where(numpy.arange(good["time"].size) == 7, numpy.nan, 0.0)})
        self.refused("(time 6927, input 6927, position 5)", gapscope.detect, YAML,
                     {**good, "position": good["position"][:5]})
        self.refused("shape (3, 2), expected (n,)", gapscope.detect, YAML, {**good, "input": numpy.zeros((3, 2))})
        self.refused("input: could not convert", gapscope.detect, YAML, {**good, "input": ["a"]})
        self.refused("recording.csv: has angle, expected time", gapscope.detect, YAML,
                     {**good, "angle": good["position"]})
        self.refused("columns: {voltage: voltage}", gapscope.detect, YAML, {**good, "voltage": good["input"]})
        self.refused("recording.csv:", gapscope.detect, YAML, {**good, "time": numpy.roll(good["time"], 100)})
        self.refused("recording.csv", gapscope.detect, YAML, {"time": good["time"], "position": good["position"]})
        self.refused("simulation", gapscope.detect, SOURCE / "configs/02_experiment.yaml", good)

    def test_words_are_refused_with_those_that_are_known(self):
        self.refused("expected all, gap, fit or diagnosis", gapscope.check, YAML, purpose="fun")
        self.refused("expected one of mjcf, c", gapscope.export, YAML, to="matlab")
        self.refused("gapscope effects", gapscope.diagnose, YAML, exclude=["magic"])
        self.refused("has 1 recordings", gapscope.check, YAML, which=1)
        self.assertEqual(set(gapscope.FORMATS), {"mjcf", "c", "urdf", "sdf", "isaac", "bam"})

    def test_a_folder_of_somebody_else_is_left_alone(self):
        (self.folder / "notes.txt").write_text("mine")
        self.refused("expected", gapscope.detect, YAML, output=self.folder)
        self.assertEqual(os.listdir(self.folder), ["notes.txt"])


class Work(unittest.TestCase):
    def test_ctrl_c_ends_a_long_call_and_not_the_next_one(self):
        begun = threading.Event()

        def press():
            begun.wait(60)
            os.kill(os.getpid(), signal.SIGINT)

        hand = threading.Thread(target=press)
        hand.start()
        start = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            gapscope.diagnose(SOURCE / "configs/08_missing_cogging.yaml", progress=lambda what: begun.set())
        hand.join()
        self.assertLess(time.monotonic() - start, 20)
        self.assertEqual(gapscope.detect(YAML)["model_free"]["verdict"], "backlash")

    def test_other_threads_run_meanwhile(self):
        ticks, done = 0, threading.Event()
        call = threading.Thread(target=lambda: (gapscope.fit(YAML), done.set()))
        call.start()
        while not done.is_set():
            ticks += 1
            time.sleep(0.001)
        call.join()
        self.assertGreater(ticks, 20)

    def test_calls_of_two_threads_take_turns(self):
        found = [None, None]

        def call(i):
            found[i] = gapscope.detect(YAML).json

        calls = [threading.Thread(target=call, args=(i,)) for i in range(2)]
        for one in calls:
            one.start()
        for one in calls:
            one.join()
        self.assertEqual(found[0], found[1])

    def test_progress_is_told_on_request_and_may_end_the_work(self):
        with contextlib.redirect_stderr(io.StringIO()) as told:
            gapscope.detect(YAML)
            self.assertEqual(told.getvalue(), "")
            gapscope.detect(YAML, progress=True)
        self.assertIn("model-free detector ...", told.getvalue())
        with self.assertRaises(ZeroDivisionError):
            gapscope.run(YAML, progress=lambda what: 1 // 0)

    def test_the_version_is_that_of_the_command(self):
        self.assertEqual("gapscope " + gapscope.__version__, command("--version").stdout.strip())


class Documents(InAFolder):
    def test_the_example_works_as_it_is_printed(self):
        blocks = re.findall(r"```python\n(.*?)```", (SOURCE / "docs/your_own_drive.md").read_text(), re.S)
        self.assertEqual(len(blocks), 1)
        (self.folder / "drive.yaml").write_text(YAML.read_text())
        (self.folder / "drive.csv").write_text(CSV.read_text().split("\n", 1)[1])
        os.environ["PYTHONPATH"] = str(Path(gapscope.__file__).resolve().parents[1])
        done = subprocess.run([sys.executable, "-c", blocks[0]], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("backlash 0.022", done.stdout)
        self.assertIn("<mujoco", (self.folder / "drive_03_recording.xml").read_text())

    def test_the_numbered_example_reads_a_gap(self):
        os.environ["PYTHONPATH"] = str(Path(gapscope.__file__).resolve().parents[1])
        done = subprocess.run([sys.executable, str(SOURCE / "docs/example/10_python.py"), str(CSV)],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("backlash 22.", done.stdout)


if __name__ == "__main__":
    unittest.main()
