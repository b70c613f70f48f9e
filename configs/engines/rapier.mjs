// Rapier 3D, single precision, deterministic build: rigid bodies in world coordinates, joints as constraints.
import {Refusal, conjugate, contact_of, cross, dot, gap, minus, module_of, one_ground, plus, point_radius, principal, rotated, scaled, serve, times, turn_to} from "./protocol.mjs";

const rapier = await module_of("@dimforge/rapier3d-deterministic-compat");
await rapier.init();

const guide = "user guide, Integration parameters";
// Substeps, and sweeps over the constraints in each.
const iterations = {default: [4, 1], recommended: [20, 1], converged: [1, 1000]};
const constants = name => ({numSolverIterations: iterations[name][0], numInternalPgsIterations: iterations[name][1], "contact natural frequency [Hz]": 30});
const hello = {
  name: "rapier", version: rapier.version(), precision: "single",
  settings: [
    {name: "default", source: guide + ": the library's own"},
    {name: "recommended", source: guide + ": more solver iterations where accuracy counts; 20 is ours"},
    {name: "converged", source: "ours: one substep, and sweeps until joints and contacts are solved to rounding"},
  ].map(setting => ({...setting, constants: constants(setting.name)})),
  gaps: [
    gap("static friction that differs from kinetic", "noticed", "this engine has one coefficient of friction, and it is the kinetic one"),
    gap("prismatic joints", "refused", "choose engine mujoco_3_14"),
    gap("rotor inertias", "refused", "choose engine mujoco_3_14"),
    gap("links without mass", "refused", "give every link a mass"),
    gap("bases that are kept in a plane", "refused", "choose engine mujoco_3_14"),
    gap("friction of single contacts", "stated", "Rapier tells normal forces alone: what the robot's momentum needs beside them is shared among its contacts by load"),
  ],
};

const vector = a => ({x: a[0], y: a[1], z: a[2]});
const rotation = q => ({w: q[0], x: q[1], y: q[2], z: q[3]});
const list = v => [v.x, v.y, v.z];
const turn = q => [q.w, q.x, q.y, q.z];

const half = Math.SQRT1_2, from_y_to_z = [half, half, 0, 0];  // Rapier's cylinders stand along y
// Who meets whom: shapes the ground, points without a size the ground that is lowered for them.
const shapes = 1, ground = 2, points = 4, lowered = 8;
const groups = (own, others) => own << 16 | others;

function shape_of(shape) {
  const {ColliderDesc} = rapier;
  switch (shape.type) {
    case "sphere": return ColliderDesc.ball(shape.radius);
    case "point": return ColliderDesc.ball(shape.radius || point_radius);
    case "box": return ColliderDesc.cuboid(...scaled(0.5, shape.dimensions));
    case "cylinder": return ColliderDesc.cylinder(0.5 * shape.length, shape.radius);
    case "capsule": return ColliderDesc.capsule(0.5 * shape.length, shape.radius);
    case "hull": return ColliderDesc.convexHull(new Float32Array(shape.vertices)) ?? refuse("Rapier makes no hull of these vertices");
    case "triangles": return ColliderDesc.trimesh(new Float32Array(shape.vertices), new Uint32Array(shape.triangles));
    default: return refuse(`Rapier has no shape ${shape.type} here`);
  }
}
function refuse(reason) { throw new Refusal(reason); }
const axis_turn = shape => shape.type === "cylinder" || shape.type === "capsule" ? from_y_to_z : [1, 0, 0, 0];

class World {
  constructor(experiment) {
    this.experiment = experiment;
    this.ground = one_ground(experiment);
    this.world = new rapier.World(vector(experiment.gravity));
    this.world.integrationParameters.dt = experiment.deltat;
    [this.world.integrationParameters.numSolverIterations, this.world.integrationParameters.numInternalPgsIterations] = iterations[experiment.settings];
    this.add_ground();
    this.bodies = experiment.bodies.map(body => this.add_body(body));
    this.robots = [...new Set(experiment.bodies.map(body => body.robot))]
      .map(name => experiment.bodies.map((body, i) => body.robot === name && body.mobile ? i : -1).filter(i => i >= 0));
    this.joints = experiment.joints.map(joint => this.add_joint(joint));
  }

  add_ground() {
    const fixed = this.world.createRigidBody(rapier.RigidBodyDesc.fixed());
    const add = (shape, position, orientation, own, others) =>
      this.world.createCollider(this.surface(shape, 1, 1).setTranslation(...position).setRotation(rotation(orientation)).setCollisionGroups(groups(own, others)), fixed);
    for (const piece of this.experiment.ground) {
      if (piece.type === "plane") {
        // A box that is wide and deep: there are no half-spaces here.
        const wide = 100, deep = 5;
        for (const [own, others, down] of [[ground, shapes, 0], [lowered, points, point_radius]])
          add(rapier.ColliderDesc.cuboid(wide, wide, deep), scaled(piece.offset - down - deep, piece.normal), turn_to(piece.normal), own, others);
      } else {
        const place = piece.type === "triangles" ? {position: [0, 0, 0], orientation: [1, 0, 0, 0]} : piece;
        add(shape_of(piece), place.position, times(place.orientation, axis_turn(piece)), ground, shapes | points);
      }
    }
  }

  /** The coefficients of a contact are the collider's: the ground's are 1. */
  surface(shape, friction, restitution) {
    const product = rapier.CoefficientCombineRule.Multiply;
    return shape.setDensity(0).setFriction(friction).setFrictionCombineRule(product).setRestitution(restitution).setRestitutionCombineRule(product);
  }

