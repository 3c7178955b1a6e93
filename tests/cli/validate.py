"""validate.py SCHEMAS FILE...: every JSON document (*.jsonl: every line) against the schema that it names itself.

SCHEMAS has <name>.schema.json for documents of the schema "gapscope.<name>/1"; timing.json names none.
A FILE may be a folder, whose documents are results of the present version: each must hold the version and the
configuration that it was made from. The SHA-256 beside a configuration must be that of its text.
"""
import functools
import hashlib
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed")
    sys.exit(77)

# Made on the way to a result, or with what would give the labels of a blind check away.
NO_CONFIGURATION = ("files", "timing", "blind_manifest", "blind_answers")
MAY_BE_NULL = ("blind", "blind_labels")  # of own recordings, whose sheets are sealed instead


def refuse_constant(name):
    raise ValueError(f"holds {name}, expected a number or null")


def documents(path):
    text = path.read_text()
    for part in text.splitlines() if path.suffix == ".jsonl" else [text]:
        yield json.loads(part, parse_constant=refuse_constant)


@functools.lru_cache(maxsize=None)
def validator(path):
    schema = json.loads(path.read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def missing(name, document):
    if name not in ("timing", "blind_labels") and "version" not in document:
        yield "the version is missing"
    if name not in NO_CONFIGURATION and document.get("configuration") is None:
        if name not in MAY_BE_NULL or "configuration" not in document:
            yield "the configuration is missing"


def wrong_hash(document):
    made = document.get("configuration")
    if made and hashlib.sha256(made["resolved"].encode()).hexdigest() != made["sha256"]:
        yield "configuration.sha256 is not that of configuration.resolved"


def problems(schemas, path, complete):
    for document in documents(path):
        name = document.get("schema", "gapscope." + path.stem + "/1").split(".")[1].split("/")[0]
        for error in validator(schemas / (name + ".schema.json")).iter_errors(document):
            yield f"{path}: {error.json_path}: {error.message[:200]}"
        head = name != "stream" or document.get("kind") == "settings"
        for what in [*wrong_hash(document), *(missing(name, document) if complete and head else [])]:
            yield f"{path}: {what}"


def below(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".json", ".jsonl"))


def main(schemas, *files):
    found, count = [], 0
    for given in map(pathlib.Path, files):
        for path in below(given) if given.is_dir() else [given]:
            count += 1
            try:
                found += problems(pathlib.Path(schemas), path, complete=given.is_dir())
            except (ValueError, OSError) as error:
                found.append(f"{path}: {error}")
    print("\n".join(found) or f"{count} files are valid")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
