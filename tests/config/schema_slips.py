"""schema_slips.py FOLDER: the configurations there (*.json) with a slip of a user in each, by the schema there.

Prints a line of JSON for each slip: the configuration, what was done, the text as YAML, and whether
configuration.schema has nothing against it. Slips of every value go by its kind; those of what is written by
hand below are of rules that hold between several keys.
"""
import copy
import json
import pathlib
import re
import sys

try:
    import jsonschema
except ImportError:
    sys.exit(77)

GONE = object()


class Plain(str):
    """A scalar as it is typed, which is not what JSON would write."""


def core_value(text):
    """What YAML 1.2 (core schema) makes of a plain scalar."""
    if text in ("", "~", "null", "Null", "NULL"):
        return None
    if text in ("true", "True", "TRUE", "false", "False", "FALSE"):
        return text.lower() == "true"
    if re.fullmatch(r"[-+]?[0-9]+", text):
        return int(text)
    if re.fullmatch(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", text):
        return float(text)
    return text


def valued(node):
    if isinstance(node, dict):
        return {key: valued(item) for key, item in node.items()}
    if isinstance(node, list):
        return [valued(item) for item in node]
    return core_value(node) if isinstance(node, Plain) else node


def written(node):
    if isinstance(node, dict):
        return "{" + ", ".join(f"{json.dumps(key)}: {written(item)}" for key, item in node.items()) + "}"
    if isinstance(node, list):
        return "[" + ", ".join(map(written, node)) + "]"
    return str(node) if isinstance(node, Plain) else json.dumps(node)


def leaves(node, path=()):
    inner = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else []
    for key, item in inner:
        yield path + (key,), item
        yield from leaves(item, path + (key,))


def changed(document, path, value):
    document = copy.deepcopy(document)
    node = document
    for key in path[:-1]:
        if isinstance(node, dict) and not isinstance(node.get(key), (dict, list)):
            node[key] = {}
        node = node[key]
    if value is GONE:
        del node[path[-1]]
    else:
        node[path[-1]] = value
    return document


def renamed(document, path, key):
    document = copy.deepcopy(document)
    node = document
    for part in path[:-1]:
        node = node[part]
    node[key] = node.pop(path[-1])
    return document


def slips_of_number(value):
    yield "negative", -value if value else -1
    yield "none", 0
    yield "with a unit", Plain(f"{value} rad")
    yield "in quotes", str(value)
    yield "decimal comma", Plain(f"{value}".replace(".", ";") if "." in f"{value}" else f"{value};5")
    yield "with a fraction", value + 0.5
    yield "whole, with a point", Plain(f"{int(value)}.0")
    yield "no number", Plain("many")
    yield "a pair", [value, value]
    yield "nothing", None
    yield "far too large", 1e16


def slips_of_truth(value):
    yield "yes", Plain("yes")
    yield "True", Plain("True")
    yield "1", 1
    yield "in quotes", "true"
    yield "the other", not value


def slips_of_text(value):
    yield "misspelt", value[:-1] + "x" if len(value) > 2 else value + "x"
    yield "capital", value.capitalize()
    yield "empty", ""
    yield "nothing", None
    yield "a number", 7
    yield "a truth", True
    yield "a list", [value]


def slips_of_kind(document):
    for path, value in leaves(document):
        place = ".".join(map(str, path))
        by_kind = (slips_of_truth if isinstance(value, bool) else slips_of_number if isinstance(value, (int, float))
                   else slips_of_text if isinstance(value, str) else None)
        for what, slip in by_kind(value) if by_kind else [("empty map", {}), ("empty list", []), ("nothing", None)]:
            yield f"{place}: {what}", changed(document, path, slip)
        if isinstance(path[-1], str):
            yield f"{place}: left out", changed(document, path, GONE)
            yield f"{place}: misspelt key", renamed(document, path, path[-1][:-1])


RECORDED, SIMULATED = "03_recording", "08_missing_cogging"
SLIDE, SERVO, ARM, LOCKED = "09_slide_with_a_screw", "10_servo_of_goals", "11_joint_of_an_arm", "06_locked_output"
GEAR = ("recording.gear_ratio", {"position": 50})
INERTIA = "model.parameters.motor_inertia"
TARGET = ("recording.columns", {"target": "goal"})
BY_GAIN = ("controller", {"position": {"gain": 3}})

# Each: the configuration, and what is put where.
BY_HAND = [
    *[(RECORDED, ("name", name)) for name in ("a/b", "..", "a b", ".hidden", "-x", "ä", "a" * 101, "v1.2", Plain("true"),
                                              Plain("007"), Plain("-5"), Plain("1.5"), Plain("null"))],
    *[(RECORDED, ("recording.units", {"position": unit}))
      for unit in ("deg", "furlong", "mm", "counts", "Deg", 0, -1, 1e-3, "rad ", "0.001")],
    *[(RECORDED, ("recording.units", {"input": unit})) for unit in ("mA", "Nm", "N*m", "mN·m", "N", "amps", "%", 0, 2)],
    *[(RECORDED, ("recording.units", {"time": unit})) for unit in ("ms", "min", "us", "µs", 0)],
    (RECORDED, ("recording.units", {"load_position": "counts"})),
    (RECORDED, ("recording.units", {"load_position": "counts"}), ("encoder.side", "load")),
    (RECORDED, ("recording.units", {"position": "counts"}), ("encoder", GONE)),
    (RECORDED, ("recording.units", {"position": "counts"}), ("encoder", {"side": "motor"})),
    *[(RECORDED, ("recording.gear_ratio", {"position": ratio})) for ratio in (0, -50, 1e-7, -1e-7, 2e6, 50)],
    *[(RECORDED, ("recording.registers", {"position": bits})) for bits in (16, 16.0, 0, -1, 53, 16.5)],
    *[(RECORDED, ("recording.resample", how))
      for how in ({"rate": 500}, {"rate": 0}, {}, {"for": "detector"}, {"rate": 500, "for": "fit"}, 500)],
    *[(RECORDED, ("recording.file", files))
      for files in ([], ["a.csv"], ["a.csv", "a.csv"], [["a.csv"]], {"name": "a.csv"}, {"gain_times": 2},
                    {"name": "a.csv", "gain_times": 2}, ["a.csv", {"name": "b.csv", "gain_times": 0.5}], "", 12, True)],
    *[(RECORDED, ("recording.held_out", files)) for files in ([], "b.csv", ["b.csv", "c.csv"], {})],
    *[(RECORDED, ("recording.window", window)) for window in ([0, 5], [0], [0, 1, 2], 5, {}, [None, 5])],
    *[(RECORDED, ("recording.lost_rows", how)) for how in ("held", "bridged", "dropped", True)],
    *[(RECORDED, ("recording.columns", {"input": name})) for name in ("i_q", "Motor_temp", "coil [°C]", "temporary", 3)],
    (RECORDED, ("recording.columns.target", "goal")),
    (RECORDED, ("recording.columns", {"target": "goal"}), ("controller", {"position": {"gain": 3}})),
    (RECORDED, BY_GAIN),
    (RECORDED, TARGET, ("controller", {"position": {"gain": "estimate"}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": {"estimate": True}}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3, "derivative": "estimate"}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3, "derivative": {"estimate": True}}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3, "delay": {"value": 0.001, "estimate": True}}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": "fit"}})),
    (RECORDED, TARGET, ("controller", {"position": {}})),
    (RECORDED, TARGET, ("controller", {})),
    (RECORDED, TARGET, ("controller", {"velocity": {"gain": "estimate"}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3}, "velocity": {"gain": "estimate"}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": "estimate"}, "velocity": {"gain": 2}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3, "rate": 100}, "velocity": {"gain": 2}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3, "dead_band": 0.1}, "velocity": {"gain": 2}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": 3, "saturation": 0}})),
    (RECORDED, ("recording.columns", {"target": "g", "input": "i"}), ("controller", {"position": {"gain": "estimate"}})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": "estimate"}}), ("recording.resample", {"rate": 100})),
    (RECORDED, TARGET, ("controller", {"position": {"gain": "estimate"}}),
     ("recording.resample", {"rate": 100, "for": "detector"})),
    (RECORDED, TARGET, BY_GAIN, ("recording.file", {"name": "a.csv", "gain_times": 2})),
    (RECORDED, TARGET, BY_GAIN, ("recording.simulated", {"name": "b.csv", "gain_times": 2})),
    *[(RECORDED, ("encoder", encoder))
      for encoder in ({}, {"bits": 20, "counts": 4096}, {"quantum": 1e-6, "counts": 4096}, {"counts": 4096}, {"counts": 0},
                      {"bits": 16.0}, {"bits": 1e1}, {"bits": 16.5}, {"bits": 0}, {"quantum": 0}, {"side": "both"},
                      {"side": "arm"}, {"bits": 20, "side": "load"})],
    *[(RECORDED, (INERTIA, setting))
      for setting in ({}, {"value": 1e-3}, {"estimate": False}, {"estimate": True}, {"value": 1e-3, "estimate": True},
                      {"value": 1e-3, "bounds": [1e-4, 1e-2], "estimate": True}, {"bounds": [1e-4]}, {"bounds": 1},
                      {"value": 1e-3, "guess": True}, {"guess": True}, {"value": 1e-3, "guess": True, "estimate": True},
                      {"value": 1e-3, "estimate": True, "prior": {"std": 1e-4}},
                      {"value": 1e-3, "estimate": True, "prior": {"std": 0}},
                      {"value": 1e-3, "estimate": True, "prior": {"std": -1}},
                      {"value": 1e-3, "estimate": True, "prior": {"value": 2e-3}},
                      {"value": 1e-3, "prior": {"std": 1e-4}}, {"prior": {"std": 1e-4}},
                      {"prior": {"value": 1e-3, "std": 1e-4}}, {"estimate": False, "prior": {"value": 1e-3, "std": 1e-4}},
                      {"value": 1e-3, "given_at": "motor"}, {"value": 1e-3, "given_at": "load"},
                      {"value": 1e-3, "given_at": "gear"}, {"value": 1e-3, "unit": "kg m^2"}, GONE)],
    (RECORDED, (INERTIA, {"value": 1e-3, "given_at": "motor"}), GEAR),
    (RECORDED, ("model.parameters.mass_ratio", {"value": 1, "given_at": "load"})),
    *[(RECORDED, ("model.parameters.mass_ratio", ratio))
      for ratio in (1e-4, 1e-3, {"value": 0, "estimate": True}, {"value": 1e-4}, {"value": 1, "estimate": True, "bounds": [0, 1e-4]},
                    {"estimate": True, "bounds": [0, 5]})],
    (RECORDED, ("model.load", "locked")),
    (RECORDED, ("model.contact", {"rigid": {"restitution": 0.5}})),
    (RECORDED, ("model.contact", "rigid")),
    (RECORDED, ("model.contact", {"rigid": {}})),
    (RECORDED, ("model.contact", {"rigid": {"restitution": 1.5}})),
    (LOCKED, ("encoder.side", "load")),
    (LOCKED, ("encoder.side", "both")),
    (LOCKED, ("model.parameters.mass_ratio", 0)),
    (LOCKED, ("model.parameters.load_damping", {"value": 0.1, "estimate": True})),
    *[(RECORDED, ("model.effects", effects))
      for effects in ([{"cogging_torque": {}}], [{"cogging_torque": {"amplitude_nm": 0.01, "periods_per_turn": 24}}],
                      [{"cogging_torque": {"periods_per_turn": 24, "period_rad": 0.2}}], [{"cogging_torque": {"period_rad": 0.2}}],
                      ["cogging_torque"], [{"cogging_torque": None}], {"cogging_torque": {"periods_per_turn": 24}},
                      [{"cogging_torque": {"periods_per_turn": {"estimate": True}}}],
                      [{"cogging_torque": {"periods_per_turn": {"estimate": False}}}],
                      [{"cogging_torque": {"periods_per_turn": {}}}],
                      [{"load_unbalance": {"amplitude_nm": 0.1, "periods_per_turn": 1, "period_rad": 6.28}}],
                      [{"load_unbalance": {"amplitude_nm": 0.1}}], [{"load_unbalance": {}}], [{}], [{"actuator_lag": {}}],
                      [{"motor_coulomb_friction": {"level_nm": 0.1}, "cogging_torque": {"periods_per_turn": 6}}],
                      [{"motor_coulomb_friction": {"level": 0.1}}], [{"motor_coulomb_friction": {"level_nm": -0.1}}])],
    *[(RECORDED, ("detector", detector))
      for detector in ({"method": "paper"}, {"method": "paper", "bound": 40}, {"method": "paper", "bound": "auto"},
                       {"method": "literal"}, {"method": "literal", "bound": 40}, {"method": "literal", "bound": "auto"},
                       {"method": "impact", "bound": 40}, {"method": "lost_motion", "bound": "auto"}, {"bound": 0}, {"bound": -4},
                       {"frozen": True}, {"bound": {"from_model": {"input_limit": 0.5, "load_force_bound": 0}}},
                       {"bound": {"from_model": {"input_limit": 0.5}}}, {"bound": {}}, {"method": "magic"}, {})],
    (RECORDED, ("detector", {"bound": {"from_model": {"input_limit": 0.5, "load_force_bound": 0}}}), (INERTIA, GONE)),
    (RECORDED, ("detector", {"bound": {"from_model": {"input_limit": 0.5, "load_force_bound": 0}}}), (INERTIA, {"estimate": True})),
    *[(RECORDED, ("anchor", anchor), (INERTIA, GONE))
      for anchor in ({"mass": 1, "arm": 0.1}, {"mass": 1}, {"arm": 0.1}, {"inertia": 1e-3}, {"friction": 0.01}, {"gravity": 9.81},
                     {"mass": 1, "arm": 0.1, "inertia": 1e-3}, {"mass": 0, "arm": 0.1}, {"mass": 1, "arm": 0.1, "hangs_at": {}}, {},
                     {"mass": 1, "arm": 0.1, "hangs_at": {"estimate": True}}, {"inertia": 1e-3, "hangs_at": 0})],
    (RECORDED, ("anchor", {"inertia": 1e-3})),
    (RECORDED, ("anchor", {"mass": 1, "arm": 0.1}), GEAR),
    (RECORDED, ("anchor", {"mass": 1, "arm": 0.1}), ("model.load", "locked")),
    (ARM, ("anchor", {"mass": 1, "arm": 0.1})),
    (ARM, ("anchor", {"friction": 0.1})),
    (SLIDE, ("encoder", {"bits": 20})),
    (SLIDE, ("encoder", {"counts": 4096})),
    (SLIDE, ("anchor", {"mass": 1, "arm": 0.1})),
    (SLIDE, ("anchor", {"friction": 1})),
    (SLIDE, ("model.effects", [{"load_unbalance": {"amplitude_nm": 0.1}}])),
    (SLIDE, ("coordinates", "rotation")),
    (SLIDE, ("simulation", GONE), ("recording", {"file": "a.csv", "units": {"position": "deg"}})),
    (SLIDE, ("simulation", GONE), ("recording", {"file": "a.csv", "units": {"position": "mm", "input": "kN"}})),
    (SLIDE, ("simulation", GONE), ("recording", {"file": "a.csv", "units": {"input": "N m"}})),
    (SIMULATED, ("recording", {"file": "a.csv"})),
    (SIMULATED, ("simulation", GONE)),
    *[(SIMULATED, ("simulation.excitation", kind))
      for kind in ({"recorded": {}}, {"recorded": {"file": "a.csv"}}, {"recorded": {"file": ""}}, {"sine": {"amplitude": 1}}, {},
                   {"sine": {"amplitude": 1, "frequency": 1}, "steps": {"amplitude": 1, "hold": 0.1}}, "sine",
                   {"sine": {"amplitude": -1, "frequency": 1}}, {"sine": {"amplitude": 1, "frequency": 0}})],
    (SIMULATED, ("simulation.plant", "independent")),
    (SIMULATED, ("simulation.plant", "independent"), ("simulation.model.effects", [])),
    (SIMULATED, ("simulation.plant", "independent"), ("simulation.model.effects", GONE)),
    (SERVO, ("simulation.plant", "independent")),
    (SERVO, ("controller.position.gain", "estimate")),
    (SERVO, ("controller", GONE)),
    *[(SIMULATED, ("simulation.seed", seed)) for seed in (-1, 1.5, 2.0, 1e3, "a")],
    *[(SIMULATED, ("fit", fit)) for fit in ({}, {"starts": 0}, {"starts": 8.0}, {"loss_width": -1}, {"compare_parts": Plain("no")}, None)],
    *[(SIMULATED, ("implant", implant))
      for implant in ({}, {"known": 0}, {"known": 0, "outside": 0, "none": 0}, {"sizes": []}, {"sizes": [0]}, {"sizes": [0.1]},
                      {"sizes": 0.1}, {"effects": ["cogging"]}, {"known": -1})],
    *[(SIMULATED, ("diagnosis", told))
      for told in ({"periods_per_turn": [4]}, {"periods_per_turn": 4}, {"outside_catalogue": 1}, {"exclude": "cogging_torque"},
                   {"exclude": ["cogging_torque"]}, {"exclude": []}, {"periods": [0]})],
    *[(SIMULATED, ("tolerance", told)) for told in ({"gap": 0}, {"gap": 1e-3}, {"torque_percent": 5}, {"torque": 5})],
    *[(SIMULATED, ("next_experiment", told)) for told in ({"duration": 0}, {"input": 1, "travel": -1}, {"duration": 10})],
    # Two numbers that are compared: only the description says what they must be.
    (RECORDED, ("recording.window", [5, 0])),
    (RECORDED, ("recording.file", ["a.csv", "./a.csv"])),
    (RECORDED, ("recording.held_out", "03_recording.csv")),
    (RECORDED, ("recording.simulated", ["a.csv", "b.csv", "c.csv"])),
    (RECORDED, ("recording.columns", {"time": "a", "input": "a"})),
    (RECORDED, (INERTIA, {"value": 1, "bounds": [1e-4, 1e-2], "estimate": True})),
    (RECORDED, (INERTIA, {"value": 1e-3, "bounds": [1e-2, 1e-4], "estimate": True})),
    (SIMULATED, ("simulation.duration", 0.001)),
    (SIMULATED, ("simulation.excitation.multisine.low", 30)),
    (SIMULATED, ("simulation.excitation.multisine.high", 600)),
    (SIMULATED, ("next_experiment", {"lowest_frequency": 5, "highest_frequency": 1})),
]


def slips_by_hand(bases):
    for base, *puts in BY_HAND:
        document = bases[base]
        for place, value in puts:
            document = changed(document, place.split("."), value)
        yield base, ", ".join(f"{place} {'left out' if value is GONE else written(value)}" for place, value in puts), document


def all_slips(bases):
    for base in (RECORDED, LOCKED, SLIDE, SERVO):
        for what, document in slips_of_kind(bases[base]):
            yield base, what, document
    yield from slips_by_hand(bases)


def main(folder):
    bases = {path.stem: json.loads(path.read_text()) for path in pathlib.Path(folder).glob("*.json")}
    validator = jsonschema.Draft202012Validator(json.loads((pathlib.Path(folder) / "configuration.schema").read_text()))
    for base, what, document in all_slips(bases):
        print(json.dumps({"base": base, "slip": what, "text": written(document), "valid": validator.is_valid(valued(document))}))


if __name__ == "__main__":
    main(sys.argv[1])
