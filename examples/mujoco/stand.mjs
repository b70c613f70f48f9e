// A robot of an MJCF file stands in MuJoCo 3.14 with the servos of its keyframe; how deep its feet penetrate and how fast they creep.
//   cd configs/engines && npm ci          (once: MuJoCo of npm)
//   node examples/mujoco/stand.mjs ROBOT.xml [SLOPE in degrees] [KEYFRAME]
// The model has its ground itself. On a slope, gravity is tilted towards +x instead of the ground. Answers on one line of JSON: mm, mm/s and N.
import {readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {dirname, join} from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const installed = createRequire(join(here, "../../configs/engines/package.json"));
const mujoco = await (await import(pathToFileURL(installed.resolve("@mujoco/mujoco")))).default();

const [file, slope = "0", keyframe = "0"] = process.argv.slice(2);
const settle = 3, judged = 2;  // s
const model = mujoco.MjModel.from_xml_string(readFileSync(file, "utf8"));
const data = new mujoco.MjData(model);
mujoco.mj_resetDataKeyframe(model, data, Number(keyframe));
const angle = Number(slope) * Math.PI / 180, weight = Math.hypot(...model.opt.gravity);
model.opt.gravity[0] = weight * Math.sin(angle);
model.opt.gravity[2] = -weight * Math.cos(angle);

/** Of each geometry that touches the ground: depth [m], load [N], place [m]. */
function feet() {
  const found = new Map(), six = new mujoco.DoubleBuffer(6), contacts = data.contact;
  for (let i = 0; i < data.ncon; ++i) {
    const contact = contacts.get(i);
    const geometry = model.geom_bodyid[contact.geom1] === 0 ? contact.geom2 : contact.geom1;
    mujoco.mj_contactForce(model, data, i, six);
    found.set(geometry, {depth: -contact.dist, load: six.GetView()[0], place: Array.from(data.geom_xpos.subarray(3 * geometry, 3 * geometry + 2))});
    contact.delete();
  }
  contacts.delete();
  six.delete();
  return [...found.entries()].sort(([a], [b]) => a - b).map(([, foot]) => foot);
}

function advance(seconds) {
  for (const end = data.time + seconds - 0.5 * model.opt.timestep; data.time < end;) mujoco.mj_step(model, data);
}

advance(settle);
const first = feet();
advance(judged);
const last = feet();
if (first.length === 0 || first.length !== last.length) throw new Error(`${first.length} feet touch the ground at first, ${last.length} at the end`);
const round = value => Number(value.toPrecision(4));
const mean = values => values.reduce((sum, value) => sum + value, 0) / values.length;
const creep = axis => last.map((foot, i) => 1e3 * (foot.place[axis] - first[i].place[axis]) / judged);
console.log(JSON.stringify({
  version: mujoco.mj_versionString(),
  load_N: last.map(foot => round(foot.load)),
  depth_mm: last.map(foot => round(1e3 * foot.depth)),
  creep_mm_per_s: last.map((foot, i) => round(Math.hypot(creep(0)[i], creep(1)[i]))),
  mean_depth_mm: round(mean(last.map(foot => 1e3 * foot.depth))),
  mean_creep_mm_per_s: round(Math.hypot(mean(creep(0)), mean(creep(1)))),  // of all feet together: what legs push apart cancels
}));
