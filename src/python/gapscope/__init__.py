"""gapscope: the backlash gap and the sim-to-real gap of a drive with a single motor encoder.

Each function is a command of that name and answers with the same bytes:

    check      what a recording is worth: look before you estimate
    detect     the gap from the encoder, without a model
    fit        the parameters of a model of the drive
    run        both, and their comparison
    diagnose   why the simulated drive does not move like the real one
    export     the fitted drive for MuJoCo, C, URDF, SDF, Isaac Lab or BAM

A *configuration* is the path of a YAML, YAML itself (a text with a line break) or a dict of the same keys; of a text
or a dict, paths are relative to the current folder. A *recording* is the file that it names, or arrays:

    {"time": t, "input": u, "position": x1}

each of shape (n,), by the keys of ``recording: columns:`` (also load_position, voltage, target) and in the units that
the configuration declares: s, the unit of u, rad (m with ``coordinates: translation``) where it declares none. A key
"name" may give the name of the file that the arrays stand for. Several recordings are a list.

What is wrong with the input is a ValueError, "file:line: what is wrong, what was expected"; Ctrl-C raises
KeyboardInterrupt within a step of the work, other threads run on meanwhile. Of several calls in one process one works
at a time: each takes all cores. Nothing is printed unless `progress` asks for it, and nothing written without `output`.
"""

import contextlib
import json
import os
import sys
import tempfile
from collections.abc import Mapping

import numpy

from . import _gapscope

__all__ = ["check", "detect", "fit", "run", "diagnose", "export", "Result", "Export", "MODES", "FORMATS"]
__version__ = _gapscope.version

#: What the numbers in the columns ``mode`` and ``fit_mode`` of a trace mean.
MODES = {-1: "engagement-", 0: "gap", 1: "engagement+", 2: "impact", 3: "one_body"}
#: What `export` can write, each with a line of what it is.
FORMATS = dict(_gapscope.formats)


class Result(dict):
    """What a command found: its JSON as a dict (SI, units in the keys, None where a number is not known).

    json       the bytes of that JSON as the command writes them, as str
    traces     {"traces/1_drive.csv": {"t_s": (n,), "u": (n,), "x1_rad": (n,), "e_x_rad": (n,), ...}}: float64 arrays
               by the names of the JSON and the columns of the files, modes as int8 (see MODES); of a diagnosis what
               was held out, with torque_before_nm and torque_after_nm, the torque that the model leaves [N m]
    files      the texts that the command would put into its folder, {"fitted.yaml": bytes, ...}
    warnings   what the command would warn of, a list of str
    bound_map  of the detector, (columns of time, bounds): |e_x| over its floor; None where there is none
    """

    def __init__(self, told):
        self.json = told["json"].decode()
        super().__init__(json.loads(self.json))
        self.traces = told["traces"]
        self.files = told["files"]
        self.warnings = told["warnings"]
        self.bound_map = told["bound_map"]

    @property
    def tables(self):
        """The files that are tables (compensation_<law>.csv, next_experiment.csv): {name: {column: (n,)}}."""
        return {name: _table(text.decode()) for name, text in self.files.items() if name.endswith(".csv")}


class Export(dict):
    """A drive for a simulator: {file name: bytes}, certificate.md and certificate.json among them.

    certificate  the latter as a dict
    warnings     a list of str
    """

    def __init__(self, told):
        super().__init__(told["files"])
        self.certificate = json.loads(self["certificate.json"])
        self.warnings = told["warnings"]


def check(configuration=None, recording=None, *, purpose="all", which=0, settings=None, axis=None, progress=None):
    """What a recording is worth: one finding for each question put to it.

    configuration  as in the module's text, or the path of a recording itself; nothing of it counts but recording:,
                   encoder: and coordinates:
    recording      arrays in place of its files
    purpose        what it is judged for: "all", "gap", "fit" or "diagnosis"
    which          of several recordings, counted from 0, those held out behind those that are fitted
    settings       {"recording.gear_ratio.position": 50}: values in place of the configuration's
    axis           of a machine with several: what {axis} in its columns stands for
    progress       True: what begins is told on standard error; or a callable that is told it

    Returns a Result with "spoilt", "findings" and "facts" (`gapscope check --json`); files["report.txt"] is what the
    command prints.
    """
    if isinstance(configuration, (str, os.PathLike)) and recording is None and not _is_yaml(configuration):
        configuration = {"name": "check", "recording": {"file": os.fspath(configuration)}}
    with _asked(configuration, settings, axis, recording) as asked:
        return Result(_gapscope.check(asked, purpose, which, _told(progress)))


