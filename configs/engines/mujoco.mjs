// Today's MuJoCo: the experiment as an MJCF text, set up as hookpoint's linked MuJoCo is (docs/reference_engines.md).
import {Refusal, contact_of, conjugate, cross, gap, minus, module_of, one_ground, plus, rotated, scaled, serve, turn_to, dot} from "./protocol.mjs";

const mujoco = await (await module_of("@mujoco/mujoco")).default();

const advice = "manual, Modeling, choice of algorithm: what to do against slip";
const elliptic = impratio => ({cone: "elliptic", impratio, tolerance: 1e-10});
const options = {
  default: {},
  recommended: elliptic(100),
  matched: elliptic(100),
  noslip: {...elliptic(100), noslip_iterations: 10},
  elliptic: elliptic(1),
  elliptic_10: elliptic(10),
  discrete: {integrator: "discrete"},
  file: {},
};
const constants = name => ({cone: "pyramidal", impratio: 1, tolerance: 1e-8, noslip_iterations: 0, integrator: "Euler", ...options[name],
  ...(name === "file" ? Object.fromEntries(["cone", "impratio", "solref", "solimp"].map(word => [word, "of the Materials"])) : {}),
  ...(name === "matched" ? {impratio: "(c_t + dt k_t)/(c + dt k)", solref: "-d k R, -d/dt; R = 1/(dt (c + dt k))", solimp: "d = A/(A + R)"} : {})});
const spring_and_damper = ["normal_stiffness", "normal_damping", "tangential_stiffness", "tangential_damping"];
const hello = {
  name: "mujoco", version: mujoco.mj_versionString(), precision: "double",
  settings: [
    {name: "default", source: "XML reference, option and geom: every attribute at its default"},
    {name: "recommended", source: advice + "; impratio of the Menagerie's legged robots, unitree_a1/a1.xml"},
    {name: "matched", source: "manual, Computation, Constraint model: solref and solimp of a spring and a damper taken implicitly"},
    {name: "noslip", source: advice + ", its last resort; 10 iterations are ours"},
    {name: "elliptic", source: advice + "; impratio 1"},
    {name: "elliptic_10", source: advice + "; impratio 10"},
    {name: "discrete", source: "XML reference, option: the integrator of that name"},
    {name: "file", source: "what the Materials state: solref, solimp, cone, impratio"},
  ].map(setting => ({...setting, constants: constants(setting.name), reads: setting.name === "matched" ? spring_and_damper : []})),
  gaps: [
    gap("links without mass", "refused", "give every link a mass"),
    gap("static friction that differs from kinetic", "noticed", "this engine has one coefficient of friction, and it is the kinetic one"),
    gap("restitution", "noticed", "MuJoCo has no coefficient of restitution: how a body rebounds follows from solref"),
    gap("height fields", "refused", "choose engine mujoco, which has them"),
  ],
};

const words = values => values.join(" ");
const least_impedance = 1e-4;  // mjMINIMP
const point_radius = 1e-6;  // m, of the ball that a point without a size is: friction acts so far below the point

/** f = -k (r + dt (v + dt a)) - c (v + dt a) as a constraint row: R = 1/(dt (c + dt k)), B = 1/dt, K d = k R. */
function row(material, dt, inverse_weight) {
  const softness = 1 / (dt * (material.normal_damping + dt * material.normal_stiffness));
  const d = Math.min(Math.max(inverse_weight / (inverse_weight + softness), least_impedance), 1 - least_impedance);
  return {solref: [-d * material.normal_stiffness * softness, -d / dt], solimp: [d, d, 0, 0.5, 1]};
}

class Model {
  constructor(experiment) {
    this.experiment = experiment;
    this.ground = one_ground(experiment);
    this.assets = "";
    this.geometries = [];  // of bodies: {name, body, collider}
  }

  text() {
    const {deltat, gravity, settings, bodies} = this.experiment;
    const option = {...options[settings]};
    const some = this.experiment.contacts[0];
    if (settings === "matched" && some)
      option.impratio = (some.tangential_damping + deltat * some.tangential_stiffness) / (some.normal_damping + deltat * some.normal_stiffness);
    if (settings === "file" && some?.mujoco) Object.assign(option, {cone: some.mujoco.cone, impratio: some.mujoco.impratio});
    const attributes = Object.entries(option).map(([name, value]) => `${name}="${value}"`).join(" ");
    const world = this.experiment.ground.map((piece, i) => this.piece(piece, i)).join("") +
      bodies.map((body, i) => body.parent < 0 ? this.body(i) : "").join("");
    return `<mujoco><compiler angle="radian" inertiafromgeom="false" balanceinertia="false" boundmass="0" boundinertia="0"/>` +
      `<option timestep="${deltat}" gravity="${words(gravity)}" ${attributes}><flag autoreset="disable"/></option>` +
      `<default><geom contype="0" conaffinity="0" margin="0" gap="0"/></default>` +
      `<asset>${this.assets}</asset><worldbody>${world}</worldbody></mujoco>`;
  }

