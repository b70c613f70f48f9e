"""Reads a CSV record with its two companions and prints it in the lines of tests/support/read_record.h.

usage: read_csv.py TRACE.csv [COMPANION_STEM]
"""
import csv
import json
import sys

trace = sys.argv[1]
stem = sys.argv[2] if len(sys.argv) > 2 else trace[:-len(".csv")]


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


rows = table(trace)
head, data = rows[0], rows[1:]
channels = table(stem + ".channels.csv")[1:]
assert len(head) == len(channels)
assert all(len(row) == len(head) for row in data)
for index, (path, unit, kind, low, high, doc) in enumerate(channels):
    assert head[index] == (f"{path} [{unit}]" if unit else path)
    values = ["%.17g" % float(row[index]) for row in data]
    if index == 0:
        print("\t".join(["time", *values]))
        continue
    print("\t".join(["channel", path, unit, kind, low, high, doc]))
    print("\t".join(["data", *values]))
for key, value in table(stem + ".record.csv")[1:]:
    print("\t".join(["about", key, json.dumps(value)]))