def detect(configuration=None, recording=None, *, output=None, svg=False, settings=None, axis=None, progress=None):
    """The model-free detector alone: the gap from the encoder; ["model_free"] is its answer. As `run`."""
    return _estimate(True, False, configuration, recording, output, svg, settings, axis, progress)


def fit(configuration, recording=None, *, output=None, svg=False, settings=None, axis=None, progress=None):
    """The fit of a model alone: parameters of the drive; ["reference"] is its answer. As `run`."""
    return _estimate(False, True, configuration, recording, output, svg, settings, axis, progress)


def run(configuration, recording=None, *, output=None, svg=False, settings=None, axis=None, progress=None):
    """Both estimators and their comparison.

    configuration  as in the module's text; with arrays its recording: needs no file
    recording      arrays in place of its files
    output         folder to write the command's report into; whatever else is in it is refused
    svg            figures of the report also as SVG
    settings       {"model.parameters.gap": 0.02}: values in place of the configuration's (--set)
    axis           of a machine with several: what {axis} in its columns stands for
    progress       True: what begins is told on standard error; or a callable that is told it

    Returns a Result (result.json).
    """
    return _estimate(True, True, configuration, recording, output, svg, settings, axis, progress)


def diagnose(configuration, recording=None, held_out=None, simulated=None, *, exclude=(), threads=0, output=None,
             svg=False, settings=None, axis=None, progress=None):
    """What the simulation of a drive lacks, from recordings of it.

    configuration, recording, output, svg, settings, axis, progress   as `run`
    held_out    arrays on which it is judged, in place of recording: held_out
    simulated   what your simulator answers to the recorded input: arrays (time, position; input where it has one), or
                the paths of such files; one for each recording, then one for each that is held out, or none of these
    exclude     names of effects that are no candidates
    threads     0: all cores; the answer does not depend on it

    Returns a Result (diagnosis.json). Ctrl-C ends it with KeyboardInterrupt and nothing.
    """
    arrays, paths = (None, simulated) if _are_paths(simulated) else (simulated, ())
    with _asked(configuration, settings, axis, recording, held_out, arrays) as asked:
        told = _gapscope.diagnose(asked, list(exclude), [os.fspath(p) for p in _listed(paths)], threads,
                                  os.fspath(output or ""), svg, _told(progress))
    return Result(_of_folder(told, output, "diagnosis.json"))


def export(model, to, *, output=None, settings=None, progress=None):
    """The drive for a simulator, with a certificate of what the format can say of it.

    model   a Result of fit, run or diagnose; a report folder; or a configuration
    to      one of FORMATS: "mjcf", "c", "urdf", "sdf", "isaac", "bam"
    output  folder to write the files into

    Returns an Export: {file name: bytes}.
    """
    with contextlib.ExitStack() as stack:
        if isinstance(model, Result):
            model = _stored_model(model, stack.enter_context(tempfile.TemporaryDirectory()))
        elif not isinstance(model, Mapping) and not _is_text(model):
            model = _gapscope.exported_configuration(os.fspath(model))
        asked = stack.enter_context(_asked(model, settings, None))
        return Export(_gapscope.export(asked, to, os.fspath(output or ""), _told(progress)))


def _estimate(model_free, reference, configuration, recording, output, svg, settings, axis, progress):
    with _asked(configuration, settings, axis, recording) as asked:
        told = _gapscope.estimate(asked, model_free, reference, os.fspath(output or ""), svg, _told(progress))
    return Result(_of_folder(told, output, "result.json"))


@contextlib.contextmanager
def _asked(configuration, settings, axis, recording=None, held_out=None, simulated=None):
    """The question, while the files that its arrays stand for are there; messages do not tell where."""
    given = [_recordings(arrays, name) for arrays, name in
             ((recording, "recording"), (held_out, "held_out"), (simulated, "simulated"))]
    text, file = _source(configuration)
    laid = [(key, _yaml(value)) for key, value in (settings or {}).items()]
    with tempfile.TemporaryDirectory(prefix="gapscope-") if any(given) else contextlib.nullcontext("") as folder:
        try:
            yield _gapscope.Asked(text, file, laid, folder, axis or "", *given)
        except ValueError as error:
            if not folder or folder not in str(error):
                raise
            raise ValueError(str(error).replace(folder + "/", "")) from None