  add_body(body) {
    const of = body.mobile ? rapier.RigidBodyDesc.dynamic() : rapier.RigidBodyDesc.fixed();
    of.setTranslation(...body.position).setRotation(rotation(body.orientation));
    const arm = rotated(body.orientation, body.center_of_mass);
    if (body.mobile) {
      const {values, turn} = principal(body.inertia);
      of.setCanSleep(false).setAdditionalMassProperties(body.mass, vector(body.center_of_mass), vector(values), rotation(turn));
      of.setLinvel(...plus(body.velocity, cross(body.angular_velocity, arm))).setAngvel(vector(body.angular_velocity));
    }
    const made = this.world.createRigidBody(of);
    const colliders = body.colliders.map(collider => {
      const contact = contact_of(this.experiment, collider.material, this.ground);
      const shape = this.surface(shape_of(collider), contact?.kinetic_friction ?? 0, contact?.restitution ?? 0);
      const bare = collider.type === "point" && !collider.radius;
      shape.setTranslation(...collider.position).setRotation(rotation(times(collider.orientation ?? [1, 0, 0, 0], axis_turn(collider))));
      shape.setCollisionGroups(bare ? groups(points, lowered) : groups(collider.type === "point" ? points : shapes, ground));
      return this.world.createCollider(shape, made);
    });
    return {made, colliders, mass: body.mass, center: body.center_of_mass, mobile: body.mobile};
  }

  add_joint(joint) {
    const z = [0, 0, 1], axis = rotated(joint.orientation, z);
    const data = rapier.JointData.revoluteWithAxes(vector(joint.position), vector([0, 0, 0]), vector(axis), vector(z));
    this.world.createImpulseJoint(data, this.bodies[joint.parent].made, this.bodies[joint.body].made, true);
    return {...joint, angle: joint.angle};
  }

  motion(body) {
    const q = turn(body.made.rotation()), spin = list(body.made.angvel());
    const center_velocity = list(body.made.linvel());
    return {position: list(body.made.translation()), orientation: q, spin, center_velocity,
            velocity: minus(center_velocity, cross(spin, rotated(q, body.center)))};
  }

  step(torques, loads, states) {
    const before = this.bodies.map(body => this.motion(body));
    const outside = this.bodies.map(() => [0, 0, 0]);
    for (const {made} of this.bodies) {
      made.resetForces(false);
      made.resetTorques(false);
    }
    for (const load of loads) {
      const {position, orientation} = before[load.body], {made} = this.bodies[load.body];
      made.addForceAtPoint(vector(load.force), vector(plus(position, rotated(orientation, load.point))), true);
      made.addTorque(vector(load.torque), true);
      outside[load.body] = plus(outside[load.body], load.force);
    }
    this.joints.forEach((joint, k) => {
      const torque = scaled(torques[k], rotated(before[joint.body].orientation, [0, 0, 1]));
      this.bodies[joint.body].made.addTorque(vector(torque), true);
      this.bodies[joint.parent].made.addTorque(vector(scaled(-1, torque)), true);
    });
    this.world.step();
    const after = this.bodies.map(body => this.motion(body));
    for (const {position, orientation, velocity, spin} of after) states.push(...position, ...orientation, ...velocity, ...spin);
    for (const joint of this.joints) states.push(...this.coordinate(joint, after));
    const contacts = this.contacts(before, after, outside);
    states.push(contacts.length);
    for (const {body, collider, place, force, depth} of contacts) states.push(body, collider, ...place, ...force, depth);
  }

  /** Position and rate of a joint, from its two bodies; the position keeps count of whole turns. */
  coordinate(joint, motions) {
    const parent = motions[joint.parent], child = motions[joint.body];
    const relative = times(conjugate(times(parent.orientation, joint.orientation)), child.orientation);
    const angle = 2 * Math.atan2(relative[3], relative[0]);
    joint.angle = angle + 2 * Math.PI * Math.round((joint.angle - angle) / (2 * Math.PI));
    return [joint.angle, dot(minus(child.spin, parent.spin), rotated(child.orientation, [0, 0, 1]))];
  }

  contacts(before, after, outside) {
    const {deltat, gravity} = this.experiment, found = [];
    for (const robot of this.robots) {
      const own = [];
      for (const i of robot)
        this.bodies[i].colliders.forEach((collider, k) => {
          this.world.contactPairsWith(collider, other => this.world.contactPair(collider, other, (manifold, flipped) => {
            // The manifold's normal is out of its first collider.
            const normal = scaled(flipped ? 1 : -1, list(manifold.normal()));
            for (let c = 0; c < manifold.numContacts(); ++c) {
              const load = manifold.contactImpulse(c) / deltat;
              const place = manifold.solverContactPoint(Math.min(c, manifold.numSolverContacts() - 1));
              if (load > 0 && place) own.push({body: i, collider: k, place: list(place), load, normal, force: scaled(load, normal), depth: -manifold.contactDist(c)});
            }
          }));
        });
      const load = own.reduce((sum, contact) => sum + contact.load, 0);
      if (load > 0) {
        let rest = [0, 0, 0];
        for (const i of robot) {
          const body = this.bodies[i];
          const gained = scaled(body.mass / deltat, minus(after[i].center_velocity, before[i].center_velocity));
          rest = plus(rest, minus(minus(gained, scaled(body.mass, gravity)), outside[i]));
        }
        for (const contact of own) rest = minus(rest, contact.force);
        for (const contact of own) contact.force = plus(contact.force, scaled(contact.load / load, rest));
      }
      found.push(...own);
    }
    return found;
  }

  close() { this.world.free(); }
}

serve(hello, experiment => new World(experiment));