  shape(shape, name) {
    switch (shape.type) {
      case "sphere": return `type="sphere" size="${shape.radius}"`;
      case "point": return `type="sphere" size="${shape.radius || point_radius}"`;
      case "box": return `type="box" size="${words(scaled(0.5, shape.dimensions))}"`;
      case "cylinder": return `type="cylinder" size="${shape.radius} ${0.5 * shape.length}"`;
      case "capsule": return `type="capsule" size="${shape.radius} ${0.5 * shape.length}"`;
      case "hull":
        this.assets += `<mesh name="${name}" vertex="${words(shape.vertices)}"/>`;
        return `type="mesh" mesh="${name}"`;
      default: throw new Refusal(`MuJoCo has no shape ${shape.type} here`);
    }
  }

  // Shapes meet ground of type 1, points without a size that of type 2, which is as much lower as their ball is high.
  piece(piece, i) {
    const geometry = (type, lowered) => {
      if (piece.type === "plane")
        return `<geom contype="${type}" type="plane" size="0 0 1" pos="${words(scaled(piece.offset - lowered, piece.normal))}" quat="${words(turn_to(piece.normal))}"/>`;
      return type === 2 ? "" : `<geom contype="${type}" ${this.shape(piece, `ground${i}`)} pos="${words(piece.position)}" quat="${words(piece.orientation)}"/>`;
    };
    return geometry(1, 0) + geometry(2, point_radius);
  }

  body(i) {
    const {bodies, joints} = this.experiment, body = bodies[i];
    const offset = this.offset(body);
    const joint = joints.find(each => each.body === i);
    let position = body.position, orientation = body.orientation, inner = "";
    if (joint) {
      position = minus(joint.position, this.offset(bodies[joint.parent]));
      orientation = joint.orientation;
      inner = `<joint name="j${i}" type="${joint.type === "prismatic" ? "slide" : "hinge"}" axis="0 0 1" armature="${joint.rotor_inertia}"/>`;
    } else if (body.keeps_in_plane) {
      const to_body = conjugate(orientation), axes = this.plane(body);
      inner = `<joint name="j${i}" type="slide" axis="${words(rotated(to_body, axes[0]))}"/><joint type="slide" axis="${words(rotated(to_body, axes[1]))}"/>` +
        `<joint type="hinge" axis="${words(rotated(to_body, axes[2]))}"/>`;
    } else if (body.mobile) {
      inner = `<freejoint name="j${i}"/>`;
    }
    position = plus(position, rotated(orientation, offset));
    if (body.mobile)
      inner += `<inertial mass="${body.mass}" pos="${words(minus(body.center_of_mass, offset))}" fullinertia="${words(body.inertia)}"/>`;
    body.colliders.forEach((collider, k) => {
      const contact = contact_of(this.experiment, collider.material, this.ground);
      const friction = contact?.kinetic_friction ?? 0, name = `c${i}_${k}`;
      this.geometries.push({name, body: i, collider: k, material: collider.material});
      inner += `<geom name="${name}" conaffinity="${collider.type === "point" && !collider.radius ? 2 : 1}" priority="1" condim="${friction > 0 ? 3 : 1}" ` +
        `friction="${friction} 0.005 0.0001" ${this.shape(collider, name)} pos="${words(minus(collider.position, offset))}" quat="${words(collider.orientation ?? [1, 0, 0, 0])}"/>`;
    });
    const children = bodies.map((child, k) => child.parent === i ? this.body(k) : "").join("");
    return `<body name="b${i}" pos="${words(position)}" quat="${words(orientation)}">${inner}${children}</body>`;
  }

  // A free joint is integrated where the body's frame is: at its centre of mass.
  offset(body) { return body.parent < 0 && body.mobile ? body.center_of_mass : [0, 0, 0]; }
  plane(body) {
    const n = body.keeps_in_plane, first = [n[2], n[0], n[1]];
    return [first, cross(n, first), n];
  }
}

class World {
  constructor(experiment) {
    this.experiment = experiment;
    const text = new Model(experiment);
    try {
      this.model = mujoco.MjModel.from_xml_string(text.text());
    } catch (error) {
      if (error instanceof Refusal) throw error;
      throw new Refusal(`MuJoCo does not compile it: ${error.message ?? error}`);
    }
    this.text = text;
    this.data = new mujoco.MjData(this.model);
    this.six = new mujoco.DoubleBuffer(6);
    const geom = mujoco.mjtObj.mjOBJ_GEOM.value, body = mujoco.mjtObj.mjOBJ_BODY.value, joint = mujoco.mjtObj.mjOBJ_JOINT.value;
    this.kind = mujoco.mjtObj.mjOBJ_XBODY.value;
    this.colliders = new Map(text.geometries.map(each => [mujoco.mj_name2id(this.model, geom, each.name), each]));
    this.bodies = experiment.bodies.map((each, i) => mujoco.mj_name2id(this.model, body, `b${i}`));
    this.joints = experiment.joints.map(each => mujoco.mj_name2id(this.model, joint, `j${each.body}`));
    this.soften();
    this.start(joint);
  }