def _is_text(configuration):
    return isinstance(configuration, str) and "\n" in configuration


def _is_yaml(configuration):
    return _is_text(configuration) or os.fspath(configuration).endswith((".yaml", ".yml"))


def _source(configuration):
    """The text of a configuration, "" where it is in a file; and the name of that file."""
    if configuration is None or isinstance(configuration, Mapping):
        return _yaml(configuration or {}, indent=1), "configuration.yaml"
    if _is_text(configuration):
        return configuration, "configuration.yaml"
    return "", os.fspath(configuration)


def _yaml(value, indent=None):
    """A Python value as YAML, of which JSON is a part."""
    def plain(other):
        if isinstance(other, os.PathLike):
            return os.fspath(other)
        if isinstance(other, (numpy.ndarray, numpy.generic)):
            return other.tolist()
        raise TypeError(f"a configuration holds {other!r}, expected numbers, texts, lists and dicts")
    return json.dumps(value, indent=indent, default=plain, ensure_ascii=False)


def _listed(one_or_several):
    if one_or_several is None:
        return []
    return list(one_or_several) if isinstance(one_or_several, (list, tuple)) else [one_or_several]


def _are_paths(given):
    return all(isinstance(one, (str, os.PathLike)) for one in _listed(given))


def _recordings(given, name):
    """[(name of the file, {key: float64 array})]"""
    recordings = []
    for number, columns in enumerate(_listed(given), 1):
        if not isinstance(columns, Mapping):
            raise ValueError(f'{name} is {type(columns).__name__}, expected arrays: {{"time": t, "input": u, ...}}')
        stands_for = columns.get("name", f"{name}.csv" if number == 1 else f"{name}_{number}.csv")
        if not stands_for.endswith(".csv") or os.path.basename(stands_for) != stands_for or '"' in stands_for:
            raise ValueError(f"{name} has the name {stands_for!r}, expected that of a CSV without a folder")
        arrays = {key: _array(stands_for, key, values) for key, values in columns.items() if key != "name"}
        if len({len(array) for array in arrays.values()}) > 1:
            lengths = ", ".join(f"{key} {len(array)}" for key, array in arrays.items())
            raise ValueError(f"{stands_for}: columns differ in length ({lengths}), expected one for all")
        recordings.append((stands_for, arrays))
    return recordings


def _array(name, key, values):
    try:
        array = numpy.ascontiguousarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: {key}: {error}, expected numbers of shape (n,)") from None
    if array.ndim != 1 or numpy.ndim(values) != 1:
        raise ValueError(f"{name}: {key} has the shape {numpy.shape(values)}, expected (n,)")
    wrong = numpy.flatnonzero(~numpy.isfinite(array))
    if wrong.size:
        raise ValueError(f"{name}: {key}[{wrong[0]}] is {array[wrong[0]]}, expected finite numbers")
    return array


def _told(progress):
    if progress is True:
        return lambda what: print(what, "...", file=sys.stderr)
    return progress or None


def _of_folder(told, output, result):
    """What was told, with the texts as they stand in the folder where there is one."""
    if output:
        names = [name for name in os.listdir(output) if name.endswith((".yaml", ".csv"))]
        told["files"] = {name: _bytes(os.path.join(output, name)) for name in sorted(names)}
        told["json"] = _bytes(os.path.join(output, result))
    return told


def _bytes(path):
    with open(path, "rb") as file:
        return file.read()


def _stored_model(result, folder):
    """fitted.yaml of a result in a folder, with the trace whose input it is run under."""
    if "fitted.yaml" not in result.files:
        raise ValueError("the result holds no fitted model, expected that of fit, run or diagnose")
    path = os.path.join(folder, "fitted.yaml")
    with open(path, "wb") as file:
        file.write(result.files["fitted.yaml"])
    os.mkdir(os.path.join(folder, "traces"))
    for name, columns in result.traces.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write("t_s,u\n")
            file.writelines(f"{t!r},{u!r}\n" for t, u in zip(columns["t_s"].tolist(), columns["u"].tolist()))
    return path


def _table(text):
    names, *rows = [line.split(",") for line in text.splitlines()]
    numbers = [[float(cell) if cell else numpy.nan for cell in row] for row in rows]
    return dict(zip(names, numpy.array(numbers, dtype=float).reshape(len(rows), len(names)).T))
