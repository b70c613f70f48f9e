// What engines in JavaScript share: the frames of docs/engine_protocol.md, and vectors.
import fs from "node:fs";

/** An experiment, or a step, that the engine does not take; the message says why. */
export class Refusal extends Error {}

/** The module of an npm package; where it is not installed, says so and ends. */
export async function module_of(name) {
  try {
    return await import(name);
  } catch (error) {
    fs.writeSync(2, `the npm package ${name} is not installed\n`);
    process.exit(3);
  }
}

function read(count) {
  const bytes = Buffer.alloc(count);
  for (let done = 0; done < count;) {
    const more = fs.readSync(0, bytes, done, count - done, null);
    if (more === 0) process.exit(0);
    done += more;
  }
  return bytes;
}

function write(kind, payload) {
  const frame = Buffer.alloc(5 + payload.length);
  frame.writeUInt32LE(payload.length, 0);
  frame.write(kind, 4, "latin1");
  payload.copy(frame, 5);
  for (let done = 0; done < frame.length;) done += fs.writeSync(1, frame, done);
}

const write_json = message => write("J", Buffer.from(JSON.stringify(message)));

/**
 * Answers until the input ends. `hello`: name, version, precision, settings, gaps. `open(experiment)`: a
 * world with `step(torques, loads, states)`, which appends the numbers of one step to `states`, and `close()`.
 * A load: {body, point, force, torque}.
 */
export function serve(hello, open) {
  console.log = console.error;  // the standard output is the protocol's
  let experiment = null, world = null;
  const start = () => {
    world?.close();
    world = null;
    world = open(experiment);
    write_json({type: "ready"});
  };
  for (;;) {
    const head = read(5);
    const payload = read(head.readUInt32LE(0));
    try {
      if (head.toString("latin1", 4) === "D") {
        const numbers = new Float64Array(payload.buffer.slice(payload.byteOffset, payload.byteOffset + payload.length));
        const joints = experiment.joints.length, torques = numbers.subarray(1, 1 + joints), loads = [];
        for (let at = 1 + joints; at < numbers.length; at += 10) {
          const part = from => Array.from(numbers.subarray(at + from, at + from + 3));
          loads.push({body: numbers[at], point: part(1), force: part(4), torque: part(7)});
        }
        const states = [];
        for (let i = 0; i < numbers[0]; ++i) world.step(torques, loads, states);
        write("D", Buffer.from(new Float64Array(states).buffer));
        continue;
      }
      const message = JSON.parse(payload.toString());
      if (message.type === "hello") {
        write_json({type: "hello", protocol: 1, ...hello});
      } else {
        if (message.type === "experiment") experiment = message;
        if (!hello.settings.some(setting => setting.name === experiment.settings))
          throw new Refusal(`there are no settings ${experiment.settings}`);
        start();
      }
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      write_json({type: head.toString("latin1", 4) === "D" ? "failed" : "refused", reason: error.message});
    }
  }
}

export const gap = (feature, handling, instead) => ({feature, handling, instead});

export const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (s, a) => [s * a[0], s * a[1], s * a[2]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Quaternions are w, x, y, z. */
export const conjugate = q => [q[0], -q[1], -q[2], -q[3]];
export const times = (p, q) => [
  p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
  p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3], p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1]];
export function rotated(q, a) {
  const u = [q[1], q[2], q[3]], t = scaled(2, cross(u, a));
  return plus(plus(a, scaled(q[0], t)), cross(u, t));
}
/** The shortest turn from z to the unit vector n. */
export function turn_to(n) {
  const length = Math.sqrt(2 * (1 + n[2]));
  return length > 1e-9 ? [length / 2, -n[1] / length, n[0] / length, 0] : [0, 1, 0, 0];
}

/** Axes of a symmetric matrix xx, yy, zz, xy, xz, yz as a turn, and its values along them, by Jacobi's rotations. */
export function principal(inertia) {
  const [xx, yy, zz, xy, xz, yz] = inertia;
  const a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 30; ++sweep)
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(a[p][q]) < 1e-300) continue;
      const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.sqrt(theta * theta + 1)), c = 1 / Math.sqrt(t * t + 1), s = t * c;
      for (let k = 0; k < 3; ++k) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
      for (let k = 0; k < 3; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
      for (let k = 0; k < 3; ++k) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
    }
  const axis = k => [v[0][k], v[1][k], v[2][k]], third = cross(axis(0), axis(1));
  return {values: [a[0][0], a[1][1], a[2][2]], turn: quaternion_of([axis(0), axis(1), third])};
}
/** Of the turn that takes x, y, z to these three axes. */
export function quaternion_of([x, y, z]) {
  const squares = [1 + x[0] + y[1] + z[2], 1 + x[0] - y[1] - z[2], 1 - x[0] + y[1] - z[2], 1 - x[0] - y[1] + z[2]];
  const largest = squares.indexOf(Math.max(...squares)), r = 2 * Math.sqrt(squares[largest]);
  const [yz, zx, xy] = [y[2] - z[1], z[0] - x[2], x[1] - y[0]], [s_xy, s_xz, s_yz] = [x[1] + y[0], x[2] + z[0], y[2] + z[1]];
  return [[r / 4, yz / r, zx / r, xy / r], [yz / r, r / 4, s_xy / r, s_xz / r],
          [zx / r, s_xy / r, r / 4, s_yz / r], [xy / r, s_xz / r, s_yz / r, r / 4]][largest];
}

/** Of a point, which has no size: the radius of the ball in its place, and how far the ground is lowered for it [m]. */
export const point_radius = 1e-3;

/** Constants of the contact of a collider with a piece of ground. */
export function contact_of(experiment, foot, ground) {
  return experiment.contacts.find(contact => contact.foot === foot && contact.ground === ground);
}
/** The one material of all ground; refuses several. */
export function one_ground(experiment) {
  const materials = new Set(experiment.ground.map(piece => piece.material));
  if (materials.size > 1) throw new Refusal("this engine's contacts know one material of the ground");
  return materials.size === 1 ? [...materials][0] : -1;
}