  soften() {
    if (!["matched", "file"].includes(this.experiment.settings)) return;
    for (const [id, each] of this.colliders) {
      const material = contact_of(this.experiment, each.material, this.text.ground);
      const stated = this.experiment.settings === "file";
      if (!material || (stated && !material.mujoco)) continue;  // MuJoCo's own defaults stay
      const {solref, solimp} = stated ? material.mujoco : row(material, this.experiment.deltat, this.model.body_invweight0[2 * this.bodies[each.body]]);
      solref.forEach((value, k) => { this.model.geom_solref[2 * id + k] = value; });
      solimp.forEach((value, k) => { this.model.geom_solimp[5 * id + k] = value; });
    }
  }

  start(joint_kind) {
    const {qpos, qvel} = this.data, {jnt_qposadr, jnt_dofadr} = this.model;
    this.experiment.joints.forEach((joint, k) => {
      qpos[jnt_qposadr[this.joints[k]]] = joint.angle;
      qvel[jnt_dofadr[this.joints[k]]] = joint.rate;
    });
    this.experiment.bodies.forEach((body, i) => {
      if (body.parent >= 0 || !body.mobile) return;
      const at = jnt_dofadr[mujoco.mj_name2id(this.model, joint_kind, `j${i}`)];
      const velocity = plus(body.velocity, cross(body.angular_velocity, rotated(body.orientation, this.text.offset(body))));
      const turn = rotated(conjugate(body.orientation), body.angular_velocity);
      const axes = body.keeps_in_plane && this.text.plane(body);
      const rates = axes ? [dot(velocity, axes[0]), dot(velocity, axes[1]), dot(body.angular_velocity, axes[2])] : [...velocity, ...turn];
      rates.forEach((rate, k) => { qvel[at + k] = rate; });
    });
    this.see();
  }

  // Places and speeds at the present coordinates; the last step's contacts stay.
  see() {
    mujoco.mj_kinematics(this.model, this.data);
    mujoco.mj_comPos(this.model, this.data);
    mujoco.mj_comVel(this.model, this.data);
  }

  motion(i) {
    const {xpos, xquat} = this.data, id = this.bodies[i];
    mujoco.mj_objectVelocity(this.model, this.data, this.kind, id, this.six, 0);
    const six = this.six.GetView(), spin = [six[0], six[1], six[2]];
    const q = Array.from(xquat.subarray(4 * id, 4 * id + 4));
    const arm = rotated(q, this.text.offset(this.experiment.bodies[i]));
    return {position: minus(Array.from(xpos.subarray(3 * id, 3 * id + 3)), arm), orientation: q,
            velocity: minus([six[3], six[4], six[5]], cross(spin, arm)), spin};
  }

  step(torques, loads, states) {
    const {data, model} = this;
    data.qfrc_applied.fill(0);
    data.xfrc_applied.fill(0);
    for (const load of loads) {
      const id = this.bodies[load.body], {position, orientation} = this.motion(load.body);
      const point = plus(position, rotated(orientation, load.point));
      // xfrc_applied acts at the centre of mass.
      const arm = minus(point, Array.from(data.xipos.subarray(3 * id, 3 * id + 3)));
      const torque = plus(load.torque, cross(arm, load.force));
      for (let k = 0; k < 3; ++k) {
        data.xfrc_applied[6 * id + k] += load.force[k];
        data.xfrc_applied[6 * id + 3 + k] += torque[k];
      }
    }
    this.joints.forEach((joint, k) => { data.qfrc_applied[model.jnt_dofadr[joint]] += torques[k]; });
    mujoco.mj_step(model, data);
    const contacts = this.contacts();
    this.see();
    for (let i = 0; i < this.bodies.length; ++i) {
      const {position, orientation, velocity, spin} = this.motion(i);
      states.push(...position, ...orientation, ...velocity, ...spin);
    }
    for (const joint of this.joints) states.push(data.qpos[model.jnt_qposadr[joint]], data.qvel[model.jnt_dofadr[joint]]);
    states.push(contacts.length / 9, ...contacts);
  }

  contacts() {
    const told = [], all = this.data.contact;
    for (let i = 0; i < this.data.ncon; ++i) {
      const contact = all.get(i);
      const first = this.colliders.get(contact.geom1), second = this.colliders.get(contact.geom2);
      mujoco.mj_contactForce(this.model, this.data, i, this.six);
      const f = this.six.GetView(), frame = contact.frame, sign = second ? 1 : -1;
      if (f[0] > 0) {
        const force = [0, 1, 2].map(k => sign * (f[0] * frame[k] + f[1] * frame[3 + k] + f[2] * frame[6 + k]));
        const {body, collider} = second ?? first;
        told.push(body, collider, ...contact.pos, ...force, -contact.dist);
      }
      contact.delete();
    }
    all.delete();
    return told;
  }

  close() {
    for (const part of [this.six, this.data, this.model]) part.delete();
  }
}

serve(hello, experiment => new World(experiment));
