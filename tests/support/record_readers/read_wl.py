"""Reads a record in Wolfram Language syntax and prints it in the lines of tests/support/read_record.h.

A parser of the part of the language that a record uses: associations, lists, strings, numbers and five symbols.
usage: read_wl.py FILE
"""
import json
import re
import sys

TOKEN = re.compile(r'\s*(?:(?P<mark><\||\|>|->|[{},])|(?P<string>"(?:[^"\\]|\\.)*")'
                   r'|(?P<number>-?\d+(?P<real>\.\d*`?)?(?:\*\^-?\d+)?)|(?P<symbol>-?[A-Za-z]+))', re.S)
SYMBOLS = {"True": True, "False": False, "Indeterminate": float("nan"), "Infinity": float("inf"), "-Infinity": float("-inf")}
ESCAPE = re.compile(r'\\(?::([0-9a-f]{4})|\|([0-9a-f]{6})|(.))', re.S)


def unescape(match):
    code = match[1] or match[2]
    return chr(int(code, 16)) if code else {"n": "\n", "t": "\t"}.get(match[3], match[3])


class Parser:
    def __init__(self, text):
        self.tokens = []
        place = 0
        text = text.rstrip()
        while place < len(text):
            match = TOKEN.match(text, place)
            if not match:
                raise SyntaxError(text[place:place + 40])
            self.tokens.append(match)
            place = match.end()
        self.next = 0

    def mark(self):
        return self.tokens[self.next]["mark"]

    def expect(self, mark):
        assert self.mark() == mark, (self.mark(), mark)
        self.next += 1

    def items(self, end, item):
        result = []
        while self.mark() != end:
            if result:
                self.expect(",")
            result.append(item())
        self.expect(end)
        return result

    def rule(self):
        key = self.value()
        self.expect("->")
        return key, self.value()

    def value(self):
        token = self.tokens[self.next]
        self.next += 1
        if token["mark"] == "<|":
            return dict(self.items("|>", self.rule))
        if token["mark"] == "{":
            return self.items("}", self.value)
        if token["string"]:
            return ESCAPE.sub(unescape, token["string"][1:-1])
        if token["symbol"]:
            return SYMBOLS[token["symbol"]]
        plain = token["number"].replace("`", "").replace("*^", "e")
        return float(plain) if token["real"] else int(plain)


def number(value):
    return "%.17g" % value


parser = Parser(open(sys.argv[1], encoding="ascii").read())
record = parser.value()
assert parser.next == len(parser.tokens)
columns, rows = record["columns"], record["rows"]
for index, column in enumerate(columns):
    values = [row[index] for row in rows]
    assert all(type(value) is {"double": float, "int": int, "bool": bool}[column["type"]] or value != value for value in values)
    if index == 0:
        print("\t".join(["time", *map(number, values)]))
        continue
    print("\t".join(["channel", column["path"], column["unit"], column["type"], number(column["minimum"]),
                     number(column["maximum"]), column["doc"]]))
    print("\t".join(["data", *map(number, values)]))
for key in ("name", "experiment"):
    print("\t".join(["about", key, json.dumps(record[key])]))
print("\t".join(["about", "period", json.dumps(number(record["period"]))]))
print("\t".join(["about", "complete", json.dumps("true" if record["complete"] else "false")]))
for key, value in record["annotations"].items():
    print("\t".join(["about", key, json.dumps(value)]))
