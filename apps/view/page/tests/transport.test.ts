import assert from "node:assert/strict";
import { test } from "node:test";
import { neighbouringSpeed } from "../transport.ts";

test("faster ends at as fast as possible, slower at a thousandth", () => {
  assert.equal(neighbouringSpeed(1, 1), 2);
  assert.equal(neighbouringSpeed(1, -1), 0.5);
  assert.equal(neighbouringSpeed(1000, 1), 0);
  assert.equal(neighbouringSpeed(0, 1), 0);
  assert.equal(neighbouringSpeed(0, -1), 1000);
  assert.equal(neighbouringSpeed(0.001, -1), 0.001);
  assert.equal(neighbouringSpeed(3, 1), 5);
  assert.equal(neighbouringSpeed(3, -1), 2);
});
