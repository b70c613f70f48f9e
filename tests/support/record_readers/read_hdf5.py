"""Reads a record in HDF5 or MATLAB 7.3 with h5py and prints it in the lines of tests/support/read_record.h.

usage: read_hdf5.py hdf5|mat73 FILE
"""
import json
import sys

import h5py


def number(value):
    return "%.17g" % value


def line(*fields):
    print("\t".join(fields))


def channel(path, unit, kind, low, high, doc, data):
    line("channel", path, unit, kind, number(low), number(high), doc)
    line("data", *map(number, data))


def read_hdf5(file):
    def text(value):
        return value.decode() if isinstance(value, bytes) else value

    line("time", *map(number, file["time"][:]))
    assert text(file["time"].attrs["unit"]) == "s"
    for dataset in file["channels"].values():
        notes = dataset.attrs
        channel(text(notes["path"]), text(notes["unit"]), text(notes["type"]), notes["minimum"], notes["maximum"],
                text(notes["doc"]), dataset[:])
    line("about", "name", json.dumps(text(file.attrs["name"])))
    line("about", "period", json.dumps(number(file.attrs["period"])))
    line("about", "complete", json.dumps("true" if file.attrs["complete"] == 1 else "false"))
    line("about", "experiment", json.dumps(text(file["experiment"][()])))
    for key, value in file["annotations"].items():
        line("about", key, json.dumps(text(value[()])))


def read_mat73(file):
    def text(dataset):
        if dataset.attrs.get("MATLAB_empty", 0):
            return ""
        assert dataset.attrs["MATLAB_class"] == b"char"
        return dataset[:].astype("<u2").tobytes().decode("utf-16-le")

    def column(dataset):
        return [] if dataset.attrs.get("MATLAB_empty", 0) else dataset[:].ravel()

    line("time", *map(number, column(file["time"])))
    for name, group in file.items():
        if name in ("time", "record") or name.startswith("#"):
            continue
        assert group.attrs["MATLAB_class"] == b"struct"
        channel(text(group["path"]), text(group["unit"]), text(group["type"]), group["min"][0, 0], group["max"][0, 0],
                text(group["doc"]), column(group["data"]))
        line("variable", name)
    record = file["record"]
    line("about", "name", json.dumps(text(record["name"])))
    line("about", "period", json.dumps(number(record["period"][0, 0])))
    line("about", "experiment", json.dumps(text(record["experiment"])))
    for key, value in record["annotations"].items():
        line("about", key, json.dumps(text(value)))


with h5py.File(sys.argv[2], "r") as opened:
    {"hdf5": read_hdf5, "mat73": read_mat73}[sys.argv[1]](opened)
