#!/usr/bin/env python3
"""validate.py TRANSCRIPT SCHEMAS: checks each hello and experiment of a transcript against its JSON Schema.

Knows the keywords that those schemas use, and fails on another: a rule that nobody checks would look like one that holds.
"""
import json
import sys
from pathlib import Path

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "number": (int, float), "integer": int}
KNOWN = {"$schema", "title", "$defs", "$ref", "type", "const", "enum", "required", "properties", "additionalProperties", "items", "minItems",
         "maxItems", "minimum", "exclusiveMinimum"}


def check(value, schema, root, place):
    unknown = set(schema) - KNOWN
    assert not unknown, f"the schema uses {unknown}"
    if "$ref" in schema:
        return check(value, root["$defs"][schema["$ref"].rsplit("/", 1)[1]], root, place)
    if "type" in schema:
        kind = TYPES[schema["type"]]
        assert isinstance(value, kind) and (kind is bool or not isinstance(value, bool)), f"{place} is no {schema['type']}"
    assert "const" not in schema or value == schema["const"], f"{place} is {value}"
    assert "enum" not in schema or value in schema["enum"], f"{place} is {value}"
    assert "minimum" not in schema or value >= schema["minimum"], f"{place} is {value}"
    assert "exclusiveMinimum" not in schema or value > schema["exclusiveMinimum"], f"{place} is {value}"
    if isinstance(value, list):
        assert schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)), f"{place} has {len(value)} items"
        for i, item in enumerate(value):
            check(item, schema.get("items", {}), root, f"{place}[{i}]")
    if isinstance(value, dict):
        for name in schema.get("required", []):
            assert name in value, f"{place} lacks {name}"
        others = schema.get("additionalProperties", {})
        for name, member in value.items():
            rule = schema.get("properties", {}).get(name, others)
            assert rule is not False, f"{place} has {name}"
            check(member, rule if isinstance(rule, dict) else {}, root, f"{place}.{name}")


count = 0
for line in Path(sys.argv[1]).read_text(encoding="utf-8").splitlines():
    message = json.loads(line[4:]) if line[2] == "J" else {}
    if (line[0], message.get("type")) in {("<", "hello"), (">", "experiment")}:
        schema = json.loads((Path(sys.argv[2]) / f"{message['type']}.schema.json").read_text(encoding="utf-8"))
        check(message, schema, schema, message["type"])
        count += 1
print(f"{count} messages fit")
