import assert from "node:assert/strict";
import { test } from "node:test";
import { decimalsOfRange, decimalsOfTime, engineering, formatDecimals, formatMultiples, formatNumber, formatSpeed, formatUnit, parseNumber, spansDecades } from "../numbers.ts";

test("numbers keep their digits, so that they stay in their place", () => {
  const shown: [number, string][] = [
    [1, "1.0000"], [-1.23456789, "\u22121.2346"], [99999.6, "100000"], [123456.7, "123457"], [0, "0.0000"], [-0, "0.0000"],
    [1234567, "1.2346e6"], [0.000123456, "1.2346e\u22124"], [0.001, "0.0010000"], [-2e-9, "\u22122.0000e\u22129"],
    [NaN, "\u2013"], [Infinity, "\u221e"], [-Infinity, "\u2212\u221e"],
  ];
  for (const [value, text] of shown) assert.equal(formatNumber(value), text);
  assert.equal(formatNumber(3.14159, 3), "3.14");
});

test("a slider shows about a thousand steps of its range", () => {
  assert.equal(decimalsOfRange(-3.2, 3.2), 3);
  assert.equal(decimalsOfRange(100, 60000), 0);
  assert.equal(decimalsOfRange(0, 0.01), 5);
  assert.equal(decimalsOfRange(0, 0), 3);
});

test("time has a decimal for each step", () => {
  assert.equal(decimalsOfTime(0.001), 3);
  assert.equal(decimalsOfTime(0.0005), 4);
  assert.equal(decimalsOfTime(1e-9), 6);
  assert.equal(decimalsOfTime(1), 0);
  assert.equal(formatDecimals(-0.0001, 3), "0.000");
  assert.equal(formatDecimals(-1.5, 3), "\u22121.500");
});

test("what is shown can be typed", () => {
  const typed: [string, number | null][] = [
    ["1.5", 1.5], [" \u22121.5 ", -1.5], ["1e-3", 0.001], ["0,5", 0.5], ["", null], ["abc", null], ["1.5 m", null], ["Infinity", null],
  ];
  for (const [text, value] of typed) assert.equal(parseNumber(text), value);
});

test("units and speeds", () => {
  assert.equal(formatUnit("N.m.s/rad"), "N\u00b7m\u00b7s/rad");
  assert.equal(formatUnit("m/s^2"), "m/s\u00b2");
  assert.equal(formatSpeed(0.001), "1/1000");
  assert.equal(formatSpeed(10), "10");
  assert.equal(formatSpeed(0), "as fast as possible");
});

test("a range of three decades above 0 spans decades", () => {
  assert.equal(spansDecades(1, 1e6), true);
  assert.equal(spansDecades(0.001, 1), true);
  assert.equal(spansDecades(1, 999), false);
  assert.equal(spansDecades(0, 1e6), false);
  assert.equal(spansDecades(-1e6, 1e6), false);
});

const numberOf = (label: string) => Number(label.replaceAll("\u2212", "-"));

test("multiples have the decimals that their distance takes", () => {
  assert.deepEqual(formatMultiples([0, 0.25, 0.5, 0.75]), ["0", "0.25", "0.50", "0.75"]);
  assert.deepEqual(formatMultiples([-0.5, 0, 0.5]), ["\u22120.5", "0", "0.5"]);
  assert.deepEqual(formatMultiples([0, 20, 40]), ["0", "20", "40"]);
  assert.deepEqual(formatMultiples([2.5, 5, 7.5]), ["2.5", "5.0", "7.5"]);
  assert.deepEqual(formatMultiples([0, 0.00001, 0.00002]), ["0", "1e\u22125", "2e\u22125"]);
  assert.deepEqual(formatMultiples([100000, 150000]), ["1.0e5", "1.5e5"]);
  assert.deepEqual(formatMultiples([null, 5]), ["", "5"]);
});

// What an axis says is where its line is: for all distances that an axis may have, over 30 decades.
test("every tick is the number of its label", () => {
  let state = 1;
  const random = (below: number) => (state = (state * 48271) % 2147483647) % below; // Park and Miller
  for (let power = -15; power <= 15; ++power)
    for (const mantissa of [1, 2, 2.5, 5])
      for (let round = 0; round < 40; ++round) {
        const distance = Number(`${mantissa}e${power}`);
        const first = random(round < 20 ? 20 : 4000) - (round < 20 ? 10 : 2000);
        const ticks = Array.from({ length: 3 + random(6) }, (_, i) => (first + i) * distance);
        const labels = formatMultiples(ticks);
        labels.forEach((label, i) => {
          assert.ok(Math.abs(numberOf(label) - ticks[i]) <= 1e-9 * distance, `${ticks[i]} is called ${label}, ${distance} apart`);
        });
        assert.equal(new Set(labels).size, ticks.length, labels.join(" "));
      }
});

test("small values are read in the prefix that fits, where the unit takes one", () => {
  const read = (value: number, unit: string) => {
    const found = engineering(Math.abs(value), unit);
    return `${Number((value / found.factor).toPrecision(4))} ${found.unit}`.trim();
  };
  const shown: [number, string, string][] = [
    [3.174e-5, "m", "31.74 \u00b5m"], [-1.2e-5, "m", "-12 \u00b5m"], [0.001283, "m", "1.283 mm"], [0.05, "m", "0.05 m"], [6.8e-12, "m", "6.8 pm"],
    [4e-3, "m/s", "4 mm/s"], [2e-7, "N.m", "200 nN\u00b7m"], [1e-3, "N", "1 mN"], [0, "m", "0 m"], [5e-14, "m", "0.05 pm"],
    [1e-4, "rad", "0.0001 rad"], [1e-4, "m^2", "0.0001 m\u00b2"], [1e-4, "kg", "0.0001 kg"], [1e-4, "min", "0.0001 min"], [1e-4, "", "0.0001"],
  ];
  for (const [value, unit, text] of shown) assert.equal(read(value, unit), text);
  assert.equal(engineering(NaN, "m").factor, 1);
});
