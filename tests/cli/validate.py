"""validate.py SCHEMAS FILE...: every JSON document (*.jsonl: every line) against the schema that it names itself.

SCHEMAS has <name>.schema.json for documents of the schema "gapscope.<name>/1"; timing.json names none.
"""
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed")
    sys.exit(77)


def refuse_constant(name):
    raise ValueError(f"holds {name}, expected a number or null")


def documents(path):
    text = path.read_text()
    for part in text.splitlines() if path.suffix == ".jsonl" else [text]:
        yield json.loads(part, parse_constant=refuse_constant)


def problems(schemas, path):
    for document in documents(path):
        name = document.get("schema", "gapscope." + path.stem + "/1").split(".")[1].split("/")[0]
        schema = json.loads((schemas / (name + ".schema.json")).read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        for error in jsonschema.Draft202012Validator(schema).iter_errors(document):
            yield f"{path}: {error.json_path}: {error.message[:200]}"


def main(schemas, *files):
    found = []
    for file in files:
        try:
            found += problems(pathlib.Path(schemas), pathlib.Path(file))
        except (ValueError, OSError) as error:
            found.append(f"{file}: {error}")
    print("\n".join(found) or f"{len(files)} files are valid")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
