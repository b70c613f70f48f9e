// What is shown of a robot whose file says nothing of windows.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Context } from "../context.ts";
import { pitch, plotsOf, roll, slidersOf } from "../overview.ts";
import type { PortDescription } from "../protocol.ts";

const port = (trail: string, writable = false): [string, PortDescription] => [trail, { trail, unit: "", writable, minimum: null, maximum: null, doc: "" }];

function robot(mass: number): Pick<Context, "description"> {
  const body = (trail: string, parent: number, joint: string | null, own: number) => ({ trail, robot: 0, parent, joint, mass: own });
  return { description: { world: "w", scene: { terrain: {}, gravity: [0, 0, -10], bodies: [body("w.r.base", -1, null, mass), body("w.r.leg.a", 0, "revolute", 1), body("w.r.leg.b", 1, "revolute", 1)] } } } as unknown as Pick<Context, "description">;
}

// A turn of q about x and then one about y: w x y z = (cos, sin, 0, 0) and so on, of half the angle.
test("roll and pitch are angles about x and y", () => {
  const half = (angle: number) => [Math.cos(angle / 2), Math.sin(angle / 2)];
  const [c, s] = half(0.3);
  assert.ok(Math.abs(roll(c, s, 0, 0) - (0.3 * 180) / Math.PI) < 1e-9);
  assert.ok(Math.abs(pitch(c, 0, s, 0) - (0.3 * 180) / Math.PI) < 1e-9);
  assert.ok(Math.abs(roll(c, 0, 0, s)) < 1e-9 && Math.abs(pitch(c, 0, 0, s)) < 1e-9);
});

test("a robot that moves has height, speed, attitude, loads and energy; an arm its joints", () => {
  const trails = ["position.z", ..."xyz".split("").map((axis) => `velocity.${axis}`), ..."wxyz".split("").map((part) => `orientation.${part}`), "kinetic_energy", "potential_energy",
    "leg.a.angle", "leg.b.angle", "leg.a.rate", "leg.b.rate", "leg.a.contact.force.z", "leg.b.contact.force.z"];
  const ports = new Map(trails.map((trail) => port(`w.r.${trail}`)));
  const labels = (mass: number) => plotsOf(robot(mass), ports).map(({ label, traces }) => `${label} ${traces.length}`);
  assert.deepEqual(labels(1), ["Height 1", "Speed 3", "Attitude 2", "Load 1", "Energy 2"]);
  assert.deepEqual(labels(0), ["Joints 2", "Rates 2", "Load 1", "Energy 2"]);
  assert.deepEqual(plotsOf(robot(1), new Map()), []);
});

test("sliders are of what nothing else drives", () => {
  const ports = new Map([port("w.r.leg.a.torque", true), port("w.r.leg.b.torque"), port("w.pd.goal", true), port("w.pd.pconstant", true)]);
  const groups = slidersOf(robot(4), ports);
  assert.deepEqual(groups.map(({ label, sliders }) => [label, sliders.map((each) => each.trail)]), [["Goals", ["w.pd.goal"]], ["Drives", ["w.r.leg.a.torque"]]]);
  assert.deepEqual(groups[1].sliders[0].range, [-30, 30]); // half of 6 kg under 10 m/s^2, in newton metres
});
