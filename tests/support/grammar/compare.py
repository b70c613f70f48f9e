"""Colours files as an editor would and holds the colours against what the language's own lexer and parser say.

compare.py GRAMMAR LIST: each line of LIST is the path of a file and that of a table with a line a token, `offset length class`.
Carries out the part of TextMate grammars that this one uses: match with captures, and begin/end, line by line. Ends with status 1
and a line a disagreement.
"""
import json
import re
import sys

CLASSES = [  # the first scope that fits
    ("comment", "comment"), ("string", "string"), ("constant.character", "string"), ("constant.numeric", "number"),
    ("keyword.other.unit", "number"), ("keyword.control", "keyword"), ("entity.name.type", "type"),
    ("entity.name.tag", "name"), ("variable.other.property", "field")]


def class_of(scope):
    return next((kind for start, kind in CLASSES if scope.startswith(start)), "other")


class Rule:
    def __init__(self, rule):
        self.kind = class_of(rule["name"]) if "name" in rule else None
        self.match = re.compile(rule.get("match") or rule["begin"], re.ASCII)
        self.end = re.compile(rule["end"], re.ASCII) if "end" in rule else None
        self.captures = {int(k): class_of(v["name"]) for k, v in rule.get("captures", {}).items()}
        self.inner = [Rule(inner) for inner in rule.get("patterns", [])]


def colour_line(line, rules, inside):
    """The class of each character of the line, and the rule that it leaves open."""
    kinds, at = ["other"] * len(line), 0

    def paint(begin, end, kind):
        kinds[begin:end] = [kind] * (end - begin)

    while at <= len(line):
        candidates = inside.inner if inside else rules
        found = [(m.start(), i, r, m) for i, r in enumerate(candidates) if (m := r.match.search(line, at))]
        first = min(found, default=None, key=lambda f: f[:2])
        closing = inside.end.search(line, at) if inside else None
        if closing and (first is None or closing.start() <= first[0]):
            paint(at, closing.end(), inside.kind)
            at, inside = closing.end(), None
            if closing.end() == len(line):
                return kinds, None
            continue
        if inside:
            paint(at, first[0] if first else len(line), inside.kind)
        if first is None:
            return kinds, inside
        start, _, rule, found_match = first
        if rule.kind:
            paint(start, found_match.end(), rule.kind)
        for group, kind in rule.captures.items():
            if found_match.group(group) is not None:
                paint(*found_match.span(group), kind)
        if rule.end:
            inside = rule
        at = max(found_match.end(), at + (found_match.end() == at))
    return kinds, inside


def colour(text, rules):
    kinds, inside = [], None
    for line in text.split("\n"):
        coloured, inside = colour_line(line, rules, inside)
        kinds += coloured + ["other"]
    return kinds


def disagreements(path, table, rules):
    raw = open(path, "rb").read()
    text = raw.decode("latin-1")  # a character a byte: offsets are in bytes
    kinds = colour(text, rules)
    for line in open(table):
        offset, length, wanted = line.split()
        begin, end = int(offset), int(offset) + int(length)
        got = {kinds[i] for i in range(begin, end) if not text[i].isspace()}
        if got - {wanted}:
            number = text.count("\n", 0, begin) + 1
            yield f"{path}:{number}: `{text[begin:end]}` is a {wanted}, coloured as {', '.join(sorted(got))}"


def main(grammar, listing):
    rules = [Rule(rule) for rule in json.load(open(grammar))["patterns"]]
    wrong = [line for pair in open(listing) for line in disagreements(*pair.rstrip("\n").split("\t"), rules)]
    print("\n".join(wrong[:20]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
